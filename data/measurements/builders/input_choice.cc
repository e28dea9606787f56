#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/column_values.h"
#include "data/column_words.h"
#include "data/measurements/builders/inputs_in_use.h"
#include "data/measurements/clock/text_times.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/joined_tables.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

// A column that nobody named: the index that spreadsheets and data frames
// write beside their rows, under an empty name or (once read and written again)
// as "Unnamed: 0".
bool IsUnnamed(const CsvColumn& column) {
  return !column.has_name || StartsWithIgnoringCase(column.name, "Unnamed:");
}

// True where no cell holds anything: a channel that was never logged.
bool IsAllMissing(const CsvColumn& column) {
  return column.is_text() &&
         std::all_of(column.texts.begin(), column.texts.end(), IsMissingNumber);
}

// Whether two names differ in nothing but the letter of an axis: "disp_x" and
// "disp_z", yet not "x" and "z", which may be positions.
bool DifferInAxis(std::string_view a, std::string_view b) {
  constexpr std::string_view kAxes = "xyzabcuvwXYZABCUVW";
  if (a.size() != b.size() || a.size() < 2) return false;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (EqualsIgnoringCase(a.substr(i, 1), b.substr(i, 1))) continue;
    if (kAxes.find(a[i]) == kAxes.npos || kAxes.find(b[i]) == kAxes.npos) {
      return false;
    }
    ++differing;
  }
  return differing == 1;
}

// Of those that are not NaN.
double RangeOf(const ColumnValues& values) {
  double least = INFINITY;
  double most = -INFINITY;
  for (const double value : values) {
    least = std::fmin(least, value);
    most = std::fmax(most, value);
  }
  return most - least;
}

// Errors measured beside a target: not at hand when its map is used, and
// telling it all too well.
class MeasuredBeside {
 public:
  explicit MeasuredBeside(const CsvColumn& target)
      : stem_(StemOfColumn(target.name)),
        header_(ReadHeader(target.name)),
        range_(RangeOf(target.values)) {}

  // Why a column is not a default input; "" where it may be one.
  std::string_view Why(const CsvColumn& column) const {
    const std::string& name = column.name;
    // "column_3" says nothing: the table has no line of names.
    if (NamesPosition(name) || stem_ == "column") return "";
    const std::string stem = StemOfColumn(name);
    // Channels of a logger have one stem, whatever they measure.
    if (stem == stem_ && !StatesTemperature(name)) {
      return "measures the target's quantity";
    }
    const Header header = ReadHeader(name);
    const bool is_called =
        (ErrorSign(name) != 0 || SaysPhrase(name, Word::kComputed)) &&
        (IsLengthOrAngle(header.unit) || header.unit.symbol.empty() ||
         header.unit.quantity == Quantity::kRatio);
    const bool alike = header.unit == header_.unit &&
                       header.unit_text.empty() == header_.unit_text.empty() &&
                       DifferInAxis(stem, stem_);
    return alike || is_called || BeginsAsError(name) ||
                   IsInUnitOfErrors(name) || header.unit.symbol == "um/m" ||
                   (IsAxisLetter(name) && MovesAsLittle(column))
               ? "measures an error, as the target does"
               : "";
  }

 private:
  // A probe's "X_um" moves as little as the error does, a stage's far more.
  bool MovesAsLittle(const CsvColumn& column) const {
    constexpr double kFarther = 10.0;
    constexpr std::size_t kFewestRows = 12;
    const Unit unit = UnitOfColumn(column.name);
    return column.values.size() >= kFewestRows && IsUnitOfErrors(unit) &&
           AreConvertible(unit, header_.unit) &&
           Converted(RangeOf(column.values), unit, header_.unit) <
               kFarther * range_;
  }

  std::string stem_;
  Header header_;
  double range_;  // of the target
};

// A controller's temperature: called so, and another one in few rows.
bool IsSetPoint(const CsvColumn& column) {
  constexpr std::size_t kSeldom = 20;
  if (!StatesTemperature(column.name) ||
      !(Says(column.name, Word::kNominal) ||
        HasWordOf(column.name, "sp set tset"))) {
    return false;
  }
  std::size_t changes = 0;
  for (std::size_t i = 1; i < column.values.size(); ++i) {
    changes += column.values[i] != column.values[i - 1] ? 1 : 0;
  }
  return kSeldom * changes < column.values.size();
}

bool Is(std::ptrdiff_t role, std::size_t index) {
  return role == static_cast<std::ptrdiff_t>(index);
}

class InputChooser {
 public:
  InputChooser(const CsvTable& table,
               const DatasetSelection& selection,
               const ColumnRoles& roles,
               const FoundSessions& found)
      : table_(table), selection_(selection), roles_(roles), found_(found) {}

  ChosenInputs Choose() {
    if (selection_.inputs.empty() && !selection_.only_to_judge) {
      ChooseDefaultInputs();
    } else {
      ChooseNamedInputs();
    }
    return std::move(chosen_);
  }

 private:
  const std::string& Name(std::size_t index) const {
    return table_.At(index).name;
  }

  bool IsFiltered(std::size_t index) const {
    return std::ranges::any_of(selection_.where, [&](const auto& filter) {
      return filter.column == Name(index);
    });
  }

  void Drop(std::size_t index, const std::string& why) {
    chosen_.dropped.push_back({.column = Name(index), .why = why});
  }

  void ChooseNamedInputs() {
    const std::unordered_set<std::string> excluded = ExcludedNames();
    std::unordered_set<std::string> seen;
    for (const std::string& name : selection_.inputs) {
      const std::size_t index =
          RequireColumn(table_,
                        name,
                        selection_.only_to_judge ? "an input of the map"
                                                 : ArgumentName("inputs"));
      if (!seen.insert(name).second) {
        ThrowUnusable(table_,
                      ArgumentName("inputs") + " names " + QuotedName(name) +
                          " twice; name it once");
      }
      if (index == roles_.target) {
        ThrowUnusable(table_,
                      QuotedName(name) +
                          " is the target and cannot be an input; leave it "
                          "out of " +
                          ArgumentName("inputs"));
      }
      if (excluded.contains(name)) {
        ThrowUnusable(table_,
                      QuotedName(name) + " is named in " +
                          ArgumentName("inputs") + " and in " +
                          ArgumentName("exclude") +
                          "; take it out of one of them");
      }
      RequireNumbers(table_, {index, ColumnUse::kInput});
      chosen_.inputs.push_back(index);
    }
  }

  std::unordered_set<std::string> ExcludedNames() const {
    for (const std::string& name : selection_.exclude) {
      RequireColumn(table_, name, ArgumentName("exclude"));
    }
    return {selection_.exclude.begin(), selection_.exclude.end()};
  }

  // "columns a, b hold text and are left out of the inputs".
  void SayLeftOut(const std::vector<std::string>& columns,
                  const std::string& what,
                  const std::string& behind) {
    if (columns.empty()) return;
    const bool one = columns.size() == 1;
    chosen_.remarks.push_back(
        (one ? "column " : "columns ") + ListOfNames(columns) + " " + what +
        (one ? " and is" : " and are") + " left out" + behind);
  }

  // Why a column in a unit of time, or of hours by its name
  // ("Betriebsstunden"), is not a sensor. Another clock goes mostly not back:
  // rows may be many in its step, and it may begin anew with each pass.
  // "Giri/min" is a rate.
  static std::string_view WhatItTimes(const CsvColumn& column) {
    if (UnitOfColumn(column.name).quantity != Quantity::kTime &&
        StatedUnit(column.name) != FindTimeUnit("h")) {
      return "";
    }
    const std::string per_unit = "/" + ReadHeader(column.name).unit_text;
    if (column.name.ends_with(per_unit) && !Says(column.name, Word::kTime)) {
      return "";
    }
    const Steps steps = StepsOf(column.values);
    return steps.on > 2 * steps.back ? "is another clock" : "is a duration";
  }

  bool IsOfStatistics(std::string_view name) const {
    return SaysPhrase(name, Word::kSpread) ||
           (IsOneOf(name, "n N") && has_spreads_);
  }

  bool IsTaken(std::size_t i) const {
    return i == roles_.target || Is(roles_.group, i) || Is(roles_.weight, i) ||
           Is(found_.time_column, i) || Is(found_.date_column, i) ||
           (Is(roles_.direction, i) && !table_.At(i).is_text()) ||
           Name(i) == found_.sessions.column || IsFiltered(i) ||
           (Name(i) == kFileColumn && table_.At(i).is_text());
  }

  // Words, or nothing at all.
  void ConsiderText(std::size_t i) {
    const CsvColumn& column = table_.At(i);
    if (NamesPosition(column.name)) {
      RefuseNumbersAsText(table_, column);
    } else if (IsAllMissing(column)) {
      Drop(i, "no number in any row");
      chosen_.remarks.push_back("input " + NameInRemark(column.name) +
                                " has no number in any row and is left out");
    } else if (!HoldsTimes(column)) {
      RefuseNumbersAsText(table_, column);
      if (!PartsComponents(table_, column)) texts_.push_back(column.name);
      chosen_.words.push_back(i);
    }
  }

  // Why a column of numbers is not a default input, kept for what is said of
  // all such; "" where it is one.
  std::string_view WhyNone(std::size_t i, const MeasuredBeside& measured) {
    const CsvColumn& column = table_.At(i);
    const bool is_axis = column.name == selection_.position;
    if (!is_axis && CountsRows(column)) return "counts the rows";
    if (!is_axis && IsOfStatistics(column.name)) {
      return "tells how readings scatter";
    }
    const std::string_view timed = WhatItTimes(column);
    if (!timed.empty()) return timed;
    if (is_axis) return "";
    if (IsSetPoint(column)) {
      return "is a set point";
    }
    if (IsCalled(column.name, Word::kPart) ||
        IsCalled(column.name, Word::kComponent)) {
      chosen_.words.push_back(i);
      return "tells which one, and measures nothing";
    }
    const std::string_view why = measured.Why(column);
    if (!why.empty()) beside_.push_back(column.name);
    return why;
  }

  void Consider(std::size_t i, const MeasuredBeside& measured) {
    const CsvColumn& column = table_.At(i);
    if (IsUnnamed(column) && column.name != selection_.position) {
      had_candidates_ = true;
      Drop(i, "has no name in the header");
      chosen_.remarks.push_back(
          "column " + NameInRemark(column.name) +
          " has no name in the header and is left out of the inputs");
    } else if (column.is_text()) {
      ConsiderText(i);
    } else if (const std::string_view why = WhyNone(i, measured); why.empty()) {
      chosen_.inputs.push_back(i);
    } else {
      had_candidates_ = true;
      Drop(i, std::string(why));
    }
  }

  void ChooseDefaultInputs() {
    const std::unordered_set<std::string> excluded = ExcludedNames();
    const MeasuredBeside measured(table_.At(roles_.target));
    has_spreads_ = std::ranges::any_of(table_.columns, [](const auto& column) {
      return SaysPhrase(column.name, Word::kSpread);
    });
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      const CsvColumn& column = table_.At(i);
      if (IsTaken(i)) continue;
      if (KeepsRecord(column)) {
        if (!column.is_text()) chosen_.records.push_back(i);
      } else if (excluded.contains(column.name)) {
        had_candidates_ = had_candidates_ || !column.is_text();
      } else {
        Consider(i, measured);
      }
    }
    const bool one = beside_.size() == 1;
    SayLeftOut(beside_,
               one ? "measures an error as the target does"
                   : "measure errors as the target does",
               "; name " + std::string(one ? "it" : "them") + " in " +
                   ArgumentName("inputs") + " to use " + (one ? "it" : "them"));
    SayLeftOut(texts_,
               texts_.size() == 1 ? "holds text" : "hold text",
               " of the inputs");
    if (chosen_.inputs.empty() && found_.time_column >= 0) {
      had_candidates_ = true;
      Drop(static_cast<std::size_t>(found_.time_column), "is the time");
    }
    if (chosen_.inputs.empty() && had_candidates_) {
      ThrowNoInputs(table_, chosen_.dropped);
    }
  }

  const CsvTable& table_;
  const DatasetSelection& selection_;
  const ColumnRoles& roles_;
  const FoundSessions& found_;
  bool had_candidates_ = false;  // numeric columns that might have been inputs
  bool has_spreads_ = false;     // statistics beside means
  std::vector<std::string> texts_;   // names of columns of words
  std::vector<std::string> beside_;  // of errors beside the target
  ChosenInputs chosen_;
};

}  // namespace

ChosenInputs ChooseInputs(const CsvTable& table,
                          const DatasetSelection& selection,
                          const ColumnRoles& roles,
                          const FoundSessions& found) {
  return InputChooser(table, selection, roles, found).Choose();
}

void ThrowNoInputs(const CsvTable& table,
                   const std::vector<DroppedColumn>& dropped) {
  constexpr std::size_t kMostReasons = 3;
  std::vector<std::string> reasons;
  for (const DroppedColumn& column : dropped) {
    reasons.push_back(QuotedName(column.column) + " " + column.why);
  }
  ThrowUnusable(table,
                "no input is left" + std::string(reasons.empty() ? "" : ": ") +
                    ShortList(reasons, kMostReasons, "; ", "; and ") +
                    "; name inputs with " + ArgumentName("inputs") +
                    ", or keep dead ones with " + ArgumentName("keep_dead"));
}

}  // namespace errmap::data
