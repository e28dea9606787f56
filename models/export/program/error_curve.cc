#include "models/export/program/error_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "data/text.h"

namespace errmap::models {
namespace {

constexpr int kFineSteps = 4096;

VectorXd HeldReadings(const std::vector<TrainedInput>& inputs,
                      const std::vector<HeldReading>& held) {
  VectorXd readings(std::ssize(inputs));
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto found =
        std::ranges::find(held, inputs[i].column.name, &HeldReading::first);
    readings[static_cast<Index>(i)] =
        found != held.end() ? found->second : inputs[i].mean;
  }
  return readings;
}

int RequirePosition(const MapProgram& program) {
  const int position = PositionOf(program);
  if (position < 0) {
    throw std::invalid_argument(
        "it reads no position, so it is not a table of positions");
  }
  return position;
}

// Curves on a fine grid.
struct FineCurves {
  std::vector<double> positions;
  std::vector<std::vector<double>> values;  // by curve

  int last() const { return static_cast<int>(positions.size()) - 1; }

  // How far the curves leave the lines between two grid points.
  double Sag(int from, int to) const {
    double worst = 0.0;
    const auto x = [&](int i) {
      return positions[static_cast<std::size_t>(i)];
    };
    for (const std::vector<double>& curve : values) {
      const auto y = [&](int i) { return curve[static_cast<std::size_t>(i)]; };
      const double slope = (y(to) - y(from)) / (x(to) - x(from));
      for (int i = from + 1; i < to; ++i) {
        worst = std::max(worst,
                         std::fabs(y(from) + slope * (x(i) - x(from)) - y(i)));
      }
    }
    return worst;
  }

  // The furthest grid point to which a line from `from` stays within
  // `tolerance`, found by doubling, then halving.
  int Furthest(int from, double tolerance) const {
    int reached = from + 1;
    int stride = 1;
    while (reached + stride <= last() &&
           Sag(from, reached + stride) <= tolerance) {
      reached += stride;
      stride *= 2;
    }
    for (; stride >= 1; stride /= 2) {
      if (reached + stride <= last() &&
          Sag(from, reached + stride) <= tolerance) {
        reached += stride;
      }
    }
    return reached;
  }

  std::vector<int> KnotsWithin(double tolerance, int most) const {
    std::vector<int> knots{0};
    while (knots.back() < last() && static_cast<int>(knots.size()) <= most) {
      knots.push_back(Furthest(knots.back(), tolerance));
    }
    return knots;
  }
};

FineCurves Sampled(const std::vector<Curve>& curves, double low, double high) {
  FineCurves fine;
  for (int i = 0; i <= kFineSteps; ++i) {
    const double share = static_cast<double>(i) / kFineSteps;
    fine.positions.push_back(
        i == kFineSteps ? high : Tidied(low + share * (high - low)));
  }
  for (const Curve& curve : curves) {
    std::vector<double>& values = fine.values.emplace_back();
    for (const double position : fine.positions) {
      values.push_back(curve(position));
    }
  }
  return fine;
}

}  // namespace

ErrorCurve::ErrorCurve(const MapProgram& program,
                       const std::vector<TrainedInput>& inputs,
                       const std::vector<HeldReading>& held)
    : program_(&program),
      run_(program, Precision::kDouble),
      readings_(HeldReadings(inputs, held)),
      position_(RequirePosition(program)) {
  run_.Begin(readings_);
}

ErrorCurve::ErrorCurve(const MapProgram& program,
                       ProgramRun run,
                       VectorXd readings)
    : program_(&program),
      run_(std::move(run)),
      readings_(std::move(readings)),
      position_(RequirePosition(program)) {}

double ErrorCurve::operator()(double position) const {
  VectorXd readings = readings_;
  readings[position_] = position;
  return After(0.0, readings);  // the filters stay as they are
}

double ErrorCurve::operator()(double position, int input, double value) const {
  VectorXd readings = readings_;
  readings[position_] = position;
  readings[input] = value;
  constexpr double kForEver = 1e30;  // s
  return After(kForEver, readings);
}

const ProgramReading& ErrorCurve::position() const {
  return program_->readings[static_cast<std::size_t>(position_)];
}

double ErrorCurve::After(double dt, const VectorXd& readings) const {
  ProgramRun run = run_;
  double error = 0.0;
  if ((run.Step(dt, readings, &error) & kMapInvalid) != 0) {
    throw std::domain_error("its error is not finite there");
  }
  const double most = program_->limits.max_error;
  return std::clamp(error, -most, most);
}

bool ErrorCurve::IsAtLimit(double error) const {
  return std::fabs(error) >= program_->limits.max_error;
}

void AtLimit::Add(double position) {
  ++points;
  low = std::min(low, position);
  high = std::max(high, position);
}

double Tidied(double value) {
  double tidy = value;
  data::ParseNumber(fmt::format("{:.12g}", value), &tidy);
  return tidy;
}

int PositionOf(const MapProgram& program) {
  for (std::size_t i = 0; i < program.readings.size(); ++i) {
    if (data::IsPosition(program.readings[i].column)) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

Knots ChooseKnots(const std::vector<Curve>& curves,
                  double low,
                  double high,
                  int most,
                  double enough) {
  if (!(low < high)) {
    throw std::invalid_argument("the positions have no range in common");
  }
  const FineCurves fine = Sampled(curves, low, high);
  const auto fits = [&](double tolerance) {
    return static_cast<int>(fine.KnotsWithin(tolerance, most).size()) <= most;
  };
  // The smallest tolerance that `most` knots keep, by bisection of its
  // logarithm; the largest ever needed is that of a single line.
  double tolerance = enough;
  if (!fits(enough)) {
    double above = std::max(fine.Sag(0, fine.last()), enough);
    double below = enough;
    constexpr double kClose = 1.01;
    while (above > kClose * below) {
      const double middle = std::sqrt(above * below);
      (fits(middle) ? above : below) = middle;
    }
    tolerance = above;
  }
  const std::vector<int> knots = fine.KnotsWithin(tolerance, most);
  Knots chosen;
  for (std::size_t k = 0; k < knots.size(); ++k) {
    chosen.positions.push_back(
        fine.positions[static_cast<std::size_t>(knots[k])]);
    if (k > 0) {
      chosen.interpolation_error = std::max(chosen.interpolation_error,
                                            fine.Sag(knots[k - 1], knots[k]));
    }
  }
  return chosen;
}

}  // namespace errmap::models
