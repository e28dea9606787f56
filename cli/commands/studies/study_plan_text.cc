#include <cmath>

#include <fmt/format.h>

#include "cli/commands/studies/compare_arguments.h"
#include "cli/report/number_text.h"
#include "cli/report/text/answers/data_words.h"
#include "cli/report/wrap_text.h"
#include "cli/study_setup/plan/study_forecast.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

std::string InUnit(double value, const data::Unit& unit) {
  return report::WithSymbol(fmt::format("{:g}", value * unit.display_scale),
                            unit.display_symbol);
}

// "every:3 (1 fold), groups:5 (5 folds)"
std::string HoldoutList(const std::vector<models::Holdout>& holdouts) {
  std::vector<std::string> parts;
  for (const models::Holdout& holdout : holdouts) {
    parts.push_back(
        fmt::format("{} ({})",
                    data::Printable(holdout.name),
                    report::Count(std::ssize(holdout.folds), "fold")));
  }
  return data::JoinWords(parts, ", ");
}

// "  hold-outs every:3 (1 fold), ...", what follows below its beginning.
std::string ListLine(const char* what, const std::string& list) {
  constexpr std::size_t kWidth = 78;
  return report::Hanging(fmt::format("  {:<10}", what), list, kWidth);
}

std::string ComponentText(const models::ComponentPlan& component,
                          const study_setup::ComponentConfig& config) {
  const data::Dataset& dataset = component.comparison.data.dataset;
  std::vector<std::string> models;
  for (const auto& recipe : component.recipes) {
    models.push_back(data::Printable(recipe->name()));
  }
  std::string text =
      fmt::format("component {}\n", data::Printable(config.name));
  text += "  data      " +
          data::Printable(study_setup::ShownNames(config.AllData()));
  for (const data::ColumnFilter& filter : config.selection.where) {
    text += fmt::format(" where {} = {}",
                        data::Printable(filter.column),
                        data::Printable(ValueText(filter)));
  }
  text += fmt::format("\n  rows      {}{}\n",
                      report::Count(dataset.num_rows(), "row"),
                      data::Printable(report::UnitsWords(dataset)));
  text += fmt::format("  target    {}\n",
                      data::Printable(report::TargetWords(dataset)));
  text += fmt::format("  inputs    {}\n", dataset.num_inputs());
  if (std::isfinite(component.comparison.goal)) {
    text +=
        fmt::format("  goal      {}\n",
                    InUnit(component.comparison.goal, dataset.target().unit));
  }
  text += ListLine("hold-outs", HoldoutList(component.comparison.holdouts));
  text += ListLine("models", data::JoinWords(models, ", "));
  text += fmt::format("  fits      {}\n", component.num_fits());
  return text;
}

double SecondsOf(const study_setup::StudyPlan& plan, int jobs) {
  double seconds = 0.0;
  for (const models::ComponentPlan& component : plan.components) {
    seconds += study_setup::RoughSeconds(component, jobs);
  }
  return seconds;
}

}  // namespace

std::string PlanText(const study_setup::StudyPlan& plan,
                     int jobs,
                     const std::string& out) {
  std::string text;
  for (std::size_t i = 0; i < plan.components.size(); ++i) {
    text += ComponentText(plan.components[i], plan.config.components[i]) + "\n";
  }
  text += fmt::format("{} in all, seed {}; roughly {} on {}\n",
                      report::Count(plan.num_fits(), "fit"),
                      plan.config.seed,
                      study_setup::RoughTimeText(SecondsOf(plan, jobs)),
                      report::Count(jobs, "job"));
  if (out.empty()) {
    text += "no files (give --out DIR for them)\n";
  } else {
    text += fmt::format("files in {}: {}\n",
                        data::Printable(out),
                        plan.components.size() > 1
                            ? "results.json, residuals/COMPONENT.csv, "
                              "models/COMPONENT/MODEL.json"
                            : "results.json, residuals.csv, models/MODEL.json");
  }
  return text + "Nothing was fitted or written (--dry-run).\n";
}

std::vector<std::string> LongRunLines(const study_setup::StudyPlan& plan,
                                      int jobs,
                                      bool chosen) {
  constexpr double kLong = 30.0;
  const double seconds = SecondsOf(plan, jobs);
  if (seconds < kLong) return {};
  std::vector<std::string> lines = {
      fmt::format("this takes about {} on {}",
                  study_setup::RoughTimeText(seconds),
                  report::Count(jobs, "job"))};
  const study_setup::FasterModels faster = study_setup::FasterModelsOf(plan);
  if (!chosen && !faster.names.empty()) {
    lines.push_back(
        fmt::format("about {} without the slowest: --models {}",
                    study_setup::RoughTimeText(faster.seconds / jobs),
                    data::Printable(data::JoinWords(faster.names, ","))));
  }
  return lines;
}

}  // namespace errmap::cli
