#include "cli/command.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

// Matrices of some megabytes come and go by the thousand: to give each back and
// to ask for its pages again took a twentieth of a comparison.
void KeepFreedMemory() {
#ifdef __GLIBC__
  constexpr int kMegabyte = 1 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);  // the most it takes
  mallopt(M_TRIM_THRESHOLD, 256 * kMegabyte);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  KeepFreedMemory();
  return errmap::cli::RunApplication(argc, argv);
}
