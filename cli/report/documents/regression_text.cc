#include "cli/report/documents/regression_text.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "cli/report/table.h"
#include "cli/report/tables/regression_tables.h"
#include "cli/report/wrap_text.h"
#include "data/text.h"
#include "models/study/record/making/fit_blocks.h"
#include "models/study/record/making/make_figure_record.h"

namespace errmap::report {
namespace {

std::string Paragraph(const std::string& text, const Terminal& room) {
  if (text.empty()) return "";
  return WrapText(data::Printable(text, text.size()), room.text_columns()) +
         "\n";
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
  const std::vector<std::string> taken = TakeColumns(room.columns, 2, &table);
  if (!taken.empty()) more.push_back(data::JoinWords(taken, ", "));
  std::string text = table.title.empty() ? "" : table.title + "\n";
  text += TerminalTable(table, room.columns);
  if (!more.empty()) {
    text += Paragraph(data::JoinWords(more, "; ") + " with --details.", room);
  }
  return text + Paragraph(table.note, room) + "\n";
}

}  // namespace

std::string RegressionText(const models::RegressionReport& report,
                           const data::ColumnInfo& target,
                           const Terminal& room) {
  const models::RegressionRecord record = models::MakeRecord(report);
  Table anova = AnovaTable(record);
  if (report.weighted) anova.title += " (weighted)";
  std::string text =
      "\n" + Paragraph(record.method, room) + "\n" +
      InRoom(StepTable(record), room) + InRoom(CoefficientTable(record), room) +
      InRoom(anova, room) +
      Paragraph(RegressionSummary(record, ErrorText(target.unit, report.fit.s)),
                room) +
      "\n" + InRoom(ExcludedTerms(record), room) +
      InRoom(AliasedTerms(record), room);
  for (const std::string& note : report.notes) text += Paragraph(note, room);
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
