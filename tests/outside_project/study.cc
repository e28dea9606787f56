// A study.toml read, planned, run and judged: results.json and the report.
#include <fstream>
#include <iostream>

#include <errmap/errmap.h>

int main(int argc, char** argv) {
  using namespace errmap;
  if (argc != 4) return 2;
  const auto study = desk::ReadStudyFile(argv[1], {"seed=2"});
  const auto say = [](const std::string& line) { std::cout << line << "\n"; };
  auto plan = desk::PlanStudy(study, say);
  const auto run = desk::RunPlan(std::move(plan), "study", {.jobs = 2});
  const auto record = desk::RecordOf(run);
  std::ofstream(argv[2]) << models::ToJsonText(record);
  std::ofstream(argv[3]) << report::ReportHtml(record);
  std::cout << report::ScreenText(record);
}
