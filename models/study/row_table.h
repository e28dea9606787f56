#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Returns the index in `dataset` of each of its data rows.
std::unordered_map<Index, Index> IndexByRow(const data::Dataset& dataset);

/// Reads users' tables with one line for each row of a data set. Each accessor
/// throws data::InputError naming file, line and column.
class RowTable {
 public:
  /// `table` must outlive it.
  explicit RowTable(const data::CsvTable& table) : table_(table) {}

  std::size_t num_lines() const { return table_.num_rows; }
  bool Has(const std::string& column) const { return table_.Find(column) >= 0; }
  /// Returns a whole number, at least 0.
  Index Whole(std::size_t line, const std::string& column) const;
  double Number(std::size_t line, const std::string& column) const;
  std::string Text(std::size_t line, const std::string& column) const;
  /// Throws with the line and `why`.
  [[noreturn]] void Refuse(std::size_t line,
                           const std::string& column,
                           const std::string& why) const;
  /// Throws unless all of these columns exist.
  void Require(const std::vector<std::string>& columns) const;

 private:
  const data::CsvColumn& Column(const std::string& name) const;

  const data::CsvTable& table_;
};

}  // namespace errmap::models
