#include "cli/application.h"

int main(int argc, char** argv) {
  return errmap::cli::RunApplication(argc, argv);
}
