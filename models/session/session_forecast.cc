#include "models/session/session_forecast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include <Eigen/Cholesky>

#include "models/session/session_offset.h"
#include "stats/indices.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

// What more of them change is less than what sessions differ by.
constexpr Index kMostProbes = 96;
constexpr Index kSites = 72;
constexpr int kDraws = 500;
constexpr std::uint64_t kForecastSeed = 29;

// Before any probe: that nothing is wrong, as often as any disturbance.
constexpr double kSound = 0.6;
// Sizes of sound sessions over the promise, and of disturbances. Logarithms of
// sessions' RMSE scatter by a quarter at least: few sessions tell it badly.
constexpr std::array kScales = {0.5, 0.7, 1.0, 1.4, 2.0};
constexpr double kLeastScatter = 0.25;
constexpr std::array kSizes = {1.5, 3.0, 6.0, 12.0, 24.0};
constexpr std::array kGains = {0.1, 0.3, 1.0, 2.0};
// Of the range of positions, over which a shape bends.
constexpr double kBend = 0.35;
// A hypothesis below this share of the likeliest is not drawn from.
constexpr double kNegligible = 1e-4;

// When, where and what was predicted.
struct Sites {
  VectorXd elapsed;
  VectorXd position;
  VectorXd predicted;

  Index size() const { return elapsed.size(); }
};

// The covariance of errors at two sites.
using Kernel =
    std::function<double(const Sites& a, Index i, const Sites& b, Index j)>;

MatrixXd CovarianceOf(const Kernel& kernel, const Sites& a, const Sites& b) {
  MatrixXd covariance(a.size(), b.size());
  for (Index i = 0; i < a.size(); ++i) {
    for (Index j = 0; j < b.size(); ++j) {
      covariance(i, j) = kernel(a, i, b, j);
    }
  }
  return covariance;
}

Sites SitesOf(const HeldOutErrors& errors) {
  std::vector<double> elapsed;
  std::vector<double> position;
  std::vector<double> predicted;
  for (const HeldOutErrors::Unit& unit : errors.units) {
    for (Index i = 0; i < unit.elapsed.size(); ++i) {
      elapsed.push_back(unit.elapsed[i]);
      position.push_back(unit.position.size() > 0 ? unit.position[i] : 0.0);
      predicted.push_back(unit.predicted.size() > 0 ? unit.predicted[i] : 0.0);
    }
  }
  std::vector<Index> order = stats::AllIndices(std::ssize(elapsed));
  std::ranges::stable_sort(
      order, {}, [&](Index i) { return elapsed[static_cast<std::size_t>(i)]; });
  const std::vector<Index> kept = stats::SpreadSample(order, kSites);
  Sites sites{.elapsed = VectorXd(std::ssize(kept)),
              .position = VectorXd(std::ssize(kept)),
              .predicted = VectorXd(std::ssize(kept))};
  for (Index i = 0; i < sites.size(); ++i) {
    const auto from =
        static_cast<std::size_t>(kept[static_cast<std::size_t>(i)]);
    sites.elapsed[i] = errors.time_unit == "s" ? elapsed[from] : 0.0;
    sites.position[i] = position[from];
    sites.predicted[i] = predicted[from];
  }
  return sites;
}

// The size of held-out errors over time: their RMS in stretches of as many,
// over that of all, straight from middle to middle.
class SizeOverTime {
 public:
  explicit SizeOverTime(const HeldOutErrors& errors) {
    constexpr std::size_t kStretches = 6;
    std::vector<std::pair<double, double>> squares;
    double all = 0.0;
    for (const HeldOutErrors::Unit& unit : errors.units) {
      for (Index i = 0; i < unit.residuals.size(); ++i) {
        squares.emplace_back(unit.elapsed[i],
                             unit.residuals[i] * unit.residuals[i]);
        all += squares.back().second;
      }
    }
    std::ranges::sort(squares);
    const auto count = squares.size();
    for (std::size_t k = 0; k < kStretches; ++k) {
      const std::size_t from = count * k / kStretches;
      const std::size_t until = count * (k + 1) / kStretches;
      if (until == from) continue;
      double sum = 0.0;
      double time = 0.0;
      for (std::size_t i = from; i < until; ++i) {
        time += squares[i].first;
        sum += squares[i].second;
      }
      const auto size = static_cast<double>(until - from);
      times_.push_back(time / size);
      constexpr double kLeast = 0.3;
      sizes_.push_back(std::max(
          kLeast, std::sqrt(sum / size / (all / static_cast<double>(count)))));
    }
  }

  double At(double time) const {
    const auto after = std::ranges::upper_bound(times_, time);
    if (after == times_.begin()) return sizes_.front();
    if (after == times_.end()) return sizes_.back();
    const auto k = static_cast<std::size_t>(after - times_.begin());
    const double part = (time - times_[k - 1]) / (times_[k] - times_[k - 1]);
    return sizes_[k - 1] + part * (sizes_[k] - sizes_[k - 1]);
  }

 private:
  std::vector<double> times_;
  std::vector<double> sizes_;
};

// One hypothesis: sound errors of a size and a disturbance of a size.
struct Hypothesis {
  double prior = 0.0;
  double scale = 1.0;
  double size = 0.0;       // target's unit, of gains without one
  std::size_t kernel = 0;  // of the disturbances
};

struct Disturbances {
  std::vector<Kernel> kernels;
  std::vector<Hypothesis> hypotheses;
};

// `placed`: whether positions of sites and probes are known.
Disturbances DisturbancesOf(const HeldOutErrors& errors,
                            const Sites& sites,
                            bool placed) {
  const double longest =
      std::max(sites.elapsed.maxCoeff(), std::numeric_limits<double>::min());
  const double range =
      std::max(sites.position.maxCoeff() - sites.position.minCoeff(),
               std::numeric_limits<double>::min());
  const auto grown = [longest](
                         const Sites& a, Index i, const Sites& b, Index j) {
    return std::min(a.elapsed[i], b.elapsed[j]) / longest;
  };
  const auto alike = [range](const Sites& a, Index i, const Sites& b, Index j) {
    const double apart = (a.position[i] - b.position[j]) / (kBend * range);
    return std::exp(-0.5 * apart * apart);
  };
  Disturbances all;
  const auto add = [&](Kernel kernel) {
    for (const double size : kSizes) {
      all.hypotheses.push_back({.prior = 1.0 / std::size(kSizes),
                                .size = size * errors.rmse,
                                .kernel = all.kernels.size()});
    }
    all.kernels.push_back(std::move(kernel));
  };
  add([](const Sites&, Index, const Sites&, Index) { return 1.0; });
  if (errors.time_unit == "s") add(grown);
  if (placed) {
    add(alike);
    if (errors.time_unit == "s") {
      add([=](const Sites& a, Index i, const Sites& b, Index j) {
        return alike(a, i, b, j) * grown(a, i, b, j);
      });
    }
  }
  if (sites.predicted.cwiseAbs().maxCoeff() > 0.0) {
    for (const double gain : kGains) {
      all.hypotheses.push_back({.prior = 1.0 / std::size(kGains),
                                .size = gain,
                                .kernel = all.kernels.size()});
    }
    all.kernels.push_back([](const Sites& a, Index i, const Sites& b, Index j) {
      return a.predicted[i] * b.predicted[j];
    });
  }
  for (Hypothesis& one : all.hypotheses) {
    one.prior *= (1.0 - kSound) / static_cast<double>(all.kernels.size());
  }
  return all;
}

// Weights of kScales by how the held-out units differ.
std::array<double, std::size(kScales)> PriorOfScales(
    const HeldOutErrors& errors) {
  double squares = 0.0;
  double sum = 0.0;
  double count = 0.0;
  for (const HeldOutErrors::Unit& unit : errors.units) {
    if (!(unit.rmse > 0.0)) continue;
    const double ratio = std::log(unit.rmse / errors.rmse);
    sum += ratio;
    squares += ratio * ratio;
    ++count;
  }
  const double mean = count > 0.0 ? sum / count : 0.0;
  const double scatter = std::max(
      kLeastScatter,
      count > 1.0 ? std::sqrt(std::max(0.0, squares - count * mean * mean) /
                              (count - 1.0))
                  : 0.0);
  std::array<double, std::size(kScales)> prior{};
  double total = 0.0;
  for (std::size_t k = 0; k < prior.size(); ++k) {
    const double z = (std::log(kScales[k]) - mean) / scatter;
    total += prior[k] = std::exp(-0.5 * z * z);
  }
  for (double& weight : prior) weight /= total;
  return prior;
}

Sites Kept(const SessionProbes& probes, bool timed, VectorXd* residuals) {
  const std::vector<Index> rows =
      stats::SpreadSample(probes.residuals.size(), kMostProbes);
  Sites sites;
  const auto count = std::ssize(rows);
  sites.elapsed =
      timed ? VectorXd(probes.elapsed(rows)) : VectorXd(VectorXd::Zero(count));
  sites.position = probes.position.size() > 0 ? VectorXd(probes.position(rows))
                                              : VectorXd(VectorXd::Zero(count));
  sites.predicted = probes.predicted(rows);
  *residuals = probes.residuals(rows);
  return sites;
}

class Forecaster {
 public:
  Forecaster(const HeldOutErrors& errors, const SessionProbes& probes)
      : errors_(errors),
        sites_(SitesOf(errors)),
        probes_(Kept(probes, errors.time_unit == "s", &residuals_)),
        placed_(!errors.position.empty() && probes.position.size() > 0),
        size_(errors) {
    const OffsetModel offset = FitOffset(errors);
    const Kernel sound = [&](const Sites& a, Index i, const Sites& b, Index j) {
      const double lag = std::abs(a.elapsed[i] - b.elapsed[j]);
      return offset.variance * std::exp(-lag / offset.memory) *
             size_.At(a.elapsed[i]) * size_.At(b.elapsed[j]);
    };
    sound_.probes = CovarianceOf(sound, probes_, probes_);
    sound_.across = CovarianceOf(sound, sites_, probes_);
    sound_.sites = CovarianceOf(sound, sites_, sites_);
    for (Index i = 0; i < probes_.size(); ++i) {
      const double size = size_.At(probes_.elapsed[i]);
      sound_.probes(i, i) += offset.noise * size * size;
    }
    for (Index i = 0; i < sites_.size(); ++i) {
      const double size = size_.At(sites_.elapsed[i]);
      sound_.sites(i, i) += offset.noise * size * size;
    }
  }

  SessionForecast Forecast() {
    const Disturbances disturbances = DisturbancesOf(errors_, sites_, placed_);
    std::vector<Covariances> of_kernels;
    for (const Kernel& kernel : disturbances.kernels) {
      of_kernels.push_back({CovarianceOf(kernel, probes_, probes_),
                            CovarianceOf(kernel, sites_, probes_),
                            CovarianceOf(kernel, sites_, sites_)});
    }
    const auto scales = PriorOfScales(errors_);
    std::vector<Hypothesis> hypotheses;
    for (std::size_t k = 0; k < scales.size(); ++k) {
      hypotheses.push_back({.prior = kSound * scales[k], .scale = kScales[k]});
      // What a shape explains is not scatter beside it.
      for (Hypothesis one : disturbances.hypotheses) {
        one.prior *= scales[k];
        one.scale = kScales[k];
        hypotheses.push_back(one);
      }
    }
    std::vector<double> logs;
    std::vector<Covariances> all;
    for (const Hypothesis& one : hypotheses) {
      Covariances sum = sound_.Times(one.scale * one.scale);
      if (one.size > 0.0) {
        sum.Add(of_kernels[one.kernel], one.size * one.size);
      }
      logs.push_back(std::log(one.prior) + LogLikelihood(sum.probes));
      all.push_back(std::move(sum));
    }
    return Draw(all, Shares(logs));
  }

 private:
  struct Covariances {
    MatrixXd probes;  // (n x n)
    MatrixXd across;  // (m x n)
    MatrixXd sites;   // (m x m)

    Covariances Times(double factor) const {
      return {factor * probes, factor * across, factor * sites};
    }
    void Add(const Covariances& other, double factor) {
      probes += factor * other.probes;
      across += factor * other.across;
      sites += factor * other.sites;
    }
  };

  double LogLikelihood(const MatrixXd& covariance) const {
    const Eigen::LLT<MatrixXd> root(covariance);
    const MatrixXd lower = root.matrixL();
    return -0.5 * residuals_.dot(root.solve(residuals_)) -
           lower.diagonal().array().log().sum();
  }

  static std::vector<double> Shares(const std::vector<double>& logs) {
    const double most = std::ranges::max(logs);
    std::vector<double> shares;
    double total = 0.0;
    for (const double log : logs) {
      const double share = std::exp(log - most);
      shares.push_back(share > kNegligible ? share : 0.0);
      total += shares.back();
    }
    for (double& share : shares) share /= total;
    return shares;
  }

  // As many draws of each as its share says.
  SessionForecast Draw(const std::vector<Covariances>& all,
                       const std::vector<double>& shares) {
    stats::Random random(kForecastSeed);
    SessionForecast forecast{.elapsed = sites_.elapsed,
                             .position = sites_.position,
                             .predicted = sites_.predicted,
                             .so_far = {},
                             .later = {},
                             .errors = MatrixXd(kDraws, sites_.size())};
    double until = 0.0;
    Index row = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      until += shares[k];
      const auto end = k + 1 == all.size()
                           ? Index{kDraws}
                           : static_cast<Index>(std::lround(until * kDraws));
      if (end <= row) continue;
      const Eigen::LLT<MatrixXd> root(all[k].probes);
      const VectorXd mean = all[k].across * root.solve(residuals_);
      const MatrixXd told = root.solve(all[k].across.transpose());
      MatrixXd left = all[k].sites - all[k].across * told;
      // Rounding may take from a variance that is hardly there.
      left.diagonal().array() += 1e-9 * left.diagonal().mean();
      const Eigen::LLT<MatrixXd> spread(left);
      const MatrixXd lower = spread.matrixL();
      for (; row < end; ++row) {
        VectorXd normal(sites_.size());
        for (double& value : normal) value = random.Normal();
        forecast.errors.row(row) = mean + lower * normal;
      }
    }
    const double last = probes_.elapsed.maxCoeff();
    for (Index i = 0; i < sites_.size(); ++i) {
      (sites_.elapsed[i] > last ? forecast.later : forecast.so_far)
          .push_back(i);
    }
    return forecast;
  }

  const HeldOutErrors& errors_;
  VectorXd residuals_;  // of probes_
  Sites sites_;
  Sites probes_;
  bool placed_;
  SizeOverTime size_;
  Covariances sound_;
};

}  // namespace

SessionForecast ForecastSession(const HeldOutErrors& errors,
                                const SessionProbes& probes) {
  return Forecaster(errors, probes).Forecast();
}

}  // namespace errmap::models
