#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "cli/python/module.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::python {
namespace {

constexpr auto kSize = static_cast<py::ssize_t>(sizeof(double));

// Whether the numbers can be read as they are.
bool IsDoubles(const py::buffer_info& info) {
  return info.ndim == 1 && info.format == "d" && info.strides[0] % kSize == 0 &&
         reinterpret_cast<std::uintptr_t>(info.ptr) % alignof(double) == 0;
}

std::uint32_t IndexOf(const std::string& text, data::CsvColumn* column) {
  for (std::size_t i = 0; i < column->texts.size(); ++i) {
    if (column->texts[i] == text) return static_cast<std::uint32_t>(i);
  }
  column->texts.push_back(text);
  return static_cast<std::uint32_t>(column->texts.size() - 1);
}

std::string TextOf(double value) {
  return std::isnan(value) ? "" : value > 0.0 ? "inf" : "-inf";
}

// What is not finite is kept as the text that a file would have.
void NoteExceptions(data::CsvColumn* column) {
  bool is_infinite = false;
  std::size_t row = 0;
  for (const double value : column->values) {
    if (!std::isfinite(value)) {
      is_infinite = is_infinite || std::isinf(value);
      column->exceptions.emplace_back(row, IndexOf(TextOf(value), column));
    }
    ++row;
  }
  if (!is_infinite) return;
  for (double& value : column->values.Own()) {
    if (std::isinf(value)) value = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

std::shared_ptr<py::object> Kept(py::object object) {
  return {new py::object(std::move(object)), [](py::object* kept) {
            const py::gil_scoped_acquire gil;
            delete kept;
          }};
}

VectorXd ToVector(const py::object& object) {
  const py::buffer_info info =
      py::reinterpret_borrow<py::buffer>(object).request();
  if (!IsDoubles(info)) {
    throw py::value_error("expected an array of float64 in one dimension");
  }
  return Eigen::Map<const VectorXd, 0, Eigen::InnerStride<>>(
      static_cast<const double*>(info.ptr),
      info.shape[0],
      Eigen::InnerStride<>(info.strides[0] / kSize));
}

Table::Table(const std::string& name, std::size_t num_rows)
    : table_(std::make_shared<data::CsvTable>()) {
  table_->file = name;
  table_->num_rows = num_rows;
}

data::CsvColumn* Table::NewColumn(const std::string& name, std::size_t rows) {
  const std::string& file = table_->file;
  if (name.empty()) throw data::InputError(file + ": a column has no name");
  if (table_->Find(name) >= 0) {
    throw data::InputError(
        fmt::format("{}: two columns are named '{}'; give each its own name",
                    file,
                    data::Printable(name)));
  }
  if (rows != table_->num_rows) {
    throw data::InputError(
        fmt::format("{}: column '{}' has {} rows, and others have {}",
                    file,
                    data::Printable(name),
                    rows,
                    table_->num_rows));
  }
  data::CsvColumn& column = table_->columns.emplace_back();
  column.name = name;
  return &column;
}

void Table::AddNumbers(const std::string& name, const py::buffer& numbers) {
  auto info = std::make_shared<py::buffer_info>(numbers.request());
  if (!IsDoubles(*info)) {
    throw data::InputError(fmt::format(
        "{}: column '{}' is not a column of float64", table_->file, name));
  }
  data::CsvColumn* const column =
      NewColumn(name, static_cast<std::size_t>(info->shape[0]));
  const auto* const first = static_cast<const double*>(info->ptr);
  const std::ptrdiff_t stride = info->strides[0] / kSize;
  const auto size = static_cast<std::size_t>(info->shape[0]);
  // Released where any thread lets go of the column.
  const std::shared_ptr<const void> keeper(info.get(),
                                           [info](const void*) mutable {
                                             const py::gil_scoped_acquire gil;
                                             info.reset();
                                           });
  column->values = data::ColumnValues::Borrowed(first, stride, size, keeper);
  NoteExceptions(column);
}

void Table::AddCells(const std::string& name, const py::list& cells) {
  data::CsvColumn* const column = NewColumn(name, cells.size());
  std::size_t row = 0;
  for (const py::handle cell : cells) {
    double value = std::numeric_limits<double>::quiet_NaN();
    std::string text;
    if (py::isinstance<py::str>(cell)) {
      // Half a surrogate pair is not a character.
      text = py::bytes(cell.attr("encode")("utf-8", "replace"));
      text = data::Trimmed(text);
    } else if (!cell.is_none()) {
      value = cell.cast<double>();
      text = TextOf(value);
    }
    column->values.push_back(std::isfinite(value)
                                 ? value
                                 : std::numeric_limits<double>::quiet_NaN());
    if (!std::isfinite(value)) {
      column->exceptions.emplace_back(row, IndexOf(text, column));
    }
    ++row;
  }
}

Table Table::OfCsv(const std::string& text, const std::string& name) {
  Table table(name, 0);
  *table.table_ = data::ParseCsv(text, name);
  return table;
}

py::dict Table::Columns() const {
  py::dict columns;
  for (const data::CsvColumn& column : table_->columns) {
    const auto is_missing = [&](const auto& exception) {
      return column.texts[exception.second].empty();
    };
    if (!std::ranges::all_of(column.exceptions, is_missing)) {
      py::list cells;
      for (std::size_t row = 0; row < table_->num_rows; ++row) {
        cells.append(table_->CellText(column, row));
      }
      columns[py::str(column.name)] = cells;
      continue;
    }
    Numbers numbers;
    numbers.values.resize(std::ssize(column.values), 1);
    Index row = 0;
    for (const double value : column.values) numbers.values(row++) = value;
    columns[py::str(column.name)] = py::cast(std::move(numbers));
  }
  return columns;
}

void DefineTables(py::module_* module) {
  module->def(
      "difference",
      [](const py::object& a, const py::object& b) {
        return Numbers{ToVector(a) - ToVector(b)};
      },
      py::arg("a"),
      py::arg("b"),
      "a - b, element by element.");
  py::class_<Numbers>(
      *module, "Numbers", py::buffer_protocol(), "Numbers in memory.")
      .def_buffer([](Numbers& numbers) {
        const py::ssize_t rows = numbers.values.rows();
        const py::ssize_t columns = numbers.values.cols();
        double* const data = numbers.values.data();
        return numbers.is_column
                   ? py::buffer_info(data, rows)
                   : py::buffer_info(data,
                                     kSize,
                                     py::format_descriptor<double>::format(),
                                     2,
                                     {rows, columns},
                                     {kSize, kSize * rows});
      });
  py::class_<Table>(*module, "Table", "Named columns of equal length.")
      .def(py::init<const std::string&, std::size_t>(),
           py::arg("name"),
           py::arg("rows"))
      .def("add_numbers",
           &Table::AddNumbers,
           py::arg("column"),
           py::arg("numbers"))
      .def("add_cells", &Table::AddCells, py::arg("column"), py::arg("cells"))
      .def("columns", &Table::Columns)
      .def_static("of_csv", &Table::OfCsv, py::arg("text"), py::arg("name"));
}

}  // namespace errmap::python
