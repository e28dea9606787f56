#include "cli/commands/control/export_tables.h"

#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/number_text.h"
#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/text.h"
#include "data/throwing_as.h"
#include "models/export/compensation_table.h"
#include "models/export/program/controller.h"
#include "models/export/program/error_curve.h"
#include "models/model_file.h"

namespace errmap::cli {
namespace {

using models::ErrorCurve;
using models::HeldReading;

// Every name of --at is an input of some map, and not the position.
std::vector<HeldReading> HeldIn(
    const TableArguments& arguments,
    const std::vector<const models::MapProgram*>& programs) {
  return data::ThrowingAs<UsageError>("", [&] {
    std::vector<HeldReading> held = models::ParseHeldReadings(arguments.at);
    models::RequireHeldReadings(held, programs);
    return held;
  });
}

// A map that tables are made of; what refers to what stays in place.
struct TableMap {
  std::string file;
  models::FittedModel fitted;
  models::MapProgram program;
};

TableMap LoadTableMap(const std::string& file,
                      models::Motion motion,
                      const LimitsFor& limits) {
  TableMap map{.file = file, .fitted = models::LoadModel(file), .program = {}};
  const models::LimitOptions options = limits(map.fitted.target.unit);
  data::ThrowingAs<data::InputError>(data::PrintablePath(file) + ": ", [&] {
    models::RequireMadeFor(map.fitted, motion);
    map.program = models::MakeMapProgram(map.fitted);
    models::AddController({&map.fitted}, options, &map.program);
  });
  return map;
}

// The state in which the session of a log leaves a map at `row`.
ErrorCurve AfterLog(const models::FittedModel& fitted,
                    const models::MapProgram& program,
                    const TableArguments& arguments) {
  const data::CsvTable table =
      models::ReadForMap(
          fitted, {arguments.log}, models::MapColumns::kInputs, {})
          .table;
  const auto num_rows = static_cast<int>(table.num_rows);
  const int row = arguments.row < 0 ? num_rows - 1 : arguments.row;
  if (row >= num_rows) {
    throw UsageError(fmt::format("--row {}: {} has {}",
                                 row,
                                 data::PrintablePath(arguments.log),
                                 report::Count(num_rows, "row")));
  }
  return models::CurveAfterLog(fitted, program, table, row);
}

ErrorCurve CurveOf(const std::string& file,
                   const models::FittedModel& fitted,
                   const models::MapProgram& program,
                   const std::vector<HeldReading>& held,
                   const TableArguments& arguments) {
  return data::ThrowingAs<data::InputError>(
      data::PrintablePath(file) + ": ", [&] {
        return arguments.log.empty() ? ErrorCurve(program, fitted.inputs, held)
                                     : AfterLog(fitted, program, arguments);
      });
}

// How large errors may be, and where they are.
std::string LimitText(const models::ErrorCurve& curve,
                      const models::AtLimit& at_limit,
                      int points,
                      const std::string& position_unit) {
  const double most = curve.program().limits.max_error;
  const std::string limit =
      "at most " +
      report::ErrorText(curve.program().target.unit, most).WithUnit(most);
  if (at_limit.points == 0) return limit + ", nowhere reached";
  return fmt::format("{}, reached in {} of {} points, from {:g} to {:g} {}",
                     limit,
                     at_limit.points,
                     points,
                     at_limit.low,
                     at_limit.high,
                     position_unit);
}

void CheckTableArguments(const TableArguments& arguments) {
  if (!arguments.at.empty() && !arguments.log.empty()) {
    throw UsageError("export: --at or --log, not both");
  }
  if (arguments.row >= 0 && arguments.log.empty()) {
    throw UsageError("export: --row needs --log");
  }
}

// The maps of both directions of motion; one for both acts both ways.
struct BothWays {
  TableMap forward;
  TableMap reverse;
  bool are_two;
};

BothWays LoadBothWays(const std::string& model,
                      const TableArguments& arguments,
                      const LimitsFor& limits) {
  using models::Motion;
  const std::string& increasing = arguments.increasing;
  const std::string& decreasing = arguments.decreasing;
  if (!model.empty() && !(increasing.empty() && decreasing.empty())) {
    throw UsageError(
        "export --linuxcnc: name one MODEL for both directions, or "
        "--increasing and --decreasing");
  }
  if (!increasing.empty() && !decreasing.empty()) {
    return {LoadTableMap(increasing, Motion::kIncreasing, limits),
            LoadTableMap(decreasing, Motion::kDecreasing, limits),
            true};
  }
  const std::string& only = !model.empty()        ? model
                            : !increasing.empty() ? increasing
                                                  : decreasing;
  if (only.empty()) {
    throw UsageError(
        "export --linuxcnc: name --increasing FILE.json and --decreasing "
        "FILE.json, the directions of motion");
  }
  return {LoadTableMap(only, Motion::kAny, limits),
          LoadTableMap(only, Motion::kAny, limits),
          false};
}

void SayOfLinuxcnc(const models::CompFile& file,
                   const BothWays& maps,
                   const ErrorCurve& increasing,
                   const ErrorCurve& decreasing,
                   const TableArguments& arguments,
                   const std::string& out) {
  const data::Unit unit = data::UnitOfSymbol(arguments.units);
  const auto text = [&](double error) {
    return report::ErrorText(unit, error).WithUnit(error);
  };
  Warn(
      fmt::format("{}: COMP_FILE_TYPE = 0 in {}, {} from {:g} to {:g}; beyond "
                  "the ends LinuxCNC holds the value",
                  data::PrintablePath(out),
                  unit.symbol,
                  report::Count(file.num_points, "point"),
                  file.low,
                  file.high));
  const std::string forward = data::PrintablePath(maps.forward.file);
  Warn(maps.are_two
           ? fmt::format("forward column (position increases): {}; reverse: {}",
                         forward,
                         data::PrintablePath(maps.reverse.file))
           : fmt::format(
                 "{} fills both columns: both directions are assumed equal",
                 forward));
  Warn(fmt::format(
      "errors forward: {}; reverse: {}",
      LimitText(
          increasing, file.forward_at_limit, file.num_points, unit.symbol),
      LimitText(
          decreasing, file.reverse_at_limit, file.num_points, unit.symbol)));
  Warn(models::StateText(increasing));
  Warn(fmt::format("between the points it is off by up to {}",
                   text(file.interpolation_error)));
  if (arguments.resolution > 0.0) {
    Warn(fmt::format("in steps of {:g} {} by up to {}",
                     arguments.resolution,
                     unit.symbol,
                     text(file.error_with_steps)));
  }
  Warn(
      "column = nominal + error; LinuxCNC adds nominal - column, which is "
      "compensation = -error");
}

}  // namespace

void ExportLinuxcnc(const std::string& model,
                    const TableArguments& arguments,
                    const LimitsFor& limits,
                    const std::string& out,
                    bool quiet) {
  CheckTableArguments(arguments);
  CheckOutputName(
      "-o",
      out,
      {model, arguments.increasing, arguments.decreasing, arguments.log});
  const BothWays maps = LoadBothWays(model, arguments, limits);
  const std::vector<HeldReading> held =
      HeldIn(arguments, {&maps.forward.program, &maps.reverse.program});
  const auto curve_of = [&](const TableMap& map) {
    return CurveOf(map.file, map.fitted, map.program, held, arguments);
  };
  const ErrorCurve increasing = curve_of(maps.forward);
  const ErrorCurve decreasing = curve_of(maps.reverse);
  const auto file = data::ThrowingAs<data::InputError, std::logic_error>(
      data::PrintablePath(maps.forward.file) + ": ", [&] {
        return models::LinuxcncCompFile(
            increasing,
            decreasing,
            {.unit = data::UnitOfSymbol(arguments.units),
             .most_points = arguments.points,
             .resolution = arguments.resolution});
      });
  data::WriteFileAtomically(out, file.text);
  SayUnless(quiet, maps.forward.fitted.remarks);
  if (maps.reverse.file != maps.forward.file) {
    SayUnless(quiet, maps.reverse.fitted.remarks);
  }
  if (!quiet) {
    SayOfLinuxcnc(file, maps, increasing, decreasing, arguments, out);
  }
}

models::ExportedFile ExportTable(const models::FittedModel& fitted,
                                 const models::MapExport& map,
                                 const TableArguments& arguments,
                                 std::string* said) {
  CheckTableArguments(arguments);
  const ErrorCurve curve = CurveOf(map.name,
                                   fitted,
                                   map.program,
                                   HeldIn(arguments, {&map.program}),
                                   arguments);
  const auto options = data::ThrowingAs<UsageError>("", [&] {
    return models::ParseGrid(arguments.grid, arguments.over, curve);
  });
  const auto table = data::ThrowingAs<data::InputError, std::domain_error>(
      map.name + ": ",
      [&] { return models::CompensationGrid(curve, options); });
  *said = fmt::format(
      "{}.csv: compensation = -error, {}; {}{}; between its points it is off "
      "by up to {}",
      map.name,
      models::StateText(curve),
      LimitText(curve,
                table.at_limit,
                table.num_cells,
                curve.position().column.unit.symbol),
      map.program.made_for.empty() ? "" : "; for " + map.program.made_for,
      report::ErrorText(map.program.target.unit, table.interpolation_error)
          .WithUnit(table.interpolation_error));
  return {map.name + ".csv", table.text};
}

}  // namespace errmap::cli
