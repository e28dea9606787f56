#include "data/tables/folded_positions.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "data/text.h"
#include "data/text_index.h"

namespace errmap::data {
namespace {

constexpr std::size_t kFewestPositions = 3;
constexpr auto kLengths = std::to_array<std::string_view>(
    {"mm", "um", "\u00b5m", "inch", "in", "m", "deg"});

// What a name such as "e@-215.9mm_um" says.
struct PlacedName {
  std::string quantity;  // "error_um"
  std::string unit;      // of the position
  double position;
};

std::string QuantityOf(std::string_view before, std::string_view after) {
  std::string name(Trimmed(before));
  if (name.empty() || EqualsIgnoringCase(name, "e") ||
      EqualsIgnoringCase(name, "err")) {
    name = "error";
  }
  return name + std::string(after);
}

std::optional<PlacedName> ReadPlacedName(std::string_view name) {
  const std::size_t at = name.find('@');
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view rest = Trimmed(name.substr(at + 1));
  if (rest.starts_with('+')) rest.remove_prefix(1);
  PlacedName placed{.quantity = {}, .unit = "mm", .position = 0.0};
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
  // What follows is the unit of the quantity: "_um", " [um]", or nothing.
  if (!rest.empty() &&
      std::string_view("_ [(").find(rest.front()) == std::string_view::npos) {
    return std::nullopt;
  }
  placed.quantity = QuantityOf(name.substr(0, at), rest);
  return placed;
}

// The columns of a quantity, a column a position.
struct Placed {
  std::vector<double> positions;
  std::vector<std::size_t> columns;
};

struct Fold {
  std::map<std::string, Placed> quantities;  // all of the same positions
  std::vector<std::size_t> kept;             // the other columns
  std::string unit;

  const std::vector<double>& positions() const {
    return quantities.begin()->second.positions;
  }
};

std::optional<Fold> FindFold(const CsvTable& table) {
  Fold fold;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::optional<PlacedName> name =
        ReadPlacedName(table.columns[i].name);
    if (!name) {
      fold.kept.push_back(i);
      continue;
    }
    if (fold.unit.empty()) fold.unit = name->unit;
    if (name->unit != fold.unit) return std::nullopt;
    Placed& placed = fold.quantities[name->quantity];
    placed.positions.push_back(name->position);
    placed.columns.push_back(i);
  }
  if (fold.quantities.empty()) return std::nullopt;
  const std::vector<double>& positions = fold.positions();
  const std::set<double> distinct(positions.begin(), positions.end());
  const bool are_alike =
      std::ranges::all_of(fold.quantities, [&](const auto& quantity) {
        return quantity.second.positions == positions;
      });
  if (!are_alike || distinct.size() != positions.size() ||
      positions.size() < kFewestPositions) {
    return std::nullopt;
  }
  return fold;
}

// Column by column of one table, cell by cell of another.
class CellCopier {
 public:
  CellCopier(std::string name, std::size_t rows) {
    column_.name = std::move(name);
    column_.values.reserve(rows);
  }

  void Copy(const CsvTable& table, const CsvColumn& from, std::size_t row) {
    const std::size_t at = column_.values.size();
    column_.values.push_back(from.values[row]);
    if (std::isnan(from.values[row])) {
      column_.exceptions.emplace_back(
          at, index_.IndexOf(table.CellText(from, row), &column_.texts));
    }
    const auto given = static_cast<std::ptrdiff_t>(row);
    const auto now = static_cast<std::ptrdiff_t>(at);
    if (from.first_decimal_comma == given && column_.first_decimal_comma < 0) {
      column_.first_decimal_comma = now;
    }
    if (from.first_decimal_point == given && column_.first_decimal_point < 0) {
      column_.first_decimal_point = now;
    }
  }

  void Put(double value) { column_.values.push_back(value); }

  CsvColumn Take() { return std::move(column_); }

 private:
  CsvColumn column_;
  TextIndex index_;
};

std::string FreeName(const CsvTable& table, const std::string& name) {
  std::string free = name;
  for (int i = 2; table.Find(free) >= 0; ++i) {
    free = name + "_" + std::to_string(i);
  }
  return free;
}

}  // namespace

void FoldPositions(CsvTable* table) {
  const std::optional<Fold> fold = FindFold(*table);
  if (!fold) return;
  const std::vector<double>& positions = fold->positions();
  const std::size_t rows = table->num_rows * positions.size();
  std::vector<CsvColumn> columns;
  for (const std::size_t i : fold->kept) {
    CellCopier copy(table->columns[i].name, rows);
    for (std::size_t row = 0; row < rows; ++row) {
      copy.Copy(*table, table->columns[i], row / positions.size());
    }
    columns.push_back(copy.Take());
    columns.back().has_name = table->columns[i].has_name;
  }
  CellCopier position(FreeName(*table, "position_" + fold->unit), rows);
  for (std::size_t row = 0; row < rows; ++row) {
    position.Put(positions[row % positions.size()]);
  }
  columns.push_back(position.Take());
  std::vector<std::string> names;
  for (const auto& [name, placed] : fold->quantities) {
    CellCopier copy(FreeName(*table, name), rows);
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t column = placed.columns[row % positions.size()];
      copy.Copy(*table, table->columns[column], row / positions.size());
    }
    columns.push_back(copy.Take());
    names.push_back(QuotedName(columns.back().name));
  }
  decltype(table->line_runs) runs;
  for (std::size_t row = 0; row < rows; ++row) {
    runs.emplace_back(row, table->LineOfRow(row / positions.size()));
  }
  const auto [low, high] = std::ranges::minmax(positions);
  table->remarks.push_back(
      PrintablePath(table->file) + ": " + std::to_string(table->num_rows) +
      " rows with a column for each of " + std::to_string(positions.size()) +
      " positions (" + CsvNumber(low) + " to " + CsvNumber(high) + " " +
      fold->unit + ") are read as " + std::to_string(rows) + " rows, of " +
      JoinWords(names, ", "));
  table->columns = std::move(columns);
  table->line_runs = std::move(runs);
  table->num_rows = rows;
}

}  // namespace errmap::data
