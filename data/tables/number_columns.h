#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/tables/csv_dialect.h"

namespace errmap::data {

/// Of some of a row's cells: how many are numbers, and words that stand for
/// none.
struct CellCounts {
  std::size_t numbers = 0;
  std::size_t words = 0;
};

/// Which columns of a file's first records hold numbers, and what a row has
/// there. A number may stand behind a label that all cells of its column have
/// ("T1=21.4").
class NumberColumns {
 public:
  /// Of the records of `width` cells, the usual number.
  NumberColumns(const std::vector<CsvRecord>& records,
                std::size_t width,
                const CsvDialect& dialect);

  std::size_t width() const { return is_number_.size(); }
  std::size_t count() const { return count_; }
  bool Holds(std::size_t column) const { return is_number_[column]; }

  /// In the columns of numbers.
  CellCounts CountsOf(const std::vector<std::string>& cells) const;
  /// Whether a line may be that of names: none is a number where the rows have
  /// them. A separator at the rows' ends, or columns that no row reaches, make
  /// it shorter by one, or longer.
  bool MayBeNames(const std::vector<std::string>& cells) const;
  /// Whether a line has units for most columns of numbers.
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
