#include "cli/machine/machine_study.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "cli/machine/true_poses.h"
#include "cli/study_setup/provenance.h"
#include "data/argument_name.h"
#include "data/columns.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/dataset.h"
#include "data/measurements/sessions.h"
#include "data/text.h"

namespace errmap::machine {
namespace {

constexpr const char* kPoints = "tool_tip.csv";
constexpr const char* kDiagonals = "diagonals.csv";

std::string SessionColumn(const data::CsvTable& points,
                          const std::string& wanted) {
  std::vector<std::string> names(data::kSessionColumns.begin(),
                                 data::kSessionColumns.end());
  if (!wanted.empty()) names = {wanted};
  for (const std::string& name : names) {
    if (points.Find(name) >= 0) return name;
  }
  throw data::InputError(fmt::format(
      "{}: no column {} that tells days apart; add one, or name it with {}",
      data::PrintablePath(points.file),
      wanted.empty() ? data::kSessionColumnsText : data::QuotedName(wanted),
      data::ArgumentName("session")));
}

// One map is asked for of each, and PlanStudy plans two where rows go both
// ways.
void RequireOneWay(const MachineStudy& study,
                   const study_setup::StudyPlan& plan) {
  for (const std::string& stem : study.stems) {
    if (std::ranges::any_of(plan.config.components,
                            [&](const study_setup::ComponentConfig& component) {
                              return component.name == stem;
                            })) {
      continue;
    }
    throw data::InputError(fmt::format(
        "{}: its rows go both ways, and {} asks for one map of them, {}.json; "
        "make a file of each way, and name both maps there: {{ forward = ..., "
        "reverse = ... }}",
        data::PrintablePath(study.FileNamed(stem + ".csv")),
        data::PrintablePath(study.path),
        data::PrintablePath(stem)));
  }
}

// Better refused before the fits than after them.
void RequireQuantities(const MachineStudy& study,
                       const study_setup::StudyPlan& plan) {
  const models::Machine& machine = study.file.machine;
  for (std::size_t k = 0; k < machine.errors.size(); ++k) {
    const data::Unit wanted =
        models::UnitOf(machine, machine.chain.errors()[k].direction);
    for (const models::ErrorSource& source : machine.errors[k].sources) {
      if (source.file.empty()) continue;
      const std::string stem = StemOf(source.file);
      for (const models::ComponentPlan& component : plan.components) {
        if (component.comparison.name != stem) continue;
        const data::ColumnInfo& target =
            component.comparison.data.dataset.target();
        if (data::AreConvertible(target.unit, wanted)) continue;
        throw data::InputError(fmt::format(
            "{}: {} is in {}, and {} of {} is {}; an error in another quantity "
            "has its unit in the column's name",
            data::PrintablePath(component.comparison.data.dataset.source()),
            data::QuotedName(target.name),
            target.unit.symbol.empty() ? "no unit" : target.unit.symbol,
            machine.errors[k].name,
            data::PrintablePath(study.path),
            wanted.quantity == data::Quantity::kAngle ? "an angle"
                                                      : "a length"));
      }
    }
  }
}

// Days that are named otherwise in one file would be learnt from and judge.
void RequireSharedSessions(const MachineStudy& study,
                           const study_setup::StudyPlan& plan) {
  const std::vector<std::string> of_points =
      data::GroupByColumn(
          study.points, study.session, data::AllRows(study.points.num_rows))
          .labels;
  for (const models::ComponentPlan& component : plan.components) {
    const std::vector<std::string>& labels =
        component.comparison.data.dataset.log()->sessions.labels;
    if (std::ranges::find_first_of(labels, of_points) != labels.end()) continue;
    throw data::InputError(fmt::format(
        "{}: none of its sessions ({}) is one of {} ({}), so those that judge "
        "cannot be kept from the fits; name them alike",
        data::PrintablePath(component.comparison.data.dataset.source()),
        data::ListOfNames(labels),
        data::PrintablePath(study.points.file),
        data::ListOfNames(of_points)));
  }
}

}  // namespace

std::string StemOf(const std::string& file) {
  return std::filesystem::path(file).replace_extension().string();
}

std::string MachineStudy::FileNamed(const std::string& name) const {
  return (std::filesystem::path(folder) / name).string();
}

MachineStudy ReadMachineStudy(const std::string& machine,
                              const std::string& folder,
                              int later,
                              const std::string& session) {
  MachineStudy study{
      .path = machine, .folder = folder, .file = ReadMachineOutline(machine)};
  study.points = data::ReadCsv(study.FileNamed(kPoints));
  for (const models::MachineError& error : study.file.machine.errors) {
    for (const models::ErrorSource& source : error.sources) {
      if (source.file.empty()) continue;
      const std::string stem = StemOf(source.file);
      if (std::ranges::find(study.stems, stem) == study.stems.end()) {
        study.stems.push_back(stem);
      }
    }
  }
  if (study.stems.empty()) {
    throw data::InputError(fmt::format(
        "{}: names no map STEM.json, and so no data STEM.csv to compare",
        data::PrintablePath(machine)));
  }
  study.session = SessionColumn(study.points, session);
  const data::Grouping sessions = data::GroupByColumn(
      study.points, study.session, data::AllRows(study.points.num_rows));
  const auto count = static_cast<int>(sessions.labels.size());
  if (count <= later) {
    throw data::InputError(fmt::format(
        "{}: {} by {}, and {} of them are to judge; more days are needed",
        data::PrintablePath(study.points.file),
        count == 1 ? "1 session" : fmt::format("{} sessions", count),
        data::QuotedName(study.session),
        data::ArgumentName("later", std::to_string(later))));
  }
  study.later.assign(sessions.labels.end() - later, sessions.labels.end());
  // Better refused now than after the fits.
  MakeTruePoses(study.points, study.file.machine, study.session);
  const std::string diagonals = study.FileNamed(kDiagonals);
  if (std::filesystem::exists(diagonals)) {
    study.diagonals = data::ReadCsv(diagonals);
    if (!ReadDiagonalRuns(*study.diagonals)) {
      throw data::InputError(fmt::format("{}: no column 'diagonal'",
                                         data::PrintablePath(diagonals)));
    }
    MakeTruePoses(*study.diagonals, study.file.machine, study.session);
  }
  return study;
}

study_setup::StudyPlan PlanOfMachine(const MachineStudy& study,
                                     study_setup::StudyConfig config,
                                     const study_setup::Remark& remark) {
  const study_setup::ComponentConfig like = config.components.empty()
                                                ? study_setup::ComponentConfig{}
                                                : config.components.front();
  config.components.clear();
  for (const std::string& stem : study.stems) {
    study_setup::ComponentConfig component = like;
    component.name = stem;
    component.data = study.FileNamed(stem + ".csv");
    component.selection.session = study.session;
    component.later = study.later;
    config.components.push_back(std::move(component));
  }
  study_setup::StudyPlan plan = study_setup::PlanStudy(config, remark);
  RequireOneWay(study, plan);
  RequireQuantities(study, plan);
  RequireSharedSessions(study, plan);
  plan.inputs.push_back(study_setup::HashInput(study.path));
  plan.inputs.push_back(study_setup::HashInput(study.points.file));
  if (study.diagonals) {
    plan.inputs.push_back(study_setup::HashInput(study.diagonals->file));
  }
  return plan;
}

}  // namespace errmap::machine
