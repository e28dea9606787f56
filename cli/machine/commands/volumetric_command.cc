#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/machine/machine_file.h"
#include "cli/machine/machine_points.h"
#include "cli/machine/true_poses.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/number_text.h"
#include "cli/report/table.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "data/columns.h"
#include "data/csv.h"
#include "data/files/atomic_file.h"
#include "data/text.h"
#include "data/throwing_as.h"
#include "models/history/map_log.h"
#include "models/kinematics/machine.h"
#include "models/kinematics/volumetric.h"
#include "stats/error_metrics.h"
#include "stats/summary.h"

namespace errmap::cli {
namespace {

using Eigen::MatrixX3d;
using models::Machine;
using models::VolumetricErrors;

struct VolumetricArguments {
  std::string machine;
  std::string points;
  std::string out;
  models::MapDataArguments log;
  models::VolumetricOptions options;
  bool quiet = false;
};

// What was computed, for the table and the remarks.
struct Synthesis {
  const Machine& machine;
  const data::CsvTable& points;
  const machine::MachinePoints& maps;
  const VolumetricErrors& errors;
  VectorXd sensitive;  // (m) length of the error in the sensitive directions
};

// ---- The table.

// The errors whose maps extrapolate at a point.
std::string Outside(const Synthesis& s, std::size_t row) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < s.maps.outside.size(); ++k) {
    if (s.maps.outside[k][row]) names.push_back(s.machine.errors[k].name);
  }
  return data::JoinWords(names, " ");
}

// A row per point: what tells it apart, and its errors.
report::Table PointTable(const Synthesis& s) {
  report::Table table;
  table.nothing = "";
  table.rows.resize(s.points.num_rows);
  const auto add = [&](const std::string& name, const auto& cell) {
    table.columns.push_back({data::CsvField(name)});
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      table.rows[row].emplace_back(cell(row));
    }
  };
  const auto add_numbers = [&](const std::string& name,
                               const VectorXd& values) {
    add(name + "_" + s.machine.length.symbol, [&](std::size_t row) {
      // The sum turns -0, of an arm of no length, into 0.
      const double value = values[static_cast<Index>(row)] + 0.0;
      return report::Number{std::isfinite(value) ? value : models::kNotKnown};
    });
  };
  const auto add_vector = [&](const std::string& name,
                              const MatrixX3d& values) {
    for (const Index d : {0, 1, 2}) {
      add_numbers(fmt::format("{}_{}", name, "xyz"[d]), values.col(d));
    }
  };
  std::vector<std::string> given = {
      "record", "day", "cycle", "diagonal", "diagonal_direction"};
  for (const std::string& column : s.machine.columns) {
    given.push_back(column);
    given.push_back(models::DirectionColumn(column));
  }
  for (const std::string& name : given) {
    const std::ptrdiff_t index = s.points.Find(name);
    if (index < 0) continue;
    add(name, [&](std::size_t row) {
      return s.points.CellText(s.points.At(index), row);
    });
  }
  add_vector("error", s.errors.exact);
  add_numbers("error_sensitive", s.sensitive);
  add_vector("first_order", s.errors.first_order);
  add_vector("half_width_90", s.errors.half_widths);
  add_vector("lower_90", s.errors.lower);
  add_vector("upper_90", s.errors.upper);
  add("inside",
      [&](std::size_t row) { return Outside(s, row).empty() ? "1" : "0"; });
  add("outside", [&](std::size_t row) { return Outside(s, row); });
  for (std::size_t k = 0; k < s.machine.errors.size(); ++k) {
    add_vector(s.machine.errors[k].name, s.errors.contributions[k]);
  }
  return table;
}

// ---- What is said of it.

double Quantile95(const VectorXd& values) {
  VectorXd ascending = values;
  std::ranges::sort(ascending);
  constexpr double kShare = 0.95;
  return stats::Quantile(ascending, kShare);
}

std::string SensitiveText(const Machine& machine) {
  std::vector<std::string> letters;
  for (std::size_t d = 0; d < machine.sensitive.size(); ++d) {
    if (!machine.sensitive[d]) continue;
    letters.emplace_back(1, static_cast<char>('X' + d));
  }
  return data::JoinWords(letters, ", ");
}

void SayErrors(const Synthesis& s) {
  const double most = s.sensitive.maxCoeff();
  const report::ErrorText text(s.machine.length, most);
  Warn(fmt::format(
      "{} of {}: tool minus work, in {} at most {}, 95 % within {}. "
      "The compensation is minus that",
      report::Count(s.sensitive.size(), "point"),
      data::QuotedText(s.machine.name),
      SensitiveText(s.machine),
      text.WithUnit(most),
      text.WithUnit(Quantile95(s.sensitive))));
}

// The components that matter most, by the RMS of their contributions.
void SayContributions(const Synthesis& s) {
  std::vector<std::pair<double, std::string>> sizes;
  for (std::size_t k = 0; k < s.machine.errors.size(); ++k) {
    sizes.emplace_back(stats::RootMeanSquare(models::SensitiveLengths(
                           s.machine, s.errors.contributions[k])),
                       s.machine.errors[k].name);
  }
  std::ranges::stable_sort(
      sizes, std::greater{}, &decltype(sizes)::value_type::first);
  constexpr std::size_t kMost = 6;
  sizes.resize(std::min(sizes.size(), kMost));
  if (sizes.empty()) return;
  const report::ErrorText text(s.machine.length, sizes.front().first);
  std::vector<std::string> parts;
  for (const auto& [size, name] : sizes) {
    parts.push_back(fmt::format("{} {}", name, text(size)));
  }
  Warn(fmt::format("RMS of the largest contributions, {}: {}",
                   text.symbol(),
                   data::JoinWords(parts, ", ")));
}

// Where the points have true errors, what compensation would leave of them.
void SayRest(const Synthesis& s, const MatrixX3d& truth) {
  const auto rms = [&](const MatrixX3d& errors) {
    return stats::RootMeanSquare(models::SensitiveLengths(s.machine, errors));
  };
  const double before = rms(truth);
  const report::ErrorText text(s.machine.length, before);
  Warn(fmt::format("measured there {} RMS, {} after subtracting the maps",
                   text.WithUnit(before),
                   text.WithUnit(rms(truth - s.errors.exact))));
}

// "ppp 12.1, pnp 3.0 um"
std::string DiagonalText(const Synthesis& s,
                         const machine::DiagonalRuns& runs,
                         const MatrixX3d& errors) {
  const std::vector<machine::DiagonalFigures> all = machine::DiagonalFiguresOf(
      s.points,
      runs,
      data::AllRows(s.points.num_rows),
      machine::PlacesOf(s.machine.chain, s.maps.coordinates),
      errors);
  double most = 0.0;
  for (const machine::DiagonalFigures& diagonal : all) {
    most = std::max(most, diagonal.figures.systematic);
  }
  const report::ErrorText text(s.machine.length, most);
  std::vector<std::string> parts;
  for (const machine::DiagonalFigures& diagonal : all) {
    parts.push_back(
        fmt::format("{} {}", diagonal.name, text(diagonal.figures.systematic)));
  }
  return fmt::format("{} {}", data::JoinWords(parts, ", "), text.symbol());
}

// ISO 230-6:2002, both ways together, where the points lie on diagonals.
std::vector<std::string> DiagonalLines(const Synthesis& s,
                                       const std::optional<MatrixX3d>& truth) {
  const std::optional<machine::DiagonalRuns> runs =
      machine::ReadDiagonalRuns(s.points);
  if (!runs) return {};
  constexpr const char* kWhat = "systematic deviation E along diagonals";
  std::vector<std::string> lines = {
      fmt::format("{}, predicted by the maps: {}",
                  kWhat,
                  DiagonalText(s, *runs, s.errors.exact))};
  if (truth) {
    lines.push_back(
        fmt::format("{}, measured: {}; minus the maps: {}",
                    kWhat,
                    DiagonalText(s, *runs, *truth),
                    DiagonalText(s, *runs, *truth - s.errors.exact)));
  }
  return lines;
}

void SayOutsidePoints(const Synthesis& s) {
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < s.maps.outside.size(); ++k) {
    const auto count = std::ranges::count(s.maps.outside[k], true);
    if (count == 0) continue;
    parts.push_back(fmt::format(
        "{} at {}", s.machine.errors[k].name, report::Count(count, "point")));
  }
  if (parts.empty()) return;
  Warn(fmt::format(
      "warning: maps extrapolate (inside = 0): {}: outside a trained "
      "range, or in a session whose first rows are missing",
      data::JoinWords(parts, ", ")));
}

// ---- The command.

std::vector<std::string> InputsOf(const VolumetricArguments& arguments,
                                  const Machine& machine) {
  std::vector<std::string> files = {
      arguments.machine, arguments.points, arguments.log.after};
  for (const models::MachineError& error : machine.errors) {
    for (const models::ErrorSource& source : error.sources) {
      files.push_back(source.file);
    }
  }
  return files;
}

int RunVolumetric(const VolumetricArguments& arguments) {
  data::ThrowingAs<UsageError>("", [&] { arguments.options.Validate(); });
  const machine::MachineFile file = machine::ReadMachineFile(arguments.machine);
  CheckOutputName("-o", arguments.out, InputsOf(arguments, file.machine));
  const data::CsvTable points = data::ReadCsv(arguments.points);
  std::optional<data::CsvTable> log;
  if (!arguments.log.after.empty()) log = data::ReadCsv(arguments.log.after);
  const machine::MachinePoints maps = machine::EvaluateAt(
      file.machine, points, log ? &*log : nullptr, arguments.log);
  const VolumetricErrors errors = models::CombineErrors(
      file.machine.chain, maps.coordinates, maps.components, arguments.options);
  const Synthesis synthesis{
      file.machine,
      points,
      maps,
      errors,
      models::SensitiveLengths(file.machine, errors.exact)};
  std::optional<MatrixX3d> truth;
  if (machine::HasTrueErrors(points)) {
    truth = machine::TrueErrors(points, file.machine);
  }
  const std::vector<std::string> diagonals = DiagonalLines(synthesis, truth);
  const std::string text = report::CsvTable(PointTable(synthesis));
  if (arguments.out.empty()) {
    PrintResult(text);
  } else {
    data::WriteFileAtomically(arguments.out, text);
  }
  const bool finite = !SayNotFinite(errors.exact.rowwise().sum(),
                                    data::AllRows(points.num_rows),
                                    arguments.points);
  if (!arguments.quiet) {
    for (const std::string& line : file.warnings) Warn(line);
    for (const std::string& line : maps.remarks) Warn(line);
    if (finite) {
      SayErrors(synthesis);
      SayContributions(synthesis);
      if (truth) SayRest(synthesis, *truth);
      for (const std::string& line : diagonals) Warn(line);
    }
    SayOutsidePoints(synthesis);
  }
  return finite ? kDone : kEveryFitFailed;
}

}  // namespace

void AddVolumetricCommand(CLI::App* app, Run* run) {
  const Command<VolumetricArguments> command(
      app,
      run,
      "volumetric",
      "Compute the error at the tool from the maps of all components");
  AddOption(command, "MACHINE FILE.toml", command->machine)
      .About("Machine file: its kinematic chain, with a map for each error")
      .Required();
  AddOption(command, "--at POINTS.csv", command->points)
      .About("Points: coordinates, directions, temperatures")
      .Required();
  AddOption(command, "-o,--output OUT.csv", command->out)
      .About("File to write (default: stdout)")
      .Under(kOutputOptions);
  AddMapDataArguments(command, &command->log);
  AddFromRest(command, &command->log);
  AddOption(command, "--draws", command->options.draws)
      .About(
          "Monte Carlo draws per point for lower_90 and upper_90; 0 for none")
      .ShowDefault();
  AddSeedOption(command, &command->options.seed, "Seed of the draws");
  AddQuietFlag(command, &command->quiet);
  SetFooter(command, R"(Columns, in the machine's unit of length:
- error_x ... error_z: tool minus work in the base frame, the product of the matrices
- error_sensitive: its length in the machine's sensitive directions
- first_order_*, half_width_90_*: to first order
- lower_90_*, upper_90_*: by draws; empty without intervals
- inside, outside: outside names maps that extrapolate
- the contribution of each error

The position of a map is the coordinate of its link. The column x_direction
chooses from a pair { forward, reverse } for x_mm. Components are assumed
independent. Points with error_x_mm ... error_z_mm also give the error with and
without compensation. Points with diagonal and diagonal_direction also give the
deviations of ISO 230-6. diagonal has the signs of X, Y and Z along it: ppn, p0n.
Exit status: 0 done; 4 an error is not finite.
Example: errmap volumetric data/sets/machines/three_axis.toml --at data/sets/machines/three_axis_points.csv)");
  command.Runs(RunVolumetric);
}

}  // namespace errmap::cli
