#include "data/tables/folded_positions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/column_words.h"
#include "data/columns.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

constexpr std::size_t kFewestPositions = 3;
constexpr auto kLengths = std::to_array<std::string_view>(
    {"mm", "um", "\u00b5m", "inch", "in", "m", "deg"});

// What a name such as "e@-215.9mm_um" or "X=25 mm" says.
struct PlacedName {
  std::string quantity;  // "error_um"
  std::string unit;      // of the position
  double position;
  bool is_marked = false;  // by "@" or "="
};

std::string QuantityOf(std::string_view before, std::string_view after) {
  std::string name(Trimmed(before));
  if (name.empty() || EqualsIgnoringCase(name, "e") ||
      EqualsIgnoringCase(name, "err")) {
    name = "error";
  }
  return name + std::string(after);
}

// What stands before a number without "@": nothing, an axis, a position, or an
// error; thermometers have their places in their names, too. Letters directly
// before a number name one of several: "A1 deg" is the first angle.
std::optional<std::string_view> BeforePlace(std::string_view before) {
  const bool is_apart = before.empty() || std::string_view("=: ").find(
                                              before.back()) != before.npos;
  before = Trimmed(before);
  if (before.ends_with('=') || before.ends_with(':')) before.remove_suffix(1);
  before = Trimmed(before);
  if (!is_apart) return std::nullopt;
  if (before.empty() ||
      IsOneOf(before, "x y z a b c u v w pos pos. position at")) {
    return std::string_view();
  }
  if (!IsOneOf(before, "e err error dev fehler abweichung"))
    return std::nullopt;
  return before;
}

std::optional<PlacedName> ReadPlacedName(std::string_view name) {
  std::size_t at = name.find('@');
  std::optional<std::string_view> before;
  if (at != std::string_view::npos) {
    before = name.substr(0, at);
    ++at;
  } else {
    at = std::min(name.find_first_of("+-0123456789"), name.size());
    before = BeforePlace(name.substr(0, at));
  }
  if (!before) return std::nullopt;
  const bool has_at = at > 0 && name[at - 1] == '@';
  std::string_view rest = Trimmed(name.substr(at));
  if (rest.starts_with('+')) rest.remove_prefix(1);
  PlacedName placed{
      .quantity = {},
      .unit = "",
      .position = 0.0,
      .is_marked = name.substr(0, at).find_first_of("@=") != name.npos};
  const char* const end = rest.data() + rest.size();
  const auto [stop, error] = std::from_chars(rest.data(), end, placed.position);
  if (error != std::errc()) return std::nullopt;
  rest = Trimmed({stop, static_cast<std::size_t>(end - stop)});
  for (const std::string_view unit : kLengths) {
    if (!rest.starts_with(unit)) continue;
    placed.unit = unit;
    rest.remove_prefix(unit.size());
    break;
  }
  if (placed.unit.empty()) {
    if (!has_at) return std::nullopt;
    placed.unit = "mm";
  }
  // What follows is the unit of the quantity: "_um", " [um]", or nothing.
  if (!rest.empty() &&
      std::string_view("_ [(").find(rest.front()) == std::string_view::npos) {
    return std::nullopt;
  }
  placed.quantity = QuantityOf(*before, rest);
  return placed;
}

// What a name such as "Run 3 up [um]" says.
struct RunName {
  std::string quantity = {};  // "error [um]"
  int run = 0;
  std::string direction = {};  // "up", "down", or ""
};

// "up" and "down" of a sign that ends a name but for its unit: "Pass 1 - [um]".
// The dash of "Pass 1-um" parts name and unit.
std::string SignBehind(std::string_view name, std::string_view unit) {
  if (!unit.empty()) {
    name = name.substr(0, name.rfind(unit));
    if (!name.empty()) name.remove_suffix(1);
  }
  name = Trimmed(name);
  return name.ends_with('+') ? "up" : name.ends_with('-') ? "down" : "";
}

std::optional<RunName> ReadRunName(std::string_view name) {
  constexpr std::string_view kRuns =
      "run cycle pass traverse lauf zyklus messung messlauf ciclo cyclus";
  constexpr std::string_view kUp = "up fwd forward pos vor f";
  constexpr std::string_view kDown = "down dn rev reverse neg bwd backward r b";
  const Header header = ReadHeader(name);
  constexpr std::string_view kBetween = " _.#:-+";
  RunName said{.direction = SignBehind(name, header.unit_text)};
  bool is_run = false;
  const std::string_view base = header.base;
  for (std::size_t at = 0; at < base.size();) {
    std::size_t end = at;
    if (kBetween.find(base[at]) != kBetween.npos) {
      ++at;
      continue;
    }
    const bool digits = base[at] >= '0' && base[at] <= '9';
    while (end < base.size() && kBetween.find(base[end]) == kBetween.npos &&
           (base[end] >= '0' && base[end] <= '9') == digits) {
      ++end;
    }
    const std::string_view word = base.substr(at, end - at);
    if (digits) {
      std::from_chars(word.data(), word.data() + word.size(), said.run);
    } else if (IsOneOf(word, kRuns)) {
      is_run = true;
    } else if (IsOneOf(word, kUp)) {
      said.direction = "up";
    } else if (IsOneOf(word, kDown)) {
      said.direction = "down";
    } else {
      return std::nullopt;
    }
    at = end;
  }
  if (!is_run || said.run <= 0) return std::nullopt;
  said.quantity = "error";
  if (!header.unit_text.empty()) said.quantity += " [" + header.unit_text + "]";
  return said;
}

// Columns that become rows: each row of the table becomes one for each slot.
struct Fold {
  std::vector<std::size_t> kept;  // the other columns
  std::vector<CsvColumn> labels;  // (slots) what tells the slots apart
  std::map<std::string, std::vector<std::size_t>> quantities;  // (slots)
  std::size_t slots = 0;
  bool slot_by_slot = false;    // all rows of one, then those of the next
  std::vector<bool> backwards;  // (slots) the rows of one from the last up
  std::string what;             // "a column for each of 9 positions"
};

// A column of errors beside those that might be folded.
const CsvColumn* ErrorBeside(const CsvTable& table, const Fold& fold) {
  const auto found = std::ranges::find_if(fold.kept, [&](std::size_t i) {
    return !table.columns[i].is_text() && ErrorSign(table.columns[i].name) != 0;
  });
  return found == fold.kept.end() ? nullptr : &table.columns[*found];
}

std::optional<Fold> FindPositions(const CsvTable& table) {
  Fold fold;
  std::string unit;
  bool are_marked = true;
  std::map<std::string, std::vector<double>> places;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::optional<PlacedName> name =
        ReadPlacedName(table.columns[i].name);
    if (!name || table.columns[i].is_text()) {
      fold.kept.push_back(i);
      continue;
    }
    if (unit.empty()) unit = name->unit;
    if (name->unit != unit) return std::nullopt;
    are_marked = are_marked && name->is_marked;
    places[name->quantity].push_back(name->position);
    fold.quantities[name->quantity].push_back(i);
  }
  if (places.empty()) return std::nullopt;
  const std::vector<double>& positions = places.begin()->second;
  const std::set<double> distinct(positions.begin(), positions.end());
  const bool are_alike = std::ranges::all_of(
      places, [&](const auto& of) { return of.second == positions; });
  if (!are_alike || distinct.size() != positions.size() ||
      positions.size() < kFewestPositions ||
      (!are_marked && ErrorBeside(table, fold) != nullptr)) {
    return std::nullopt;
  }
  fold.slots = positions.size();
  fold.backwards.assign(fold.slots, false);
  fold.labels.push_back(NumberColumn("position_" + unit, positions));
  fold.what = "a column for each of " + std::to_string(fold.slots) +
              " positions (" + CsvNumber(*distinct.begin()) + " to " +
              CsvNumber(*distinct.rbegin()) + " " + unit + ")";
  return fold;
}

// -1 where all cells of a column fall down the rows, 1 where they rise, else 0.
int WayOfRows(const CsvColumn& column) {
  if (!column.exceptions.empty() || column.values.size() < 2) return 0;
  const std::vector<double> values = column.values;
  const auto breaks = [&](auto not_so) {
    return std::ranges::adjacent_find(values, not_so) != values.end();
  };
  if (!breaks(std::less_equal<>())) return -1;
  return breaks(std::greater_equal<>()) ? 0 : 1;
}

// Whether the rows list the positions from the highest down: those of the first
// column that is called a position, else of the first that goes one way.
bool PositionsDescend(const CsvTable& table,
                      const std::vector<std::size_t>& columns) {
  for (const bool called : {true, false}) {
    for (const std::size_t i : columns) {
      const CsvColumn& column = table.columns[i];
      if (called && !IsCalledPosition(column.name)) continue;
      if (const int way = WayOfRows(column); way != 0) return way < 0;
    }
  }
  return false;
}

std::optional<Fold> FindRuns(const CsvTable& table) {
  Fold fold;
  fold.slot_by_slot = true;
  std::set<std::pair<int, std::string>> runs;
  std::vector<double> numbers;
  std::vector<std::ptrdiff_t> ways;  // 0: up, 1: down, 2: nothing said
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::optional<RunName> name = ReadRunName(table.columns[i].name);
    if (!name || table.columns[i].is_text()) {
      fold.kept.push_back(i);
      continue;
    }
    if (!runs.emplace(name->run, name->direction).second) return std::nullopt;
    fold.quantities[name->quantity].push_back(i);
    numbers.push_back(name->run);
    ways.push_back(name->direction.empty()   ? 2
                   : name->direction == "up" ? 0
                                             : 1);
  }
  const auto unsaid = std::ranges::count(ways, 2);
  if (fold.quantities.size() != 1 || runs.size() < 3 || fold.kept.empty() ||
      (unsaid > 0 && std::cmp_not_equal(unsaid, runs.size()))) {
    return std::nullopt;
  }
  // Beside errors in another unit they are something else: positions read.
  const CsvColumn* const beside = ErrorBeside(table, fold);
  if (beside != nullptr && UnitOfColumn(beside->name) !=
                               UnitOfColumn(fold.quantities.begin()->first)) {
    return std::nullopt;
  }
  fold.slots = runs.size();
  // Each run goes from where the one before it ended.
  const bool descend = PositionsDescend(table, fold.kept);
  for (const std::ptrdiff_t way : ways) {
    fold.backwards.push_back(way != 2 && (way == 1) != descend);
  }
  fold.labels.push_back(NumberColumn("cycle", std::move(numbers)));
  if (unsaid == 0) {
    fold.labels.push_back(WordColumn("direction", ways, {"up", "down"}));
  }
  fold.what = "a column for each of " + std::to_string(fold.slots) + " runs";
  return fold;
}

// Rows of the folded table: the row and the slot that each is from.
struct Places {
  std::vector<std::ptrdiff_t> rows;
  std::vector<std::ptrdiff_t> slots;
};

Places PlacesOf(const Fold& fold, std::size_t num_rows) {
  Places places;
  for (std::size_t i = 0; i < num_rows * fold.slots; ++i) {
    const std::size_t slot = fold.slot_by_slot ? i / num_rows : i % fold.slots;
    const std::size_t row = fold.slot_by_slot ? i % num_rows : i / fold.slots;
    places.rows.push_back(static_cast<std::ptrdiff_t>(
        fold.backwards[slot] ? num_rows - 1 - row : row));
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

}  // namespace

void FoldPositions(CsvTable* table) {
  std::optional<Fold> fold = FindPositions(*table);
  if (!fold) fold = FindRuns(*table);
  if (!fold) return;
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
  table->remarks.push_back(PrintablePath(table->file) + ": " +
                           std::to_string(table->num_rows) + " rows with " +
                           fold->what + " are read as " + std::to_string(rows) +
                           " rows, of " + JoinWords(names, ", "));
  table->columns = std::move(columns);
  table->line_runs = std::move(runs);
  table->num_rows = rows;
}

}  // namespace errmap::data
