#include "data/measurements/axis/counting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

constexpr Index kNearlyAll = 90;  // percent

bool AreNearlyAll(Index part, Index of) {
  return 100 * part >= kNearlyAll * of;
}

// Where a column changes, and how.
class ChangesOf {
 public:
  ChangesOf(const std::vector<double>& values, const Motion& motion)
      : motion_(motion),
        has_passes_(motion.num_passes >= 2),
        rows_(std::ssize(values)) {
    double before = std::nan("");
    Index length = 0;  // of the block so far: passes, or rows without any
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double now = values[i];
      if (i == 0) {
        first_ = now;
      } else if (now != before) {
        Note(now - before, PlaceOf(i));
        shortest_ = std::min(shortest_, length);
        length = 0;
      } else if (PlaceOf(i) == Place::kPass) {
        ++passes_without_;
      } else if (PlaceOf(i) == Place::kTurn) {
        ++turns_without_;
      }
      const bool begins = i == 0 || !has_passes_ || PlaceOf(i) == Place::kPass;
      if (begins) ++length;
      before = now;
    }
  }

  Counted Counts(bool is_called) const {
    const Index changes = passes_with_ + turns_with_ + inside_;
    if (changes == 0 || 2 * even_ <= changes) {
      return Counted::kNothing;
    }
    constexpr Index kFewestRows = 12;
    const double step = std::abs(step_);
    const bool is_round = step == 1.0 || step == 5.0 || step == 10.0 ||
                          step == 100.0;  // as programs number their lines
    if (rows_ < kFewestRows || !is_round) return Counted::kNothing;
    if (AreNearlyAll(even_, rows_ - 1)) return Counted::kRows;
    if (has_passes_ && inside_ > 0) return Counted::kNothing;
    const bool every_pass =
        has_passes_ &&
        AreNearlyAll(passes_with_, passes_with_ + passes_without_);
    if (every_pass && turns_with_ == 0) return Counted::kPasses;
    if (every_pass && AreNearlyAll(turns_with_, turns_with_ + turns_without_)) {
      return Counted::kWays;
    }
    constexpr Index kFewestPasses = 2;
    constexpr Index kFewestInBlock = 8;  // rows
    const bool begins_so =
        is_called || first_ == 1.0 || (first_ == 0.0 && changes >= 2);
    const bool are_blocks =
        back_ == 0 && step_ == 1.0 && turns_with_ == 0 && begins_so &&
        shortest_ >= (has_passes_ ? kFewestPasses : kFewestInBlock);
    return are_blocks ? Counted::kBlocks : Counted::kNothing;
  }

 private:
  enum class Place { kInside, kPass, kTurn };

  Place PlaceOf(std::size_t i) const {
    if (!has_passes_) return Place::kInside;
    if (motion_.passes[i] != motion_.passes[i - 1]) return Place::kPass;
    const bool turns =
        motion_.both_ways && motion_.directions[i] != motion_.directions[i - 1];
    return turns ? Place::kTurn : Place::kInside;
  }

  void Note(double step, Place place) {
    (place == Place::kPass   ? passes_with_
     : place == Place::kTurn ? turns_with_
                             : inside_)++;
    if (step_ == 0.0) step_ = step;
    even_ += step == step_ ? 1 : 0;
    back_ += step < 0.0 ? 1 : 0;
  }

  const Motion& motion_;
  bool has_passes_;
  Index rows_;
  double first_ = 0.0;
  Index passes_with_ = 0;
  Index passes_without_ = 0;
  Index turns_with_ = 0;
  Index turns_without_ = 0;
  Index inside_ = 0;
  double step_ = 0.0;  // the first
  Index even_ = 0;     // changes by as much
  Index back_ = 0;
  Index shortest_ = std::numeric_limits<Index>::max();
};

bool MayCount(const CsvColumn& column) {
  return column.has_name && UnitOfColumn(column.name).symbol.empty() &&
         !IsCalledPosition(column.name) &&
         !Says(column.name, Word::kTemperature) &&
         !IsCalled(column.name, Word::kPart) &&
         !IsCalled(column.name, Word::kComponent) &&
         !IsCalled(column.name, Word::kDirection) && !HoldsTimes(column);
}

// Whole numbers; of words 0, 1, ... in the order in which they appear. None
// where the column has others, or lacks one.
std::vector<double> NumbersOf(const CsvTable& table,
                              const CsvColumn& column,
                              const std::vector<Index>& rows) {
  constexpr std::size_t kMostWords = 1000;
  std::vector<double> numbers;
  if (!column.is_text()) {
    for (const Index row : rows) {
      const double value = column.values[row];
      if (value != std::floor(value)) return {};  // NaN, too
      numbers.push_back(value);
    }
    return numbers;
  }
  const LabelsOfRows words = LabelsOf(table, column, rows, kMostWords);
  if (words.codes.size() == rows.size() &&
      std::ranges::none_of(words.labels, IsMissingText)) {
    numbers.assign(words.codes.begin(), words.codes.end());
  }
  return numbers;
}

// Of what changes with each pass: words that come again name what a pass has.
Counted AsTurns(const std::vector<double>& values, bool are_words) {
  const bool goes_on = std::ranges::is_sorted(values) ||
                       std::ranges::is_sorted(values, std::greater<>());
  if (goes_on) return Counted::kPasses;
  if (are_words) return Counted::kNothing;
  constexpr std::size_t kTwo = 2;
  const std::set<double> distinct(values.begin(), values.end());
  return distinct.size() > kTwo ? Counted::kPasses : Counted::kTurns;
}

}  // namespace

std::string_view ToString(Counted counted) {
  constexpr auto kNames =
      std::to_array<std::string_view>({"counts nothing",
                                       "counts the rows",
                                       "counts the passes along the axis",
                                       "counts the passes so far",
                                       "changes by turns with the passes",
                                       "counts the ways along the axis",
                                       "counts days or other blocks of rows"});
  return NameOf(kNames, counted);
}

std::vector<Counter> FindCounters(const CsvTable& table,
                                  const DatasetSelection& selection,
                                  std::size_t target,
                                  const std::vector<Index>& rows,
                                  const Motion& motion) {
  std::vector<Counter> found;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    const std::string& name = column.name;
    const bool is_named = std::ranges::count(selection.inputs, name) > 0 ||
                          name == selection.session;
    if (i == target || is_named || !MayCount(column)) continue;
    const bool is_called =
        KeepsRecord(column) || column.is_text() || Says(name, Word::kDay);
    const std::vector<double> values = NumbersOf(table, column, rows);
    Counted counts = ChangesOf(values, motion).Counts(is_called);
    if (counts == Counted::kPasses && !is_called &&
        CountsCycles({.name = name, .unit = {}})) {
      counts = Counted::kElapsed;
    }
    if (counts == Counted::kPasses && !KeepsRecord(column)) {
      counts = AsTurns(values, column.is_text());
    }
    if (counts != Counted::kNothing) found.push_back({i, counts});
  }
  return found;
}

}  // namespace errmap::data
