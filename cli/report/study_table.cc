#include "cli/report/study_table.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/machine_tables.h"
#include "cli/report/result_table.h"
#include "cli/report/verdict_text.h"
#include "cli/shell/number_text.h"
#include "cli/study_file/data_arguments.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

std::string Header(const Comparison& comparison) {
  const data::Dataset& dataset = comparison.data.dataset;
  constexpr std::size_t kMostInputsNamed = 6;
  std::vector<std::string> inputs;
  for (const data::ColumnInfo& input : dataset.inputs()) {
    inputs.push_back(input.name);
  }
  const std::size_t more =
      inputs.size() - std::min(inputs.size(), kMostInputsNamed);
  inputs.resize(inputs.size() - more);
  return fmt::format(
      "{}: {}{}\ntarget {} from {}{}\n",
      comparison.file,
      Count(dataset.num_rows(), "row"),
      UnitsText(dataset),
      TargetText(dataset),
      inputs.empty() ? "no inputs" : fmt::format("{}", fmt::join(inputs, ", ")),
      more > 0 ? fmt::format(" and {} more", more) : "");
}

// "net:scg: 7 of 7 fits ended without converging (iteration_limit 7)": such
// figures are usable, but another run length or start would give others.
std::string UnconvergedNote(const ModelRecord& model) {
  std::map<std::string, int> reasons;
  int fits = 0;
  int unconverged = 0;
  const auto count = [&](const models::FitRecord& fit) {
    ++fits;
    if (fit.summary.value.converged) return;
    ++unconverged;
    ++reasons[std::string(fitting::ToString(fit.summary.value.stop))];
  };
  for (const auto& [holdout, result] : model.results) {
    for (const models::FoldRecord& fold : result.folds) count(fold.fit.value);
  }
  if (model.final) count(*model.final);
  if (unconverged == 0) return "";
  std::vector<std::string> parts;
  for (const auto& [reason, times] : reasons) {
    parts.push_back(fmt::format("{} {}", reason, times));
  }
  return fmt::format("{}: {} of {} ended without converging ({})\n",
                     model.name,
                     unconverged,
                     Count(fits, "fit"),
                     fmt::join(parts, ", "));
}

std::string ComponentTable(const Comparison& comparison,
                           const models::ComponentRecord& record) {
  const std::string symbol = ErrorTextOf(record).symbol();
  std::string notes;
  for (const ModelRecord& model : record.models) {
    if (model.why) {
      notes += fmt::format("{} failed, {}\n", model.name, *model.why);
    }
    notes += UnconvergedNote(model);
    if (model.memorisation) notes += model.memorisation->sentence + "\n";
  }
  return fmt::format(
      "{}RMSE of target - predicted{}; models of one tier do not differ in "
      "practice\n{}\n\n{}\n{}{}{}",
      Header(comparison),
      symbol.empty() ? "" : " in " + symbol,
      kIntervalCoverage,
      TerminalTable(TerminalLeaderboard(record)),
      notes,
      notes.empty() ? "" : "\n",
      VerdictParagraphs(record));
}

}  // namespace

std::string StudyTable(const StudyRun& run, const models::StudyRecord& record) {
  std::string text;
  for (std::size_t i = 0; i < run.components.size(); ++i) {
    const Comparison& component = run.components[i];
    if (run.has_several()) {
      text +=
          fmt::format("{}== {} ==\n",
                      text.empty() ? "" : "\n",
                      data::Printable(component.name, component.name.size()));
    }
    text += ComponentTable(component, record.components[i]);
  }
  if (record.machine) {
    for (const Table& table :
         {ToolTipTable(*record.machine), PositioningTable(*record.machine)}) {
      if (table.rows.empty()) continue;
      text += "\n" + table.title + "\n\n" + TerminalTable(table);
    }
  }
  return text;
}

}  // namespace errmap::cli
