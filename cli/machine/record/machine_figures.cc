#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "cli/machine/record/machine_record.h"
#include "cli/report/figures/figure_parts.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::machine {
namespace {

using report::Figure;
using report::kAutomatic;
using report::Mark;
using report::Plain;
using report::Series;

constexpr int kWidth = 560;

// Reads downwards to 1, 2 or 5 times a power of ten.
double RoundDown(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double round : {5.0, 2.0}) {
    if (round * power <= value) return round * power;
  }
  return power;
}

const MachineChoiceRecord* ChoiceOf(const MachineRecord& machine,
                                    const std::string& name) {
  const auto found =
      std::ranges::find(machine.choices, name, &MachineChoiceRecord::name);
  return found == machine.choices.end() || found->cells.empty() ? nullptr
                                                                : &*found;
}

double LengthOfMean(const models::PlaneCell& cell) {
  return std::hypot(cell.mean_across, cell.mean_up);
}

// Largest finite value of cells, 0 without.
template <typename Value>
double Largest(const std::vector<models::PlaneCell>& cells,
               const Value& value) {
  double largest = 0.0;
  for (const models::PlaneCell& cell : cells) {
    if (std::isfinite(value(cell))) largest = std::max(largest, value(cell));
  }
  return largest;
}

// A line, and a break behind it.
void AddLine(double x0, double y0, double x1, double y1, Series* lines) {
  lines->Add({x0, y0});
  lines->Add({x1, y1});
  lines->Add({kAutomatic, kAutomatic});
}

// With a head of at most `head`, no longer than half of the arrow.
void AddArrow(
    double x, double y, double dx, double dy, double head, Series* lines) {
  const double length = std::hypot(dx, dy);
  if (!(length > 0.0)) return;
  AddLine(x, y, x + dx, y + dy, lines);
  const double size = std::min(head, 0.5 * length) / length;
  constexpr double kWing = 0.4;
  for (const double side : {kWing, -kWing}) {
    AddLine(x + dx,
            y + dy,
            x + dx - size * (dx - side * dy),
            y + dy - size * (dy + side * dx),
            lines);
  }
}

class MachinePictures {
 public:
  MachinePictures(const MachineRecord& machine,
                  const MachineChoiceRecord& before,
                  const MachineChoiceRecord& after)
      : machine_(machine), before_(before), after_(after) {
    const data::Unit unit = data::UnitOfSymbol(machine.unit);
    scale_ = unit.display_scale;
    symbol_ = report::PrettyUnit(unit.display_symbol);
    Frame();
  }

  std::vector<Figure> Figures() const {
    std::vector<Figure> figures;
    const double most = std::max(Largest(before_.cells, LengthOfMean),
                                 Largest(after_.cells, LengthOfMean));
    figures.push_back(
        Arrows("before", "Error at the tool, uncompensated", before_, most));
    figures.push_back(Arrows(
        "after", "The same after compensation, same scale", after_, most));
    const auto rms = [](const models::PlaneCell& cell) { return cell.rms; };
    const double highest =
        std::max(Largest(before_.cells, rms), Largest(after_.cells, rms));
    figures.push_back(
        Colours("before", "RMS of the error, uncompensated", before_, highest));
    figures.push_back(Colours(
        "after", "The same after compensation, same scale", after_, highest));
    // What is left has a shape of its own, too small to see beside the whole.
    const double left = Largest(after_.cells, LengthOfMean);
    constexpr double kMuchLess = 0.5;
    if (left > 0.0 && left < kMuchLess * most) {
      figures.push_back(Arrows(
          "left", "What compensation leaves, larger scale", after_, left));
      figures.push_back(Colours("left",
                                "What compensation leaves, larger scale",
                                after_,
                                Largest(after_.cells, rms)));
    }
    return figures;
  }

 private:
  // The cells' rectangle with room for arrows, of one scale both ways where it
  // is not too flat or too steep for a picture.
  void Frame() {
    const PlaneRecord& plane = *machine_.plane;
    double low_x = HUGE_VAL;
    double high_x = -HUGE_VAL;
    double low_y = HUGE_VAL;
    double high_y = -HUGE_VAL;
    for (const models::PlaneCell& cell : before_.cells) {
      if (!std::isfinite(cell.across) || !std::isfinite(cell.up)) continue;
      low_x = std::min(low_x, cell.across - 0.5 * plane.cell_width);
      high_x = std::max(high_x, cell.across + 0.5 * plane.cell_width);
      low_y = std::min(low_y, cell.up - 0.5 * plane.cell_height);
      high_y = std::max(high_y, cell.up + 0.5 * plane.cell_height);
    }
    x_ = {low_x, high_x};
    y_ = {low_y, high_y};
    const double across = high_x - low_x;
    const double up = high_y - low_y;
    constexpr double kAround = 55.0;  // below and above the axes, px
    constexpr double kAxis = 480.0;   // px of the x axis
    constexpr double kLowest = 220.0;
    constexpr double kHighest = 620.0;
    const double wanted = kAround + 1.25 * kAxis * up / across;
    height_ =
        std::isfinite(wanted) ? std::clamp(wanted, kLowest, kHighest) : kLowest;
  }

  Figure Begin(const std::string& name, const std::string& title) const {
    Figure figure;
    figure.title = title;
    figure.plot.name = "machine-" + name;
    figure.plot.width = kWidth;
    figure.plot.height = static_cast<int>(height_);
    figure.plot.x = {.quantity = machine_.plane->across,
                     .unit = report::PrettyUnit(machine_.unit)};
    figure.plot.y = {.quantity = machine_.plane->up,
                     .unit = report::PrettyUnit(machine_.unit)};
    return figure;
  }

  std::string WithSymbol(double value) const {
    return Plain(scale_ * value) + " " + symbol_;
  }

  // `most` is drawn as long as a cell is wide or high, whichever is less.
  Figure Arrows(const std::string& name,
                const std::string& title,
                const MachineChoiceRecord& choice,
                double most) const {
    Figure figure = Begin("arrows-" + name, title);
    const PlaneRecord& plane = *machine_.plane;
    constexpr double kShareOfCell = 1.0;
    const double cell = std::min(plane.cell_width, plane.cell_height);
    const double factor = most > 0.0 ? kShareOfCell * cell / most : 0.0;
    const double head = 0.3 * cell;
    Series arrows{.label = "mean error of a cell",
                  .mark = Mark::kLine,
                  .colour = report::kBlue,
                  .size = 1.6};
    Series origins{.label = "",
                   .mark = Mark::kPoints,
                   .colour = report::kGrey,
                   .size = 1.0};
    for (const models::PlaneCell& at : choice.cells) {
      if (!std::isfinite(LengthOfMean(at))) continue;
      origins.Add({at.across, at.up});
      AddArrow(at.across,
               at.up,
               factor * at.mean_across,
               factor * at.mean_up,
               head,
               &arrows);
    }
    figure.plot.series.push_back(std::move(origins));
    if (!arrows.columns[0].empty()) {
      figure.plot.series.push_back(std::move(arrows));
    }
    if (most > 0.0) AddScale(most, factor, head, &figure);
    figure.plot.x.low = x_[0] - 0.5 * cell;
    figure.plot.x.high = x_[1] + 0.5 * cell;
    figure.plot.y.high = y_[1] + 0.5 * cell;
    figure.note = Note(choice) + " Arrows begin at the dots.";
    figure.description = fmt::format(
        "Mean errors of {} cells of the plane of {} and {} as arrows; the "
        "longest stands for {}.",
        choice.cells.size(),
        machine_.plane->across,
        machine_.plane->up,
        WithSymbol(Largest(choice.cells, LengthOfMean)));
    return figure;
  }

  // An arrow along each axis below the cells, of a round length.
  void AddScale(double most, double factor, double head, Figure* figure) const {
    const double round = RoundDown(scale_ * most) / scale_;
    const double length = factor * round;
    const double cell =
        std::min(machine_.plane->cell_width, machine_.plane->cell_height);
    const double x = x_[0];
    const double y = y_[0] - 1.5 * cell;
    Series& scale = figure->plot.series.emplace_back(Series{
        .label = fmt::format("scale: {} {}", Plain(scale_ * round), symbol_),
        .mark = Mark::kLine,
        .colour = report::kVermillion,
        .size = 1.6});
    AddArrow(x, y, length, 0.0, head, &scale);
    AddArrow(x, y, 0.0, length, head, &scale);
    figure->plot.y.low = y - 0.5 * cell;
  }

  Figure Colours(const std::string& name,
                 const std::string& title,
                 const MachineChoiceRecord& choice,
                 double highest) const {
    Figure figure = Begin("grid-" + name, title);
    Series cells{.mark = Mark::kCells};
    for (const models::PlaneCell& at : choice.cells) {
      cells.Add({at.across,
                 at.up,
                 0.5 * machine_.plane->cell_width,
                 0.5 * machine_.plane->cell_height,
                 scale_ * at.rms});
    }
    figure.plot.series.push_back(std::move(cells));
    figure.plot.colour = {.quantity = "RMS",
                          .unit = symbol_,
                          .low = 0.0,
                          .high = highest > 0.0 ? scale_ * highest : 1.0};
    figure.plot.x.low = x_[0];
    figure.plot.x.high = x_[1];
    figure.plot.y.low = y_[0];
    figure.plot.y.high = y_[1];
    figure.note = Note(choice) + " Hatched: no pose was there.";
    figure.description = fmt::format(
        "Root mean square length of the error in {} cells of the plane, the "
        "largest {}. Hatched: no pose.",
        choice.cells.size(),
        WithSymbol(Largest(
            choice.cells, [](const models::PlaneCell& at) { return at.rms; })));
    return figure;
  }

  std::string Note(const MachineChoiceRecord& choice) const {
    return fmt::format(
        "{} poses of {} {}, {} maps; tool minus work. {} and {} from the "
        "work's "
        "origin.",
        choice.points,
        machine_.later.size() == 1 ? "session" : "sessions",
        data::JoinWords(machine_.later, ", "),
        choice.maps.empty() ? "without" : choice.name,
        machine_.plane->across,
        machine_.plane->up);
  }

  const MachineRecord& machine_;
  const MachineChoiceRecord& before_;
  const MachineChoiceRecord& after_;
  double scale_ = 1.0;  // shown = value * scale_
  std::string symbol_;
  std::array<double, 2> x_ = {};
  std::array<double, 2> y_ = {};
  double height_ = 0.0;
};

}  // namespace

std::vector<Figure> MachineFigures(const MachineRecord& machine) {
  const MachineChoiceRecord* const before = ChoiceOf(machine, "uncompensated");
  const MachineChoiceRecord* const after = ChoiceOf(machine, "recommended");
  if (!machine.plane || before == nullptr || after == nullptr) return {};
  return MachinePictures(machine, *before, *after).Figures();
}

}  // namespace errmap::machine
