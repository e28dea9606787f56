#include "data/columns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "data/text_index.h"

namespace errmap::data {
namespace {

void AddText(std::string_view text, TextIndex* index, CsvColumn* column) {
  column->exceptions.emplace_back(column->values.size(),
                                  index->IndexOf(text, &column->texts));
  column->values.push_back(std::nan(""));
}

}  // namespace

CsvColumn NumberColumn(const std::string& name, std::vector<double> values) {
  CsvColumn column{.name = name};
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isnan(values[row])) continue;
    if (column.texts.empty()) column.texts.emplace_back();
    column.exceptions.emplace_back(row, 0U);
  }
  column.values = std::move(values);
  return column;
}

CsvColumn WordColumn(const std::string& name,
                     const std::vector<std::ptrdiff_t>& codes,
                     std::vector<std::string> words) {
  CsvColumn column{.name = name, .texts = std::move(words)};
  column.values = std::vector<double>(codes.size(), std::nan(""));
  for (std::size_t row = 0; row < codes.size(); ++row) {
    column.exceptions.emplace_back(row, static_cast<std::uint32_t>(codes[row]));
  }
  return column;
}

CsvColumn TakeRows(const CsvColumn& column,
                   const std::vector<std::ptrdiff_t>& rows) {
  CsvColumn taken{.name = column.name, .has_name = column.has_name};
  taken.values.reserve(rows.size());
  TextIndex index;
  const auto note = [&](std::ptrdiff_t from, std::ptrdiff_t* first) {
    const auto at = static_cast<std::ptrdiff_t>(taken.values.size()) - 1;
    if (*first < 0 && from == rows[at]) *first = at;
  };
  for (const std::ptrdiff_t row : rows) {
    const double value = row < 0 ? std::nan("") : column.values[row];
    if (std::isnan(value)) {
      AddText(
          row < 0 ? std::string_view() : *column.TextAt(row), &index, &taken);
      continue;
    }
    taken.values.push_back(value);
    note(column.first_decimal_comma, &taken.first_decimal_comma);
    note(column.first_decimal_point, &taken.first_decimal_point);
  }
  return taken;
}

CsvTable TakeRows(const CsvTable& table,
                  const std::vector<std::ptrdiff_t>& rows) {
  CsvTable taken{.file = table.file,
                 .num_rows = rows.size(),
                 .titles = table.titles,
                 .remarks = table.remarks};
  for (const CsvColumn& column : table.columns) {
    taken.columns.push_back(TakeRows(column, rows));
  }
  for (std::size_t i = 0; !table.line_runs.empty() && i < rows.size(); ++i) {
    taken.line_runs.emplace_back(
        i, table.LineOfRow(static_cast<std::size_t>(rows[i])));
  }
  return taken;
}

void AppendCells(const CsvColumn& more, CsvColumn* column) {
  const std::size_t rows = column->values.size();
  TextIndex index;
  std::vector<std::uint32_t> place;  // of each text of `more`
  for (const std::string& text : more.texts) {
    place.push_back(index.IndexOf(text, &column->texts));
  }
  for (const double value : more.values) column->values.push_back(value);
  for (const auto& [row, text] : more.exceptions) {
    column->exceptions.emplace_back(rows + row, place[text]);
  }
  for (const auto first :
       {&CsvColumn::first_decimal_comma, &CsvColumn::first_decimal_point}) {
    if (column->*first >= 0 || more.*first < 0) continue;
    column->*first = static_cast<std::ptrdiff_t>(rows) + more.*first;
  }
}

void DropUnusedTexts(CsvColumn* column) {
  constexpr std::uint32_t kUnused = 0xFFFFFFFFU;
  std::vector<std::uint32_t> place(column->texts.size(), kUnused);
  std::vector<std::string> texts;
  for (auto& [row, text] : column->exceptions) {
    if (place[text] == kUnused) {
      place[text] = static_cast<std::uint32_t>(texts.size());
      texts.push_back(std::move(column->texts[text]));
    }
    text = place[text];
  }
  column->texts = std::move(texts);
}

LabelsOfRows LabelsOf(const CsvTable& table,
                      const CsvColumn& column,
                      const std::vector<std::ptrdiff_t>& rows,
                      std::size_t most) {
  LabelsOfRows found;
  TextIndex index;
  for (const std::ptrdiff_t row : rows) {
    found.codes.push_back(index.IndexOf(
        table.CellText(column, static_cast<std::size_t>(row)), &found.labels));
    if (found.labels.size() > most) break;
  }
  return found;
}

std::vector<std::ptrdiff_t> AllRows(std::size_t count) {
  std::vector<std::ptrdiff_t> rows(count);
  std::iota(rows.begin(), rows.end(), std::ptrdiff_t{0});
  return rows;
}

std::vector<std::ptrdiff_t> MarkedRows(const std::vector<bool>& marks) {
  std::vector<std::ptrdiff_t> rows;
  for (std::size_t row = 0; row < marks.size(); ++row) {
    if (marks[row]) rows.push_back(static_cast<std::ptrdiff_t>(row));
  }
  return rows;
}

std::vector<double> ValuesOf(const CsvColumn& column,
                             std::span<const std::ptrdiff_t> rows) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const std::ptrdiff_t row : rows) {
    values.push_back(column.values[row]);
  }
  return values;
}

std::vector<std::ptrdiff_t> PartsOfRows(
    const CsvTable& table, const std::vector<std::ptrdiff_t>& rows) {
  std::vector<std::ptrdiff_t> parts;
  auto next = table.parts.begin();
  for (const std::ptrdiff_t row : rows) {
    while (next != table.parts.end() && std::cmp_less_equal(next->first, row)) {
      ++next;
    }
    parts.push_back(next - table.parts.begin() - 1);
  }
  return parts;
}

std::vector<std::ptrdiff_t> RunStarts(
    const std::vector<std::ptrdiff_t>& codes) {
  std::vector<std::ptrdiff_t> starts;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (i == 0 || codes[i] != codes[i - 1]) {
      starts.push_back(static_cast<std::ptrdiff_t>(i));
    }
  }
  return starts;
}

std::string FreeName(const CsvTable& table, const std::string& name) {
  std::string free = name;
  for (int i = 2; table.Find(free) >= 0; ++i) {
    free = name + "_" + std::to_string(i);
  }
  return free;
}

}  // namespace errmap::data
