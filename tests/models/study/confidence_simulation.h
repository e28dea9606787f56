#pragma once

// Worlds of which the truth is known, for the study of how often something
// false, and something true, is called established: tests/benchmarks/
// confidence_study.cc in full, confidence_null_test.cc in small.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "models/study/judgement/confidence.h"
#include "stats/random.h"

namespace errmap::testing {

/// Student's t with 3 or 5 degrees of freedom, or the normal distribution.
enum class Tails { kNormal, kT3, kT5 };

/// Losses of models on units in order. What is drawn has a standard deviation
/// of 1 from unit to unit and follows an autoregression of coefficient
/// `memory`, its innovations of these tails.
struct World {
  enum class Kind {
    kLosses,  // the drawn values are the losses themselves, off a constant
    kBiases,  // ... the biases of units of 17 rows, of half the variance
    kScales,  // ... 0.3 makes them logarithms of the units' scales
  };
  Kind kind = Kind::kLosses;
  Eigen::Index units = 35;
  Eigen::Index models = 2;
  double memory = 0.0;
  Tails tails = Tails::kNormal;
  bool separate_sessions = false;
  /// By how many standard deviations of the loss difference of two models the
  /// second is worse (kLosses), or the ratio of its RMSE less 1 (kBiases).
  double worse = 0.0;
  /// The first model is what the comparison is about, all others are
  /// yardsticks.
  bool in_turn = false;
};

class Simulation {
 public:
  Simulation(const World& world, std::uint64_t seed)
      : world_(world), random_(seed) {}

  stats::UnitLosses Draw() {
    const Eigen::Index units = world_.units;
    stats::UnitLosses losses;
    losses.rows = Eigen::VectorXd::Constant(units, kRows);
    losses.mean_squares.resize(units, world_.models);
    for (Eigen::Index model = 0; model < world_.models; ++model) {
      const Eigen::VectorXd series = DrawSeries();
      losses.mean_squares.col(model) = world_.kind == World::Kind::kLosses
                                           ? LossesOf(series, model)
                                           : SquaresOf(series, model);
    }
    return losses;
  }

  stats::Comparison Compare(int repetition) {
    // Fewer draws than by default: the tests keep their level, in less time.
    stats::ComparisonOptions options{
        .seed = static_cast<std::uint64_t>(repetition),
        .flips = 999,
        .resamples = 399,
        .separate_units = world_.separate_sessions};
    if (world_.in_turn) {
      options.first = 0;
      for (Eigen::Index other = 1; other < world_.models; ++other) {
        options.yardsticks.push_back(other);
      }
    }
    return stats::CompareModels(Draw(), nullptr, options);
  }

  const World& world() const { return world_; }

 private:
  static constexpr double kRows = 17.0;

  double DrawInnovation() {
    const double z = stats::NormalSample(1, &random_)[0];
    if (world_.tails == Tails::kNormal) return z;
    // t = z / sqrt(chi2 / df), whose variance is df / (df - 2).
    const Eigen::Index df = world_.tails == Tails::kT3 ? 3 : 5;
    return z * std::sqrt(static_cast<double>(df - 2) /
                         stats::NormalSample(df, &random_).squaredNorm());
  }

  Eigen::VectorXd DrawSeries() {
    constexpr Eigen::Index kBurnIn = 60;
    const double memory = world_.memory;
    const double fresh = std::sqrt(1.0 - memory * memory);
    Eigen::VectorXd series(world_.units);
    double value = DrawInnovation();
    for (Eigen::Index i = memory == 0.0 ? 0 : -kBurnIn; i < world_.units; ++i) {
      value = memory * value + fresh * DrawInnovation();
      if (i >= 0) series[i] = value;
    }
    return series;
  }

  Eigen::VectorXd LossesOf(const Eigen::VectorXd& series, Eigen::Index model) {
    constexpr double kFarAboveZero = 1000.0;
    const double shift = model == 1 ? world_.worse * std::sqrt(2.0) : 0.0;
    return (series.array() + (kFarAboveZero + shift)).cwiseMax(0.0);
  }

  Eigen::VectorXd SquaresOf(const Eigen::VectorXd& series, Eigen::Index model) {
    const double scale = model == 1 ? 1.0 + world_.worse : 1.0;
    Eigen::VectorXd squares(series.size());
    for (Eigen::Index unit = 0; unit < series.size(); ++unit) {
      const Eigen::ArrayXd own =
          stats::NormalSample(static_cast<Eigen::Index>(kRows), &random_);
      if (world_.kind == World::Kind::kBiases) {
        squares[unit] = 0.5 * (series[unit] + own).square().mean();
      } else {
        // Rows of a unit are correlated by 0.3.
        const double shared = stats::NormalSample(1, &random_)[0];
        squares[unit] =
            std::exp(0.6 * series[unit]) *
            (std::sqrt(0.3) * shared + std::sqrt(0.7) * own).square().mean();
      }
      squares[unit] *= scale * scale;
    }
    return squares;
  }

  World world_;
  stats::Random random_;
};

/// Share (%) of `repetitions` in which any pair is called different.
inline double EstablishedDifferent(const World& world, int repetitions) {
  Simulation simulation(world, 2026);
  int count = 0;
  for (int i = 0; i < repetitions; ++i) {
    const stats::Comparison found = simulation.Compare(i);
    count += std::ranges::any_of(found.pairs, [&](const auto& pair) {
      return models::ThatTheyDiffer(found, pair, world.separate_sessions) ==
             models::Confidence::kEstablished;
    });
  }
  return 100.0 * count / repetitions;
}

/// Share (%) in which the second model, a baseline, is said to lose at most 5 %
/// of the best RMSE to the first.
inline double EstablishedWithin(const World& world, int repetitions) {
  Simulation simulation(world, 2026);
  int count = 0;
  for (int i = 0; i < repetitions; ++i) {
    const stats::Comparison found = simulation.Compare(i);
    const double margin = stats::Margin{}.Of(found.rmse.minCoeff());
    count += models::ThatItLosesAtMost(
                 margin, found, 1, 0, world.separate_sessions) ==
             models::Confidence::kEstablished;
  }
  return 100.0 * count / repetitions;
}

}  // namespace errmap::testing
