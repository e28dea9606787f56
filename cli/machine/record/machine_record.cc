#include "cli/machine/record/machine_record.h"

#include <fmt/format.h>

#include "cli/report/figures/figures.h"
#include "data/argument_name.h"
#include "models/record_json.h"

namespace errmap::machine {
namespace {

// Throws data::InputError naming what is of another type.
MachineRecord MachineOfJson(const std::string& json) {
  models::record_json::Tree tree;
  MachineRecord machine;
  std::string misfit;
  if (!tree.Parse(json) || !models::FromJson(*tree.root(), &machine, &misfit)) {
    models::record_json::RefuseMisfit(
        fmt::format(".{}{}", kMachineKey, misfit),
        models::kResultsSchema,
        fmt::format("errmap compare with {} rewrites it",
                    data::ArgumentName("out")));
  }
  return machine;
}

report::RecordPart PartOf(const std::string& json) {
  const MachineRecord machine = MachineOfJson(json);
  return {.id = kMachineKey,
          .title = "The machine",
          .link = "The machine: the error at the tool",
          .answer = MachineAnswer(machine),
          .screen = ScreenTables(machine),
          .tables = MachineTables(machine),
          .figures = MachineFigures(machine)};
}

}  // namespace

void AddMachine(const MachineRecord& machine, models::StudyRecord* record) {
  record->others.emplace_back(kMachineKey, models::JsonText(machine, -1));
}

report::RecordPartMaker AsRecordPart() { return {kMachineKey, PartOf}; }

}  // namespace errmap::machine
