// report.html of a results.json, with the part "report" alone.
#include <fstream>
#include <iterator>

#include <errmap/cli/report/report.h>

int main(int argc, char** argv) {
  using namespace errmap;
  if (argc != 3) return 2;
  std::ifstream file(argv[1]);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  std::ofstream(argv[2]) << report::ReportHtml(models::FromJsonText(text));
}
