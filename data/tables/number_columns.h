#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/tables/csv_dialect.h"

namespace errmap::data {

/// Counts over some cells of a row: numbers, and words for missing ones.
struct CellCounts {
  std::size_t numbers = 0;
  std::size_t words = 0;
};

/// Columns that hold numbers in a file's first records, and the content of a
/// row there. A number may follow a label that all cells of its column have
/// ("T1=21.4").
class NumberColumns {
 public:
  /// Uses the records of `width` cells, the usual number.
  NumberColumns(const std::vector<CsvRecord>& records,
                std::size_t width,
                const CsvDialect& dialect);

  std::size_t width() const { return is_number_.size(); }
  std::size_t count() const { return count_; }
  bool Holds(std::size_t column) const { return is_number_[column]; }

  /// Counts over the columns of numbers.
  CellCounts CountsOf(const std::vector<std::string>& cells) const;
  /// True if a line may have the names: it has no number where the rows have
  /// numbers. A separator at the rows' ends, or columns that no row reaches,
  /// may make it shorter or longer by one.
  bool MayBeNames(const std::vector<std::string>& cells) const;
  /// True if a line has units for most columns of numbers.
  bool AreUnits(const std::vector<std::string>& cells) const;

 private:
  bool IsNumber(std::string_view cell, std::size_t column) const;
  void FindLabels(const std::vector<CsvRecord>& records, std::size_t width);

  CsvDialect dialect_;
  std::vector<std::string> labels_;  // (width) before all cells' numbers
  std::vector<bool> is_number_;      // (width) most cells are numbers
  std::size_t count_ = 0;
};

}  // namespace errmap::data
