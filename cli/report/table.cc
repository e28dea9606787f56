#include "cli/report/table.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/report/html.h"
#include "cli/report/wrap_text.h"
#include "data/csv.h"
#include "data/formula_text.h"
#include "data/text.h"

namespace errmap::report {
namespace {

// What is known of a value in words, given how errors are written; "" where
// nothing is.
class Pen {
 public:
  explicit Pen(const Table& table) : error_(table.error) {}

  std::string operator()(std::monostate /*nothing*/) const { return ""; }
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(std::int64_t n) const { return std::to_string(n); }
  std::string operator()(const Word& word) const { return word.text; }
  std::string operator()(const Number& number) const {
    if (std::isnan(number.value)) return "";
    return fmt::format("{:.{}g}", number.value * number.scale, number.digits);
  }
  std::string operator()(const Fixed& fixed) const {
    constexpr double kTooLarge = 1e6;
    if (!std::isfinite(fixed.value)) return (*this)(Number{fixed.value});
    if (std::abs(fixed.value) >= kTooLarge) return (*this)(Number{fixed.value});
    const std::string text =
        fmt::format("{:.{}f}", fixed.value, fixed.decimals);
    // No minus before nothing.
    return text.find_first_of("123456789") == std::string::npos &&
                   text.starts_with('-')
               ? text.substr(1)
               : text;
  }
  std::string operator()(const Error& error) const {
    if (!error_) return (*this)(Number{error.value, 4, error.scale});
    return std::isfinite(error.value) ? (*error_)(error.value) : "";
  }
  std::string operator()(const Interval& interval) const {
    const auto& [low, high] = interval.ends;
    std::string of = (*this)(Error{interval.of});
    if (!std::isfinite(low) || !std::isfinite(high)) return of;
    const std::string from = (*this)(Error{low});
    const std::string to = (*this)(Error{high});
    return of.empty() ? fmt::format("{}-{}", from, to)
                      : fmt::format("{} ({} to {})", of, from, to);
  }
  std::string operator()(const P& p) const {
    return std::isnan(p.value) ? "" : PText(p.value) + p.remark;
  }
  std::string operator()(const Statistic& test) const {
    if (!std::isfinite(test.value)) return "";
    return fmt::format(
        "{:.4g} ({})", test.value, std::isnan(test.p) ? "-" : PText(test.p));
  }

 private:
  const std::optional<ErrorText>& error_;
};

// The number that a cell holds, in the data's own unit.
std::optional<double> NumberIn(const Cell& cell) {
  return std::visit(
      [](const auto& held) -> std::optional<double> {
        if constexpr (requires { held.value; }) {
          return held.value;
        } else {
          return std::nullopt;
        }
      },
      cell.value());
}

const Word* WordIn(const Cell& cell) {
  return std::get_if<Word>(&cell.value());
}

std::string Padded(const std::string& text, std::size_t width, bool right) {
  const std::string blanks(width - std::min(width, WidthOf(text)), ' ');
  return right ? blanks + text : text + blanks;
}

void EndLine(std::string* text) {
  text->erase(text->find_last_not_of(' ') + 1);
}

// Takes from the widest column of words what is too much; numbers stay whole.
void Squeeze(const Table& table,
             std::size_t width,
             std::vector<std::size_t>* widths) {
  constexpr std::size_t kLeast = 8;
  std::size_t all = 0;
  for (std::size_t i = 0; i < widths->size(); ++i) {
    all += (*widths)[i] + (i == 0 ? 0 : table.columns[i].gap);
  }
  while (all > width) {
    std::size_t* widest = nullptr;
    for (std::size_t i = 0; i < widths->size(); ++i) {
      if (i > 0 && table.columns[i].is_number) continue;
      if ((*widths)[i] > kLeast &&
          (widest == nullptr || (*widths)[i] > *widest)) {
        widest = &(*widths)[i];
      }
    }
    if (widest == nullptr) return;
    --*widest;
    --all;
  }
}

// Above the names: what columns have there, a group's once and centred.
std::string LineAbove(const Table& table,
                      const std::vector<std::size_t>& widths) {
  std::string line;
  for (std::size_t i = 0; i < widths.size();) {
    const Table::Column& first = table.columns[i];
    line += std::string(i == 0 ? 0 : first.gap, ' ');
    if (first.group.empty()) {
      line += Padded(first.above, widths[i], i > 0 && first.is_number);
      ++i;
      continue;
    }
    std::size_t width = widths[i];
    while (++i < widths.size() && table.columns[i].group == first.group) {
      width += table.columns[i].gap + widths[i];
    }
    line += fmt::format("{:^{}}", first.group, width);
  }
  EndLine(&line);
  return line;
}

}  // namespace

void Table::Add(std::vector<Named> row) {
  const bool is_first = columns.empty();
  std::vector<Cell>& cells = rows.emplace_back();
  for (Named& named : row) {
    if (is_first) columns.push_back(std::move(named.column));
    cells.push_back(std::move(named.cell));
  }
}

std::string Table::Shown(const Cell& cell) const {
  const std::string text = std::visit(Pen(*this), cell.value());
  const bool known = std::holds_alternative<std::string>(cell.value());
  return text.empty() && !known ? nothing : text;
}

Table WithoutEmptyColumns(Table table) {
  const auto is_empty = [&](std::size_t column) {
    return std::ranges::all_of(table.rows, [&](const std::vector<Cell>& row) {
      if (column >= row.size()) return true;
      const std::string shown = table.Shown(row[column]);
      return shown.empty() || shown == table.nothing;
    });
  };
  for (std::size_t column = table.columns.size();
       !table.rows.empty() && column-- > 1;) {
    if (!is_empty(column)) continue;
    const auto at = static_cast<std::ptrdiff_t>(column);
    table.columns.erase(table.columns.begin() + at);
    for (std::vector<Cell>& row : table.rows) {
      if (column < row.size()) row.erase(row.begin() + at);
    }
  }
  return table;
}

std::vector<std::string> TerminalLines(const Table& table, std::size_t width) {
  // A cell is one line, whatever a column of the data is called.
  const auto one_line = [](const std::string& text) {
    return data::Printable(text);
  };
  std::vector<std::vector<std::string>> lines(1);
  for (const Table::Column& column : table.columns) {
    lines.front().push_back(one_line(column.name));
  }
  for (const std::vector<Cell>& row : table.rows) {
    std::vector<std::string>& line = lines.emplace_back();
    for (const Cell& cell : row) {
      const Word* word = WordIn(cell);
      line.push_back(
          one_line(word != nullptr ? word->on_terminal : table.Shown(cell)));
    }
  }
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    widths.push_back(table.columns[i].width);
    for (const std::vector<std::string>& line : lines) {
      if (i < line.size()) widths[i] = std::max(widths[i], WidthOf(line[i]));
    }
  }
  Squeeze(table, width, &widths);
  std::vector<std::string> text;
  if (std::string above = LineAbove(table, widths); !above.empty()) {
    text.push_back(std::move(above));
  }
  for (const std::vector<std::string>& line : lines) {
    std::string& shown = text.emplace_back();
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Table::Column& column = table.columns[i];
      shown += std::string(i == 0 ? 0 : column.gap, ' ') +
               Padded(Squeezed(line[i], widths[i]),
                      widths[i],
                      i > 0 && column.is_number);
    }
    EndLine(&shown);
  }
  return text;
}

std::vector<std::string> TakeColumns(std::size_t width,
                                     std::size_t fewest,
                                     Table* table) {
  std::vector<std::string> taken;
  const auto is_wide = [&] {
    return std::ranges::any_of(
        TerminalLines(*table, std::string::npos),
        [&](const std::string& line) { return WidthOf(line) > width; });
  };
  while (table->columns.size() > fewest && is_wide()) {
    const std::string& name = table->columns.back().name;
    taken.insert(taken.begin(), data::Printable(name));
    table->columns.pop_back();
    for (std::vector<Cell>& row : table->rows) {
      if (row.size() > table->columns.size()) row.pop_back();
    }
  }
  return taken;
}

std::string TerminalTable(const Table& table, std::size_t width) {
  std::string text;
  for (const std::string& line : TerminalLines(table, width)) {
    text += line + "\n";
  }
  return text;
}

std::string CsvTable(const Table& table) {
  std::string text;
  for (const Table::Column& column : table.columns) {
    text += (text.empty() ? "" : ",") + column.name;
  }
  text += "\n";
  for (const std::vector<Cell>& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const Word* word = WordIn(row[i]);
      const std::optional<double> number = NumberIn(row[i]);
      text += i == 0 ? "" : ",";
      text += number            ? data::CsvNumber(*number)
              : word != nullptr ? data::CsvField(word->in_csv)
                                : data::CsvField(table.Shown(row[i]));
    }
    text += "\n";
  }
  return data::MarkedCsv(std::move(text));
}

std::string MarkdownTable(const Table& whole, const std::string& level) {
  const Table table = WithoutEmptyColumns(whole);
  std::string text =
      table.title.empty()
          ? ""
          : fmt::format("{} {}\n\n", level, MarkdownText(table.title));
  if (!table.missing.empty()) {
    return text + MarkdownText(table.missing) + "\n\n";
  }
  text += "|";
  std::string rule = "|";
  for (const Table::Column& column : table.columns) {
    text += " " + MarkdownText(column.name) + " |";
    rule += column.is_number ? "---:|" : "---|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    text += "|";
    for (const Cell& cell : table.rows[i]) {
      const std::string shown = MarkdownText(table.Shown(cell));
      const bool strong = i == table.marked && !shown.empty();
      text += strong ? " **" + shown + "** |" : " " + shown + " |";
    }
    text += "\n";
  }
  if (table.title.empty()) return text;
  return text + "\n" +
         (table.note.empty() ? "" : MarkdownText(table.note) + "\n\n");
}

std::string HtmlTable(const Table& whole) {
  // What does not apply is left out of a page.
  if (!whole.missing.empty()) return "";
  const Table table = WithoutEmptyColumns(whole);
  std::string html = "<thead><tr>";
  for (const Table::Column& column : table.columns) {
    html += fmt::format("<th scope=\"col\"{}>{}{}</th>",
                        column.is_number ? "" : " class=\"t\"",
                        HtmlName(column.name),
                        column.explanation.empty()
                            ? ""
                            : fmt::format("<br><span class=\"soft\">{}</span>",
                                          HtmlText(column.explanation)));
  }
  html += "</tr></thead><tbody>\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    html += i == table.marked ? "<tr class=\"mark\">" : "<tr>";
    for (std::size_t j = 0; j < table.rows[i].size(); ++j) {
      constexpr std::size_t kLong = 36;
      const std::string shown = table.Shown(table.rows[i][j]);
      html += table.columns[j].is_number ? "<td>" + HtmlText(shown)
              : shown.size() > kLong ? "<td class=\"t long\">" + HtmlName(shown)
                                     : "<td class=\"t\">" + HtmlName(shown);
      html += "</td>";
    }
    html += "</tr>\n";
  }
  html = ScrolledTable(table.title, html + "</tbody>") + "\n";
  if (!table.title.empty()) {
    html = "<h4>" + HtmlText(table.title) + "</h4>\n" + html;
  }
  if (table.note.empty()) return html;
  return html + "<p class=\"soft small\">" + HtmlText(table.note) + "</p>\n";
}

const std::vector<TableFormat>& TableFormats() {
  static const std::vector<TableFormat> formats{
      {"csv", &CsvTable},
      {"md", [](const Table& table) { return MarkdownTable(table); }}};
  return formats;
}

std::optional<std::string> TableText(const Table& table,
                                     std::string_view format) {
  const auto& formats = TableFormats();
  const auto found = std::ranges::find(formats, format, &TableFormat::name);
  if (found == formats.end()) return std::nullopt;
  return found->text(table);
}

}  // namespace errmap::report
