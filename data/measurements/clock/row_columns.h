#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/columns.h"
#include "data/csv.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// The columns of a table, limited to some of its rows, for the search for
/// times and sessions. An unusable column is an error if the user named it;
/// otherwise it is skipped.
class RowColumns {
 public:
  RowColumns(const CsvTable& table,
             const DatasetSelection& selection,
             const std::vector<Eigen::Index>& rows)
      : table_(table), selection_(selection), rows_(rows) {}

 protected:
  std::size_t DataRow(std::size_t i) const {
    return static_cast<std::size_t>(rows_[i]);
  }

  /// Row numbers, used in place of times.
  Eigen::VectorXd RowNumbers() const {
    Eigen::VectorXd numbers(std::ssize(rows_));
    std::ranges::copy(rows_, numbers.begin());
    return numbers;
  }

  /// Returns a column in these rows.
  std::vector<double> ValuesOf(const CsvColumn& column) const {
    return data::ValuesOf(column, rows_);
  }

  /// True for the target and the weight: as times, they would let filters see
  /// the error.
  bool IsMeasured(std::size_t column) const;
  /// Throws InputError if the column does not exist or is measured.
  std::size_t NamedColumn(const std::string& name,
                          const std::string& argument) const;

  /// Skips an unusable column. Throws the reason with the remedy if the user
  /// named the column; otherwise adds a remark.
  static void PassOver(bool named,
                       const std::string& why,
                       const std::string& remedy,
                       std::vector<std::string>* remarks);

  static void Skip(const std::string& why, std::vector<std::string>* remarks) {
    remarks->push_back(why + "; the column is skipped");
  }
  /// True if a missing cell of a column is allowed in this row of the table,
  /// which drops the row. Otherwise makes a remark, or throws InputError for a
  /// named column.
  bool MayBeMissing(std::size_t column,
                    std::size_t row,
                    bool named,
                    std::vector<std::string>* remarks) const;

  /// Gives unknown rows the value before them, or at the start the value after
  /// them, so that the other rows determine the steps. Returns false if none is
  /// known.
  template <typename Values>
  static bool HoldLast(const std::vector<bool>& known, Values* values) {
    const auto first = std::ranges::find(known, true) - known.begin();
    if (first == std::ssize(known)) return false;
    auto last = (*values)[first];
    for (std::size_t i = 0; i < known.size(); ++i) {
      auto& value = (*values)[static_cast<Eigen::Index>(i)];
      if (known[i]) last = value;
      value = last;
    }
    return true;
  }

  const CsvTable& table_;
  const DatasetSelection& selection_;
  const std::vector<Eigen::Index>& rows_;
};

}  // namespace errmap::data
