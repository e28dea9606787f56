#include "models/export/compensation_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "data/csv.h"
#include "models/export/program/safe_names.h"

namespace errmap::models {
namespace {

constexpr int kChecksPerCell = 4;

double Share(double low, double high, int i, int count) {
  return i == count ? high : low + (high - low) * i / count;
}

void RequireConvertible(const data::ColumnInfo& column,
                        const data::Unit& unit) {
  if (data::AreConvertible(column.unit, unit)) return;
  throw std::invalid_argument(
      fmt::format("'{}' is not a length that can be written in {}",
                  CommentText(column.name),
                  unit.symbol));
}

// A map's error and position in the machine's unit.
class MachineCurve {
 public:
  MachineCurve(const ErrorCurve& curve, const data::Unit& unit)
      : curve_(curve), unit_(unit) {
    RequireConvertible(curve.position().column, unit);
    RequireConvertible(curve.program().target, unit);
  }

  double operator()(double position) const {
    return InMachine(curve_(OfMap(position)), curve_.program().target.unit);
  }
  // The same in whole steps that stay within the limit.
  double InSteps(double position, double resolution, AtLimit* at_limit) const {
    const double error = curve_(OfMap(position));
    if (curve_.IsAtLimit(error)) at_limit->Add(position);
    const double value = InMachine(error, curve_.program().target.unit);
    if (!(resolution > 0.0)) return value;
    const double most = InMachine(curve_.program().limits.max_error,
                                  curve_.program().target.unit);
    const double steps = std::round(value / resolution);
    return resolution * (std::fabs(steps) * resolution > most
                             ? std::trunc(value / resolution)
                             : steps);
  }
  double low() const {
    return InMachine(curve_.position().trained_min,
                     curve_.position().column.unit);
  }
  double high() const {
    return InMachine(curve_.position().trained_max,
                     curve_.position().column.unit);
  }

 private:
  double InMachine(double value, const data::Unit& unit) const {
    return data::Converted(value, unit, unit_);
  }
  double OfMap(double position) const {
    return data::Converted(position, unit_, curve_.position().column.unit);
  }

  const ErrorCurve& curve_;
  data::Unit unit_;
};

// Largest distance between a curve and the lines through points of a table.
double LargestDifference(const Curve& curve,
                         const std::vector<double>& positions,
                         const std::vector<double>& values) {
  constexpr int kChecksPerLine = 16;
  double worst = 0.0;
  for (std::size_t k = 1; k < positions.size(); ++k) {
    for (int i = 0; i <= kChecksPerLine; ++i) {
      const double at =
          Share(positions[k - 1], positions[k], i, kChecksPerLine);
      const double on_line = Share(values[k - 1], values[k], i, kChecksPerLine);
      worst = std::max(worst, std::fabs(curve(at) - on_line));
    }
  }
  return worst;
}

}  // namespace

CompFile LinuxcncCompFile(const ErrorCurve& increasing,
                          const ErrorCurve& decreasing,
                          const CompFileOptions& options) {
  // Far below what any machine resolves, in either of its units.
  constexpr double kEnough = 1e-9;
  const MachineCurve forward(increasing, options.unit);
  const MachineCurve reverse(decreasing, options.unit);
  const double low = std::max(forward.low(), reverse.low());
  const double high = std::min(forward.high(), reverse.high());
  const Knots knots =
      ChooseKnots({forward, reverse}, low, high, options.most_points, kEnough);

  CompFile file{.text = "",
                .num_points = static_cast<int>(knots.positions.size()),
                .low = low,
                .high = high,
                .interpolation_error = knots.interpolation_error};
  std::vector<double> forward_values;
  std::vector<double> reverse_values;
  for (const double position : knots.positions) {
    forward_values.push_back(
        forward.InSteps(position, options.resolution, &file.forward_at_limit));
    reverse_values.push_back(
        reverse.InSteps(position, options.resolution, &file.reverse_at_limit));
    file.text += fmt::format("{} {} {}\n",
                             RealText(position),
                             RealText(position + forward_values.back()),
                             RealText(position + reverse_values.back()));
  }
  file.error_with_steps =
      std::max(LargestDifference(forward, knots.positions, forward_values),
               LargestDifference(reverse, knots.positions, reverse_values));
  return file;
}

GridTable CompensationGrid(const ErrorCurve& curve,
                           const GridOptions& options) {
  const ProgramReading& position = curve.position();
  const bool is_grid = options.over >= 0;
  const int rows = options.positions - 1;
  const int columns = is_grid ? options.columns - 1 : 0;
  const auto reading = [&]() -> const ProgramReading& {
    return curve.program().readings[static_cast<std::size_t>(options.over)];
  };
  const auto position_at = [&](double row) {
    return Tidied(position.trained_min +
                  (position.trained_max - position.trained_min) * row / rows);
  };
  const auto value_at = [&](double column) {
    return Tidied(reading().trained_min +
                  (reading().trained_max - reading().trained_min) * column /
                      columns);
  };
  const auto compensation = [&](double row, double column) {
    return is_grid ? -curve(position_at(row), options.over, value_at(column))
                   : -curve(position_at(row));
  };

  const std::string& unit = curve.program().target.unit.symbol;
  GridTable table;
  table.text = fmt::format(
      "# compensation = -error{}, to be added to the nominal position; at most "
      "{:.6g} in size{}{}\n",
      unit.empty() ? "" : " in " + CommentText(unit),
      curve.program().limits.max_error,
      curve.program().made_for.empty() ? "" : "; for ",
      curve.program().made_for);
  table.text += data::CsvField(CommentText(position.column.name));
  for (int column = 0; column <= columns; ++column) {
    table.text +=
        "," +
        data::CsvField(is_grid ? fmt::format("{}={}",
                                             CommentText(reading().column.name),
                                             data::CsvNumber(value_at(column)))
                               : "compensation");
  }
  table.text += "\n";
  std::vector<std::vector<double>> cells;
  for (int row = 0; row <= rows; ++row) {
    std::vector<double>& line = cells.emplace_back();
    table.text += data::CsvNumber(position_at(row));
    for (int column = 0; column <= columns; ++column) {
      line.push_back(compensation(row, column));
      ++table.num_cells;
      if (curve.IsAtLimit(line.back())) table.at_limit.Add(position_at(row));
      table.text += "," + data::CsvNumber(line.back());
    }
    table.text += "\n";
  }

  // Bilinear within each cell; linear if there is one column.
  const auto cell = [&](int row, int column) {
    return cells[static_cast<std::size_t>(std::min(row, rows))]
                [static_cast<std::size_t>(std::min(column, columns))];
  };
  for (int i = 0; i <= kChecksPerCell * rows; ++i) {
    for (int j = 0; j <= kChecksPerCell * columns; ++j) {
      const int row = i / kChecksPerCell;
      const int column = j / kChecksPerCell;
      const double r = static_cast<double>(i % kChecksPerCell) / kChecksPerCell;
      const double c = static_cast<double>(j % kChecksPerCell) / kChecksPerCell;
      const double interpolated =
          (1 - r) * ((1 - c) * cell(row, column) + c * cell(row, column + 1)) +
          r * ((1 - c) * cell(row + 1, column) + c * cell(row + 1, column + 1));
      table.interpolation_error =
          std::max(table.interpolation_error,
                   std::fabs(interpolated - compensation(row + r, column + c)));
    }
  }
  return table;
}

}  // namespace errmap::models
