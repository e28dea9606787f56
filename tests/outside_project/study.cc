// A study.toml read, planned, run and judged: results.json and the report.
#include <fstream>
#include <iostream>

#include <errmap/errmap.h>

int main(int argc, char** argv) {
  using namespace errmap;
  if (argc != 4) return 2;
  const auto study = study_setup::ReadStudyFile(argv[1], {"seed=2"});
  const auto say = [](const std::string& line) { std::cout << line << "\n"; };
  auto plan = study_setup::PlanStudy(study, say);
  const auto run = study_setup::RunPlan(std::move(plan), "study", {.jobs = 2});
  const auto record = study_setup::RecordOf(run);
  std::ofstream(argv[2]) << models::ToJsonText(record);
  std::ofstream(argv[3]) << report::ReportHtml(record);
  std::cout << report::ScreenText(record);
}
