#include "fitting/minimisers/cost_resolution.h"

#include <cstdio>

namespace errmap::fitting {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Largest difference of the cost over moves of a few units in the last place,
// of each move and its opposite the smaller: a step of the cost, which a run
// may stand right before, shows on one side. NaN where neither is finite or an
// evaluation is refused.
double Rounding(const Objective& f,
                const VectorXd& x,
                double cost,
                const std::function<bool()>& may_evaluate) {
  constexpr int kPairs = 4;
  double largest = std::abs(cost) * kEpsilon;
  VectorXd moved = x;
  for (int pair = 1; pair <= kPairs; ++pair) {
    double smaller = std::nan("");
    for (const double side : {1.0, -1.0}) {
      for (Index i = 0; i < x.size(); ++i) {
        // One to three units up or down, in another pattern each time.
        const auto pattern = static_cast<double>((i * (2 * pair + 1)) % 7 - 3);
        moved[i] = x[i] * (1.0 + side * pattern * kEpsilon);
      }
      if (!may_evaluate()) return std::nan("");
      // fmin leaves NaN out.
      smaller = std::fmin(smaller, std::abs(f.Evaluate(moved, nullptr) - cost));
    }
    if (!std::isfinite(smaller)) return std::nan("");
    largest = std::max(largest, smaller);
  }
  return largest;
}

// H times a vector by central differences of the gradient at x.
class HessianProduct {
 public:
  HessianProduct(const Objective& f,
                 const VectorXd& x,
                 const std::function<bool()>& may_evaluate)
      : f_(f),
        x_(x),
        may_evaluate_(may_evaluate),
        difference_(std::cbrt(kEpsilon) * std::max(1.0, x.norm())) {}

  // Returns false if an evaluation is refused or not finite.
  bool Apply(const VectorXd& v, VectorXd* product) {
    const double h = difference_ / v.norm();
    if (!may_evaluate_()) return false;
    const double cost_above = f_.Evaluate(x_ + h * v, &above_);
    if (!may_evaluate_()) return false;
    const double cost_below = f_.Evaluate(x_ - h * v, &below_);
    *product = (above_ - below_) / (2.0 * h);
    return std::isfinite(cost_above + cost_below) && product->allFinite();
  }

 private:
  const Objective& f_;
  const VectorXd& x_;
  const std::function<bool()>& may_evaluate_;
  double difference_;
  VectorXd above_;
  VectorXd below_;
};

// Conjugate gradients on H d = b, step by step.
class ConjugateSteps {
 public:
  ConjugateSteps(HessianProduct* hessian, const VectorXd& b)
      : hessian_(hessian), rest_(b), direction_(b) {}

  double rest() const { return rest_.norm(); }
  // d'Hd / d'd along the direction taken last.
  double curvature() const { return curvature_; }
  // Contribution of the last step to 1/2 b'd.
  double gain() const { return gain_; }

  // Returns false if H d is unknown. Do not call it after a curvature that was
  // not positive.
  bool Step() {
    const double squared = rest_.squaredNorm();
    if (!hessian_->Apply(direction_, &turned_)) return false;
    const double along = direction_.dot(turned_);
    curvature_ = along / direction_.squaredNorm();
    const double length = squared / along;
    gain_ = 0.5 * length * squared;
    rest_ -= length * turned_;
    direction_ = rest_ + (rest_.squaredNorm() / squared) * direction_;
    return true;
  }

 private:
  HessianProduct* hessian_;
  VectorXd rest_;
  VectorXd direction_;
  VectorXd turned_;
  double curvature_ = 0.0;
  double gain_ = 0.0;
};

constexpr Index kMostSteps = 500;

// 1/2 g'H^-1 g; infinite if it exceeds `limit` or is unknown.
double NewtonDecrease(HessianProduct* hessian,
                      const VectorXd& gradient,
                      double limit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kSolved = 0.1;
  const double enough = kSolved * gradient.norm();
  ConjugateSteps steps(hessian, -gradient);
  double promised = 0.0;
  for (Index step = 0; steps.rest() > enough; ++step) {
    if (step == std::min(2 * gradient.size(), kMostSteps) || !steps.Step() ||
        !(steps.curvature() > 0.0)) {
      return kInfinity;
    }
    promised += steps.gain();
    if (!(promised <= limit)) return kInfinity;
  }
  return promised;
}

// Returns true if f curves down somewhere, unseen by a symmetric gradient:
// starts from a direction with a part in every other. Returns false if it
// curves down by less than the differences can tell.
bool CurvesDown(HessianProduct* hessian, Index n) {
  constexpr Index kEnoughSteps = 100;
  constexpr double kSolved = 1e-3;
  constexpr double kResolved = 1e-6;
  VectorXd b(n);
  for (Index i = 0; i < n; ++i) b[i] = std::sin(1.0 + static_cast<double>(i));
  ConjugateSteps steps(hessian, b);
  const double enough = kSolved * b.norm();
  double largest = 0.0;
  for (Index step = 0; step < std::min(n, kEnoughSteps); ++step) {
    if (!steps.Step()) return true;
    largest = std::max(largest, std::abs(steps.curvature()));
    if (!(steps.curvature() > kResolved * largest)) {
      return steps.curvature() < -kResolved * largest;
    }
    if (steps.rest() <= enough) return false;
  }
  return false;
}

// Returns `remaining` at x; infinity if H is found to curve down.
double Remaining(const Objective& f,
                 const VectorXd& x,
                 const VectorXd& gradient,
                 double limit,
                 const std::function<bool()>& may_evaluate) {
  HessianProduct hessian(f, x, may_evaluate);
  const double remaining = NewtonDecrease(&hessian, gradient, limit);
  return std::isfinite(remaining) && CurvesDown(&hessian, x.size())
             ? std::numeric_limits<double>::infinity()
             : remaining;
}

// f of parameters as shares of their own size.
class InShares final : public Objective {
 public:
  InShares(const Objective& f, const VectorXd& sizes) : f_(f), sizes_(sizes) {}
  Index num_parameters() const override { return sizes_.size(); }
  double Evaluate(const VectorXd& shares, VectorXd* gradient) const override {
    const double cost = f_.Evaluate(sizes_.cwiseProduct(shares), gradient);
    if (gradient != nullptr) gradient->array() *= sizes_.array();
    return cost;
  }

 private:
  const Objective& f_;
  VectorXd sizes_;
};

}  // namespace

std::string CostResolution::Text() const {
  char text[128];
  std::snprintf(text,
                sizeof text,
                "a minimum at the resolution of the cost: no step lowers it, "
                "Newton's promises %.0e of %.2e",
                remaining,
                cost);
  return text;
}

CostResolution FindCostResolution(const Objective& f,
                                  const VectorXd& x,
                                  const std::function<bool()>& may_evaluate) {
  CostResolution result;
  VectorXd gradient;
  if (!may_evaluate()) return result;
  result.cost = f.Evaluate(x, &gradient);
  result.rounding = Rounding(f, x, result.cost, may_evaluate);
  if (!std::isfinite(result.rounding) || !gradient.allFinite()) return result;
  double remaining = Remaining(f, x, gradient, result.limit(), may_evaluate);
  // A few parameters may be of units so different that what one of them still
  // promises is lost in the gradient of another.
  constexpr Index kMostOfUnits = 100;
  if (std::isfinite(remaining) && x.size() <= kMostOfUnits) {
    const VectorXd sizes = (x.array() != 0.0).select(x.cwiseAbs(), 1.0);
    const double in_shares = Remaining(InShares(f, sizes),
                                       x.cwiseQuotient(sizes),
                                       sizes.cwiseProduct(gradient),
                                       result.limit(),
                                       may_evaluate);
    remaining = std::max(remaining, in_shares);
  }
  result.remaining = remaining;
  return result;
}

void StopWithoutDescent(const Objective& f,
                        const VectorXd& x,
                        const std::function<bool()>& spend,
                        const std::string& why,
                        RunMonitor* monitor) {
  const CostResolution resolution = FindCostResolution(f, x, spend);
  if (monitor->stopped()) return;
  if (resolution.is_reached()) {
    monitor->Stop(Termination::kResolution, resolution.Text());
  } else {
    monitor->Stop(Termination::kNoDescent, why);
  }
}

}  // namespace errmap::fitting
