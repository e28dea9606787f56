#include "cli/netcg/netcg_run.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

#include "cli/netcg/netcg_objective.h"
#include "fitting/minimisers/ordered_sums.h"
#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "stats/kolmogorov_smirnov.h"
#include "stats/normality/lilliefors.h"
#include "stats/not_a_number.h"
#include "stats/report_1995.h"
#include "stats/summary.h"

namespace errmap::netcg {
namespace {

// The program maps targets to 0.01 .. 0.99.
constexpr double kTargetRange = 0.98;
constexpr double kTargetTop = 0.99;

[[noreturn]] void Refuse(const std::string& why) {
  throw std::invalid_argument("RunNetcg: " + why);
}

fitting::ScaledConjugateGradientOptions OptionsOf(
    const NetcgSpecification& specification) {
  fitting::ScaledConjugateGradientOptions options;
  options.variant = fitting::ScgVariant::kNetcg;
  options.stopping.iterations = specification.iterations;
  // Nothing is below a goal of 0 or less.
  options.stopping.cost_goal = std::max(0.0, specification.egoal);
  options.stopping.gradient_goal = std::max(0.0, specification.gwgoal);
  options.stopping.progress_interval = specification.nfreq;
  options.stopping.slow_ratio = specification.errdel;
  return options;
}

int IerrOf(fitting::Termination termination) {
  switch (termination) {
    case fitting::Termination::kCostGoal:
      return 0;
    case fitting::Termination::kIterationLimit:
      return 1;
    case fitting::Termination::kGradient:
      return 2;
    default:
      return 3;
  }
}

// One run in one precision; the steps are those of the main program.
template <typename Scalar>
class Program {
 public:
  using Matrix = stats::MatrixOf<Scalar>;
  using Vector = stats::VectorOf<Scalar>;

  Program(const NetcgSpecification& specification, const NetcgData& data)
      : specification_(specification),
        target_(data.targets.template cast<Scalar>()) {
    tmax_ = target_.maxCoeff();
    const Scalar tmin = target_.minCoeff();
    if (!(tmax_ > tmin)) Refuse("the targets do not vary");
    slope_ = Scalar(kTargetRange) / (tmax_ - tmin);
    target_ = slope_ * (target_.array() - tmax_) + Scalar(kTargetTop);
    w_ = data.initial_weights.size() > 0
             ? Vector(data.initial_weights.template cast<Scalar>())
             : Vector(RandomWeights(specification.inputs,
                                    specification.hidden,
                                    specification.outputs,
                                    specification.seed)
                          .template cast<Scalar>());
    result_.scaling.slope = static_cast<double>(slope_);
    result_.scaling.offset =
        kTargetTop - static_cast<double>(slope_) * static_cast<double>(tmax_);
  }

  NetcgResult Run(const MatrixXd& inputs) {
    const NetcgObjective<Scalar> objective(inputs.template cast<Scalar>(),
                                           target_,
                                           specification_.hidden,
                                           specification_.wfactor);
    if (w_.size() != objective.num_parameters()) {
      Refuse("weights and nodes do not agree in size");
    }
    if (specification_.is_training()) Train(objective);
    // The last call of FUNC.
    Vector gradient(w_.size());
    result_.error = static_cast<double>(objective.Evaluate(w_, &gradient));
    if (specification_.is_training()) {
      result_.gradient_ratio =
          static_cast<double>(fitting::OrderedNorm<Scalar>(gradient) /
                              fitting::OrderedNorm<Scalar>(w_));
    }
    result_.weights = w_.template cast<double>();
    scaled_outputs_ = objective.Outputs(w_);
    Print();
    return std::move(result_);
  }

  const Matrix& scaled_outputs() const { return scaled_outputs_; }

 private:
  void Train(const NetcgObjective<Scalar>& objective) {
    const Vector wsav = w_;
    const fitting::Minimum minimum =
        fitting::BasicScaledConjugateGradient<Scalar>(OptionsOf(specification_))
            .Minimize(objective, w_, {.keep_trace = true});
    result_.summary = minimum.summary;
    if (result_.summary.termination == fitting::Termination::kFailed) {
      Refuse(result_.summary.message);
    }
    w_ = minimum.x.template cast<Scalar>();
    result_.ierr = IerrOf(result_.summary.termination);
    result_.iterations = result_.summary.iterations;
    result_.function_calls = result_.summary.evaluations() + 1;
    for (std::size_t k = 0; k + 1 < result_.summary.trace.size(); ++k) {
      result_.error_curve.push_back(static_cast<double>(
          static_cast<Scalar>(result_.summary.trace[k].rms_error)));
    }
    result_.weight_change =
        static_cast<double>(fitting::OrderedNorm<Scalar>(wsav - w_) /
                            std::sqrt(static_cast<Scalar>(w_.size())));
  }

  Matrix InUnits(const Matrix& scaled) const {
    return tmax_ + (scaled.array() - Scalar(kTargetTop)) / slope_;
  }

  void Print() {
    const Matrix desired = InUnits(target_);
    const Matrix predicted = InUnits(scaled_outputs_);
    const Matrix errors = desired - predicted;
    const stats::Report1995Statistics statistics =
        stats::StatisticsOf1995(errors);
    NetcgFigures& printed = result_.printed;
    printed.desired = desired.template cast<double>();
    printed.predicted = predicted.template cast<double>();
    printed.errors = errors.template cast<double>();
    printed.mean = statistics.mean;
    printed.sd = statistics.sd;
    printed.min = statistics.min;
    printed.max = statistics.max;
    printed.ks_d = statistics.ks_d;
    printed.ks_p = statistics.ks_probability;
    printed.r2 = stats::RSquaredOf1995(desired, predicted);
  }

  const NetcgSpecification& specification_;
  Matrix target_;  // scaled
  Scalar tmax_ = 0;
  Scalar slope_ = 0;
  Vector w_;
  Matrix scaled_outputs_;
  NetcgResult result_;
};

NetcgFigures Correct(const NetcgData& data,
                     const models::TargetScaling& scaling,
                     const MatrixXd& scaled_outputs) {
  NetcgFigures figures;
  figures.desired = data.scale * data.targets;
  figures.predicted =
      data.scale * (scaled_outputs.array() - scaling.offset) / scaling.slope;
  figures.errors = figures.desired - figures.predicted;
  const stats::SampleSummary summary =
      stats::Summarize(figures.errors.reshaped());
  figures.mean = summary.mean;
  figures.sd = summary.sd;
  figures.min = summary.min;
  figures.max = summary.max;
  const double total =
      (figures.desired.array() - figures.desired.mean()).square().sum();
  figures.r2 = 1.0 - figures.errors.squaredNorm() / total;
  const VectorXd first = figures.errors.col(0);
  const stats::SampleSummary of_first = stats::Summarize(first);
  figures.ks_d = stats::KsDistanceFromNormal(first, of_first.mean, of_first.sd);
  constexpr Index kLeastForLilliefors = 4;
  figures.ks_p =
      first.size() >= kLeastForLilliefors && std::isfinite(figures.ks_d)
          ? stats::LillieforsProbability(figures.ks_d, first.size())
          : stats::kNaN;
  return figures;
}

template <typename Scalar>
NetcgResult RunIn(const NetcgSpecification& specification,
                  const NetcgData& data) {
  Program<Scalar> program(specification, data);
  NetcgResult result = program.Run(data.inputs);
  const bool knows_scaling =
      specification.is_training() || data.training_scaling.has_value();
  result.corrected_scaling =
      knows_scaling ? NetcgScaling::kTraining : NetcgScaling::kTestFile;
  const models::TargetScaling scaling =
      specification.is_training() || !data.training_scaling
          ? result.scaling
          : *data.training_scaling;
  result.corrected =
      Correct(data, scaling, program.scaled_outputs().template cast<double>());
  return result;
}

constexpr std::int64_t kLargest = 0x7fffffff;
constexpr std::int64_t kM2 = 0x10000;

}  // namespace

std::string_view ToString(NetcgPrecision precision) {
  return precision == NetcgPrecision::kSingle ? "single" : "double";
}

NetcgResult RunNetcg(const NetcgSpecification& specification,
                     const NetcgData& data,
                     NetcgPrecision precision) {
  if (data.inputs.rows() != specification.patterns ||
      data.inputs.cols() != specification.inputs ||
      data.targets.rows() != specification.patterns ||
      data.targets.cols() != specification.outputs ||
      (data.initial_weights.size() != 0 &&
       data.initial_weights.size() != specification.num_weights())) {
    Refuse("patterns, weights and nodes do not agree in size");
  }
  return precision == NetcgPrecision::kSingle
             ? RunIn<float>(specification, data)
             : RunIn<double>(specification, data);
}

Uni::Uni(std::int64_t seed) {
  std::int64_t jseed = std::min<std::int64_t>(std::abs(seed), kLargest);
  if (jseed % 2 == 0) --jseed;
  constexpr std::int64_t kMultiplier = 9069;
  const std::int64_t k0 = kMultiplier % kM2;
  const std::int64_t k1 = kMultiplier / kM2;
  std::int64_t j0 = jseed % kM2;
  std::int64_t j1 = jseed / kM2;
  for (std::int64_t& m : m_) {
    jseed = j0 * k0;
    j1 = (jseed / kM2 + j0 * k1 + j1 * k0) % (kM2 / 2);
    j0 = jseed % kM2;
    m = j0 + kM2 * j1;
  }
}

float Uni::Next() {
  std::int64_t k = m_[i_] - m_[j_];
  if (k < 0) k += kLargest;
  m_[j_] = k;
  i_ = i_ == 0 ? m_.size() - 1 : i_ - 1;
  j_ = j_ == 0 ? m_.size() - 1 : j_ - 1;
  return static_cast<float>(k) / static_cast<float>(kLargest);
}

Eigen::VectorXf RandomWeights(Index inputs,
                              Index hidden,
                              Index outputs,
                              std::int64_t seed) {
  Uni uni(seed);
  uni.Next();
  Eigen::VectorXf w(hidden * (inputs + 1) + outputs * (hidden + 1));
  const auto draw = [&](Index offset, Index nodes, Index sources) {
    for (Index to = 0; to < nodes; ++to) {
      for (Index from = 0; from < sources; ++from) {
        w[offset + from * nodes + to] = uni.Next() - 0.5F;
      }
    }
  };
  draw(0, hidden, inputs + 1);
  draw(hidden * (inputs + 1), outputs, hidden + 1);
  return w;
}

}  // namespace errmap::netcg
