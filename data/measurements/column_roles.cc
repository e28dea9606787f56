#include "data/measurements/column_roles.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/clock/time_units.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/reading/derived_columns.h"
#include "data/measurements/reading/reading.h"
#include "data/tables/shapes/notes.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

// What simulators write beside an error, and no controller has.
constexpr std::string_view kTruth = "truth";

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
    if (std::cmp_equal(roles_.weight, roles_.target)) {
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
      if (!std::cmp_equal(roles_.weight, i) && Name(i) != selection_.group &&
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
    std::vector<std::size_t> candidates = CalledErrors();
    // A correction beside an error is not meant.
    const auto is_opposite = [&](std::size_t i) {
      return ErrorSign(Name(i)) < 0;
    };
    if (!std::ranges::all_of(candidates, is_opposite)) {
      std::erase_if(candidates, is_opposite);
    }
    if (candidates.empty()) candidates = InUnitsOfErrors();
    if (candidates.empty()) candidates = CalledErrorsInOtherUnits();
    if (candidates.size() > 1) AskWhich(candidates);
    if (candidates.empty()) {
      AskForDifference();
      RefuseWithoutTarget();
    }
    const std::size_t target = candidates.front();
    if (ErrorSign(Name(target)) <= 0 && !BeginsAsError(Name(target))) {
      AskForSign(target);
    }
    if (is_opposite(target)) AskForSign(target);
    if (const std::string* note = NoteOfOtherSign(table_)) {
      AskForSign(target, QuotedText(*note) + " stands in the file; ");
    }
    return target;
  }

  std::vector<std::size_t> CalledErrors() const {
    std::vector<std::size_t> candidates =
        Candidates([&](std::string_view name) {
          const Header header = ReadHeader(name);
          const int sign = ErrorSign(name);
          const bool has_size = IsLengthOrAngle(header.unit);
          if (BeginsAsError(name)) return true;
          return !table_.At(table_.Find(name)).is_text() && sign != 0 &&
                 (has_size || (sign > 0 && header.unit.symbol.empty()));
        });
    // "Error code" beside "Deviation (um)" is none.
    std::vector<std::size_t> with_unit = candidates;
    std::erase_if(with_unit, [&](std::size_t i) {
      const Header header = ReadHeader(Name(i));
      return header.source != UnitSource::kStated || header.unit.symbol.empty();
    });
    return with_unit.empty() ? candidates : with_unit;
  }

  // Of no name that says it.
  std::vector<std::size_t> InUnitsOfErrors() const {
    return Candidates([&](std::string_view name) {
      const CsvColumn& column = table_.At(table_.Find(name));
      return !column.is_text() && IsInUnitOfErrors(name) &&
             !NamesPosition(name) && !Says(name, Word::kPosition) &&
             !Says(name, Word::kMeasured) && !Says(name, Word::kNominal);
    });
  }

  // "Abweichung [mg]"; "Error (K)", though "Error amp. (K)" is a temperature.
  std::vector<std::size_t> CalledErrorsInOtherUnits() const {
    return Candidates([&](std::string_view name) {
      return !table_.At(table_.Find(name)).is_text() && ErrorSign(name) != 0 &&
             (WordsOf(name).size() == 1 || !StatesTemperature(name));
    });
  }

  [[noreturn]] void RefuseWithoutTarget() const {
    const std::vector<std::string> numeric =
        NamesOf(Candidates([&](std::string_view name) {
          return !table_.At(table_.Find(name)).is_text();
        }));
    ThrowUnusable(
        table_,
        "no column's name says that it is an error (error, "
        "deviation, Abweichung); name the measured error with " +
            ArgumentName("target") + " (" +
            (numeric.empty() ? "but no column holds numbers"
                             : "columns of numbers: " + ListOfNames(numeric)) +
            ")");
  }

  [[noreturn]] void AskWhich(const std::vector<std::size_t>& candidates) const {
    Reading::Question question{
        .topic = "target",
        .question = "several columns could be the target; name one with " +
                    ArgumentName("target") + ": " +
                    ListOfNames(NamesOf(candidates))};
    for (const std::size_t i : candidates) {
      question.answers.push_back({.option = ArgumentName("target", Name(i)),
                                  .means = QuotedName(Name(i)) + " alone"});
    }
    throw OpenQuestion(PrintablePath(table_.file), std::move(question));
  }

  // What corrects an error has its size, and its other sign or not.
  [[noreturn]] void AskForSign(std::size_t target,
                               const std::string& why = "") const {
    const std::string& name = Name(target);
    throw OpenQuestion(
        PrintablePath(table_.file),
        {.topic = "target",
         .question =
             why + "is " + QuotedName(name) +
             " the error, or the correction that is added to compensate it?",
         .answers = {{.option = ArgumentName("target", "-" + name),
                      .means = "a correction: the error is its negative"},
                     {.option = ArgumentName("target", name),
                      .means = "the error itself, actual - nominal"}}});
  }

  // Where the axis was sent and where it was read, by one instrument or by
  // several, and no error.
  void AskForDifference() const {
    const std::vector<ReadBeside> pairs = FindReadBeside(table_);
    if (pairs.empty()) return;
    const bool one = pairs.size() == 1;
    const ReadBeside& first = pairs.front();
    Reading::Question question{
        .topic = "target",
        .question =
            "no column is an error; " +
            (one ? "is " + QuotedName(Name(first.read)) +
                       " what was measured where " +
                       QuotedName(Name(first.commanded)) + " was commanded?"
                 : std::string("which is actual - nominal?"))};
    for (const ReadBeside& pair : pairs) {
      const Unit unit = UnitOfColumn(Name(pair.commanded));
      const std::string symbol = unit.symbol.empty() ? "mm" : unit.symbol;
      std::string difference = Name(pair.read) + "-" + Name(pair.commanded);
      if (UnitOfColumn(difference).symbol != symbol)
        difference += " [" + symbol + "]";
      question.answers.push_back(
          {.option = ArgumentName("target", difference),
           .means = (one ? "yes, the error is actual - nominal"
                         : "by " + QuotedName(Name(pair.read))) +
                    std::string(unit.symbol.empty() ? ", both in mm" : "")});
    }
    throw OpenQuestion(PrintablePath(table_.file), std::move(question));
  }

  void ChooseGroup() {
    if (!selection_.group.empty()) {
      roles_.group = static_cast<std::ptrdiff_t>(
          RequireColumn(table_, selection_.group, ArgumentName("group")));
      if (std::cmp_equal(roles_.group, roles_.target)) {
        ThrowUnusable(table_,
                      "column " + QuotedName(selection_.group) +
                          " cannot be both the target and the group; name "
                          "another with " +
                          ArgumentName("group"));
      }
      return;
    }
    const std::ptrdiff_t cycle = CycleColumn(table_);
    if (cycle != kNoColumn && !std::cmp_equal(cycle, roles_.target))
      roles_.group = cycle;
  }

  const CsvTable& table_;
  const DatasetSelection& selection_;
  ColumnRoles roles_;
};

// "Charge [Ah]" counts no batches, "Minute [min]" counts.
bool HasQuantity(std::string_view name) {
  return HasUnit(name) && UnitOfColumn(name).quantity != Quantity::kTime;
}

// Whether a word of a name says that it counts: "cycles" of "elapsed_cycles".
bool HasCounterIn(std::string_view name) {
  if (StatesTemperature(name) || HasQuantity(name)) return false;
  return std::ranges::any_of(WordsOf(name), [](const std::string& word) {
    // "no" and "test" are words of other names, too.
    return word.size() > 2 && word != "test" &&
           (IsWord(word, Word::kCounter) || IsWord(word, Word::kCycle) ||
            IsWord(word, Word::kRun) || IsWord(word, Word::kSession));
  });
}

// Which thing, or how many of them, and no quantity of a machine.
bool Identifies(std::string_view name) {
  return !HasQuantity(name) && !StatesTemperature(name) &&
         SaysPhrase(name, Word::kIdentifier);
}

}  // namespace

bool CountsRows(const CsvColumn& column) {
  constexpr std::size_t kFewestToTell = 12;
  const std::size_t n = column.values.size();
  if (n < kFewestToTell || !column.exceptions.empty() ||
      !UnitOfColumn(column.name).symbol.empty()) {
    return false;
  }
  const double first = column.values[0];
  const double sign = column.values[1] > first ? 1.0 : -1.0;
  bool on = true;
  bool anew = first == 0.0 || first == 1.0;  // 1, 2, 3, 1, 2, 3
  double most = first;
  for (std::size_t i = 0; i < n; ++i) {
    const double now = column.values[i];
    if (now != std::floor(now)) return false;
    most = std::max(most, now);
    if (i == 0) continue;
    const double step = now - column.values[i - 1];
    on = on && sign * step > 0.0;
    anew = anew && (step == 1.0 || (now == first && step < 0.0));
  }
  return on || (anew && most >= first + 2.0);
}

bool KeepsRecord(std::string_view name) {
  const std::vector<std::string> words = WordsOf(name);
  const bool is_number_of =
      words.size() > 1 && IsOneOf(words.back(), "no nr number nummer num") &&
      !StatesTemperature(name) && !IsCalled(name, Word::kPart);
  return is_number_of || Identifies(name) ||
         (IsCalled(name, Word::kCounter) && !HasQuantity(name)) ||
         IsCalled(name, Word::kCycle) || IsCalled(name, Word::kSession) ||
         IsCalled(name, Word::kRun) || NamesTime(name) ||
         StartsWithIgnoringCase(name, kTruth);
}

bool KeepsRecord(const CsvColumn& column) {
  const std::string& name = column.name;
  if (!KeepsRecord(name)) return false;
  if (column.is_text() || NamesTime(name) || Identifies(name) ||
      IsCalled(name, Word::kCycle) || IsCalled(name, Word::kSession) ||
      IsCalled(name, Word::kRun) || StartsWithIgnoringCase(name, kTruth)) {
    return true;
  }
  // "Pt100-Nr. 1" measures.
  const auto whole = std::ranges::count_if(
      column.values, [](double value) { return value == std::floor(value); });
  return 2 * whole >= std::ssize(column.values);
}

bool IsSensor(const ColumnInfo& column) {
  return !NamesPosition(column.name) &&
         (!column.unit.symbol.empty() || !HasCounterIn(column.name));
}

bool CountsCycles(const ColumnInfo& column) {
  return column.unit.symbol.empty() && HasCounterIn(column.name) &&
         !Says(column.name, Word::kDay);
}

bool PartsComponents(const CsvTable& table, const CsvColumn& column) {
  constexpr std::size_t kMostValues = 24;
  const bool is_named = IsCalled(column.name, Word::kPart) ||
                        IsCalled(column.name, Word::kDirection) ||
                        IsCalled(column.name, Word::kComponent);
  if (!is_named) return false;
  const std::vector<std::string> values =
      LabelsOf(table, column, AllRows(table.num_rows), kMostValues).labels;
  return values.size() >= 2 && values.size() <= kMostValues &&
         std::ranges::count(values, "") == 0;
}

std::ptrdiff_t CycleColumn(const CsvTable& table) {
  // "cycle" itself before "Cycle" before "Zyklus" and "Cycle No.".
  std::ptrdiff_t cycle = table.Find("cycle");
  const auto look = [&](const auto& fits) {
    for (std::size_t i = 0; cycle == kNoColumn && i < table.columns.size();
         ++i) {
      if (fits(table.columns[i].name)) cycle = static_cast<std::ptrdiff_t>(i);
    }
  };
  look([](std::string_view name) { return EqualsIgnoringCase(name, "cycle"); });
  look([](std::string_view name) { return IsCalled(name, Word::kCycle); });
  return cycle;
}

std::ptrdiff_t TimeColumn(const CsvTable& table) {
  std::ptrdiff_t only = kNoColumn;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (!NamesTime(table.columns[i].name)) continue;
    if (only != kNoColumn) return kNoColumn;
    only = static_cast<std::ptrdiff_t>(i);
  }
  return only;
}

ColumnRoles ChooseRoles(const CsvTable& table,
                        const DatasetSelection& selection) {
  return RoleChooser(table, selection).Choose();
}

}  // namespace errmap::data
