#include "data/tables/shapes/folded_positions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/tables/shapes/beside_errors.h"
#include "data/tables/shapes/numbered_names.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

constexpr std::size_t kFewestPositions = 3;

// Columns that become rows: each row of the table becomes one for each slot.
struct Fold {
  std::vector<std::size_t> kept;  // the other columns
  std::vector<CsvColumn> labels;  // (slots) what tells the slots apart
  std::map<std::string, std::vector<std::size_t>> quantities;  // (slots)
  std::size_t slots = 0;
  bool slot_by_slot = false;    // all rows of one, then those of the next
  std::size_t block = 0;        // rows after which the positions begin anew
  std::vector<bool> backwards;  // (slots) the rows of one from the last up
  std::string what;             // "a column for each of 9 positions"
  std::vector<std::string> made = {};  // columns that sheets make of these
};

// A column of errors beside those that might be folded.
const CsvColumn* ErrorBeside(const CsvTable& table, const Fold& fold) {
  const auto found = std::ranges::find_if(fold.kept, [&](std::size_t i) {
    return !table.columns[i].is_text() && ErrorSign(table.columns[i].name) != 0;
  });
  return found == fold.kept.end() ? nullptr : &table.columns[*found];
}

bool MeasuresError(const std::string& name) {
  return ErrorSign(name) != 0 || IsUnitOfErrors(UnitOfColumn(name));
}

bool HasPositionBeside(const CsvTable& table, const Fold& fold) {
  return std::ranges::any_of(fold.kept, [&](std::size_t i) {
    return IsCalledPosition(table.columns[i].name);
  });
}

std::optional<Fold> FindPositions(const CsvTable& table) {
  Fold fold;
  std::optional<std::string> unit;
  bool are_marked = true;
  std::map<std::string, std::vector<double>> places;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::optional<PlacedName> name =
        ReadPlacedName(table.columns[i].name);
    if (!name || table.columns[i].is_text()) {
      fold.kept.push_back(i);
      continue;
    }
    if (!unit) unit = name->unit;
    if (name->unit != *unit) return std::nullopt;
    are_marked = are_marked && name->is_marked;
    places[name->quantity].push_back(name->position);
    fold.quantities[name->quantity].push_back(i);
  }
  if (places.empty()) return std::nullopt;
  const std::vector<double>& positions = places.begin()->second;
  const std::set<double> distinct(positions.begin(), positions.end());
  const bool are_alike = std::ranges::all_of(
      places, [&](const auto& of) { return of.second == positions; });
  const bool any_errors = std::ranges::any_of(places, [](const auto& of) {
    const Header header = ReadHeader(of.first);
    return header.unit.symbol.empty() || IsLengthOrAngle(header.unit);
  });
  // "error_um@50mm" says it all, of however few positions.
  const bool are_errors_at =
      are_marked && !unit->empty() && places.size() == 1 &&
      MeasuresError(places.begin()->first) &&
      ErrorBeside(table, fold) == nullptr && !HasPositionBeside(table, fold);
  if (!any_errors || !are_alike || distinct.size() != positions.size() ||
      (positions.size() < kFewestPositions && !are_errors_at) ||
      (!are_marked && ErrorBeside(table, fold) != nullptr) ||
      (unit->empty() &&
       (!AreSpacedPositions(positions) || HasPositionBeside(table, fold)))) {
    return std::nullopt;
  }
  const std::string shown = unit->empty() ? "mm" : *unit;
  fold.slots = positions.size();
  fold.backwards.assign(fold.slots, false);
  fold.labels.push_back(NumberColumn("position_" + shown, positions));
  fold.what = "a column for each of " + std::to_string(fold.slots) +
              (fold.slots == 1 ? " position (" : " positions (") +
              CsvNumber(*distinct.begin()) +
              (fold.slots == 1 ? "" : " to " + CsvNumber(*distinct.rbegin())) +
              (unit->empty() ? ", taken as " : " ") + shown + ")";
  return fold;
}

// -1 where all cells of a column fall down these rows, 1 where they rise, else
// 0.
int WayOfRows(const CsvColumn& column, std::size_t num_rows) {
  if (!column.exceptions.empty() || num_rows < 2) return 0;
  std::vector<double> values = column.values;
  values.resize(num_rows);
  const auto breaks = [&](auto not_so) {
    return std::ranges::adjacent_find(values, not_so) != values.end();
  };
  if (!breaks(std::less_equal<>())) return -1;
  return breaks(std::greater_equal<>()) ? 0 : 1;
}

// Whether the rows list the positions from the highest down: those of the first
// column that is called a position, else of the first that goes one way.
bool PositionsDescend(const CsvTable& table,
                      const std::vector<std::size_t>& columns,
                      std::size_t num_rows) {
  for (const bool called : {true, false}) {
    for (const std::size_t i : columns) {
      const CsvColumn& column = table.columns[i];
      if (called && !IsCalledPosition(column.name)) continue;
      const int way = WayOfRows(column, num_rows);
      if (way != 0) return way < 0;
    }
  }
  return false;
}

// After how many rows the positions come again, all of them and as often as
// there are rows: tables one below the other. All rows where they do not.
std::size_t RowsOfBlock(const CsvTable& table,
                        const std::vector<std::size_t>& columns) {
  constexpr std::size_t kFewest = 3;
  for (const std::size_t i : columns) {
    const CsvColumn& column = table.columns[i];
    if (!IsCalledPosition(column.name) || !column.exceptions.empty()) continue;
    const std::vector<double> values = column.values;
    for (std::size_t n = kFewest; 2 * n <= values.size(); ++n) {
      if (values.size() % n == 0 && WayOfRows(column, n) != 0 &&
          std::equal(values.begin() + static_cast<std::ptrdiff_t>(n),
                     values.end(),
                     values.begin())) {
        return n;
      }
    }
  }
  return table.num_rows;
}

// A column of one run, or of one way.
struct RunColumn {
  std::size_t column;
  RunName name;
};

// Ways of one run follow each other, in whatever order their columns stand;
// dates stand in theirs.
void SortByRun(std::vector<RunColumn>* runs) {
  std::stable_sort(
      runs->begin(), runs->end(), [](const RunColumn& a, const RunColumn& b) {
        return std::pair(a.name.session, a.name.run) <
               std::pair(b.name.session, b.name.run);
      });
}

// Whether all names say a date and a way, or none of them does.
bool SayTheSame(const std::vector<RunColumn>& columns) {
  const auto all_or_none = [&](const auto& says) {
    const auto number = std::ranges::count_if(columns, says);
    return number == 0 || number == std::ssize(columns);
  };
  return all_or_none(
             [](const RunColumn& of) { return !of.name.date.empty(); }) &&
         all_or_none(
             [](const RunColumn& of) { return !of.name.direction.empty(); });
}

// What tells the slots apart: sessions, dates, cycles and ways, where all names
// say them.
std::vector<CsvColumn> LabelsOfRuns(const std::vector<RunColumn>& columns) {
  std::vector<double> sessions;
  std::vector<double> numbers;
  std::vector<std::string> dates;
  std::vector<std::ptrdiff_t> places;
  std::vector<std::ptrdiff_t> ways;  // 0: up, 1: down
  for (const auto& [column, name] : columns) {
    sessions.push_back(name.session);
    numbers.push_back(name.run);
    places.push_back(std::ssize(dates));
    dates.push_back(name.date);
    ways.push_back(name.direction == "down" ? 1 : 0);
  }
  const RunName& first = columns.front().name;
  std::vector<CsvColumn> labels;
  if (std::ranges::count(sessions, 0.0) == 0) {
    labels.push_back(NumberColumn("session", std::move(sessions)));
  }
  if (!first.date.empty()) {
    labels.push_back(WordColumn("date", places, std::move(dates)));
  }
  if (std::ranges::count(numbers, 0.0) == 0) {
    labels.push_back(NumberColumn("cycle", std::move(numbers)));
  }
  if (!first.direction.empty()) {
    labels.push_back(WordColumn("direction", ways, {"up", "down"}));
  }
  return labels;
}

// "Run 3" of "Run 3 Error [um]".
std::string_view UpToNumber(std::string_view name) {
  constexpr std::string_view kDigits = "0123456789";
  return name.substr(
      0, name.find_first_not_of(kDigits, name.find_first_of(kDigits)));
}

// What else each run has ("Run 3 T [degC]"), by the name without the run.
void FoldBesideRuns(const CsvTable& table,
                    const std::vector<RunColumn>& runs,
                    Fold* fold) {
  std::vector<std::string_view> of_columns;
  for (const RunColumn& of : runs) {
    of_columns.push_back(UpToNumber(table.columns[of.column].name));
  }
  const std::set<std::string_view> distinct(of_columns.begin(),
                                            of_columns.end());
  // The column of each run.
  std::map<std::string, std::map<std::string_view, std::size_t>> beside;
  for (const std::size_t i : fold->kept) {
    const std::string_view name = table.columns[i].name;
    const std::string_view run = UpToNumber(name);
    const std::size_t rest = name.find_first_not_of(" _-.:", run.size());
    if (!distinct.contains(run) || rest == name.npos) continue;
    beside[std::string(name.substr(rest))].emplace(run, i);
  }
  std::set<std::size_t> folded;
  for (const auto& found : beside) {
    if (found.second.size() != distinct.size()) continue;
    for (const std::string_view run : of_columns) {
      const std::size_t column = found.second.at(run);
      fold->quantities[found.first].push_back(column);
      folded.insert(column);
    }
  }
  std::erase_if(fold->kept, [&](std::size_t i) { return folded.contains(i); });
}

// "R1" to "R4" number runs: one letter tells a way where another tells the
// other one.
void ForgetLetters(std::vector<RunColumn>* runs) {
  const std::string& first = runs->front().name.direction;
  if (std::ranges::all_of(*runs, [&](const RunColumn& of) {
        return of.name.is_letter && of.name.direction == first;
      })) {
    for (RunColumn& of : *runs) of.name.direction.clear();
  }
}

// Of runs that have numbers, or else of one column for each way.
std::optional<Fold> FindRuns(const CsvTable& table, bool are_numbered) {
  Fold fold;
  fold.slot_by_slot = true;
  std::set<std::tuple<int, std::string, int, std::string>> runs;
  std::vector<RunColumn> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    std::optional<RunName> name = ReadRunName(table.columns[i].name);
    if (!name || name->is_numbered() != are_numbered ||
        table.columns[i].is_text() ||
        !(are_numbered || MeasuresError(table.columns[i].name))) {
      fold.kept.push_back(i);
      continue;
    }
    if (!runs.emplace(name->session, name->date, name->run, name->direction)
             .second) {
      return std::nullopt;
    }
    columns.push_back({i, *std::move(name)});
  }
  SortByRun(&columns);
  for (const auto& [column, name] : columns) {
    fold.quantities[name.quantity].push_back(column);
  }
  const std::size_t fewest = are_numbered ? 3 : 2;
  if (fold.quantities.size() != 1 || runs.size() < fewest ||
      fold.kept.empty() || !SayTheSame(columns)) {
    return std::nullopt;
  }
  ForgetLetters(&columns);
  if (are_numbered) FoldBesideRuns(table, columns, &fold);
  // Beside errors in another unit they are something else: positions read.
  const CsvColumn* const beside = ErrorBeside(table, fold);
  if (beside != nullptr && UnitOfColumn(beside->name) !=
                               UnitOfColumn(columns.front().name.quantity)) {
    return std::nullopt;
  }
  fold.slots = runs.size();
  // Each run goes from where the one before it ended; a session has all rows.
  const RunName& first = columns.front().name;
  const bool of_sessions = first.session > 0 || !first.date.empty();
  fold.block = of_sessions ? table.num_rows : RowsOfBlock(table, fold.kept);
  const bool descend = PositionsDescend(table, fold.kept, fold.block);
  for (const auto& [column, name] : columns) {
    fold.backwards.push_back(!name.direction.empty() &&
                             (name.direction == "down") != descend);
  }
  fold.labels = LabelsOfRuns(columns);
  fold.what = "a column for each of " + std::to_string(fold.slots) +
              (are_numbered ? " runs" : " ways");
  return fold;
}

// Leaves out means and ranges of the columns to be folded, or of those that go
// one way: they hold the errors that a map is to tell.
void LeaveOutFigures(const CsvTable& table, Fold* fold) {
  std::vector<std::vector<std::size_t>> sets;
  for (const auto& [name, sources] : fold->quantities) {
    sets.push_back(sources);
    sets.resize(sets.size() + 2);
    for (std::size_t slot = 0; slot < fold->slots; ++slot) {
      const std::size_t set = sets.size() - (fold->backwards[slot] ? 1 : 2);
      sets[set].push_back(sources[slot]);
    }
  }
  std::erase_if(fold->kept, [&](std::size_t column) {
    const bool is_made = std::ranges::any_of(
        sets, [&](const auto& set) { return IsRowFigure(table, column, set); });
    if (is_made) fold->made.push_back(QuotedName(table.columns[column].name));
    return is_made;
  });
}

// Rows of the folded table: the row and the slot that each is from.
struct Places {
  std::vector<std::ptrdiff_t> rows;
  std::vector<std::ptrdiff_t> slots;
};

Places PlacesOf(const Fold& fold, std::size_t num_rows) {
  Places places;
  // Rows of one slot together, then those of the next.
  const std::size_t block = fold.slot_by_slot ? fold.block : 1;
  for (std::size_t i = 0; i < num_rows * fold.slots; ++i) {
    const std::size_t first = i / (block * fold.slots) * block;
    const std::size_t slot = i / block % fold.slots;
    const std::size_t row = i % block;
    places.rows.push_back(static_cast<std::ptrdiff_t>(
        first + (fold.backwards[slot] ? block - 1 - row : row)));
    places.slots.push_back(static_cast<std::ptrdiff_t>(slot));
  }
  return places;
}

// The columns of a quantity, one below the other, in the order of the places.
CsvColumn Folded(const CsvTable& table,
                 const std::string& name,
                 const std::vector<std::size_t>& sources,
                 const Places& places) {
  CsvColumn all{.name = name};
  for (const std::size_t source : sources) {
    AppendCells(table.columns[source], &all);
  }
  std::vector<std::ptrdiff_t> at;
  for (std::size_t i = 0; i < places.rows.size(); ++i) {
    at.push_back(places.slots[i] * static_cast<std::ptrdiff_t>(table.num_rows) +
                 places.rows[i]);
  }
  return TakeRows(all, at);
}

std::optional<Fold> FindFold(const CsvTable& table) {
  std::optional<Fold> fold = FindPositions(table);
  if (!fold) fold = FindRuns(table, true);
  return fold ? fold : FindRuns(table, false);
}

// Gives each row of errors the cells of the rows of inputs that belong to it,
// as more columns to be folded.
void TakeInputRows(CsvTable* table, std::optional<Fold>* fold) {
  const InputRows found = FindInputRows(*table, (*fold)->kept);
  if (found.inputs.empty()) return;
  CsvTable errors = TakeRows(*table, found.errors);
  std::optional<Fold> of_errors = FindFold(errors);
  if (!of_errors) return;
  const std::vector<std::size_t> sources =
      of_errors->quantities.begin()->second;
  for (const auto& [name, rows] : found.inputs) {
    for (const std::size_t source : sources) {
      of_errors->quantities[name].push_back(errors.columns.size());
      errors.columns.push_back(TakeRows(table->columns[source], rows));
    }
  }
  *table = std::move(errors);
  *fold = std::move(of_errors);
}

// Says how to name columns that are errors and differ by a number.
void MentionNumbered(CsvTable* table) {
  std::map<std::string, std::vector<std::string>> numbered;
  for (const CsvColumn& column : table->columns) {
    const std::optional<PlacedName> name = ReadPlacedName(column.name);
    if (name && name->unit.empty()) {
      numbered[name->quantity].push_back(QuotedName(column.name));
    }
  }
  for (const auto& [quantity, names] : numbered) {
    if (names.size() < kFewestPositions) continue;
    table->Remark(
        names.front() + " to " + names.back() +
        " stay separate columns; a column for each position is called "
        "error_um@50mm, one for each run 'Run 1 [um]'");
  }
}

}  // namespace

bool AreSpacedPositions(const std::vector<double>& numbers) {
  if (numbers.size() < kFewestPositions) return false;
  const bool rise = numbers.front() < numbers.back();
  bool by_ones = true;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const double step = numbers[i] - numbers[i - 1];
    if (step == 0.0 || (step > 0.0) != rise) return false;
    by_ones = by_ones && std::abs(step) == 1.0;
  }
  return !by_ones;
}

void FoldPositions(CsvTable* table) {
  std::optional<Fold> fold = FindFold(*table);
  if (!fold) return MentionNumbered(table);
  TakeInputRows(table, &fold);
  LeaveOutFigures(*table, &*fold);
  const Places places = PlacesOf(*fold, table->num_rows);
  const std::size_t rows = places.rows.size();
  std::vector<CsvColumn> columns;
  for (const std::size_t i : fold->kept) {
    columns.push_back(TakeRows(table->columns[i], places.rows));
  }
  for (const CsvColumn& label : fold->labels) {
    columns.push_back(TakeRows(label, places.slots));
    columns.back().name = FreeName(*table, label.name);
  }
  std::vector<std::string> names;
  for (const auto& [name, sources] : fold->quantities) {
    columns.push_back(Folded(*table, FreeName(*table, name), sources, places));
    names.push_back(QuotedName(columns.back().name));
  }
  decltype(table->line_runs) runs;
  for (std::size_t row = 0; row < rows; ++row) {
    runs.emplace_back(
        row, table->LineOfRow(static_cast<std::size_t>(places.rows[row])));
  }
  table->Remark(std::to_string(table->num_rows) + " rows with " + fold->what +
                " are read as " + std::to_string(rows) + " rows, of " +
                JoinWords(names, ", ") +
                (fold->made.empty() ? ""
                                    : "; " + JoinWords(fold->made, ", ") +
                                          " made of these left out"));
  table->columns = std::move(columns);
  table->line_runs = std::move(runs);
  table->num_rows = rows;
}

}  // namespace errmap::data
