#include "cli/commands/studies/probe_table.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "cli/commands/data_arguments.h"
#include "cli/shell/terminal.h"
#include "data/text.h"
#include "models/promise/probe_study.h"
#include "models/report/number_text.h"
#include "models/report/wrap_text.h"

namespace errmap::cli {

void AddProbes(const study_file::StudyRun& run,
               const ProbeArguments& arguments,
               models::StudyRecord* record) {
  if (arguments.numbers.empty()) return;
  for (std::size_t i = 0; i < run.components.size(); ++i) {
    const models::ComponentStudy& component = run.components[i];
    if (!component.judgement.recommendation) continue;
    const std::size_t h = component.judgement.recommendation->holdout;
    const data::SessionLog* log = component.data.dataset.log().get();
    const bool in_rows = log != nullptr && log->time_unit == "rows";
    try {
      record->components[i].probes = models::MakeRecord(
          models::StudyProbes(component.data.dataset,
                              component.holdouts[h],
                              h,
                              component.study,
                              arguments.numbers,
                              in_rows ? 1.0 : arguments.spacing));
    } catch (const std::invalid_argument& error) {
      Say(fmt::format("--probes-per-session: {}", error.what()));
    }
  }
}

std::string ProbesText(const models::ComponentRecord& component) {
  constexpr double kMinute = 60.0;
  if (!component.probes) return "";
  const models::ProbesRecord& probes = *component.probes;
  double smallest = std::numeric_limits<double>::infinity();
  std::size_t widest = 0;
  for (const models::ProbedModelRecord& model : probes.models) {
    widest = std::max(widest, model.model.size());
    for (const double rmse : model.rmse) smallest = std::min(smallest, rmse);
  }
  const data::Unit unit = data::UnitOfSymbol(component.data.unit);
  const report::ErrorText error(unit, smallest);
  std::string text =
      "\n" +
      report::WrapText(
          fmt::format("RMSE ({}) on unseen sessions after probes of each, {} "
                      "apart from its first row on ({}; the same {} for every "
                      "number; zero: probes without a map)",
                      error.symbol(),
                      probes.time_unit == "s"
                          ? fmt::format("{:g} min", probes.spacing / kMinute)
                          : report::Count(
                                static_cast<long long>(probes.spacing), "row"),
                      probes.holdout,
                      report::Count(probes.scored_rows, "row")),
          OutputTerminal().text_columns()) +
      fmt::format("\n{:{}}", "probes", widest + 2);
  for (const std::int64_t number : probes.numbers) {
    text += fmt::format("{:>10}", number);
  }
  text += "\n";
  for (const models::ProbedModelRecord& model : probes.models) {
    text += fmt::format(
        "{:{}}", data::Printable(model.model, model.model.size()), widest + 2);
    for (const double rmse : model.rmse) {
      text += fmt::format("{:>10}", error(rmse));
    }
    text += "\n";
  }
  return text;
}

}  // namespace errmap::cli
