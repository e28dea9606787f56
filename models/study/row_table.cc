#include "models/study/row_table.h"

#include <cmath>

#include <fmt/format.h>

#include "data/text.h"

namespace errmap::models {

std::unordered_map<Index, Index> IndexByRow(const data::Dataset& dataset) {
  std::unordered_map<Index, Index> index;
  for (std::size_t i = 0; i < dataset.rows().size(); ++i) {
    index.emplace(dataset.rows()[i], static_cast<Index>(i));
  }
  return index;
}

void RowTable::Refuse(std::size_t line,
                      const std::string& column,
                      const std::string& why) const {
  throw data::InputError(table_.Where(line, column) + ": " + why);
}

void RowTable::Require(const std::vector<std::string>& columns) const {
  for (const std::string& column : columns) {
    if (Has(column)) continue;
    throw data::InputError(
        fmt::format("{}: no column '{}'; the header must have {}",
                    table_.file,
                    column,
                    data::JoinWords(columns, ",")));
  }
}

const data::CsvColumn& RowTable::Column(const std::string& name) const {
  return table_.At(table_.Find(name));
}

std::string RowTable::Text(std::size_t line, const std::string& column) const {
  return table_.CellText(Column(column), line);
}

double RowTable::Number(std::size_t line, const std::string& column) const {
  const double value = Column(column).values[line];
  if (!std::isfinite(value)) {
    Refuse(line,
           column,
           fmt::format("'{}' is not a finite number", Text(line, column)));
  }
  return value;
}

Index RowTable::Whole(std::size_t line, const std::string& column) const {
  constexpr double kMost = 1e15;  // exact in a double
  const double value = Column(column).values[line];
  if (!(value >= 0.0) || value > kMost || value != std::floor(value)) {
    Refuse(
        line,
        column,
        fmt::format("'{}' is not a whole number from 0", Text(line, column)));
  }
  return static_cast<Index>(value);
}

}  // namespace errmap::models
