#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/figures/figure_parts.h"
#include "data/text.h"

namespace errmap::report {
namespace {

constexpr std::size_t kMostAlone = 12;
constexpr std::size_t kMostTogether = 5;

using Without = models::SensorImportance::Without;

// "all 27 sensors", "t1 and 3 alike", "t1".
std::string Label(const Without& without, std::size_t all) {
  constexpr std::size_t kMost = 30;
  constexpr std::size_t kRoomBeside = 12;
  const std::vector<std::string>& sensors = without.sensors;
  if (sensors.size() == 1) return Shortened(sensors.front(), kMost);
  if (sensors.empty()) return "";  // of an incomplete record
  if (sensors.size() == all) return fmt::format("all {} sensors", all);
  return fmt::format("{} and {} alike",
                     Shortened(sensors.front(), kMost - kRoomBeside),
                     sensors.size() - 1);
}

// One row of the picture: from the error with every sensor to that without.
void AddRow(const ReportView& view,
            const models::SensorImportance& importance,
            const Without& without,
            bool together,
            std::vector<std::string>* names,
            Plot* plot) {
  const auto row = static_cast<double>(names->size());
  names->push_back(Label(without, importance.one_by_one.size()));
  const double with = importance.rmse * view.scale;
  const double left = without.rmse * view.scale;
  Series& line = plot->series[together ? 0 : 1];
  line.Add({left, row, std::min(with, left), std::max(with, left)});
  Series& dot = plot->series[together ? 2 : 3];
  dot.Add({left, row});
}

Series Lines(const char* colour) {
  return {.mark = Mark::kSpan, .colour = colour, .size = 3.0};
}

Series Dots(const char* label, const char* colour, Shape shape) {
  return {.label = label,
          .mark = Mark::kPoints,
          .colour = colour,
          .size = 2.1,
          .shape = shape};
}

std::string Words(const ErrorText& error, const Without& without) {
  return fmt::format("without {} {}",
                     data::JoinWords(without.sensors, ", "),
                     error.WithUnit(without.rmse));
}

std::string Note(const models::SensorImportance& importance) {
  std::string note =
      "The map is not fitted again: it reads an estimate from its other "
      "sensors.";
  if (!importance.together.empty()) {
    note += fmt::format(
        " Sensors that are alike (correlation {:g} or more) replace each "
        "other, so each one alone looks unnecessary.",
        importance.alike);
  }
  if (importance.one_by_one.size() > kMostAlone) {
    note += fmt::format(" {} more cost less than those shown.",
                        importance.one_by_one.size() - kMostAlone);
  }
  return note;
}

}  // namespace

std::vector<Figure> ImportanceFigures(const ReportView& view,
                                      const std::string& prefix) {
  const auto& advice = view.component->recommendation;
  if (!advice || !advice->importance) return {};
  const models::SensorImportance& importance = *advice->importance;
  if (importance.one_by_one.empty() || !std::isfinite(importance.rmse)) {
    return {};
  }
  Figure figure;
  figure.place = FigurePlace::kSensors;
  figure.title = "What the error would be without a sensor";
  figure.plot.name = prefix + "importance";
  Plot& plot = figure.plot;
  plot.series = {Lines(kVermillion),
                 Lines(kBlue),
                 Dots("several", kVermillion, Shape::kDiamond),
                 Dots("one sensor", kBlue, Shape::kDot)};
  std::vector<Without> together = importance.together;
  std::stable_sort(
      together.begin(), together.end(), [](const Without& a, const Without& b) {
        return a.rmse > b.rmse;
      });
  together.resize(std::min(together.size(), kMostTogether));
  std::vector<std::string> names;
  for (const Without& without : together) {
    AddRow(view, importance, without, true, &names, &plot);
  }
  for (std::size_t i = 0;
       i < std::min(importance.one_by_one.size(), kMostAlone);
       ++i) {
    AddRow(view, importance, importance.one_by_one[i], false, &names, &plot);
  }
  const ErrorText error = ErrorTextOf(view);
  plot.series.push_back(
      AcrossRows("every sensor: " + error.WithUnit(importance.rmse),
                 importance.rmse * view.scale,
                 names.size()));
  double low = importance.rmse;
  double high = importance.rmse;
  for (const auto* list : {&importance.one_by_one, &importance.together}) {
    for (const Without& without : *list) {
      low = std::min(low, without.rmse);
      high = std::max(high, without.rmse);
    }
  }
  // What all sensors bring may be many times what one of them does.
  plot.x = HeldOutErrorAxis(view, low * view.scale, high * view.scale);
  NameRows(names, "taken away", &plot);
  constexpr int kFrame = 60;
  constexpr int kRow = 19;
  constexpr int kLeast = 150;  // the words along the axis need it
  plot.height =
      std::max(kLeast, kFrame + kRow * static_cast<int>(names.size()));
  std::erase_if(plot.series, [](const Series& series) {
    return series.columns.front().empty();
  });
  figure.note = Note(importance);
  std::vector<std::string> words;
  for (const Without& without : together) {
    words.push_back(Words(error, without));
  }
  for (const Without& without : importance.one_by_one) {
    words.push_back(Words(error, without));
  }
  figure.description = fmt::format("Held-out error {} with every sensor; {}.",
                                   error.WithUnit(importance.rmse),
                                   data::JoinWords(words, "; "));
  return {std::move(figure)};
}

}  // namespace errmap::report
