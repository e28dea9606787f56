#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/figures/figure_parts.h"
#include "data/column_header.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::report {
namespace {

using models::FigureTableRecord;

// The position of each row in the measurement: hours, or rows without a clock.
// Sessions follow each other without the nights between them.
class Course {
 public:
  explicit Course(const ReportView& view)
      : table_(view.component->figures.tables.front()) {
    const std::size_t n = table_.target.size();
    const bool clock = table_.time && table_.time->size() == n;
    const bool parted = table_.session_labels && table_.sessions &&
                        table_.sessions->size() == n;
    constexpr double kHour = 3600.0;
    double begin = 0.0;
    double first = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double at = clock ? (*table_.time)[i] / kHour
                        : i < table_.rows.size()
                            ? static_cast<double>(table_.rows[i])
                            : static_cast<double>(i);
      const bool begins = i == 0 || (parted && (*table_.sessions)[i] !=
                                                   (*table_.sessions)[i - 1]);
      if (begins) {
        begin = at_.empty() ? 0.0 : at_.back();
        first = at;
        if (parted) Begin(begin, i);
      }
      at_.push_back(begin + (at - first));
    }
    axis_ =
        clock ? Axis{.quantity = "time", .unit = "h"} : Axis{.quantity = "row"};
    if (starts_.size() > 1) Name(view);
  }

  const std::vector<double>& at() const { return at_; }
  const Axis& axis() const { return axis_; }

  // A line for each session, of few enough points for a picture of this width.
  Series Trace(const std::vector<double>& values) const {
    constexpr std::size_t kMost = 160;
    const std::size_t step = std::max<std::size_t>(1, at_.size() / kMost);
    Series trace{.mark = Mark::kLine};
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const bool begins = std::ranges::binary_search(rows_, i);
      if (begins) trace.Add({kAutomatic, kAutomatic});
      if (begins || i % step == 0) trace.Add({at_[i], values[i]});
    }
    return trace;
  }

  // Dashed lines where sessions begin; without points if there is one.
  Series Starts(double low, double high) const {
    Series lines{.mark = Mark::kLine, .colour = kGrey, .dashed = true};
    for (std::size_t i = 1; i < starts_.size(); ++i) {
      lines.Add({starts_[i], low});
      lines.Add({starts_[i], high});
      lines.Add({kAutomatic, kAutomatic});
    }
    return lines;
  }

 private:
  const FigureTableRecord& table_;
  std::vector<double> at_;
  std::vector<double> starts_;
  std::vector<std::size_t> rows_;  // at which they lie
  std::vector<std::string> names_;
  Axis axis_;

  void Begin(double at, std::size_t row) {
    starts_.push_back(at);
    rows_.push_back(row);
    const auto code = static_cast<std::size_t>((*table_.sessions)[row]);
    names_.push_back(code < table_.session_labels->size()
                         ? Shortened((*table_.session_labels)[code], 10)
                         : "");
  }

  void Name(const ReportView& view) {
    axis_ = {.quantity = Shortened(
                 view.component->data.session.value_or("session"), 30)};
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      const double end = i + 1 < starts_.size() ? starts_[i + 1] : at_.back();
      axis_.names.emplace_back(names_[i], 0.5 * (starts_[i] + end));
    }
  }
};

double SpanOf(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax(values);
  return high - low;
}

// Thermometers that were read at every row, those that the map needs most
// first, then those that changed most.
std::vector<std::size_t> Thermometers(const ReportView& view) {
  const models::FiguresRecord& figures = view.component->figures;
  const auto& inputs = figures.tables.front().inputs;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < std::min(inputs.size(), figures.inputs.size());
       ++i) {
    if (data::UnitOfSymbol(figures.inputs[i].unit).quantity ==
            data::Quantity::kTemperature &&
        inputs[i].size() == figures.tables.front().target.size() &&
        std::ranges::all_of(inputs[i],
                            [](double v) { return std::isfinite(v); })) {
      found.push_back(i);
    }
  }
  std::ranges::stable_sort(found, [&](std::size_t a, std::size_t b) {
    return SpanOf(inputs[a]) > SpanOf(inputs[b]);
  });
  const auto& advice = view.component->recommendation;
  if (!advice || !advice->importance) return found;
  const auto& needs = advice->importance->one_by_one;
  std::ranges::stable_sort(found, {}, [&](std::size_t i) {
    return std::ranges::find_if(needs,
                                [&](const auto& without) {
                                  return without.sensors.size() == 1 &&
                                         without.sensors.front() ==
                                             figures.inputs[i].name;
                                }) -
           needs.begin();
  });
  return found;
}

Figure Begin(const ReportView& view,
             const Course& course,
             const std::string& name,
             const std::string& title) {
  Figure figure;
  figure.place = FigurePlace::kMeasured;
  figure.title = title;
  figure.plot.name = name;
  figure.plot.x = course.axis();
  figure.plot.y.unit = view.shown_unit;
  return figure;
}

std::vector<Figure> TemperatureFigures(const ReportView& view,
                                       const Course& course,
                                       const std::string& prefix) {
  const models::FiguresRecord& figures = view.component->figures;
  const auto& inputs = figures.tables.front().inputs;
  const std::vector<std::size_t> sensors = Thermometers(view);
  if (sensors.empty()) return {};
  Figure figure = Begin(view, course, prefix + "temperatures", "Temperatures");
  figure.plot.y = {.quantity = "temperature",
                   .unit = PrettyUnit(figures.inputs[sensors.front()].unit)};
  constexpr std::size_t kNamed = 4;
  double low = HUGE_VAL;
  double high = -HUGE_VAL;
  std::vector<std::string> words;
  // Those without a name lie below the others.
  for (std::size_t i = sensors.size(); i-- > 0;) {
    const std::vector<double>& values = inputs[sensors[i]];
    const auto [least, most] = std::ranges::minmax(values);
    low = std::min(low, least);
    high = std::max(high, most);
    Series trace = course.Trace(values);
    trace.colour = i < kNamed ? kLineColours[i] : "#C4CAD1";
    trace.size = i < kNamed ? 1.8 : 1.0;
    if (i < kNamed) {
      const std::string& name = figures.inputs[sensors[i]].name;
      trace.label = Shortened(data::ReadHeader(name).base, 16);
      words.push_back(
          fmt::format("{} from {} to {}", name, Plain(least), Plain(most)));
    }
    figure.plot.series.push_back(std::move(trace));
  }
  figure.plot.series.push_back(course.Starts(low, high));
  if (sensors.size() > kNamed) {
    figure.note =
        sensors.size() - kNamed == 1
            ? fmt::format("Grey: {}.", figures.inputs[sensors[kNamed]].name)
            : fmt::format("Grey: the other {} thermometers.",
                          sensors.size() - kNamed);
  }
  figure.description = fmt::format("Temperatures as measured: {}.",
                                   data::JoinWords(words, "; "));
  return {std::move(figure)};
}

Figure ErrorFigure(const ReportView& view,
                   const Course& course,
                   const std::string& prefix) {
  Figure figure = Begin(view, course, prefix + "time", "Error, no map applied");
  figure.plot.y.quantity = "error";
  std::vector<double> error = view.component->figures.tables.front().target;
  for (double& value : error) value *= view.scale;
  const auto [low, high] = std::ranges::minmax(error);
  figure.plot.series = {course.Starts(low, high), Points(course.at(), error)};
  figure.description = fmt::format(
      "Measured error from {} to {}, {} rows in the order of measuring.",
      Plain(low),
      Amount(high, view),
      error.size());
  return figure;
}

}  // namespace

std::vector<Figure> MeasuredFigures(const ReportView& view,
                                    const std::string& prefix) {
  const auto& tables = view.component->figures.tables;
  if (tables.empty() || tables.front().target.empty()) return {};
  const Course course(view);
  std::vector<Figure> figures = TemperatureFigures(view, course, prefix);
  figures.push_back(ErrorFigure(view, course, prefix));
  return figures;
}

}  // namespace errmap::report
