#include "data/measurements/reading/axis.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/argument_name.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/reading/column_words.h"
#include "data/units.h"

namespace errmap::data {
namespace {

using Eigen::Index;

bool IsLengthOrAngle(const Unit& unit) {
  return unit.quantity == Quantity::kLength ||
         unit.quantity == Quantity::kAngle;
}

// What errors are in, and positions hardly ever.
bool IsSmall(const Unit& unit) {
  constexpr std::string_view kSmall[] = {"nm", "um", "uin", "arcsec", "urad"};
  return std::ranges::count(kSmall, std::string_view(unit.symbol)) > 0;
}

struct Candidate {
  std::size_t column = 0;
  bool named = false;
  bool nominal = false;
  bool measured = false;
  bool constant = false;
  Levels levels = {};
  Motion motion = {};

  // How often it changes from row to row: an axis more often than what counts
  // its passes.
  Index Moves() const {
    Index moves = 0;
    for (std::size_t i = 1; i < levels.codes.size(); ++i) {
      moves += levels.codes[i] != levels.codes[i - 1] ? 1 : 0;
    }
    return moves;
  }

  // Higher is likelier.
  int Rank() const {
    return (motion.is_commanded ? 8 : 0) + (named ? 4 : 0) + (nominal ? 2 : 0) -
           (measured ? 3 : 0) - (levels.width > 0.0 ? 1 : 0);
  }
};

class AxisFinder {
 public:
  AxisFinder(const CsvTable& table,
             const DatasetSelection& selection,
             std::size_t target,
             const std::vector<Index>& rows)
      : table_(table), selection_(selection), target_(target), rows_(rows) {}

  Axis Find() {
    if (!selection_.position.empty()) {
      const std::size_t index =
          RequireColumn(table_, selection_.position, ArgumentName("position"));
      RequireNumbers(table_, {index, ColumnUse::kOther});
      TakeFrom(Look(index, rows_.size()));
      axis_.evidence = Evidence::kUser;
      axis_.positions.push_back(index);
      AddNamed();
      return std::move(axis_);
    }
    std::vector<Candidate> candidates = Named();
    if (candidates.empty()) candidates = ByValues();
    if (!candidates.empty()) Choose(&candidates);
    return std::move(axis_);
  }

 private:
  const std::string& Name(std::size_t i) const {
    return table_.columns[i].name;
  }

  bool IsFree(std::size_t i) const {
    const CsvColumn& column = table_.columns[i];
    return i != target_ && !column.is_text() && column.has_name &&
           Name(i) != selection_.weight && Name(i) != selection_.group &&
           Name(i) != selection_.time && Name(i) != selection_.session &&
           !KeepsRecord(Name(i)) &&
           std::ranges::find(selection_.exclude, Name(i)) ==
               selection_.exclude.end();
  }

  Candidate Look(std::size_t column, std::size_t most_rows) const {
    Candidate candidate{.column = column};
    const std::vector<std::string> words = WordsOf(Name(column));
    candidate.named = IsCalledPosition(Name(column));
    candidate.nominal = SayAny(words, Word::kNominal);
    candidate.measured = SayAny(words, Word::kMeasured);
    std::vector<double> values;
    const std::size_t n = std::min(most_rows, rows_.size());
    values.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      values.push_back(
          table_.columns[column].values[static_cast<std::size_t>(rows_[i])]);
    }
    candidate.levels = LevelsOf(values);
    candidate.motion = MotionThrough(candidate.levels);
    candidate.constant = candidate.levels.centers.size() <= 1;
    return candidate;
  }

  std::vector<Candidate> Named() const {
    std::vector<Candidate> found;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (!IsFree(i) || !IsCalledPosition(Name(i))) continue;
      Candidate candidate = Look(i, kRowsLooked);
      // A letter alone may be anything.
      if (candidate.motion.is_commanded || NamesPosition(Name(i)) ||
          !IsAxisLetter(Name(i)) || !UnitOfColumn(Name(i)).symbol.empty()) {
        found.push_back(std::move(candidate));
      }
    }
    return found;
  }

  // Of no name that says it: lengths, angles, and what has no unit.
  std::vector<Candidate> ByValues() const {
    constexpr std::size_t kMostLooked = 200;
    std::vector<Candidate> found;
    std::size_t looked = 0;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const Unit unit = UnitOfColumn(Name(i));
      if (!IsFree(i) || IsSmall(unit) ||
          !(IsLengthOrAngle(unit) || unit.symbol.empty()) ||
          Says(Name(i), Word::kTemperature) ||
          Says(Name(i), Word::kDirection) ||
          CountsCycles({.name = Name(i), .unit = unit}) ||
          ++looked > kMostLooked) {
        continue;
      }
      Candidate candidate = Look(i, kRowsLooked);
      if (candidate.motion.is_commanded ||
          (candidate.motion.is_sorted && candidate.levels.come_alike)) {
        found.push_back(std::move(candidate));
      }
    }
    return found;
  }

  void Choose(std::vector<Candidate>* candidates) {
    std::ranges::stable_sort(
        *candidates, std::greater<>(), [](const Candidate& candidate) {
          return std::pair(candidate.Rank(), candidate.Moves());
        });
    const Candidate& best = candidates->front();
    const bool beside_constant =
        std::ranges::any_of(*candidates, &Candidate::constant) &&
        !best.motion.is_commanded;
    for (const Candidate& other : *candidates) {
      const bool reads = &other != &best && !other.motion.is_commanded &&
                         !other.constant && IsReadBeside(other, best);
      (reads ? axis_.measured : axis_.positions).push_back(other.column);
    }
    if (best.constant) return;
    if (beside_constant) {
      // Held in one place: what is read there is the error itself.
      std::erase(axis_.positions, best.column);
      axis_.measured.push_back(best.column);
      return;
    }
    axis_.sure = best.motion.is_commanded || best.named;
    axis_.evidence = best.named ? best.motion.is_commanded
                                      ? Evidence::kNameAndValues
                                      : Evidence::kName
                                : Evidence::kValues;
    if (candidates->size() > 1 && !(*candidates)[1].constant &&
        (*candidates)[1].motion.is_commanded == best.motion.is_commanded) {
      axis_.alternative = Name((*candidates)[1].column);
      axis_.sure = axis_.sure && best.Rank() > (*candidates)[1].Rank();
    }
    if (!best.named && UnitOfColumn(Name(best.column)).symbol.empty()) {
      axis_.sure = false;
    }
    const std::size_t column = best.column;
    TakeFrom(rows_.size() > kRowsLooked ? Look(column, rows_.size())
                                        : std::move(candidates->front()));
  }

  // Whether one column is the other as an instrument read it.
  bool IsReadBeside(const Candidate& read, const Candidate& commanded) const {
    if (!commanded.motion.is_commanded) return false;
    const auto& a = table_.columns[read.column].values;
    const auto& b = table_.columns[commanded.column].values;
    const Levels& levels = commanded.levels;
    const double spacing = (levels.centers.back() - levels.centers.front()) /
                           static_cast<double>(levels.centers.size() - 1);
    for (const Index row : rows_) {
      const double away =
          a[static_cast<std::size_t>(row)] - b[static_cast<std::size_t>(row)];
      if (std::abs(away) > 0.25 * spacing) return false;
    }
    return true;
  }

  void TakeFrom(Candidate candidate) {
    axis_.column = static_cast<std::ptrdiff_t>(candidate.column);
    axis_.levels = std::move(candidate.levels);
    axis_.motion = std::move(candidate.motion);
  }

  void AddNamed() {
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (IsFree(i) && IsCalledPosition(Name(i)) &&
          std::cmp_not_equal(i, axis_.column)) {
        axis_.positions.push_back(i);
      }
    }
  }

  static constexpr std::size_t kRowsLooked = 20000;

  const CsvTable& table_;
  const DatasetSelection& selection_;
  std::size_t target_;
  const std::vector<Index>& rows_;
  Axis axis_;
};

}  // namespace

bool IsCalledPosition(std::string_view name) {
  const Header header = ReadHeader(name);
  const bool fits = header.source == UnitSource::kNone ||
                    header.source == UnitSource::kAssumed ||
                    (IsLengthOrAngle(header.unit) && !IsSmall(header.unit));
  const std::vector<std::string> words = WordsOf(name);
  if (SayAny(words, Word::kError) || SayAny(words, Word::kCorrection)) {
    return false;
  }
  return NamesPosition(name) ||
         (fits && (SayAny(words, Word::kPosition) ||
                   (SayAny(words, Word::kNominal) && words.size() <= 2) ||
                   IsAxisLetter(name)));
}

Axis FindAxis(const CsvTable& table,
              const DatasetSelection& selection,
              std::size_t target,
              const std::vector<Index>& rows) {
  return AxisFinder(table, selection, target, rows).Find();
}

}  // namespace errmap::data
