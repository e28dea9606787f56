#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/control/export_tables.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/number_text.h"
#include "cli/shell/command_options.h"
#include "cli/study_setup/given_error.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/text.h"
#include "data/throwing_as.h"
#include "models/export/compensation_table.h"
#include "models/export/export_map.h"
#include "models/export/program/controller.h"
#include "models/export/program/safe_names.h"
#include "models/export/program_text.h"

namespace errmap::cli {
namespace {

struct ExportArguments {
  std::string model;
  bool c = false;
  bool python = false;
  std::vector<models::TextForm> text;
  bool single = false;
  bool table = false;
  bool linuxcnc = false;
  bool hal = false;
  int joint = 0;
  std::string max_offset;
  std::string max_rate;
  std::string every;
  TableArguments tables;
  std::string out;
  std::string name;
  bool force = false;
  bool quiet = false;
};

// In the target's unit; nothing where the flag is not given.
std::optional<double> LimitOf(const char* flag,
                              const std::string& text,
                              const data::Unit& target) {
  if (text.empty()) return std::nullopt;
  return data::ThrowingAs<UsageError>(flag + std::string(" "), [&] {
    return study_setup::InUnitOf(target, ErrorOfFlag(flag, text, false));
  });
}

models::LimitOptions LimitsOf(const ExportArguments& arguments,
                              const data::Unit& target) {
  return {.max_error = LimitOf("--max-offset", arguments.max_offset, target),
          .max_rate = LimitOf("--max-rate", arguments.max_rate, target)};
}

bool WritesProgram(const ExportArguments& arguments) {
  return arguments.c || arguments.python || !arguments.text.empty() ||
         arguments.hal;
}

// The maps as they are named: one for both directions, or one for each.
std::vector<std::string> MapsOf(const ExportArguments& arguments) {
  const TableArguments& tables = arguments.tables;
  if (!arguments.model.empty()) return {arguments.model};
  return {tables.increasing, tables.decreasing};
}

models::MapExport Prepare(const ExportArguments& arguments,
                          const std::vector<models::FittedModel>& maps) {
  const std::vector<std::string> files = MapsOf(arguments);
  const std::string name =
      !arguments.name.empty()
          ? arguments.name
          : models::SafeIdentifier(
                std::filesystem::path(files.front()).stem().string(),
                models::kLongestMapName);
  if (!arguments.name.empty() &&
      models::SafeIdentifier(name, models::kLongestMapName) != name) {
    throw UsageError(fmt::format(
        "--name takes letters, digits and single '_', a letter first, at most "
        "{} of them; such as {}",
        models::kLongestMapName,
        models::SafeIdentifier(name, models::kLongestMapName)));
  }
  using models::Motion;
  std::vector<const models::FittedModel*> of_export;
  std::string file;
  try {
    for (std::size_t k = 0; k < maps.size(); ++k) {
      file = files[k];
      of_export.push_back(&maps[k]);
      if (!WritesProgram(arguments)) continue;
      models::RequireMadeFor(maps[k],
                             maps.size() == 1 ? Motion::kAny
                             : k == 0         ? Motion::kIncreasing
                                              : Motion::kDecreasing);
    }
    return models::PrepareExport(of_export,
                                 name,
                                 arguments.single ? models::Precision::kSingle
                                                  : models::Precision::kDouble,
                                 LimitsOf(arguments, maps.front().target.unit));
  } catch (const std::invalid_argument& error) {
    throw data::InputError(
        fmt::format("{}: {}", data::PrintablePath(file), error.what()));
  }
}

std::vector<models::ExportedFile> HalFiles(const ExportArguments& arguments,
                                           const models::MapExport& map) {
  return data::ThrowingAs<data::InputError>(map.name + ": ", [&] {
    return models::HalComponent(
               map,
               {.unit = data::UnitOfSymbol(arguments.tables.units),
                .joint = arguments.joint})
        .files;
  });
}

std::vector<models::ExportedFile> FilesOf(const ExportArguments& arguments,
                                          const models::MapExport& map) {
  std::vector<models::ExportedFile> files;
  const auto add = [&](std::vector<models::ExportedFile> more) {
    for (models::ExportedFile& file : more) files.push_back(std::move(file));
  };
  if (arguments.c) {
    add(models::CCode(
        map.program, map.name, map.precision, map.rows, map.tolerance()));
  }
  if (arguments.python) {
    add(models::PythonCode(map.program, map.name, map.rows, map.tolerance()));
  }
  for (const models::TextForm form : arguments.text) {
    files.push_back(
        models::StructuredText(map.program, map.name, map.precision, form));
  }
  if (arguments.hal) add(HalFiles(arguments, map));
  return files;
}

void SayWhatWasWritten(const models::MapExport& map,
                       const std::vector<std::string>& files,
                       const std::string& folder) {
  const std::string& unit = map.program.target.unit.symbol;
  Warn(fmt::format(
      "{} in {}", data::JoinWords(files, ", "), data::PrintablePath(folder)));
  if (map.program.has_directions()) {
    const models::ControllerLimits& limits = map.program.limits;
    Warn(
        fmt::format("the first map acts while the position increases, the "
                    "second while it decreases: a turn counts after {:.3g}, "
                    "and moves it by at most {}",
                    limits.band,
                    report::ErrorText(map.program.target.unit, limits.reversal)
                        .WithUnit(limits.reversal)));
  }
  Warn(fmt::format(
      "{}: error{} of {}, {} of state; compensation = -error",
      map.name,
      unit.empty() ? "" : " in " + unit,
      report::Count(map.program.size(models::Space::kReading), "input"),
      report::Count(map.program.size(models::Space::kState), "number")));
  Warn(
      fmt::format("its arithmetic agrees with errmap predict to {:.1e} of the "
                  "error's range at {}; its self-test runs {} others",
                  map.deviations.anywhere,
                  report::Count(static_cast<long long>(map.num_checked), "row"),
                  map.rows.size()));
  if (map.deviations.inside > models::AllowedDeviation(map.precision)) {
    Warn(
        "warning: terms of the map cancel; a penalised map (poly:ridge) would "
        "be more stable");
  }
}

// Those sensors that would do most.
void SayWhatFailuresDo(const models::MapProgram& program) {
  constexpr std::size_t kMost = 3;
  const data::Unit& unit = program.target.unit;
  const models::ControllerLimits& limits = program.limits;
  const report::ErrorText text(unit, limits.max_error);
  Warn(fmt::format(
      "limits: {}, and {} each second",
      text.WithUnit(limits.max_error),
      report::ErrorText(unit, limits.max_rate).WithUnit(limits.max_rate)));
  if (limits.own_error > 0.0 &&
      limits.max_error > models::kMostTimesOwn * limits.own_error) {
    Warn(fmt::format(
        "warning: --max-offset is {:.0f} times the map's own limit, {}; write "
        "its unit, such as 20um",
        limits.max_error / limits.own_error,
        text.WithUnit(limits.own_error)));
  }
  for (const models::ProgramReading& reading : program.readings) {
    if (reading.is_position || !models::IsCount(reading.column.unit)) continue;
    Warn(
        fmt::format("{} is counted, not measured: no check finds it wrong, so "
                    "restart it with each session",
                    data::NameInRemark(reading.column.name)));
  }
  const std::vector<models::FailingSensor> sensors =
      models::WorstOfFailing(program);
  for (std::size_t i = 0; i < std::min(kMost, sensors.size()); ++i) {
    Warn(
        fmt::format("unchecked, a failing {} could shift the compensation by "
                    "{}; checks and limits keep it within {}",
                    data::NameInRemark(sensors[i].name),
                    text.WithUnit(sensors[i].without),
                    text.WithUnit(sensors[i].with)));
  }
}

void CheckArguments(const ExportArguments& arguments) {
  const bool program = WritesProgram(arguments);
  if (!program && !arguments.table && !arguments.linuxcnc) {
    throw UsageError(
        "export: say what to write: --c, --python, --st, --scl, --plcopen, "
        "--hal, --table or --linuxcnc");
  }
  if (!program && !arguments.max_rate.empty()) {
    throw UsageError(
        "export: --max-rate is for programs; a table has no time, and acts as "
        "fast as the axis moves");
  }
  if (arguments.single && (arguments.python || arguments.hal ||
                           !(arguments.c || !arguments.text.empty()))) {
    throw UsageError(
        "export: --float is only for --c, --st, --scl and --plcopen");
  }
  if (arguments.linuxcnc && (program || arguments.table)) {
    throw UsageError(
        "export: --linuxcnc writes one file; give no other format");
  }
  const bool increasing = !arguments.tables.increasing.empty();
  const bool decreasing = !arguments.tables.decreasing.empty();
  if (!arguments.linuxcnc &&
      (arguments.model.empty() ? !(increasing && decreasing)
                               : increasing || decreasing)) {
    throw UsageError(
        "export: name the model file, or two: --increasing FILE.json and "
        "--decreasing FILE.json, the directions of motion");
  }
  if (arguments.table && arguments.model.empty()) {
    throw UsageError("export: --table takes one map");
  }
}

int RunExport(const ExportArguments& arguments) {
  CheckArguments(arguments);
  if (arguments.linuxcnc) {
    ExportLinuxcnc(
        arguments.model,
        arguments.tables,
        [&](const data::Unit& target) { return LimitsOf(arguments, target); },
        arguments.out,
        arguments.quiet);
    return kDone;
  }
  std::vector<models::FittedModel> maps;
  for (const std::string& file : MapsOf(arguments)) {
    maps.push_back(LoadForControl(file, arguments.every, arguments.quiet));
  }
  const models::MapExport map = Prepare(arguments, maps);
  std::vector<models::ExportedFile> files = FilesOf(arguments, map);
  std::string of_table;
  if (arguments.table) {
    files.push_back(
        ExportTable(maps.front(), map, arguments.tables, &of_table));
  }
  std::vector<std::string> names;
  for (const models::ExportedFile& file : files) names.push_back(file.name);
  ClaimedFolder folder(arguments.out,
                       names,
                       {arguments.model,
                        arguments.tables.increasing,
                        arguments.tables.decreasing,
                        arguments.tables.log},
                       arguments.force);
  for (const models::ExportedFile& file : files) {
    folder.Write(file.name, file.content);
  }
  folder.Finish();
  if (!arguments.quiet) {
    SayWhatWasWritten(map, names, arguments.out);
    SayWhatFailuresDo(map.program);
    if (!of_table.empty()) Warn(of_table);
  }
  return kDone;
}

void AddTableOptions(CLI::App* command, TableArguments* tables) {
  AddOption(command, "--increasing FILE.json", tables->increasing)
      .About(
          "Map of motion towards increasing positions, in place of MODEL\n(on "
          "some slides that is the reverse)");
  AddOption(command, "--decreasing FILE.json", tables->decreasing)
      .About(
          "Map of motion towards decreasing positions; one exported file has "
          "both");
  AddOption(command, "--at NAME=VALUE,...", tables->at)
      .About("Tables: thermal state (default: the trained means)");
  AddOption(command, "--log FILE.csv", tables->log)
      .About("Tables: thermal state at the end of this session");
  AddOption(command, "--row", tables->row)
      .About("Row of --log to use, from 0 (default: the last)")
      .NotNegative();
  AddOption(command, "--resolution", tables->resolution)
      .About("--linuxcnc: round errors to this (machine unit)")
      .Positive();
  AddOption(command, "--units", tables->units)
      .About("--hal, --linuxcnc: the machine's unit of length")
      .OneOf({"mm", "in"})
      .ShowDefault();
  AddOption(command, "--points", tables->points)
      .About("--linuxcnc: largest number of points")
      .Range(2, models::kMostCompPoints)
      .ShowDefault();
  AddOption(command, "--over NAME", tables->over)
      .About(
          "--table: the input across the columns (default: the only one beside "
          "the position)");
  AddOption(command, "--grid ROWSxCOLUMNS", tables->grid)
      .About("--table: positions and columns")
      .ShowDefault();
}

}  // namespace

void AddExportCommand(CLI::App* app, Run* run) {
  const Command<ExportArguments> command(
      app, run, "export", "Write a map as a program that a controller runs");
  AddOption(command, "MODEL FILE.json", command->model).About("Model file");
  AddFlag(command, "--c", command->c).About("NAME.h and NAME.c in C99");
  AddFlag(command, "--python", command->python)
      .About("NAME.py in plain Python 3");
  const auto add_text =
      [&](const char* flag, models::TextForm form, const char* what) {
        AddFlag(command, flag, [command, form] {
          command->text.push_back(form);
        }).About(what);
      };
  add_text("--st",
           models::TextForm::kStandard,
           "NAME.st in IEC 61131-3 structured text");
  add_text("--scl",
           models::TextForm::kScl,
           "NAME.scl, the same for Siemens' TIA Portal");
  add_text("--plcopen",
           models::TextForm::kPlcOpen,
           "NAME.xml, the same as PLCopen XML");
  AddFlag(command, "--float", command->single)
      .About(
          "Use single precision: in C except for the state, in structured text "
          "throughout (REAL)");
  AddOption(command, "-o,--output DIR", command->out)
      .About("Folder to write into; of --linuxcnc the file")
      .Required()
      .Under(kOutputOptions);
  AddOption(command, "--name NAME", command->name)
      .About("Prefix of all symbols (default: the file's name)");
  AddFlag(command, "--hal", command->hal)
      .About("A LinuxCNC component (.comp) and its wiring (.hal)");
  AddOption(command, "--joint", command->joint)
      .About("--hal: joint to compensate")
      .Range(0, 8)
      .ShowDefault();
  AddFlag(command, "--table", command->table)
      .About("NAME.csv, a table over position and one input");
  AddFlag(command, "--linuxcnc", command->linuxcnc)
      .About("A COMP_FILE of type 0 for a joint of LinuxCNC");
  AddOption(command, "--max-offset X", command->max_offset)
      .About(
          "Largest compensation: 20um (default: 1.3 times the errors' span)");
  AddOption(command, "--max-rate X", command->max_rate)
      .About(
          "Largest change per second: 1um (default: 10um)\n10 urad for angles");
  AddEveryOption(command, &command->every);
  AddTableOptions(command, &command->tables);
  AddForceFlag(command, &command->force);
  AddQuietFlag(command, &command->quiet);
  MarkSeldom(command,
             {"--float",
              "--joint",
              "--row",
              "--points",
              "--over",
              "--grid",
              "--resolution"});
  SetFooter(
      command,
      R"(Every file states its inputs, their order and units, and the sign: compensation = -error.
Before it is written, it is checked against errmap predict. It can test itself:
  cc -DNAME_SELF_TEST NAME.c -lm && ./a.out
In a COMP_FILE, the forward column is for increasing positions.
Example: errmap export map.json --c -o control)");
  command.Runs(RunExport);
}

}  // namespace errmap::cli
