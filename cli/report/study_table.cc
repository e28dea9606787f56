#include "cli/report/study_table.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/verdict_text.h"
#include "cli/shell/number_text.h"
#include "cli/study_file/data_arguments.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

using models::HoldoutResult;
using models::ModelResult;

constexpr std::size_t kMostNameWidth = 44;
constexpr int kNumberWidth = 9;

// A long SPEC is cut in the table only; the footnotes and files have it whole.
std::string ShortName(const std::string& name) {
  if (name.size() <= kMostNameWidth) return name;
  return name.substr(0, kMostNameWidth - 3) + "...";
}

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

double FitSeconds(const ModelResult& model) {
  double seconds = model.final_fit_seconds;
  for (const HoldoutResult& result : model.holdouts) {
    for (const models::FoldResult& fold : result.folds) {
      seconds += fold.fit_seconds;
    }
  }
  return seconds;
}

// "net:scg: 7 of 7 fits ended without converging (iteration_limit 7)": such
// figures are usable, but another run length or start would give others.
std::string UnconvergedNote(const ModelResult& model) {
  std::map<std::string, int> reasons;
  int fits = 0;
  int unconverged = 0;
  const auto count = [&](const fitting::FitSummary& summary) {
    ++fits;
    if (summary.converged()) return;
    ++unconverged;
    ++reasons[std::string(fitting::ToString(summary.termination))];
  };
  for (const HoldoutResult& result : model.holdouts) {
    for (const models::FoldResult& fold : result.folds) count(fold.summary);
  }
  if (model.final_fit) count(model.final_fit->summary);
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

// "0.786-1.093", the 95 % interval of a held-out RMSE.
std::string IntervalText(const Comparison& comparison,
                         std::size_t model,
                         std::size_t h,
                         const ErrorText& error) {
  const models::HoldoutComparison& tests = comparison.judgement.comparisons[h];
  const stats::Bounds95& bounds =
      tests.tests.rmse_bounds[static_cast<std::size_t>(*tests.PlaceOf(model))];
  if (!bounds.exist()) return "-";
  return fmt::format(
      "{}-{}", error(std::max(0.0, bounds.lower)), error(bounds.upper));
}

// How many times its error among neighbours a model has on unseen groups.
std::string GapText(const Comparison& comparison, std::size_t model) {
  const auto& gap = comparison.judgement.gap;
  if (!gap) return "";
  for (const models::InterpolationGap::Row& row : gap->rows) {
    if (row.model != model) continue;
    constexpr double kLarge = 1000.0;
    return row.ratio() < kLarge ? fmt::format("{:.1f}", row.ratio())
                                : fmt::format("{:.0e}", row.ratio());
  }
  return "-";
}

// "sd": only the scatter is within it, so that it is met after re-zeroing.
std::string GoalMark(const Comparison& comparison, std::size_t index) {
  const auto& advice = comparison.judgement.recommendation;
  if (!advice) return "-";
  switch (comparison.judgement.goals[index][advice->holdout].standing) {
    case models::GoalStanding::kMet:
      return "yes";
    case models::GoalStanding::kMetAfterRezeroing:
      return "sd";
    case models::GoalStanding::kMissed:
      return "no";
    default:
      return "-";
  }
}

std::string SensorCount(const ModelResult& model) {
  return model.final_fit
             ? std::to_string(models::SensorsOf(*model.final_fit).size())
             : "-";
}

constexpr int kIntervalWidth = 14;
constexpr int kBlockWidth = 2 * kNumberWidth + kIntervalWidth + 5;

std::string Headings(const Comparison& comparison, std::size_t name_width) {
  // Two lines: the hold-outs, then the figures of each.
  std::string first = fmt::format("{:<{}} {:>6} {:>4}", "", name_width, "", "");
  std::string second =
      fmt::format("{:<{}} {:>6} {:>4}", "model", name_width, "params", "sens");
  for (const models::Holdout& holdout : comparison.holdouts) {
    first += fmt::format("  {:^{}}", holdout.name, kBlockWidth);
    second += fmt::format("  {:>{}}{:>{}} {:>{}} {:>4}",
                          "train",
                          kNumberWidth,
                          "test",
                          kNumberWidth,
                          "95 %",
                          kIntervalWidth,
                          "tier");
  }
  if (comparison.judgement.gap) {
    first += fmt::format(" {:>6}", "");
    second += fmt::format(" {:>6}", "gap");
  }
  if (std::isfinite(comparison.goal)) {
    first += fmt::format(" {:>5}", "");
    second += fmt::format(" {:>5}", "goal");
  }
  first += fmt::format(" {:>8} {:>8}", "fit", "predict");
  second += fmt::format(" {:>8} {:>8}", "s", "ns");
  return first + "\n" + second + "\n";
}

std::string RowText(const Comparison& comparison,
                    std::size_t index,
                    std::size_t name_width,
                    const ErrorText& error) {
  const ModelResult& model = comparison.study.models[index];
  std::string text = fmt::format(
      "{:<{}} {:>6} {:>4}",
      ShortName(model.name),
      name_width,
      model.final_fit ? std::to_string(model.final_fit->model->num_parameters())
                      : "-",
      SensorCount(model));
  for (std::size_t h = 0; h < model.holdouts.size(); ++h) {
    const HoldoutResult& result = model.holdouts[h];
    if (!result.ok()) {
      text += fmt::format("  {:^{}}", "failed", kBlockWidth);
      continue;
    }
    text += fmt::format("  {:>{}}{:>{}} {:>{}} {:>4}",
                        error(result.train.rmse),
                        kNumberWidth,
                        error(result.test.rmse),
                        kNumberWidth,
                        IntervalText(comparison, index, h, error),
                        kIntervalWidth,
                        comparison.judgement.comparisons[h].TierOf(index));
  }
  if (comparison.judgement.gap) {
    text += fmt::format(" {:>6}", GapText(comparison, index));
  }
  if (std::isfinite(comparison.goal)) {
    text += fmt::format(" {:>5}", GoalMark(comparison, index));
  }
  return text + fmt::format(" {:>8.3f} {:>8}\n",
                            FitSeconds(model),
                            std::isfinite(model.predict_ns)
                                ? fmt::format("{:.0f}", model.predict_ns)
                                : "-");
}

}  // namespace

std::string ComponentTable(const Comparison& comparison) {
  const ErrorText error = ErrorTextFor(comparison);
  std::size_t name_width = 5;
  for (const ModelResult& model : comparison.study.models) {
    name_width = std::max(name_width, ShortName(model.name).size());
  }
  std::string text = Header(comparison);
  text += fmt::format(
      "RMSE of target - predicted{}; models of one tier do not differ in "
      "practice\n{}\n\n",
      error.symbol().empty() ? "" : " in " + error.symbol(),
      kIntervalCoverage);
  text += Headings(comparison, name_width);
  std::string notes;
  for (std::size_t i = 0; i < comparison.study.models.size(); ++i) {
    const ModelResult& model = comparison.study.models[i];
    text += RowText(comparison, i, name_width, error);
    if (!model.ok()) {
      notes += fmt::format("{} failed, {}\n", model.name, model.why());
    }
    notes += UnconvergedNote(model);
    if (model.memorisation) notes += MemorisationSentence(model) + "\n";
  }
  return text + "\n" + notes + (notes.empty() ? "" : "\n") +
         VerdictParagraphs(comparison);
}

std::string StudyTable(const StudyRun& run) {
  std::string text;
  for (const Comparison& component : run.components) {
    if (run.has_several()) {
      text +=
          fmt::format("{}== {} ==\n",
                      text.empty() ? "" : "\n",
                      data::Printable(component.name, component.name.size()));
    }
    text += ComponentTable(component);
  }
  return text;
}

}  // namespace errmap::cli
