#include "data/measurements/column_roles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "data/argument_name.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/reading/column_words.h"
#include "data/measurements/reading/reading.h"
#include "data/measurements/sessions.h"
#include "data/text.h"

namespace errmap::data {
namespace {

// A name less "no.", "number" and marks, in small letters: "cycle" of
// "Cycle No.", "Cycle_Number" and "cycle#".
std::string CounterStem(std::string_view name) {
  std::string stem;
  std::string word;
  const auto end_word = [&] {
    constexpr auto kNumber = std::to_array<std::string_view>(
        {"no", "nr", "num", "number", "nummer", "id", "index", "count"});
    const bool is_number =
        std::ranges::find(kNumber, word) != kNumber.end() && !stem.empty();
    if (!is_number) stem += word;
    word.clear();
  };
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (letter) {
      word += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    } else if (std::string_view("_ -.#:()").find(c) != std::string_view::npos) {
      end_word();
    } else {
      return "";  // "cycle2" is another name
    }
  }
  end_word();
  return stem;
}

constexpr auto kCounters = std::to_array<std::string_view>(
    {"cycle",   "zyklus",  "takt",      "lauf",  "session", "day",    "tag",
     "run",     "segment", "record",    "index", "row",     "id",     "sample",
     "messung", "versuch", "durchgang", "nr",    "no",      "number", "nummer",
     "zeile",   "test",    "trial",     "repeat"});

bool IsOneOf(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

// Which of several machines, tools or people a row is of: a number that means
// no more than a word.
bool NamesPart(std::string_view name) {
  constexpr auto kNames = std::to_array<std::string_view>({"machine",
                                                           "maschine",
                                                           "tool",
                                                           "werkzeug",
                                                           "pallet",
                                                           "palette",
                                                           "station",
                                                           "operator"});
  return IsOneOf(kNames, CounterStem(name));
}

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

// Units in which errors are stated and, but for an axis of one letter, nothing
// that a map is made from.
bool IsUnitOfErrors(const Header& header) {
  constexpr auto kSmall =
      std::to_array<std::string_view>({"nm", "um", "uin", "arcsec", "urad"});
  return header.base.size() > 1 &&
         std::find(kSmall.begin(), kSmall.end(), header.unit.symbol) !=
             kSmall.end();
}

// Errors measured beside a target: not at hand when its map is used, and
// telling it all too well.
class MeasuredBeside {
 public:
  explicit MeasuredBeside(std::string_view target)
      : stem_(StemOfColumn(target)), header_(ReadHeader(target)) {}

  // Why a column is no default input; "" where it may be one.
  std::string_view Why(std::string_view name) const {
    // "column_3" says nothing: the table has no line of names.
    if (NamesPosition(name) || stem_ == "column") return "";
    const std::string stem = StemOfColumn(name);
    if (stem == stem_) return "measures the target's quantity";
    const Header header = ReadHeader(name);
    const bool alike = header.unit == header_.unit &&
                       header.unit_text.empty() == header_.unit_text.empty() &&
                       DifferInAxis(stem, stem_);
    return alike || StartsWithIgnoringCase(name, "error") ||
                   IsUnitOfErrors(header)
               ? "measures an error, as the target does"
               : "";
  }

 private:
  std::string stem_;
  Header header_;
};

bool Is(std::ptrdiff_t role, std::size_t index) {
  return role == static_cast<std::ptrdiff_t>(index);
}

class RoleChooser {
 public:
  RoleChooser(const CsvTable& table, const DatasetSelection& selection)
      : table_(table), selection_(selection) {}

  ColumnRoles Choose() {
    ChooseWeightAndTarget();
    ChooseGroup();
    return roles_;
  }

 private:
  template <typename Index>
  const std::string& Name(Index index) const {
    return table_.At(index).name;
  }

  void ChooseWeightAndTarget() {
    if (!selection_.weight.empty()) {
      roles_.weight = static_cast<std::ptrdiff_t>(
          RequireColumn(table_, selection_.weight, ArgumentName("weight")));
    }
    roles_.target =
        selection_.target.empty()
            ? DefaultTarget()
            : RequireColumn(table_, selection_.target, ArgumentName("target"));
    RequireNumbers(table_, {roles_.target, ColumnUse::kTarget});
    if (Is(roles_.weight, roles_.target)) {
      ThrowUnusable(table_,
                    "column " + QuotedName(Name(roles_.target)) +
                        " cannot be both the target and the weight; name "
                        "another with " +
                        ArgumentName("weight"));
    }
    if (roles_.weight != kNoColumn) {
      RequireNumbers(
          table_,
          {static_cast<std::size_t>(roles_.weight), ColumnUse::kWeight});
    }
  }

  // Columns of numbers that `wanted` wants.
  template <typename Wanted>
  std::vector<std::size_t> Candidates(const Wanted& wanted) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (!Is(roles_.weight, i) && Name(i) != selection_.group &&
          wanted(Name(i))) {
        found.push_back(i);
      }
    }
    return found;
  }

  std::vector<std::string> NamesOf(
      const std::vector<std::size_t>& columns) const {
    std::vector<std::string> names;
    for (const std::size_t column : columns) names.push_back(Name(column));
    return names;
  }

  // What is called an error; in other words than that only in a unit of errors,
  // or alone.
  std::size_t DefaultTarget() const {
    std::vector<std::size_t> candidates = Candidates([](std::string_view name) {
      return StartsWithIgnoringCase(name, "error");
    });
    if (candidates.empty()) {
      candidates = Candidates([](std::string_view name) {
        const Header header = ReadHeader(name);
        return Says(name, Word::kError) && !Says(name, Word::kCorrection) &&
               (header.unit.quantity == Quantity::kLength ||
                header.unit.quantity == Quantity::kAngle ||
                header.unit.symbol.empty());
      });
      std::erase_if(candidates,
                    [&](std::size_t i) { return table_.columns[i].is_text(); });
      std::vector<std::size_t> with_unit = candidates;
      std::erase_if(with_unit, [&](std::size_t i) {
        return UnitOfColumn(Name(i)).symbol.empty();
      });
      if (!with_unit.empty()) candidates = std::move(with_unit);
    }
    if (candidates.empty()) {
      AskForSign();
      const std::vector<std::string> numeric =
          NamesOf(Candidates([&](std::string_view name) {
            return !table_.At(table_.Find(name)).is_text();
          }));
      ThrowUnusable(
          table_,
          "no column's name says that it is an error (error, deviation, "
          "Abweichung); name the measured error with " +
              ArgumentName("target") + " (" +
              (numeric.empty()
                   ? "but no column holds numbers"
                   : "columns of numbers: " + ListOfNames(numeric)) +
              ")");
    }
    if (candidates.size() > 1) {
      ThrowUnusable(table_,
                    "several columns could be the target; name one with " +
                        ArgumentName("target") + ": " +
                        ListOfNames(NamesOf(candidates)));
    }
    return candidates.front();
  }

  // What corrects an error has its size, and its other sign or not.
  void AskForSign() const {
    const std::vector<std::size_t> found =
        Candidates([&](std::string_view name) {
          const Unit unit = UnitOfColumn(name);
          return Says(name, Word::kCorrection) &&
                 (unit.quantity == Quantity::kLength ||
                  unit.quantity == Quantity::kAngle) &&
                 !table_.At(table_.Find(name)).is_text();
        });
    if (found.empty()) return;
    const std::string& name = Name(found.front());
    throw OpenQuestion(
        PrintablePath(table_.file),
        {.topic = "target",
         .question = "is " + QuotedName(name) +
                     " the error, or the correction that is added against it?",
         .answers = {{.option = ArgumentName("target", "-" + name),
                      .means = "a correction: the error is its negative"},
                     {.option = ArgumentName("target", name),
                      .means = "the error itself, actual - nominal"}}});
  }

  void ChooseGroup() {
    if (!selection_.group.empty()) {
      roles_.group = static_cast<std::ptrdiff_t>(
          RequireColumn(table_, selection_.group, ArgumentName("group")));
      if (Is(roles_.group, roles_.target)) {
        ThrowUnusable(table_,
                      "column " + QuotedName(selection_.group) +
                          " cannot be both the target and the group; name "
                          "another with " +
                          ArgumentName("group"));
      }
      return;
    }
    // "cycle" itself before "Cycle" before "Zyklus" and "Cycle No.".
    std::ptrdiff_t cycle = table_.Find("cycle");
    const auto look = [&](const auto& fits) {
      for (std::size_t i = 0; cycle == kNoColumn && i < table_.columns.size();
           ++i) {
        if (fits(Name(i))) cycle = static_cast<std::ptrdiff_t>(i);
      }
    };
    look([](std::string_view name) {
      return EqualsIgnoringCase(name, "cycle");
    });
    look([](std::string_view name) { return IsCalled(name, Word::kCycle); });
    if (cycle != kNoColumn && !Is(cycle, roles_.target)) roles_.group = cycle;
  }

  const CsvTable& table_;
  const DatasetSelection& selection_;
  ColumnRoles roles_;
};

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

  void ChooseDefaultInputs() {
    const std::unordered_set<std::string> excluded = ExcludedNames();
    const MeasuredBeside measured(Name(roles_.target));
    std::vector<std::string> texts;
    std::vector<std::string> beside;
    for (std::size_t i = 0; i < table_.columns.size(); ++i) {
      if (i == roles_.target || Is(roles_.group, i) || Is(roles_.weight, i) ||
          Is(found_.time_column, i) || Is(found_.date_column, i) ||
          Name(i) == found_.sessions.column || KeepsRecord(Name(i)) ||
          "-" + Name(i) == selection_.target || IsFiltered(i)) {
        continue;
      }
      const std::string name = NameInRemark(Name(i));
      if (excluded.contains(Name(i))) {
        had_candidates_ = had_candidates_ || !table_.At(i).is_text();
      } else if (IsUnnamed(table_.At(i))) {
        had_candidates_ = true;
        Drop(i, "has no name in the header");
        chosen_.remarks.push_back(
            "column " + name +
            " has no name in the header and is left out of the "
            "inputs");
      } else if (NamesPosition(Name(i)) && table_.At(i).is_text()) {
        RefuseNumbersAsText(table_, table_.At(i));
      } else if (IsAllMissing(table_.At(i))) {
        Drop(i, "no number in any row");
        chosen_.remarks.push_back("input " + name +
                                  " has no number in any row and is left out");
      } else if (table_.At(i).is_text()) {
        RefuseNumbersAsText(table_, table_.At(i));
        if (!PartsComponents(table_, table_.At(i))) texts.push_back(Name(i));
        chosen_.words.push_back(i);
      } else if (CountsRows(table_.At(i))) {
        had_candidates_ = true;
        Drop(i, "counts the rows");
      } else if (NamesPart(Name(i))) {
        had_candidates_ = true;
        Drop(i, "tells which one, and measures nothing");
        chosen_.words.push_back(i);
      } else if (const std::string_view why = measured.Why(Name(i));
                 !why.empty()) {
        had_candidates_ = true;
        Drop(i, std::string(why));
        beside.push_back(Name(i));
      } else {
        chosen_.inputs.push_back(i);
      }
    }
    if (!beside.empty()) {
      const bool one = beside.size() == 1;
      chosen_.remarks.push_back(
          (one ? "column " : "columns ") + ListOfNames(beside) +
          (one ? " measures an error as" : " measure errors as") +
          " the target does and " + (one ? "is" : "are") + " left out; name " +
          (one ? "it" : "them") + " in " + ArgumentName("inputs") + " to use " +
          (one ? "it" : "them"));
    }
    if (!texts.empty()) {
      chosen_.remarks.push_back(
          (texts.size() == 1 ? "column " : "columns ") + ListOfNames(texts) +
          (texts.size() == 1 ? " holds text and is" : " hold text and are") +
          " left out of the inputs");
    }
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
  ChosenInputs chosen_;
};

// The word of a name that says that it counts: "cycle" of "elapsed_cycles".
std::string CounterWordIn(std::string_view name) {
  while (!name.empty()) {
    const std::size_t end =
        std::min(name.find_first_of("_ -.#:()"), name.size());
    std::string word = CounterStem(name.substr(0, end));
    if (word.ends_with('s')) word.pop_back();
    // "no" and "test" are words of other names, too.
    if (word.size() > 2 && word != "test" && IsOneOf(kCounters, word)) {
      return word;
    }
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return "";
}

}  // namespace

bool CountsRows(const CsvColumn& column) {
  constexpr std::size_t kFewestToTell = 12;
  const std::size_t n = column.values.size();
  if (n < kFewestToTell || !column.exceptions.empty() ||
      !UnitOfColumn(column.name).symbol.empty()) {
    return false;
  }
  const double sign = column.values[1] > column.values[0] ? 1.0 : -1.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (column.values[i] != std::floor(column.values[i]) ||
        (i > 0 && sign * (column.values[i] - column.values[i - 1]) <= 0.0)) {
      return false;
    }
  }
  return true;
}

bool KeepsRecord(std::string_view name) {
  return IsOneOf(kCounters, CounterStem(name)) || NamesTime(name) ||
         IsCalled(name, Word::kCycle) || IsCalled(name, Word::kSession) ||
         IsCalled(name, Word::kRun) || StartsWithIgnoringCase(name, "truth");
}

bool IsSensor(const ColumnInfo& column) {
  return !NamesPosition(column.name) &&
         (!column.unit.symbol.empty() || CounterWordIn(column.name).empty());
}

bool CountsCycles(const ColumnInfo& column) {
  const std::string word = CounterWordIn(column.name);
  return column.unit.symbol.empty() && !word.empty() && word != "day" &&
         word != "tag";
}

bool PartsComponents(const CsvTable& table, const CsvColumn& column) {
  constexpr auto kNames = std::to_array<std::string_view>({"direction",
                                                           "dir",
                                                           "approach",
                                                           "motion",
                                                           "side",
                                                           "axis",
                                                           "slide",
                                                           "component"});
  constexpr std::size_t kMostValues = 24;
  const bool is_named =
      NamesPart(column.name) ||
      std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) {
        return EqualsIgnoringCase(column.name, name);
      });
  if (!is_named) return false;
  std::vector<std::string> values;
  for (std::size_t row = 0; row < table.num_rows; ++row) {
    std::string value = table.CellText(column, row);
    if (value.empty()) return false;
    if (std::find(values.begin(), values.end(), value) != values.end()) {
      continue;
    }
    values.push_back(std::move(value));
    if (values.size() > kMostValues) return false;
  }
  return values.size() >= 2;
}

ColumnRoles ChooseRoles(const CsvTable& table,
                        const DatasetSelection& selection) {
  return RoleChooser(table, selection).Choose();
}

ChosenInputs ChooseInputs(const CsvTable& table,
                          const DatasetSelection& selection,
                          const ColumnRoles& roles,
                          const FoundSessions& found) {
  return InputChooser(table, selection, roles, found).Choose();
}

void ThrowNoInputs(const CsvTable& table,
                   const std::vector<DroppedColumn>& dropped) {
  std::string what = "no input is left";
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    constexpr std::size_t kMostReasons = 3;
    if (i == kMostReasons) {
      what += "; and " + std::to_string(dropped.size() - i) + " more";
      break;
    }
    what += (i == 0 ? ": " : "; ") + QuotedName(dropped[i].column) + " " +
            dropped[i].why;
  }
  ThrowUnusable(table,
                what + "; name inputs with " + ArgumentName("inputs") +
                    ", or keep dead ones with " + ArgumentName("keep_dead"));
}

}  // namespace errmap::data
