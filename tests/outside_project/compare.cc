// What `errmap compare` does: which map to use, results.json and the report.
#include <fstream>
#include <iostream>

#include <errmap/errmap.h>

int main(int argc, char** argv) {
  using namespace errmap;
  if (argc != 4) return 2;
  const auto study = models::CompareMaps(argv[1], {}, {.jobs = 2});
  const auto record = report::MakeRecord({study}, 1);
  std::ofstream(argv[2]) << models::ToJsonText(record);
  std::ofstream(argv[3]) << report::ReportHtml(record);
  std::cout << report::VerdictText(record.components[0]) << "\n";
}
