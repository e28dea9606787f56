#include "data/measurements/row_faults.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
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

double SpreadOfMisses(const MeasuredColumns& measured,
                      const VectorXd& predicted,
                      const std::vector<Index>& rows) {
  constexpr double kNormalMad = 1.4826;
  std::vector<double> misses;
  for (const Index row : rows) {
    misses.push_back(std::abs(measured.target_values[row] - predicted[row]));
  }
  return kNormalMad * MedianOf(std::move(misses));
}

// Whether a target is exactly 0 more often than its resolution makes it: by
// three and by four times what the values next to 0 have in the mean.
bool AreInExcess(const std::vector<Index>& zeros,
                 const std::map<double, Index>& counts) {
  constexpr int kNeighbours = 4;  // on each side
  constexpr double kTimes = 4.0;
  constexpr double kMore = 3.0;
  double sum = 0.0;
  double number = 0.0;
  const auto zero = counts.find(0.0);
  auto above = zero;
  for (int i = 0; i < kNeighbours && ++above != counts.end(); ++i) {
    sum += static_cast<double>(above->second);
    number += 1.0;
  }
  auto below = zero;
  for (int i = 0; i < kNeighbours && below != counts.begin(); ++i) {
    sum += static_cast<double>((--below)->second);
    number += 1.0;
  }
  const double usual = number > 0.0 ? sum / number : 0.0;
  return static_cast<double>(zeros.size()) >= kTimes * usual + kMore;
}

void LookForZeros(const MeasuredColumns& measured,
                  std::vector<ColumnFault>* faults) {
  constexpr double kFar = 8.0;          // robust standard deviations, of the
  constexpr double kFarInExcess = 4.0;  // worst
  constexpr double kOfEach = 3.0;       // where rows may be 0 by resolution
  const VectorXd& target = measured.target_values;
  const Index m = target.size();
  std::vector<Index> zeros;
  std::vector<Index> others;
  std::map<double, Index> counts;
  for (Index row = 0; row < m; ++row) {
    (target[row] == 0.0 ? zeros : others).push_back(row);
    ++counts[target[row]];
  }
  if (zeros.empty() || static_cast<Index>(2 * zeros.size()) > m) return;
  const VectorXd predicted = LinearPrediction(measured, others);
  if (predicted.size() == 0) return;
  const double sd = SpreadOfMisses(measured, predicted, others);
  const bool in_excess = AreInExcess(zeros, counts);
  LeaveReferences(measured, &zeros);
  // Where values are few, some of these are errors that are small.
  if (2 * counts.size() < others.size()) {
    std::erase_if(zeros, [&](Index row) {
      return !(std::abs(predicted[row]) > kOfEach * sd);
    });
  }
  const auto worst = std::ranges::max_element(
      zeros, {}, [&](Index row) { return std::abs(predicted[row]); });
  if (worst == zeros.end() ||
      !(std::abs(predicted[*worst]) > (in_excess ? kFarInExcess : kFar) * sd)) {
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

// Rows one after another whose targets are of another size than the others'.
struct RowRun {
  std::size_t begin = 0;  // into the rows looked at
  std::size_t end = 0;
  double ratio = 1.0;  // of the others' sizes to theirs
};

// The rows from begin to end, and the others.
std::array<std::vector<Index>, 2> PartedBy(const std::vector<Index>& rows,
                                           const RowRun& run) {
  std::array<std::vector<Index>, 2> parts;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    parts[i >= run.begin && i < run.end ? 0 : 1].push_back(rows[i]);
  }
  return parts;
}

// Of the targets that are not 0; 0 where all are. Other such runs among the
// others do not move it as they move their mean.
double MedianSize(const VectorXd& target, const std::vector<Index>& rows) {
  std::vector<double> sizes;
  for (const Index row : rows) {
    if (target[row] != 0.0) sizes.push_back(std::abs(target[row]));
  }
  return sizes.empty() ? 0.0 : MedianOf(std::move(sizes));
}

// The run that departs most from the mean of the logarithms of sizes: between
// the extremes of their running sum (Levin & Kline 1985), which may lie at an
// end. Logarithms, so that single wrong values count little; zeros do not.
RowRun RunOfOtherSize(const VectorXd& target, const std::vector<Index>& rows) {
  double all = 0.0;
  double count = 0.0;
  for (const Index row : rows) {
    if (target[row] == 0.0) continue;
    all += std::log(std::abs(target[row]));
    count += 1.0;
  }
  double sum = 0.0;
  double least = 0.0;
  double most = 0.0;
  std::size_t at_least = 0;
  std::size_t at_most = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double value = target[rows[i]];
    if (value != 0.0) sum += std::log(std::abs(value)) - all / count;
    if (sum < least) {
      least = sum;
      at_least = i + 1;
    }
    if (sum > most) {
      most = sum;
      at_most = i + 1;
    }
  }
  RowRun run{.begin = std::min(at_least, at_most),
             .end = std::max(at_least, at_most)};
  const auto [inside, outside] = PartedBy(rows, run);
  run.ratio = MedianSize(target, outside) / MedianSize(target, inside);
  return run;
}

// Whether these targets are what the others foretell when they are taken for
// thousandths: a cold machine's errors are small, too, and stay so.
bool AreThousandths(const MeasuredColumns& measured,
                    const std::vector<Index>& small,
                    const std::vector<Index>& large) {
  constexpr double kThousand = 1000.0;
  constexpr double kBetter = 0.25;  // of the squares
  const VectorXd predicted = LinearPrediction(measured, large);
  if (predicted.size() == 0) return false;
  const VectorXd target = measured.target_values(small);
  const VectorXd wanted = predicted(small);
  return (kThousand * target - wanted).squaredNorm() <
         kBetter * (target - wanted).squaredNorm();
}

// Every run of rows in another unit, the clearest first: sessions by turns
// make several.
void LookForOtherUnit(const MeasuredColumns& measured,
                      std::vector<ColumnFault>* faults) {
  constexpr std::size_t kMostRuns = 20;
  constexpr std::size_t kFewestRows = 5;
  constexpr double kLeastRatio = 200.0;
  constexpr double kMostRatio = 5000.0;
  // A part as large as this needs no map to be in another unit.
  constexpr double kLargePart = 0.2;
  std::vector<Index> rows(
      static_cast<std::size_t>(measured.target_values.size()));
  std::iota(rows.begin(), rows.end(), Index{0});
  const auto number = static_cast<double>(rows.size());
  while (faults->size() < kMostRuns) {
    const RowRun run = RunOfOtherSize(measured.target_values, rows);
    const double ratio = std::max(run.ratio, 1.0 / run.ratio);  // NaN: neither
    if (!(ratio >= kLeastRatio && ratio <= kMostRatio)) return;
    auto [small, large] = PartedBy(rows, run);
    if (run.ratio < 1.0) std::swap(small, large);
    const auto shorter = std::min(small.size(), large.size());
    if (shorter < kFewestRows ||
        (static_cast<double>(shorter) < kLargePart * number &&
         !AreThousandths(measured, small, large))) {
      return;
    }
    faults->push_back({.kind = FaultKind::kOtherUnit,
                       .input = -1,
                       .rows = std::move(small),
                       .of_cells = true,
                       .value = ratio,
                       .low = 0.0,
                       .high = 0.0});
    rows = std::move(large);
  }
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
