#include "data/measurements/axis/axis.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

using Eigen::Index;

struct Candidate {
  std::size_t column = 0;
  bool named = false;
  bool nominal = false;
  bool measured = false;
  bool constant = false;
  bool numbers = false;  // 1, 2, 3, ... without a unit
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

  // Higher is likelier. What numbers positions is beside what measures them.
  int Rank() const {
    return (motion.is_commanded ? 8 : 0) + (named && !measured ? 4 : 0) +
           (nominal ? 2 : 0) - (measured ? 3 : 0) -
           (levels.width > 0.0 ? 1 : 0) - (numbers ? 7 : 0);
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
    if (selection_.position.empty()) {
      ChooseByNameAndValues();
    } else {
      TakeNamed();
    }
    FindNumbers();
    FindReadings();
    FindHeld();
    return std::move(axis_);
  }

 private:
  const std::string& Name(std::size_t i) const {
    return table_.columns[i].name;
  }

  void TakeNamed() {
    const std::size_t index =
        RequireColumn(table_, selection_.position, ArgumentName("position"));
    RequireNumbers(table_, {index, ColumnUse::kOther});
    const Quantity quantity = UnitOfColumn(Name(index)).quantity;
    if (quantity == Quantity::kTemperature || quantity == Quantity::kTime) {
      throw InputError(PrintablePath(table_.file) + ": " +
                       ArgumentName("position", Name(index)) + ": " +
                       "is no position; name a length or an angle");
    }
    TakeFrom(Look(index, rows_.size()));
    axis_.evidence = Evidence::kUser;
    axis_.positions.push_back(index);
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (i != index && IsFree(i) && IsCalledPosition(Name(i))) {
        axis_.positions.push_back(i);
      }
    }
  }

  void ChooseByNameAndValues() {
    std::vector<Candidate> candidates = Named();
    if (candidates.empty()) {
      candidates = ByValues();
      if (candidates.empty()) candidates = ByPlaces();
    } else if (std::ranges::all_of(candidates, [](const Candidate& named) {
                 return named.numbers || named.measured;
               })) {
      // What numbers positions, or reads them, is called so, too.
      for (Candidate& other : ByValues()) {
        if (IsLengthOrAngle(UnitOfColumn(Name(other.column)))) {
          candidates.push_back(std::move(other));
        }
      }
    }
    if (!candidates.empty()) Choose(&candidates);
  }

  bool IsFree(std::size_t i) const {
    const CsvColumn& column = table_.columns[i];
    return i != target_ && !column.is_text() && column.has_name &&
           Name(i) != selection_.weight && Name(i) != selection_.group &&
           Name(i) != selection_.time && Name(i) != selection_.session &&
           !KeepsRecord(column) &&
           std::ranges::find(selection_.exclude, Name(i)) ==
               selection_.exclude.end();
  }

  Candidate Look(std::size_t column, std::size_t most_rows) const {
    Candidate candidate{.column = column};
    const std::vector<std::string> words = WordsOf(Name(column));
    candidate.named = IsCalledPosition(Name(column));
    candidate.nominal = SayAny(words, Word::kNominal);
    candidate.measured = SayAny(words, Word::kMeasured);
    const std::span<const Index> looked(rows_.data(),
                                        std::min(most_rows, rows_.size()));
    candidate.levels = LevelsOf(ValuesOf(table_.columns[column], looked));
    candidate.motion = MotionThrough(candidate.levels);
    candidate.constant = candidate.levels.centers.size() <= 1;
    candidate.numbers =
        ReadHeader(Name(column)).source != UnitSource::kStated &&
        AreSuccessive(candidate.levels.centers);
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

  // Of no name that says it: lengths, angles, and what has no unit. In a unit
  // of errors only what rows pass through as they do where an axis is sent.
  std::vector<Candidate> ByValues() const {
    constexpr std::size_t kMostLooked = 200;
    std::vector<Candidate> found;
    std::size_t looked = 0;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const Unit unit = UnitOfColumn(Name(i));
      const bool may_err = IsInUnitOfErrors(Name(i));
      if (!IsFree(i) || (may_err && ErrorSign(Name(i)) != 0) ||
          IsCalledPosition(Name(i)) ||
          !(IsLengthOrAngle(unit) || IsOneOf(unit.symbol, "counts steps") ||
            unit.symbol.empty()) ||
          Says(Name(i), Word::kTemperature) ||
          Says(Name(i), Word::kDirection) || Says(Name(i), Word::kSpeed) ||
          CountsCycles({.name = Name(i), .unit = unit}) ||
          ++looked > kMostLooked) {
        continue;
      }
      Candidate candidate = Look(i, kRowsLooked);
      if (candidate.motion.is_commanded ||
          (!may_err && candidate.motion.is_sorted &&
           candidate.levels.come_alike)) {
        found.push_back(std::move(candidate));
      }
    }
    return found;
  }

  // Numbers of places, where nothing says where these are.
  std::vector<Candidate> ByPlaces() const {
    std::vector<Candidate> found;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (table_.columns[i].is_text() || !IsCalled(Name(i), Word::kPlace)) {
        continue;
      }
      Candidate candidate = Look(i, kRowsLooked);
      if (candidate.numbers && candidate.motion.is_commanded) {
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
      const bool varies =
          !other.motion.is_commanded || other.levels.width > best.levels.width;
      const bool reads = &other != &best && varies && !other.constant &&
                         IsReadBeside(other, best);
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

  // Whole numbers from 0 or 1 on, each one more than the one before.
  static bool AreSuccessive(const std::vector<double>& levels) {
    if (levels.size() < 3 || !(levels[0] == 0.0 || levels[0] == 1.0)) {
      return false;
    }
    for (std::size_t i = 1; i < levels.size(); ++i) {
      if (levels[i] != levels[i - 1] + 1.0) return false;
    }
    return true;
  }

  // Whether one column is the other as an instrument read it.
  bool IsReadBeside(const Candidate& read, const Candidate& commanded) const {
    if (!commanded.motion.is_commanded) return false;
    const Unit of_read = UnitOfColumn(Name(read.column));
    const Unit of_commanded = UnitOfColumn(Name(commanded.column));
    const bool converts = AreConvertible(of_read, of_commanded);
    const auto& a = table_.columns[read.column].values;
    const auto& b = table_.columns[commanded.column].values;
    const Levels& levels = commanded.levels;
    const double spacing = (levels.centers.back() - levels.centers.front()) /
                           static_cast<double>(levels.centers.size() - 1);
    for (const Index row : rows_) {
      const double value = a[row];
      const double away =
          (converts ? Converted(value, of_read, of_commanded) : value) - b[row];
      if (std::abs(away) > 0.25 * spacing) return false;
    }
    return true;
  }

  // Columns whose whole numbers go with the positions, one each.
  void FindNumbers() {
    const std::vector<Index>& codes = axis_.levels.codes;
    const std::size_t places = axis_.levels.centers.size();
    if (codes.size() != rows_.size() || places < 3 ||
        2 * places > rows_.size()) {
      return;  // in whatever order they come
    }
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (std::cmp_equal(i, axis_.column) ||
          ReadHeader(Name(i)).source == UnitSource::kStated || !IsFree(i)) {
        continue;
      }
      const ColumnValues& values = table_.columns[i].values;
      std::vector<double> number(axis_.levels.centers.size(), std::nan(""));
      bool goes_with = true;
      for (std::size_t k = 0; goes_with && k < rows_.size(); ++k) {
        const double value = values[rows_[k]];
        goes_with = codes[k] >= 0 && value == std::floor(value);
        if (!goes_with) break;
        double& known = number[codes[k]];
        if (std::isnan(known)) known = value;
        goes_with = known == value;
      }
      if (!goes_with) continue;
      const bool rises = number.front() < number.back();
      if (!rises) std::ranges::reverse(number);
      if (std::ranges::adjacent_find(number, std::greater_equal<>()) ==
          number.end()) {
        axis_.numbers.push_back(i);
        std::erase(axis_.positions, i);
      }
    }
  }

  // Counts of an encoder: a straight line over the positions, to a quarter of
  // what is between them.
  bool IsCountedBeside(std::size_t column, const Candidate& axis) const {
    const std::vector<double>& centers = axis.levels.centers;
    const double spacing = (centers.back() - centers.front()) /
                           static_cast<double>(centers.size() - 1);
    Eigen::ArrayXd x = ValuesOfRows(table_.columns[axis.column], rows_);
    Eigen::ArrayXd y = ValuesOfRows(table_.columns[column], rows_);
    x -= x.mean();
    y -= y.mean();
    const double slope = (x * y).sum() / x.square().sum();
    return slope != 0.0 &&
           ((y - slope * x).abs() <= 0.25 * std::abs(slope) * spacing).all();
  }

  // An axis that is held in place, as its encoder reads it: "Y act [mm]".
  bool IsHeld(std::size_t column) const {
    constexpr double kMostMoved = 1e-3;  // of where it stands, or the travel
    if (!IsReadAxis(Name(column)) || IsUnitOfErrors(UnitOfColumn(Name(column))))
      return false;
    double low = INFINITY;
    double high = -INFINITY;
    for (const Index row : rows_) {
      const double at = table_.columns[column].values[row];
      low = std::min(low, at);
      high = std::max(high, at);
    }
    const std::vector<double>& places = axis_.levels.centers;
    const double travel = places.empty() ? 0.0 : places.back() - places.front();
    return high - low <=
           kMostMoved * std::max({std::abs(low), std::abs(high), travel});
  }

  void FindHeld() {
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (IsFree(i) && IsHeld(i)) axis_.held.push_back(i);
    }
  }

  // Columns of no name that says it whose lengths go with the axis.
  void FindReadings() {
    if (!axis_.motion.is_commanded) return;
    const Candidate axis{.column = static_cast<std::size_t>(axis_.column),
                         .levels = axis_.levels,
                         .motion = axis_.motion};
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const Unit& unit = UnitOfColumn(Name(i));
      if (i == axis.column || !IsFree(i) ||
          std::ranges::count(axis_.measured, i) > 0 ||
          std::ranges::count(axis_.numbers, i) > 0 ||
          std::ranges::count(axis_.positions, i) > 0) {
        continue;
      }
      const bool reads = IsLengthOrAngle(unit)
                             ? IsReadBeside({.column = i}, axis)
                             : unit.symbol.empty() && IsCountedBeside(i, axis);
      if (reads) axis_.measured.push_back(i);
    }
  }

  void TakeFrom(Candidate candidate) {
    axis_.column = static_cast<std::ptrdiff_t>(candidate.column);
    axis_.levels = std::move(candidate.levels);
    axis_.motion = std::move(candidate.motion);
    if (axis_.motion.is_commanded || axis_.motion.is_sorted) return;
    // To and fro without a stop: its passes, if it has any.
    Motion swept = MotionThrough(
        PartsOfRange(ValuesOf(table_.columns[candidate.column], rows_)));
    if (swept.is_commanded) axis_.motion = std::move(swept);
  }

  static constexpr std::size_t kRowsLooked = 20000;

  const CsvTable& table_;
  const DatasetSelection& selection_;
  std::size_t target_;
  const std::vector<Index>& rows_;
  Axis axis_;
};

}  // namespace

Axis FindAxis(const CsvTable& table,
              const DatasetSelection& selection,
              std::size_t target,
              const std::vector<Index>& rows) {
  return AxisFinder(table, selection, target, rows).Find();
}

}  // namespace errmap::data
