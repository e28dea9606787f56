#include "data/measurements/row_faults.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <unordered_map>

#include <Eigen/QR>

#include "data/measurements/column_checks.h"
#include "data/measurements/dataset.h"
#include "data/measurements/text_times.h"
#include "data/measurements/thermometers.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

bool IsSummary(std::string_view text) {
  constexpr auto kWords = std::to_array<std::string_view>(
      {"mean",   "average",     "avg",     "total",      "totals",  "sum",
       "summe",  "gesamt",      "mittel",  "mittelwert", "moyenne", "media",
       "min",    "max",         "minimum", "maximum",    "std",     "stdev",
       "sd",     "sigma",       "median",  "count",      "range",   "rms",
       "anzahl", "end of file", "eof",     "end",        "ende"});
  while (text.ends_with(':') || text.ends_with('.')) text.remove_suffix(1);
  return std::ranges::any_of(kWords, [&](std::string_view word) {
    return EqualsIgnoringCase(text, word);
  });
}

bool HasDigit(std::string_view text) {
  return text.find_first_of("0123456789") != std::string_view::npos;
}

// Of the rows, what numbers or times must be for a word to be out of place.
constexpr std::size_t kUsualPercent = 80;

// A row as one number; rows that differ have others, but by rare chance.
std::uint64_t RowHash(const CsvTable& table, std::size_t row) {
  std::uint64_t hash = 0;
  const auto mix = [&](std::uint64_t bits) {
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
  };
  for (const CsvColumn& column : table.columns) {
    if (!column.has_name) continue;
    const double value = column.values[row];
    mix(std::isnan(value)
            ? std::hash<std::string>{}(table.CellText(column, row))
            : std::bit_cast<std::uint64_t>(value + 0.0));
  }
  return hash;
}

// What a linear map of the other rows makes of each row; empty where there are
// too few of them.
VectorXd LinearPrediction(const MeasuredColumns& measured,
                          const std::vector<Index>& trained) {
  constexpr Index kMostInputs = 40;
  constexpr std::size_t kMostRows = 4000;
  const Index p = std::min(measured.input_values.cols(), kMostInputs);
  std::vector<Index> rows;
  const std::size_t stride = 1 + (trained.size() - 1) / kMostRows;
  for (std::size_t i = 0; i < trained.size(); i += stride) {
    rows.push_back(trained[i]);
  }
  if (static_cast<Index>(rows.size()) < 3 * (p + 1)) return {};
  Eigen::MatrixXd design(static_cast<Index>(rows.size()), p + 1);
  design << VectorXd::Ones(design.rows()),
      measured.input_values(rows, Eigen::seqN(0, p));
  const VectorXd b = design.colPivHouseholderQr().solve(
      VectorXd(measured.target_values(rows)));
  return (measured.input_values.leftCols(p) * b.tail(p)).array() + b[0];
}

// Takes out zeros of an error that is measured from there, as at the position
// of reference: all rows of that value of an input are zero.
void LeaveReferences(const MeasuredColumns& measured,
                     std::vector<Index>* zeros) {
  const VectorXd& target = measured.target_values;
  for (Index j = 0; j < measured.input_values.cols() && !zeros->empty(); ++j) {
    struct Count {
      Index same = 0;
      Index zero = 0;
    };
    std::unordered_map<double, Count> counts;
    for (Index row = 0; row < target.size(); ++row) {
      Count& count = counts[measured.input_values(row, j)];
      ++count.same;
      count.zero += target[row] == 0.0 ? 1 : 0;
    }
    std::erase_if(*zeros, [&](Index row) {
      const Count& count = counts[measured.input_values(row, j)];
      return count.same > 1 && count.same == count.zero;
    });
  }
}

void LookForZeros(const MeasuredColumns& measured,
                  std::vector<ColumnFault>* faults) {
  constexpr double kFar = 8.0;  // robust standard deviations, of the worst
  const VectorXd& target = measured.target_values;
  const Index m = target.size();
  std::vector<Index> zeros;
  std::vector<Index> others;
  std::set<double> levels;
  for (Index row = 0; row < m; ++row) {
    (target[row] == 0.0 ? zeros : others).push_back(row);
    levels.insert(target[row]);
  }
  // Where values are few a zero is one of them.
  if (zeros.empty() || static_cast<Index>(4 * zeros.size()) > m ||
      2 * levels.size() < others.size()) {
    return;
  }
  const VectorXd predicted = LinearPrediction(measured, others);
  if (predicted.size() == 0) return;
  std::vector<double> misses;
  for (const Index row : others) {
    misses.push_back(std::abs(target[row] - predicted[row]));
  }
  constexpr double kNormalMad = 1.4826;
  const double sd = kNormalMad * MedianOf(std::move(misses));
  LeaveReferences(measured, &zeros);
  const auto worst = std::ranges::max_element(
      zeros, {}, [&](Index row) { return std::abs(predicted[row]); });
  if (worst == zeros.end() || !(std::abs(predicted[*worst]) > kFar * sd)) {
    return;
  }
  faults->push_back({.kind = FaultKind::kZero,
                     .input = -1,
                     .rows = zeros,
                     .of_cells = true,
                     .value = 0.0,
                     .low = predicted[*worst],
                     .high = sd});
}

// The cut that parts the targets best by their size, zeros apart, and how many
// times larger those before it are, by the means of their logarithms: single
// wrong values count little. 0: no part is hundreds of times smaller.
Index CutOfSizes(const VectorXd& target, double* ratio) {
  constexpr double kLeastShare = 0.2;
  constexpr double kLeastRatio = 200.0;
  constexpr double kMostRatio = 5000.0;
  double all = 0.0;
  double count = 0.0;
  for (const double value : target) {
    if (value == 0.0) continue;
    all += std::log(std::abs(value));
    count += 1.0;
  }
  double sum = 0.0;
  double before = 0.0;
  double best = 0.0;
  Index cut = 0;
  for (Index row = 0; row + 1 < target.size(); ++row) {
    if (target[row] == 0.0) continue;
    sum += std::log(std::abs(target[row]));
    before += 1.0;
    const double after = count - before;
    if (std::min(before, after) < kLeastShare * count) continue;
    const double difference = sum / before - (all - sum) / after;
    const double parted = before * after * difference * difference;
    if (!(parted > best)) continue;
    best = parted;
    *ratio = std::exp(difference);
    cut = row + 1;
  }
  const double size = std::max(*ratio, 1.0 / *ratio);
  return size >= kLeastRatio && size <= kMostRatio ? cut : 0;
}

void LookForOtherUnit(const MeasuredColumns& measured,
                      std::vector<ColumnFault>* faults) {
  double ratio = 1.0;
  const Index cut = CutOfSizes(measured.target_values, &ratio);
  if (cut == 0) return;
  const Index first = ratio < 1.0 ? 0 : cut;
  const Index last = ratio < 1.0 ? cut : measured.target_values.size();
  std::vector<Index> rows;
  for (Index row = first; row < last; ++row) rows.push_back(row);
  faults->push_back({.kind = FaultKind::kOtherUnit,
                     .input = -1,
                     .rows = std::move(rows),
                     .of_cells = true,
                     .value = std::max(ratio, 1.0 / ratio),
                     .low = 0.0,
                     .high = 0.0});
}

}  // namespace

void RefuseRowsOfWords(const CsvTable& table,
                       const std::vector<bool>& numbering,
                       const std::vector<bool>& passes) {
  const auto num_rows =
      static_cast<std::size_t>(std::ranges::count(passes, true));
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    if (column.texts.empty()) continue;
    const TextTimes times = column.is_text() ? ReadTimes(column) : TextTimes{};
    std::size_t words = 0;
    std::size_t missing = 0;
    std::ptrdiff_t first = -1;
    for (const auto& [row, text] : column.exceptions) {
      if (!passes[row] || (column.is_text() && times.seconds[text])) continue;
      const std::string& cell = column.texts[text];
      if (IsMissingNumber(cell)) {
        ++missing;
        continue;
      }
      ++words;
      const bool out_of_place =
          IsSummary(cell) || (numbering[i] && !HasDigit(cell));
      if (first < 0 && out_of_place) first = static_cast<std::ptrdiff_t>(row);
    }
    const std::size_t usual = num_rows - words - missing;
    if (first < 0 || 100 * usual < kUsualPercent * (num_rows - missing)) {
      continue;
    }
    const auto row = static_cast<std::size_t>(first);
    throw InputError(table.Where(row, column.name) + ": " +
                     QuotedText(table.CellText(column, row)) +
                     " where the other rows have " +
                     (column.is_text() ? "times" : "numbers") +
                     ": a row of totals or a remark is no measurement; remove "
                     "it, or start it with #");
  }
}

std::vector<Index> RepeatedRows(const CsvTable& table,
                                std::size_t target,
                                const std::vector<bool>& passes) {
  std::unordered_map<std::uint64_t, std::size_t> first;
  std::vector<Index> repeated;
  std::set<double> levels;
  std::size_t others = 0;
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    if (!passes[row]) continue;
    if (!first.emplace(RowHash(table, row), row).second) {
      repeated.push_back(static_cast<Index>(row));
      continue;
    }
    ++others;
    const double value = table.columns[target].values[row];
    if (!std::isnan(value)) levels.insert(value);
  }
  constexpr std::size_t kFewestRepeated = 3;
  if (repeated.size() < kFewestRepeated || 2 * levels.size() < others)
    return {};
  return repeated;
}

std::vector<ColumnFault> FindTargetFaults(const MeasuredColumns& measured) {
  std::vector<ColumnFault> faults;
  LookForOtherUnit(measured, &faults);
  if (faults.empty()) LookForZeros(measured, &faults);
  return faults;
}

}  // namespace errmap::data
