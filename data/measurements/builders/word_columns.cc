#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "data/argument_name.h"
#include "data/columns.h"
#include "data/measurements/builders/value_checks.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/least_squares.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr std::size_t kMostParts = 12;
constexpr Index kMostInputsLooked = 8;
constexpr std::size_t kMostRowsOfPart = 2000;

// A column of a few values that may part the rows into things that err
// differently: machines, tools, directions.
struct PartingColumn {
  std::string name;
  std::vector<std::string> values = {};  // distinct, in order of appearance
  std::vector<std::size_t> codes = {};   // (rows asked for) index into values
};

// Root mean squares of what plain linear maps miss, degrees of freedom taken
// into account: one for all rows, and one for each value of the column. NaN
// where the rows are too few to tell.
struct PartingEffect {
  double one = 0.0;
  double each = 0.0;
  std::vector<double> parts = {};  // of each value
};

// Sum of squares that a linear map of these rows misses.
double SquaresLeft(const std::vector<Index>& rows,
                   const Eigen::VectorXd& target,
                   const Eigen::MatrixXd& input_values,
                   Index num_inputs) {
  Eigen::MatrixXd design(static_cast<Index>(rows.size()), num_inputs + 1);
  design << Eigen::VectorXd::Ones(design.rows()),
      input_values(rows, Eigen::seqN(0, num_inputs));
  const Eigen::VectorXd wanted = target(rows);
  const Eigen::VectorXd b = SolveLeastSquares(design, wanted);
  return (wanted - design * b).squaredNorm();
}

// That column in these rows of the table; no values where it has one or more
// than 12, or lacks one of them somewhere.
PartingColumn PartBy(const CsvTable& table,
                     const CsvColumn& column,
                     const std::vector<Index>& rows) {
  auto [labels, codes] = LabelsOf(table, column, rows, kMostParts);
  if (labels.size() < 2 || labels.size() > kMostParts ||
      std::ranges::any_of(labels, IsMissingText)) {
    return {.name = column.name};
  }
  return {.name = column.name,
          .values = std::move(labels),
          .codes = std::move(codes)};
}

// Whether it changes only where a session (codes of the same rows) does.
bool IsOneInEach(const std::vector<Index>& sessions,
                 const PartingColumn& column) {
  for (std::size_t i = 1; i < column.codes.size(); ++i) {
    if (column.codes[i] != column.codes[i - 1] &&
        sessions[i] == sessions[i - 1]) {
      return false;
    }
  }
  return true;
}

// Whether each of its values names a place on the axis.
bool NamesPlaces(const PartingColumn& column, const Dataset::Parts& parts) {
  constexpr double kOnePlace = 0.01;  // of the travel
  if (column.codes.empty() || parts.inputs.empty() ||
      parts.inputs[0].role != Role::kPosition) {
    return false;
  }
  const auto position = parts.input_values.col(0);
  const double width = kOnePlace * (position.maxCoeff() - position.minCoeff());
  std::vector<double> first(column.values.size(), std::nan(""));
  for (std::size_t i = 0; i < column.codes.size(); ++i) {
    const double at = position[static_cast<Index>(i)];
    double& place = first[column.codes[i]];
    if (std::isnan(place)) place = at;
    if (std::abs(at - place) > width) return false;
  }
  return true;
}

PartingEffect EffectOfParting(const PartingColumn& column,
                              const Eigen::VectorXd& target,
                              const Eigen::MatrixXd& input_values) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const Index p = std::min(input_values.cols(), kMostInputsLooked);
  const std::size_t parts = column.values.size();
  const std::size_t stride =
      1 +
      column.codes.size() / (kMostRowsOfPart * std::max<std::size_t>(parts, 1));
  std::vector<Index> all;
  std::vector<std::vector<Index>> of_part(parts);
  for (std::size_t i = 0; i < column.codes.size(); i += stride) {
    all.push_back(static_cast<Index>(i));
    of_part[column.codes[i]].push_back(static_cast<Index>(i));
  }
  if (parts < 2) return {kNaN, kNaN};
  double squares = 0.0;
  std::vector<double> left;
  for (const std::vector<Index>& rows : of_part) {
    if (static_cast<Index>(rows.size()) < 2 * (p + 1)) return {kNaN, kNaN};
    const double of_rows = SquaresLeft(rows, target, input_values, p);
    squares += of_rows;
    left.push_back(
        std::sqrt(of_rows / static_cast<double>(std::ssize(rows) - p - 1)));
  }
  const auto free_of = [&](std::size_t maps) {
    return static_cast<double>(all.size()) -
           static_cast<double>(maps) * static_cast<double>(p + 1);
  };
  return {std::sqrt(SquaresLeft(all, target, input_values, p) / free_of(1)),
          std::sqrt(squares / free_of(parts)),
          std::move(left)};
}

std::string LengthText(double value, const Unit& target) {
  return Rounded(target.display_scale * value) +
         (target.display_symbol.empty() ? "" : " " + target.display_symbol);
}

// That the rows differ by the column, as a sentence in the target's unit.
std::string PartingText(const PartingColumn& column,
                        const PartingEffect& effect,
                        const Unit& target) {
  std::string values;
  for (const std::string& value : column.values) {
    values += (values.empty() ? "" : ", ") + NameInRemark(value);
  }
  return "Rows differ by " + NameInRemark(column.name) + " (" + values +
         "): separate linear maps leave " + LengthText(effect.each, target) +
         ", one for all leaves " + LengthText(effect.one, target) +
         "; fit each separately with " + ArgumentName("where") + ".";
}

}  // namespace

std::vector<PartingRemark> FindParts(const CsvTable& table,
                                     const std::vector<std::size_t>& words,
                                     const Dataset::Parts& parts,
                                     const std::vector<Index>& sessions) {
  constexpr double kDiffers = 0.7;
  constexpr double kUnlike = 10.0;
  std::vector<PartingRemark> remarks;
  for (const std::size_t index : words) {
    const CsvColumn& cells = table.columns[index];
    const PartingColumn column = PartBy(table, cells, parts.rows);
    const bool is_named = PartsComponents(table, cells);
    // A map for each day is of no use on another.
    if (!is_named && !sessions.empty() && IsOneInEach(sessions, column)) {
      continue;
    }
    if (NamesPlaces(column, parts)) continue;
    const PartingEffect effect =
        EffectOfParting(column, parts.target_values, parts.input_values);
    if (effect.each < kDiffers * effect.one) {
      remarks.push_back({PartingText(column, effect, parts.target.unit), true});
    } else if (is_named) {
      remarks.push_back({"rows that differ in " + QuotedName(column.name) +
                             " may need a map each, by " +
                             ArgumentName("where"),
                         false});
    }
  }
  for (const ColumnInfo& input : parts.inputs) {
    if (input.role != Role::kSwitch) continue;
    const PartingColumn column =
        PartBy(table, table.At(table.Find(input.name)), parts.rows);
    const std::vector<double> left =
        EffectOfParting(column, parts.target_values, parts.input_values).parts;
    if (left.empty()) continue;
    const auto [least, most] = std::ranges::minmax_element(left);
    if (*most <= kUnlike * *least) continue;
    const auto where = [&](auto part) {
      return LengthText(*part, parts.target.unit) + " where " +
             NameInRemark(column.name) + " is " +
             column.values[part - left.begin()];
    };
    remarks.push_back({"A linear map leaves " + where(least) + ", and " +
                           where(most) + "; keep the rows of one kind.",
                       true});
  }
  return remarks;
}

}  // namespace errmap::data
