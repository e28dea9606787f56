#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/figures/figure_parts.h"
#include "data/text.h"

namespace errmap::report {
namespace {

constexpr std::size_t kNameLength = 24;

// "neighbours (every:3)", "unseen cycle (groups:5)".
std::string HoldoutLabel(const ReportView& view, const std::string& holdout) {
  return UnseenWords(view, holdout) + " (" + Shortened(holdout, kNameLength) +
         ")";
}

std::string GapWords(const ReportView& view,
                     const std::vector<std::string>& holdouts) {
  const ErrorText error = ErrorTextOf(view);
  std::vector<std::string> words;
  for (const ModelRecord* model : view.models) {
    std::vector<std::string> parts;
    for (const std::string& holdout : holdouts) {
      const double rmse = TestRmse(*model, holdout);
      if (std::isfinite(rmse)) {
        parts.push_back(fmt::format("{} {}", holdout, error.WithUnit(rmse)));
      }
    }
    if (!parts.empty()) {
      words.push_back(
          fmt::format("{}: {}", model->name, data::JoinWords(parts, ", ")));
    }
  }
  return fmt::format("Held-out error of each model. {}.",
                     data::JoinWords(words, "; "));
}

// Intervals of the errors under one hold-out, where results have them.
Series Intervals(const ReportView& view,
                 const std::vector<const ModelRecord*>& models,
                 const std::string& holdout,
                 const std::string& colour) {
  Series series{.mark = Mark::kSpan, .colour = colour, .size = 1.6};
  for (std::size_t i = 0; i < models.size(); ++i) {
    const ResultRecord* result = ResultOf(*models[i], holdout);
    if (result == nullptr || !(result->ci95[0] > 0.0) ||
        !std::isfinite(result->ci95[1])) {
      continue;
    }
    series.Add({result->test.rmse * view.scale,
                static_cast<double>(i),
                result->ci95[0] * view.scale,
                result->ci95[1] * view.scale});
  }
  return series;
}

// Hold-outs as the picture lists them: the decisive one and those beside it.
std::vector<std::string> ShownHoldouts(const ReportView& view) {
  constexpr std::size_t kMost = 4;
  std::vector<std::string> shown;
  if (!view.decisive.empty()) shown.push_back(view.decisive);
  if (!view.neighbours.empty()) shown.push_back(view.neighbours);
  for (const std::string& holdout : view.holdouts) {
    if (std::find(shown.begin(), shown.end(), holdout) == shown.end() &&
        shown.size() < kMost) {
      shown.push_back(holdout);
    }
  }
  return shown;
}

// What stands on an axis.
struct Span {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;

  void Take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// A mark per model and hold-out, with intervals for the first, which decides.
std::vector<Series> HoldoutMarks(const ReportView& view,
                                 const std::vector<const ModelRecord*>& models,
                                 const std::vector<std::string>& holdouts,
                                 Span* span) {
  constexpr std::array kShapes = {
      Shape::kDot, Shape::kCircle, Shape::kSquare, Shape::kDiamond};
  constexpr std::array kHoldoutColours = {kVermillion, kBlue, kGreen, kPurple};
  std::vector<Series> marks;
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    Series points{.label = HoldoutLabel(view, holdouts[h]),
                  .mark = Mark::kPoints,
                  .colour = kHoldoutColours[h],
                  .size = 2.1,
                  .shape = kShapes[h],
                  .on_top = h == 0};
    for (std::size_t i = 0; i < models.size(); ++i) {
      const double rmse = TestRmse(*models[i], holdouts[h]) * view.scale;
      points.Add({rmse > 0.0 ? rmse : kAutomatic, static_cast<double>(i)});
      points.hints.push_back(fmt::format(
          "{}: {}, {}", models[i]->name, Amount(rmse, view), points.label));
      if (rmse > 0.0) span->Take(rmse);
    }
    if (h == 0) {
      Series bars = Intervals(view, models, holdouts[h], kHoldoutColours[h]);
      for (const double end : bars.columns[2]) {
        span->low = std::min(span->low, end);
      }
      for (const double end : bars.columns[3]) {
        span->high = std::max(span->high, end);
      }
      marks.push_back(std::move(bars));
    }
    marks.push_back(std::move(points));
  }
  return marks;
}

// A thin line joins what belongs to one model.
Series LinksOf(const ReportView& view,
               const std::vector<const ModelRecord*>& models,
               const std::vector<std::string>& holdouts) {
  Series links{.mark = Mark::kLine, .colour = "#AAAAAA"};
  for (std::size_t i = 0; i < models.size(); ++i) {
    for (const std::string& holdout : holdouts) {
      links.Add(
          {TestRmse(*models[i], holdout) * view.scale, static_cast<double>(i)});
    }
    links.Add({kAutomatic, kAutomatic});
  }
  return links;
}

}  // namespace

Figure GapFigure(const ReportView& view, const std::string& prefix) {
  Figure figure;
  figure.place = FigurePlace::kAnswer;
  figure.title = "Error on unseen rows, by model";
  figure.plot.name = prefix + "gap";
  std::vector<const ModelRecord*> models;
  for (const ModelRecord* model : view.models) {
    if (std::ranges::any_of(view.holdouts, [&](const std::string& holdout) {
          return std::isfinite(TestRmse(*model, holdout));
        })) {
      models.push_back(model);
    }
  }
  if (models.empty()) {
    figure.missing = "No model has an error on held-out rows.";
    return figure;
  }
  // The others are in the table; what no map does stays.
  constexpr std::size_t kMostModels = 12;
  const bool leaves_out = models.size() > kMostModels;
  if (leaves_out) {
    std::stable_partition(
        models.begin() + kMostModels - 2, models.end(), [&](const auto* model) {
          return model->name == view.recommended || model->name == "zero";
        });
    models.resize(kMostModels);
    std::ranges::stable_sort(models, {}, [&](const ModelRecord* model) {
      return PlaceOf(view, *model);
    });
  }
  const std::vector<std::string> holdouts = ShownHoldouts(view);
  Plot& plot = figure.plot;
  Span span;
  std::vector<Series> marks = HoldoutMarks(view, models, holdouts, &span);
  const bool has_bars =
      !holdouts.empty() && !marks.front().columns.front().empty();
  plot.series.push_back(LinksOf(view, models, holdouts));
  for (Series& series : marks) plot.series.push_back(std::move(series));
  const double goal = view.component->goal * view.scale;
  if (std::isfinite(goal)) {
    plot.series.push_back(
        AcrossRows(WithSymbol(fmt::format("goal {:g}", goal), view.shown_unit),
                   goal,
                   models.size()));
  }
  if (goal > 0.0 && SpansDecades(span.low, span.high)) span.Take(goal);
  plot.x = HeldOutErrorAxis(view, span.low, span.high);
  std::vector<std::string> names;
  for (const ModelRecord* model : models) {
    names.push_back(Shortened(model->name, kNameLength));
  }
  NameRows(names, "model", &plot);
  plot.width = 440;
  constexpr int kFrame = 60;
  constexpr int kRow = 25;
  constexpr int kMost = 520;
  constexpr int kLeast = 240;
  plot.height = std::clamp(
      kFrame + kRow * static_cast<int>(models.size()), kLeast, kMost);
  figure.note =
      view.decisive_is_unseen
          ? "The orange dot counts. An open dot far to its left looks too "
            "good, since the map knew neighbouring rows."
          : "Further left is better.";
  if (has_bars) figure.note += " Bars: 95 % intervals.";
  if (holdouts.size() > 2) figure.note += " Other marks: other hold-outs.";
  if (leaves_out) figure.note += " The table has all maps.";
  figure.description = GapWords(view, holdouts);
  return figure;
}

std::vector<Figure> TrainingFigures(const ReportView& view,
                                    const std::string& prefix) {
  std::vector<Figure> figures;
  std::vector<const ModelRecord*> iterated;
  for (const ModelRecord* model : view.models) {
    if (model->final && model->final->summary.value.trace &&
        !model->final->summary.value.trace->empty()) {
      iterated.push_back(model);
    }
  }
  for (std::size_t first = 0; first < iterated.size();
       first += kLineColours.size()) {
    Figure figure;
    figure.place = FigurePlace::kFits;
    figure.title = "Error against iteration";
    figure.note =
        "The fit to all rows; sqrt(2 E) of the scaled target, penalty "
        "included, as the report's Figures 10 to 24.";
    figure.plot.name =
        fmt::format("{}training-{}", prefix, 1 + first / kLineColours.size());
    figure.plot.x = {.quantity = "iteration"};
    figure.plot.y.quantity = "sqrt(2 E), scaled";
    figure.plot.y.logarithmic = true;
    std::vector<std::string> words;
    for (std::size_t i = first;
         i < std::min(iterated.size(), first + kLineColours.size());
         ++i) {
      Series series{.label = Shortened(iterated[i]->name, 34),
                    .mark = Mark::kLine,
                    .colour = kLineColours[i - first],
                    .size = 1.8};
      for (const auto& [iteration, rms, gradient] :
           *iterated[i]->final->summary.value.trace) {
        series.Add(
            {static_cast<double>(iteration), rms > 0.0 ? rms : kAutomatic});
      }
      const auto& y = series.columns[1];
      words.push_back(fmt::format("{} from {:.3g} to {:.3g} in {:.0f} steps",
                                  iterated[i]->name,
                                  y.front(),
                                  y.back(),
                                  series.columns[0].back()));
      figure.plot.series.push_back(std::move(series));
    }
    figure.description =
        fmt::format("Falling error curves: {}.", data::JoinWords(words, "; "));
    figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace errmap::report
