#include "cli/commands/control/export_tables.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/output/claimed_folder.h"
#include "data/atomic_file.h"
#include "data/input_error.h"
#include "data/text.h"
#include "models/export/compensation_table.h"
#include "models/export/error_curve.h"
#include "models/history/map_log.h"
#include "models/model_file.h"
#include "models/report/number_text.h"

namespace errmap::cli {
namespace {

using Eigen::Index;
using models::ErrorCurve;
using models::HeldReading;

std::vector<HeldReading> ParseHeld(const std::string& text) {
  std::vector<HeldReading> held;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view item = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(item.size() + 1, rest.size()));
    const std::size_t equals = item.rfind('=');
    double value = 0.0;
    if (equals == std::string_view::npos || equals == 0 ||
        !data::ParseNumber(item.substr(equals + 1), &value)) {
      throw UsageError(fmt::format("--at: '{}' is not NAME=VALUE", item));
    }
    held.emplace_back(std::string(data::Trimmed(item.substr(0, equals))),
                      value);
  }
  return held;
}

// A map that tables are made of; what refers to what stays in place.
struct TableMap {
  std::string file;
  models::FittedModel fitted;
  models::MapProgram program;
};

TableMap LoadTableMap(const std::string& file) {
  TableMap map{.file = file, .fitted = models::LoadModel(file), .program = {}};
  try {
    map.program = models::MakeMapProgram(map.fitted);
  } catch (const std::invalid_argument& error) {
    throw data::InputError(
        fmt::format("{}: {}", data::PrintablePath(file), error.what()));
  }
  return map;
}

// Every name of --at must be an input of some map, and not the position.
void CheckHeld(const std::vector<HeldReading>& held,
               const std::vector<const models::MapProgram*>& programs) {
  std::vector<std::string> known;
  for (const models::MapProgram* program : programs) {
    const int position = models::PositionOf(*program);
    for (std::size_t i = 0; i < program->readings.size(); ++i) {
      if (static_cast<int>(i) == position) continue;
      known.push_back(program->readings[i].column.name);
    }
  }
  for (const HeldReading& reading : held) {
    if (std::ranges::find(known, reading.first) != known.end()) continue;
    const std::string near = data::NearestName(reading.first, known);
    throw UsageError(fmt::format("--at: no input {} beside the position{}",
                                 data::QuotedName(reading.first),
                                 near.empty() ? "" : "; is it " + near + "?"));
  }
}

// The state in which the session of a log leaves a map at `row`.
ErrorCurve AfterLog(const models::FittedModel& fitted,
                    const models::MapProgram& program,
                    const TableArguments& arguments) {
  const data::CsvTable table =
      ReadForMap(fitted, arguments.log, models::MapColumns::kInputs, true);
  const auto num_rows = static_cast<int>(table.num_rows);
  const int row = arguments.row < 0 ? num_rows - 1 : arguments.row;
  if (row >= num_rows) {
    throw UsageError(fmt::format("--row {}: {} has {}",
                                 row,
                                 data::PrintablePath(arguments.log),
                                 report::Count(num_rows, "row")));
  }
  const Eigen::MatrixXd readings = models::InputsOf(fitted, table);
  const models::MapLog map = models::MakeMapLog(fitted, table, {});
  models::ProgramRun run(program, models::Precision::kDouble);
  const auto session = [&](Index at) {
    return map.log->sessions.codes[static_cast<std::size_t>(at)];
  };
  Index before = -1;
  for (Index at = map.log == nullptr ? row : 0; at <= row; ++at) {
    if (map.log != nullptr && session(at) != session(row)) continue;
    double error = 0.0;
    if (before < 0) {
      run.Begin(readings.row(at));
    } else {
      run.Step(
          map.log->time[at] - map.log->time[before], readings.row(at), &error);
    }
    before = at;
  }
  return {program, std::move(run), readings.row(row)};
}

ErrorCurve CurveOf(const std::string& file,
                   const models::FittedModel& fitted,
                   const models::MapProgram& program,
                   const TableArguments& arguments) {
  try {
    return arguments.log.empty()
               ? ErrorCurve(program, fitted.inputs, ParseHeld(arguments.at))
               : AfterLog(fitted, program, arguments);
  } catch (const std::invalid_argument& error) {
    throw data::InputError(
        fmt::format("{}: {}", data::PrintablePath(file), error.what()));
  }
}

// "at t1_degC = 21, t2_degC = 22": all but the position.
std::string StateText(const ErrorCurve& curve) {
  constexpr int kMost = 6;
  std::string text;
  int named = 0;
  for (std::size_t i = 0; i < curve.program().readings.size(); ++i) {
    if (static_cast<int>(i) == curve.position_index()) continue;
    if (++named > kMost) return text + ", ...";
    text += fmt::format(
        "{}{} = {:g}",
        text.empty() ? "at " : ", ",
        data::Printable(curve.program().readings[i].column.name, 40),
        curve.readings()[static_cast<Index>(i)]);
  }
  return text.empty() ? "it reads nothing but the position" : text;
}

void CheckTableArguments(const TableArguments& arguments) {
  if (!arguments.at.empty() && !arguments.log.empty()) {
    throw UsageError("export: --at or --log, not both");
  }
  if (arguments.row >= 0 && arguments.log.empty()) {
    throw UsageError("export: --row goes with --log");
  }
}

}  // namespace

void ExportLinuxcnc(const std::string& model,
                    const TableArguments& arguments,
                    const std::string& out,
                    bool quiet) {
  CheckTableArguments(arguments);
  const bool two =
      !arguments.increasing.empty() && !arguments.decreasing.empty();
  if (!model.empty() &&
      !(arguments.increasing.empty() && arguments.decreasing.empty())) {
    throw UsageError(
        "export --linuxcnc: name one MODEL for both directions, or "
        "--increasing and --decreasing");
  }
  const std::string only = !model.empty() ? model
                           : !arguments.increasing.empty()
                               ? arguments.increasing
                               : arguments.decreasing;
  if (only.empty()) {
    throw UsageError(
        "export --linuxcnc: name --increasing FILE.json and --decreasing "
        "FILE.json, the directions of motion");
  }
  RefuseInputAsOutput(
      "-o",
      out,
      {model, arguments.increasing, arguments.decreasing, arguments.log});
  const TableMap forward = LoadTableMap(two ? arguments.increasing : only);
  const TableMap reverse = LoadTableMap(two ? arguments.decreasing : only);
  CheckHeld(ParseHeld(arguments.at), {&forward.program, &reverse.program});
  const ErrorCurve increasing =
      CurveOf(forward.file, forward.fitted, forward.program, arguments);
  const ErrorCurve decreasing =
      CurveOf(reverse.file, reverse.fitted, reverse.program, arguments);
  const data::Unit unit = data::UnitOfSymbol(arguments.units);
  models::CompFile file;
  try {
    file = models::LinuxcncCompFile(increasing,
                                    decreasing,
                                    {.unit = unit,
                                     .most_points = arguments.points,
                                     .resolution = arguments.resolution});
  } catch (const std::logic_error& error) {
    throw data::InputError(
        fmt::format("{}: {}", data::PrintablePath(only), error.what()));
  }
  data::WriteFileAtomically(out, file.text);
  if (quiet) return;
  const auto text = [&](double error) {
    return report::ErrorText(unit, error).WithUnit(error);
  };
  Say(
      fmt::format("{}: COMP_FILE_TYPE = 0 in {}, {} from {:g} to {:g}; beyond "
                  "the ends LinuxCNC holds the value",
                  data::PrintablePath(out),
                  unit.symbol,
                  report::Count(file.num_points, "point"),
                  file.low,
                  file.high));
  if (two) {
    Say(fmt::format("forward column (position increases): {}; reverse: {}",
                    data::PrintablePath(forward.file),
                    data::PrintablePath(reverse.file)));
  } else {
    Say(
        fmt::format("{} fills both columns: the directions of motion are taken "
                    "as alike",
                    data::PrintablePath(only)));
  }
  Say(StateText(increasing));
  Say(fmt::format("between the points it errs by up to {}",
                  text(file.interpolation_error)));
  if (arguments.resolution > 0.0) {
    Say(fmt::format("in steps of {:g} {} by up to {}",
                    arguments.resolution,
                    unit.symbol,
                    text(file.error_with_steps)));
  }
  Say("column = nominal + error; LinuxCNC adds nominal - column, which is "
      "compensation = -error");
}

models::ExportedFile ExportTable(const models::FittedModel& fitted,
                                 const models::MapExport& map,
                                 const TableArguments& arguments,
                                 std::string* said) {
  CheckTableArguments(arguments);
  CheckHeld(ParseHeld(arguments.at), {&map.program});
  const ErrorCurve curve = CurveOf(map.name, fitted, map.program, arguments);
  models::GridOptions options;
  char times = 0;
  if (std::sscanf(arguments.grid.c_str(),
                  "%5d%c%5d",
                  &options.positions,
                  &times,
                  &options.columns) != 3 ||
      times != 'x' || options.positions < 2 || options.columns < 2) {
    throw UsageError(
        "--grid takes ROWSxCOLUMNS, both at least 2, such as 33x9");
  }
  std::vector<std::string> others;
  for (std::size_t i = 0; i < map.program.readings.size(); ++i) {
    if (static_cast<int>(i) == curve.position_index()) continue;
    others.push_back(map.program.readings[i].column.name);
    if (arguments.over == others.back()) options.over = static_cast<int>(i);
  }
  if (options.over < 0 && !arguments.over.empty()) {
    throw UsageError(fmt::format("--over: no input {} beside the position",
                                 data::QuotedName(arguments.over)));
  }
  if (options.over < 0 && others.size() == 1) {
    options.over = curve.position_index() == 0 ? 1 : 0;
  }
  if (options.over < 0 && others.size() > 1) {
    throw UsageError(fmt::format(
        "--table: name the input across the columns with --over, one of {}",
        fmt::join(
            others.begin(),
            others.begin() + std::min<std::ptrdiff_t>(6, std::ssize(others)),
            ", ")));
  }
  models::GridTable table;
  try {
    table = models::CompensationGrid(curve, options);
  } catch (const std::domain_error& error) {
    throw data::InputError(fmt::format("{}: {}", map.name, error.what()));
  }
  *said = fmt::format(
      "{}.csv: compensation = -error, {}; between its points it errs by up to "
      "{}",
      map.name,
      StateText(curve),
      report::ErrorText(map.program.target.unit, table.interpolation_error)
          .WithUnit(table.interpolation_error));
  return {map.name + ".csv", table.text};
}

}  // namespace errmap::cli
