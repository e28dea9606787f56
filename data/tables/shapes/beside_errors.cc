#include "data/tables/shapes/beside_errors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/columns.h"

namespace errmap::data {
namespace {

// "T1" is a tool in a column of words, and a thermometer among numbers.
bool NamesInput(const std::string& text, bool among_words) {
  if (StatesTemperature(text)) return true;
  if (among_words) return false;
  const Header header = ReadHeader(text);
  return NamesTemperature(text) || (header.source == UnitSource::kStated &&
                                    !IsLengthOrAngle(header.unit));
}

// The first of `rows` behind a row, or the last before it; else the only side.
std::ptrdiff_t Nearest(const std::vector<std::ptrdiff_t>& rows,
                       std::ptrdiff_t row,
                       bool before) {
  auto found = std::ranges::lower_bound(rows, row);
  if (before ? found != rows.begin() : found == rows.end()) --found;
  return *found;
}

}  // namespace

InputRows FindInputRows(const CsvTable& table,
                        const std::vector<std::size_t>& columns) {
  std::map<std::string, std::vector<std::ptrdiff_t>> named;
  std::vector<bool> is_error(table.num_rows, true);
  for (const std::size_t i : columns) {
    const CsvColumn& column = table.columns[i];
    for (const auto& [row, text] : column.exceptions) {
      const std::string& name = column.texts[text];
      if (!is_error[row] || !NamesInput(name, column.is_text())) continue;
      is_error[row] = false;
      named[name].push_back(static_cast<std::ptrdiff_t>(row));
    }
  }
  InputRows found{.errors = MarkedRows(is_error)};
  if (found.errors.empty()) return found;
  for (auto& [name, rows] : named) {
    std::ranges::sort(rows);
    for (const std::ptrdiff_t row : found.errors) {
      found.inputs[name].push_back(Nearest(rows, row, !is_error[0]));
    }
  }
  return found;
}

namespace {

using Figure = double (*)(const std::vector<double>& cells);

double Mean(const std::vector<double>& cells) {
  double sum = 0.0;
  for (const double cell : cells) sum += cell;
  return sum / static_cast<double>(cells.size());
}

double Least(const std::vector<double>& cells) {
  return std::ranges::min(cells);
}

double Most(const std::vector<double>& cells) {
  return std::ranges::max(cells);
}

double Range(const std::vector<double>& cells) {
  return Most(cells) - Least(cells);
}

double Deviation(const std::vector<double>& cells) {
  const double mean = Mean(cells);
  double squares = 0.0;
  for (const double cell : cells) squares += (cell - mean) * (cell - mean);
  return std::sqrt(squares / static_cast<double>(cells.size() - 1));
}

constexpr auto kFigures =
    std::to_array<Figure>({Mean, Least, Most, Range, Deviation});

std::vector<double> CellsOf(const CsvTable& table,
                            const std::vector<std::size_t>& columns,
                            std::size_t row) {
  std::vector<double> cells;
  for (const std::size_t i : columns) {
    cells.push_back(table.columns[i].values[row]);
  }
  return cells;
}

}  // namespace

bool IsRowFigure(const CsvTable& table,
                 std::size_t column,
                 const std::vector<std::size_t>& others) {
  constexpr std::size_t kFewestRows = 3;
  constexpr double kSlack = 0.05;
  const std::vector<double> values = table.columns[column].values;
  if (values.size() < kFewestRows || others.size() < 2 ||
      !table.columns[column].exceptions.empty()) {
    return false;
  }
  const double varies = Deviation(values);
  return varies > 0.0 && std::ranges::any_of(kFigures, [&](Figure figure) {
           double worst = 0.0;
           for (std::size_t row = 0; row < values.size(); ++row) {
             const double away =
                 std::abs(values[row] - figure(CellsOf(table, others, row)));
             worst = std::isnan(away) ? INFINITY : std::max(worst, away);
           }
           return worst <= kSlack * varies;
         });
}

}  // namespace errmap::data
