#include "data/tables/shapes/row_figures.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace errmap::data {
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
