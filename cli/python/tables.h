#pragma once

#include <memory>
#include <string>

#include <pybind11/pybind11.h>

#include "data/csv.h"
#include "stats/eigen.h"

namespace errmap::python {

namespace py = pybind11;

/// A reference to a Python object that any thread may release.
std::shared_ptr<py::object> Kept(py::object object);

/// Numbers that Python reads without a copy, by the buffer protocol.
struct Numbers {
  MatrixXd values;
  bool is_column = true;
};

/// Returns the numbers of an object that exposes its memory (float64, one
/// dimension). Throws py::value_error if it does not.
VectorXd ToVector(const py::object& object);

/// A table that is filled column by column.
class Table {
 public:
  Table(const std::string& name, std::size_t num_rows);

  /// Adds a column of numbers. float64 is read without a copy, whatever its
  /// strides.
  void AddNumbers(const std::string& column, const py::buffer& numbers);
  /// Adds a column whose cells are each a number, a text or None.
  void AddCells(const std::string& column, const py::list& cells);
  /// Adds the text of a CSV file with all its columns.
  static Table OfCsv(const std::string& text, const std::string& name);

  /// Returns each column as numbers, or as a list of texts if a cell is not a
  /// number. Empty cells of a column of numbers are NaN.
  py::dict Columns() const;
  const std::shared_ptr<data::CsvTable>& table() const { return table_; }

 private:
  data::CsvColumn* NewColumn(const std::string& name, std::size_t rows);

  std::shared_ptr<data::CsvTable> table_;
};

void DefineTables(py::module_* module);

}  // namespace errmap::python
