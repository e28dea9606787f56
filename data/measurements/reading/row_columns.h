#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// The columns of a table in some of its rows, as those see them who look for
/// times and sessions: one that somebody named must do, another is passed over.
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

  /// The numbers of the rows, for a time.
  Eigen::VectorXd RowNumbers() const {
    Eigen::VectorXd numbers(std::ssize(rows_));
    std::ranges::copy(rows_, numbers.begin());
    return numbers;
  }

  /// Of a column, in these rows.
  std::vector<double> ValuesOf(const CsvColumn& column) const;

  /// What is measured tells no time: filters would see the error itself.
  bool IsMeasured(std::size_t column) const;
  /// Throws InputError where it is not there, or measured.
  std::size_t NamedColumn(const std::string& name,
                          const std::string& argument) const;

  /// Why a column will not do: thrown with the remedy where it was named, else
  /// a remark.
  static void PassOver(bool named,
                       const std::string& why,
                       const std::string& remedy,
                       std::vector<std::string>* remarks);

  /// Whether a cell of a column may be missing in this row of the table, which
  /// drops the row; else a remark, or of a named column InputError.
  bool MayBeMissing(std::size_t column,
                    std::size_t row,
                    bool named,
                    std::vector<std::string>* remarks) const;

  /// Rows that are not known get the value before them (the first ones that
  /// after them), so that steps to and from them are those of the others. False
  /// where none is known.
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
