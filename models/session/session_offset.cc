#include "models/session/session_offset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "stats/distributions.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
// Three standard deviations, squared: no probe of an offset as the model's.
constexpr double kSurprise = 9.0;

// Products of two errors of one unit, and how far apart in time they are; the
// weight of each is one over the pairs of its unit.
struct Products {
  std::vector<double> lag;
  std::vector<double> product;
  std::vector<double> weight;
};

Products ProductsOf(const HeldOutErrors& errors) {
  Products products;
  for (const HeldOutErrors::Unit& unit : errors.units) {
    const Index size = unit.residuals.size();
    const Index pairs = size * (size - 1) / 2;
    for (Index i = 0; i < size; ++i) {
      for (Index j = 0; j < i; ++j) {
        products.lag.push_back(std::abs(unit.elapsed[i] - unit.elapsed[j]));
        products.product.push_back(unit.residuals[i] * unit.residuals[j]);
        products.weight.push_back(1.0 / static_cast<double>(pairs));
      }
    }
  }
  return products;
}

double MeanSquare(const HeldOutErrors& errors) {
  double sum = 0.0;
  for (const HeldOutErrors::Unit& unit : errors.units) {
    sum += unit.residuals.squaredNorm() /
           static_cast<double>(unit.residuals.size());
  }
  return sum / static_cast<double>(errors.units.size());
}

// The variance that fits the products best at this memory, and how well.
struct Candidate {
  double memory = 0.0;
  double variance = 0.0;
  double explained = 0.0;  // of the weighted squares
};

Candidate FitVariance(const Products& products, double memory) {
  double numerator = 0.0;
  double denominator = 0.0;
  for (std::size_t i = 0; i < products.lag.size(); ++i) {
    const double kept = std::exp(-products.lag[i] / memory);
    numerator += products.weight[i] * products.product[i] * kept;
    denominator += products.weight[i] * kept * kept;
  }
  const double variance =
      denominator > 0.0 ? std::max(0.0, numerator / denominator) : 0.0;
  return {memory, variance, variance * numerator};
}

}  // namespace

OffsetModel FitOffset(const HeldOutErrors& errors) {
  // A rest of nothing would have one probe know everything.
  constexpr double kLeastNoise = 0.01;
  constexpr double kShortest = 1.0 / 32.0;
  constexpr double kLongest = 8.0;
  const Products products = ProductsOf(errors);
  Candidate best = FitVariance(products, kUnbounded);
  const double longest = errors.longest();
  for (double share = kShortest; longest > 0.0 && share <= kLongest;
       share *= 2.0) {
    const Candidate candidate = FitVariance(products, share * longest);
    if (candidate.explained > best.explained) best = candidate;
  }
  const double total =
      std::max(MeanSquare(errors), std::numeric_limits<double>::min());
  const double least = total / static_cast<double>(errors.units.size() + 1);
  best.variance =
      std::min(std::max(best.variance, least), (1.0 - kLeastNoise) * total);
  return {.variance = best.variance,
          .memory = best.memory,
          .noise = total - best.variance};
}

OffsetFilter::OffsetFilter(const OffsetModel& model)
    : model_(model), variance_(model.variance) {}

void OffsetFilter::Advance(double time) {
  if (started_) {
    if (!(time >= time_)) {
      throw std::invalid_argument("OffsetFilter: time went back");
    }
    const double kept = std::exp(-(time - time_) / model_.memory);
    if (moved_) {  // a machine that was moved stays where it is
      variance_ += 2.0 * model_.variance * (1.0 - kept);
    } else {
      offset_ *= kept;
      variance_ = model_.variance + kept * kept * (variance_ - model_.variance);
    }
  }
  started_ = true;
  time_ = time;
}

void OffsetFilter::Update(double residual) {
  const double miss = (residual - offset_) * (residual - offset_);
  const double predicted = variance_ + model_.noise;
  const bool is_surprise = miss > kSurprise * predicted;
  if (moved_ || !is_surprise) misses_ += miss / predicted;
  if (is_surprise) {
    variance_ = miss;
    moved_ = true;
  }
  const double gain = variance_ / (variance_ + model_.noise);
  offset_ += gain * (residual - offset_);
  variance_ *= 1.0 - gain;
  ++count_;
  const double from_mean = residual - mean_;
  mean_ += from_mean / count_;
  squares_ += from_mean * (residual - mean_);
}

double OffsetFilter::MeanVariance() const {
  return count_ < 2 ? 0.0 : squares_ / (count_ - 1) / count_;
}

double OffsetFilter::Believed() const {
  // Of 2 to 4 probes the least wide where all is well.
  constexpr double kOfHeldOut = 4.0;
  return kOfHeldOut + count_;
}

double OffsetFilter::Scale() const {
  const double beginning = moved_ ? kSurprise : 0.0;
  return 1.0 + (beginning + misses_ - count_) / Believed();
}

double OffsetFilter::variance() const {
  return std::max(Scale() * variance_, MeanVariance());
}

bool OffsetFilter::contradicted() const {
  constexpr double kSure = 0.95;
  const int num_misses = count_ - (moved_ ? 1 : 0);
  return num_misses > 0 &&
         misses_ > stats::ChiSquaredQuantile(kSure, num_misses);
}

double OffsetFilter::Widening() const {
  constexpr double kUpper = 0.95;  // of 90 %
  if (count_ == 0) return 1.0;
  const double held_out = model_.variance + model_.noise;
  const auto half_width = [&](double square, double freedom) {
    return stats::StudentQuantile(kUpper, freedom) /
           stats::NormalQuantile(kUpper) * std::sqrt(square / held_out);
  };
  const double widening =
      half_width(variance() + Scale() * model_.noise, Believed());
  if (count_ == 1) {
    // An offset or a wrong shape: elsewhere the error may be none, or twice.
    return std::max(widening, std::sqrt(1.0 + mean_ * mean_ / held_out));
  }
  if (!contradicted()) return widening;
  const double off_mean = mean_ - offset_;
  const double scatter =
      (squares_ + count_ * off_mean * off_mean) / (count_ - 1);
  return std::max(widening, half_width(scatter + MeanVariance(), count_ - 1.0));
}

OffsetTrack TrackOffset(const OffsetModel& model,
                        const std::vector<Moment>& probe_moments,
                        const VectorXd& probe_residuals,
                        const std::vector<Moment>& moments) {
  std::vector<Index> order = stats::AllIndices(std::ssize(probe_moments));
  std::ranges::stable_sort(order, {}, [&](Index i) {
    return probe_moments[static_cast<std::size_t>(i)].time;
  });
  OffsetTrack track{.offset = VectorXd(std::ssize(moments)),
                    .variance = VectorXd(std::ssize(moments)),
                    .widening = VectorXd(std::ssize(moments)),
                    .contradicted = {},
                    .used = {}};
  for (std::size_t row = 0; row < moments.size(); ++row) {
    OffsetFilter filter(model);
    Index used = 0;
    for (const Index i : order) {
      const Moment& probe = probe_moments[static_cast<std::size_t>(i)];
      if (probe.session != moments[row].session ||
          probe.time > moments[row].time) {
        continue;
      }
      filter.Advance(probe.time);
      filter.Update(probe_residuals[i]);
      ++used;
    }
    if (used > 0) filter.Advance(moments[row].time);
    track.offset[static_cast<Index>(row)] = filter.offset();
    track.variance[static_cast<Index>(row)] = filter.variance();
    track.widening[static_cast<Index>(row)] = filter.Widening();
    track.contradicted.push_back(filter.contradicted());
    track.used.push_back(used);
  }
  return track;
}

}  // namespace errmap::models
