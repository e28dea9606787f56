#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/figures/figure_parts.h"
#include "cli/report/figures/figures.h"
#include "cli/report/learning_words.h"
#include "data/text.h"

namespace errmap::report {
namespace {

void AddCurve(const std::string& label,
              const char* colour,
              std::vector<std::vector<double>> columns,
              Plot* plot) {
  Series line{.label = label,
              .mark = Mark::kLine,
              .columns = std::move(columns),
              .colour = colour,
              .size = 1.8};
  Series dots{.mark = Mark::kPoints,
              .columns = line.columns,
              .colour = colour,
              .size = 1.6};
  plot->series.push_back(std::move(line));
  plot->series.push_back(std::move(dots));
}

// A level across the whole picture.
void AddLevel(const std::string& label, double level, double last, Plot* plot) {
  plot->series.push_back({.label = label,
                          .mark = Mark::kLine,
                          .columns = {{0.0, last}, {level, level}},
                          .colour = kBlack,
                          .size = 1.5,
                          .dashed = true});
}

Figure CurvesFigure(const models::LearningCurvesRecord& curves,
                    const data::Unit& unit,
                    const std::string& prefix) {
  Figure figure;
  figure.place = FigurePlace::kSensors;
  figure.title = fmt::format("What each further {} would bring", curves.unit);
  Plot& plot = figure.plot;
  plot.name = prefix + "learning-curve";
  plot.x = {.quantity = curves.unit + "s learnt from", .low = 0.0};
  plot.y = {.quantity = "RMSE on an unseen " + curves.unit,
            .unit = unit.display_symbol,
            .low = 0.0};
  const ErrorText error = ErrorTextOf(curves, unit);
  std::vector<std::string> words;
  std::vector<std::string> told;
  for (std::size_t i = 0; i < curves.models.size(); ++i) {
    const models::LearningModelRecord& model = curves.models[i];
    std::vector<std::vector<double>> columns(2);
    std::vector<std::string> of_model;
    for (const models::LearningPointRecord& point : model.points) {
      columns[0].push_back(static_cast<double>(point.units));
      columns[1].push_back(unit.display_scale * point.rmse);
      of_model.push_back(
          fmt::format("{} from {}", error.WithUnit(point.rmse), point.units));
    }
    if (of_model.empty()) continue;
    told.push_back(
        fmt::format("{}: {}", model.model, data::JoinWords(of_model, ", ")));
    const std::string law = LawWords(curves, model, error);
    if (!law.empty()) words.push_back(model.model + ": " + law + ".");
    AddCurve(Shortened(model.model, 34),
             kLineColours[i % kLineColours.size()],
             std::move(columns),
             &plot);
  }
  if (std::isfinite(curves.goal)) {
    AddLevel("goal " + error.WithUnit(curves.goal),
             unit.display_scale * curves.goal,
             static_cast<double>(curves.units),
             &plot);
  }
  figure.note = data::JoinWords(words, " ");
  figure.description =
      fmt::format("Held-out error against the number of {} learnt from. {}.",
                  curves.unit,
                  data::JoinWords(told, "; "));
  return figure;
}

Figure SensorsFigure(const models::SensorCurve& curve,
                     const data::Unit& unit,
                     const std::string& prefix) {
  Figure figure;
  figure.place = FigurePlace::kSensors;
  figure.title = "What fewer sensors would do";
  Plot& plot = figure.plot;
  plot.name = prefix + "sensor-curve";
  plot.x = {.quantity = "sensors", .low = 0.0};
  plot.y = {
      .quantity = "RMSE held out", .unit = unit.display_symbol, .low = 0.0};
  const ErrorText error = ErrorTextOf(curve, unit);
  std::vector<std::vector<double>> columns(2);
  std::vector<std::string> told;
  for (const models::SensorCurve::Point& point : curve.points) {
    columns[0].push_back(static_cast<double>(point.sensors));
    columns[1].push_back(unit.display_scale * point.rmse);
    told.push_back(
        fmt::format("{} with {}", error.WithUnit(point.rmse), point.sensors));
  }
  const double last = columns[0].empty() ? 1.0 : columns[0].back();
  AddCurve("chosen", kBlue, std::move(columns), &plot);
  AddLevel(fmt::format("all {}", curve.all.sensors),
           unit.display_scale * curve.all.rmse,
           last,
           &plot);
  figure.note = SensorWords(curve, error) +
                " By a map linear in each sensor, chosen inside the folds.";
  figure.description = fmt::format(
      "Held-out error against the number of sensors: {}; {} with "
      "all {}.",
      data::JoinWords(told, ", "),
      error.WithUnit(curve.all.rmse),
      curve.all.sensors);
  return figure;
}

bool IsOf(const models::LearningRecord& learnt,
          const ComponentRecord& component) {
  if (!learnt.provenance || component.data.sha256.empty() ||
      learnt.target != component.data.target) {
    return false;
  }
  return std::ranges::find(learnt.provenance->inputs,
                           component.data.sha256,
                           &models::InputFileRecord::sha256) !=
         learnt.provenance->inputs.end();
}

}  // namespace

std::vector<Figure> LearningFigures(const models::LearningRecord& learnt,
                                    const std::string& prefix) {
  data::Unit unit = data::UnitOfSymbol(learnt.unit);
  unit.display_symbol = PrettyUnit(unit.display_symbol);
  std::vector<Figure> figures;
  if (learnt.curves) {
    figures.push_back(CurvesFigure(*learnt.curves, unit, prefix));
  }
  if (learnt.sensors) {
    figures.push_back(SensorsFigure(*learnt.sensors, unit, prefix));
  }
  std::erase_if(figures,
                [](const Figure& figure) { return !HasPoints(figure.plot); });
  return figures;
}

void AddLearning(const models::StudyRecord& record,
                 const std::vector<models::LearningRecord>& learnt,
                 FigureSet* figures) {
  for (std::size_t l = 0; l < learnt.size(); ++l) {
    std::size_t of = 0;
    std::size_t matches = 0;
    for (std::size_t i = 0; i < record.components.size(); ++i) {
      if (!IsOf(learnt[l], record.components[i])) continue;
      of = i;
      ++matches;
    }
    if (matches != 1) continue;
    auto& list = figures->components[of].figures;
    // Beside the importance of its sensors.
    auto at = std::ranges::find(list, FigurePlace::kSensors, &Figure::place);
    if (at != list.end()) ++at;
    for (Figure& figure :
         LearningFigures(learnt[l], fmt::format("c{}-{}-", of + 1, l + 1))) {
      at = std::next(list.insert(at, std::move(figure)));
    }
  }
}

}  // namespace errmap::report
