#include "data/measurements/faults/row_faults.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <unordered_map>

#include "data/argument_name.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/dataset.h"
#include "data/measurements/faults/thermometers.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/least_squares.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// "Mean", "1 Average", "End of file".
bool IsSummary(std::string_view text) {
  return HasWordOf(
      text,
      "mean average avg total totals subtotal sum summe gesamt ergebnis "
      "teilergebnis gesamtergebnis mittel mittelwert moyenne media min max "
      "minimum maximum std stdev sd sigma median count range rms anzahl eof "
      "end ende massimo minimo medel gemiddelde suma celkem razem "
      "\u6700\u5927\u503c \u6700\u5c0f\u503c \u5e73\u5747\u503c "
      "\u5e73\u5747");
}

// Of the rows, what numbers or times must be for a word to be out of place.
constexpr std::size_t kUsualPercent = 80;

// A row as one number; rows that differ have others, but by rare chance. In
// which file or session it stands does not count.
std::uint64_t RowHash(const CsvTable& table,
                      const std::vector<const CsvColumn*>& columns,
                      std::size_t row) {
  std::uint64_t hash = 0;
  const auto mix = [&](std::uint64_t bits) {
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32U;
  };
  for (const CsvColumn* const measured : columns) {
    const CsvColumn& column = *measured;
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
  const VectorXd b = SolveLeastSquares(design, measured.target_values(rows));
  return (measured.input_values.leftCols(p) * b.tail(p)).array() + b[0];
}

// Takes out zeros of an error that is measured from there, as at the position
// of reference: all rows of that value of an input are zero. Of inputs whose
// values come again by design: two lost rows may read alike by chance.
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
    constexpr Index kRowsPerValue = 3;
    if (kRowsPerValue * std::ssize(counts) > target.size()) continue;
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
                     .rows = zeros,
                     .of_cells = true,
                     .low = predicted[*worst],
                     .high = sd});
}

// Rows whose targets are not 0, and the logarithms of their sizes, each the
// median of five rows: single small errors part nothing.
struct Sizes {
  std::vector<Index> rows;
  std::vector<double> logs;
};

Sizes SmoothedSizes(const VectorXd& target,
                    const std::vector<Index>& no_readings) {
  constexpr std::size_t kReach = 2;  // rows on each side
  Sizes sizes;
  std::vector<double> logs;
  for (Index row = 0; row < target.size(); ++row) {
    if (target[row] == 0.0 || std::ranges::binary_search(no_readings, row)) {
      continue;
    }
    sizes.rows.push_back(row);
    logs.push_back(std::log(std::abs(target[row])));
  }
  for (std::size_t i = 0; i < logs.size(); ++i) {
    const std::size_t from = i < kReach ? 0 : i - kReach;
    const std::size_t to = std::min(logs.size(), i + kReach + 1);
    sizes.logs.push_back(MedianOf({logs.begin() + std::ptrdiff_t(from),
                                   logs.begin() + std::ptrdiff_t(to)}));
  }
  return sizes;
}

// Two sizes that part the rows: the middle between them, and how many times
// larger the larger is; 1 where they are not units apart, or sizes lie between.
struct TwoSizes {
  double middle = 0.0;  // logarithm
  double ratio = 1.0;
};

TwoSizes PartSizes(std::vector<double> logs) {
  constexpr double kLeastRatio = 200.0;
  constexpr double kMostRatio = 5000.0;
  constexpr double kMostBetween = 0.1;  // of the rows, in the middle half
  if (logs.size() < 2) return {};
  std::ranges::sort(logs);
  // The cut with the most variance between the parts (Otsu 1979).
  const auto count = static_cast<double>(logs.size());
  const double all = std::accumulate(logs.begin(), logs.end(), 0.0);
  double sum = 0.0;
  double best = -1.0;
  std::size_t cut = 1;
  for (std::size_t i = 1; i < logs.size(); ++i) {
    sum += logs[i - 1];
    const auto before = static_cast<double>(i);
    const double difference = sum / before - (all - sum) / (count - before);
    const double between = before * (count - before) * difference * difference;
    if (between > best) {
      best = between;
      cut = i;
    }
  }
  const double small = logs[cut / 2];
  const double large = logs[cut + (logs.size() - cut) / 2];
  const double apart = large - small;
  const double ratio = std::exp(apart);
  const auto num_between =
      static_cast<double>(std::ranges::count_if(logs, [&](double size) {
        return size > small + apart / 4.0 && size < large - apart / 4.0;
      }));
  if (!(ratio >= kLeastRatio && ratio <= kMostRatio) ||
      num_between > kMostBetween * count) {
    return {};
  }
  return {.middle = 0.5 * (small + large), .ratio = ratio};
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

// Rows in another unit, a fault for each run of them: any block, and sessions
// by turns.
void LookForOtherUnit(const MeasuredColumns& measured,
                      const std::vector<Index>& no_readings,
                      std::vector<ColumnFault>* faults) {
  constexpr std::size_t kFewestRows = 5;
  // A part as large as this needs no map to be in another unit.
  constexpr double kLargePart = 0.2;
  const Sizes sizes = SmoothedSizes(measured.target_values, no_readings);
  const TwoSizes two = PartSizes(sizes.logs);
  if (two.ratio == 1.0) return;
  std::vector<std::vector<Index>> runs;
  std::vector<Index> small;
  std::vector<Index> large;
  for (std::size_t i = 0; i < sizes.rows.size(); ++i) {
    if (sizes.logs[i] >= two.middle) {
      large.push_back(sizes.rows[i]);
      continue;
    }
    if (i == 0 || sizes.logs[i - 1] >= two.middle) runs.emplace_back();
    runs.back().push_back(sizes.rows[i]);
    small.push_back(sizes.rows[i]);
  }
  if (static_cast<double>(small.size()) <
          kLargePart * static_cast<double>(sizes.rows.size()) &&
      !AreThousandths(measured, small, large)) {
    return;
  }
  for (std::vector<Index>& run : runs) {
    if (run.size() < kFewestRows) continue;
    faults->push_back({.kind = FaultKind::kOtherUnit,
                       .rows = std::move(run),
                       .of_cells = true,
                       .value = two.ratio});
  }
}

}  // namespace

std::vector<Index> LeaveOutRowsOfWords(const CsvTable& table,
                                       const std::vector<bool>& numbering,
                                       MissingPolicy missing_policy,
                                       std::vector<bool>* passing) {
  std::vector<bool>& passes = *passing;
  std::vector<Index> left_out;
  const auto num_rows =
      static_cast<std::size_t>(std::ranges::count(passes, true));
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    if (column.texts.empty()) continue;
    const TextTimes times = column.is_text() ? ReadTimes(column) : TextTimes{};
    std::size_t words = 0;
    std::size_t missing = 0;
    std::vector<std::size_t> rows;
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
      if (out_of_place) rows.push_back(row);
    }
    const std::size_t usual = num_rows - words - missing;
    if (rows.empty() || 100 * usual < kUsualPercent * (num_rows - missing)) {
      continue;
    }
    const std::size_t row = rows.front();
    if (missing_policy == MissingPolicy::kDropRows) {
      for (const std::size_t at : rows) {
        passes[at] = false;
        left_out.push_back(static_cast<Index>(at));
      }
      continue;
    }
    throw InputError(
        table.Where(row, column.name) + ": " +
        QuotedText(table.CellText(column, row)) +
        " where the other rows have " +
        (column.is_text() ? "times" : "numbers") +
        ": a row of totals or a remark is not a measurement; remove "
        "it, start it with #, or leave it out with " +
        ArgumentName("missing", "drop-rows"));
  }
  return left_out;
}

std::vector<Index> RepeatedRows(const CsvTable& table,
                                std::size_t target,
                                const std::vector<bool>& passes,
                                Index times_again) {
  std::unordered_map<std::uint64_t, std::size_t> first;
  std::vector<Index> repeated;
  std::vector<std::size_t> back;  // rows, from each of those to its first
  std::set<double> levels;
  std::size_t others = 0;
  std::vector<const CsvColumn*> columns;
  for (const CsvColumn& column : table.columns) {
    if (column.has_name && column.name != kFileColumn &&
        !IsCalled(column.name, Word::kSession)) {
      columns.push_back(&column);
    }
  }
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    if (!passes[row]) continue;
    const auto [at, is_new] = first.emplace(RowHash(table, columns, row), row);
    if (!is_new) {
      repeated.push_back(static_cast<Index>(row));
      back.push_back(row - at->second);
      continue;
    }
    ++others;
    const double value = table.columns[target].values[row];
    if (!std::isnan(value)) levels.insert(value);
  }
  if (std::ssize(repeated) == times_again) return repeated;
  // Rows that agree by chance do not follow each other.
  const auto follows = [&](std::size_t i) {
    return i > 0 && i < back.size() && back[i] == back[i - 1] &&
           repeated[i] - repeated[i - 1] <= (back[i] == 1 ? 2 : 1);
  };
  std::vector<Index> in_blocks;
  for (std::size_t i = 0; i < repeated.size(); ++i) {
    if (follows(i) || follows(i + 1)) in_blocks.push_back(repeated[i]);
  }
  constexpr std::size_t kFewestRepeated = 3;
  if (in_blocks.size() < kFewestRepeated || 2 * levels.size() < others)
    return {};
  return in_blocks;
}

std::vector<ColumnFault> FindTargetFaults(
    const MeasuredColumns& measured, const std::vector<Index>& no_readings) {
  std::vector<ColumnFault> faults;
  LookForOtherUnit(measured, no_readings, &faults);
  if (faults.empty()) LookForZeros(measured, &faults);
  return faults;
}

std::vector<ColumnFault> FindSlippedPoints(const MeasuredColumns& measured) {
  constexpr double kTen = 10.0;
  constexpr double kFar = 8.0;   // robust standard deviations off
  constexpr double kNear = 2.0;  // once the point is put right
  constexpr Index kRowsPerSlip = 20;
  const VectorXd& target = measured.target_values;
  const std::vector<Index> all =
      AllRows(static_cast<std::size_t>(target.size()));
  const VectorXd predicted = LinearPrediction(measured, all);
  if (predicted.size() == 0) return {};
  const double sd = SpreadOfMisses(measured, predicted, all);
  ColumnFault fault{.kind = FaultKind::kOutlying, .rows = {}, .of_cells = true};
  fault.low = std::numeric_limits<double>::infinity();
  fault.high = -fault.low;
  for (const Index row : all) {
    const double value = target[row];
    if (std::abs(value - predicted[row]) > kFar * sd &&
        std::abs(value / kTen - predicted[row]) < kNear * sd) {
      fault.rows.push_back(row);
    } else {
      fault.low = std::min(fault.low, value);
      fault.high = std::max(fault.high, value);
    }
  }
  // Many are heavy tails; and what others have, too, is not a slip.
  if (fault.rows.empty() || sd == 0.0 ||
      kRowsPerSlip * std::ssize(fault.rows) > target.size()) {
    return {};
  }
  std::erase_if(fault.rows, [&](Index row) {
    return target[row] >= fault.low && target[row] <= fault.high;
  });
  if (fault.rows.empty()) return {};
  fault.value = target[fault.rows.front()];
  return {fault};
}

}  // namespace errmap::data
