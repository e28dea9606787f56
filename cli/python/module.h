#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include <pybind11/pybind11.h>

#include "cli/shell/standard_streams.h"
#include "data/csv.h"
#include "models/error_model.h"
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

/// Tables and texts that commands read in place of files, by name.
struct Inputs {
  std::map<std::string, Table> tables;
  std::map<std::string, std::string> texts;
};

/// Runs `work` in its own thread, without Python's lock, with `inputs` as files
/// and `host` for streams. Meanwhile it checks Python's signals and calls
/// `each_moment` (may be empty) with the lock held. A signal sets `host->stop`.
/// Rethrows exceptions of `work`. Returns true if a signal came; its Python
/// error is then set.
bool RunHostedWork(const Inputs& inputs,
                   cli::Host* host,
                   std::atomic<bool>* stop,
                   const std::function<void()>& work,
                   const std::function<void()>& each_moment);

void DefineCommands(py::module_* module);

/// Adds compare, fit and folds, and the study that compare returns.
void DefineStudies(py::module_* module);

/// A recipe that fits in Python. `fit(x, y, columns)` gets the training rows as
/// Numbers (m x p), the targets as Numbers (m) and the names of the columns,
/// and returns `predict(x)`, which gives float64 (m). If it raises an
/// exception, the fit has failed for that reason.
std::unique_ptr<models::ModelRecipe> ForeignRecipe(const std::string& name,
                                                   py::object fit);

}  // namespace errmap::python
