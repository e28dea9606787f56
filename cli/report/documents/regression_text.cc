#include "cli/report/documents/regression_text.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/table.h"
#include "cli/report/tables/regression_tables.h"
#include "cli/report/wrap_text.h"
#include "data/text.h"
#include "models/study/record/making/parts.h"

namespace errmap::report {
namespace {

std::string Paragraph(const std::string& text, const Terminal& room) {
  if (text.empty()) return "";
  return WrapText(data::Printable(text, text.size()), room.text_columns()) +
         "\n";
}

// Takes the last columns off until the lines fit; returns their names.
std::vector<std::string> TakeColumns(std::size_t width, Table* table) {
  std::vector<std::string> taken;
  const auto widest = [&] {
    std::size_t most = 0;
    for (const std::string& line : TerminalLines(*table, std::string::npos)) {
      most = std::max(most, WidthOf(line));
    }
    return most;
  };
  while (table->columns.size() > 2 && widest() > width) {
    const std::string& name = table->columns.back().name;
    taken.insert(taken.begin(), data::Printable(name, name.size()));
    table->columns.pop_back();
    for (std::vector<Cell>& row : table->rows) {
      if (row.size() > table->columns.size()) row.pop_back();
    }
  }
  return taken;
}

// The title and as much of a table as there is room for: lines are not broken,
// and the terminal is not scrolled away. "" without rows.
std::string InRoom(const Table& whole, const Terminal& room) {
  Table table = WithoutEmptyColumns(whole);
  if (table.rows.empty()) return "";
  std::vector<std::string> more;
  if (room.rows > 0 && table.rows.size() > room.rows) {
    const auto hidden = static_cast<long long>(table.rows.size() - room.rows);
    more.push_back(Count(hidden, "more row"));
    table.rows.resize(room.rows);
  }
  const std::vector<std::string> taken = TakeColumns(room.columns, &table);
  if (!taken.empty()) more.push_back(data::JoinWords(taken, ", "));
  std::string text = table.title.empty() ? "" : table.title + "\n";
  text += TerminalTable(table, room.columns);
  if (!more.empty()) {
    text += Paragraph(data::JoinWords(more, "; ") + " with --details.", room);
  }
  return text + Paragraph(table.note, room) + "\n";
}

}  // namespace

std::string RegressionText(const models::RegressionRecord& record,
                           bool weighted,
                           const data::ColumnInfo& target,
                           const Terminal& room) {
  const models::LeastSquaresRecord fit =
      record.least_squares.value.value_or(models::LeastSquaresRecord());
  Table anova = AnovaTable(record);
  if (weighted) anova.title += " (weighted)";
  std::string text =
      "\n" + Paragraph(record.method, room) + "\n" +
      InRoom(StepTable(record), room) + InRoom(CoefficientTable(record), room) +
      InRoom(anova, room) +
      Paragraph(RegressionSummary(record, ErrorText(target.unit, fit.s)),
                room) +
      "\n" + InRoom(ExcludedTerms(record), room) +
      InRoom(AliasedTerms(record), room);
  for (const std::string& note : fit.notes) text += Paragraph(note, room);
  return text;
}

std::string CorrelationText(const data::Dataset& dataset,
                            const Terminal& room) {
  const models::CorrelationRecord correlations = models::Correlate(dataset);
  const std::vector<std::string>& names = correlations.columns;
  Table table{.nothing = ""};
  table.columns = {{"correlation", false}};
  for (const std::string& name : names) table.columns.push_back({name});
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<Cell>& row = table.rows.emplace_back();
    row.emplace_back(names[i]);
    for (std::size_t j = 0; j <= i; ++j) {
      row.emplace_back(Fixed{correlations.matrix[i][j], 4});
    }
  }
  return "\n" + InRoom(table, room);
}

}  // namespace errmap::report
