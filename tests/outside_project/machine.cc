// What compensation is worth at the tool, on days that no map has seen.
#include <fstream>
#include <iostream>

#include <errmap/errmap.h>

int main(int argc, char** argv) {
  using namespace errmap;
  if (argc != 4) return 2;  // machine.toml, the folder of its data, results
  const auto study = machine::ReadMachineStudy(argv[1], argv[2], 2);
  auto plan = machine::PlanOfMachine(
      study, {.holdouts = {"sessions:4"}, .models = {"poly:ridge:view=raw"}});
  const auto run = study_setup::RunPlan(
      std::move(plan), "machine", {.jobs = 2, .keep_fold_maps = true});
  auto record = study_setup::RecordOf(run);
  machine::AddMachine(machine::JudgeMachine(study, run), &record);
  std::ofstream(argv[3]) << models::ToJsonText(record);
  std::cout << report::ScreenText(record);
}
