#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "fitting/minimisers/objective.h"

namespace errmap::testing {

/// Counts and keeps what it is asked, itself. It has no Path of its own, so a
/// curvature is two gradients.
class WatchedObjective final : public fitting::Objective {
 public:
  explicit WatchedObjective(const fitting::Objective& objective)
      : objective_(objective) {}

  Eigen::Index num_parameters() const override {
    return objective_.num_parameters();
  }

  double Evaluate(const Vector& x, Vector* gradient) const override {
    ++(gradient == nullptr ? values_ : gradients_);
    const double value = objective_.Evaluate(x, gradient);
    points_.push_back(x);
    costs_.push_back(value);
    const bool feasible =
        std::isfinite(value) && (gradient == nullptr || gradient->allFinite());
    has_seen_infeasible_ = has_seen_infeasible_ || (x.allFinite() && !feasible);
    if (after_each_) after_each_();
    return value;
  }

  void AfterEach(std::function<void()> action) {
    after_each_ = std::move(action);
  }
  std::int64_t values() const { return values_; }
  std::int64_t gradients() const { return gradients_; }
  std::int64_t evaluations() const { return values_ + gradients_; }
  /// Whether a finite point had a value or gradient that is not.
  bool has_seen_infeasible() const { return has_seen_infeasible_; }
  const std::vector<Eigen::VectorXd>& points() const { return points_; }
  const std::vector<double>& costs() const { return costs_; }

 private:
  const fitting::Objective& objective_;
  std::function<void()> after_each_;
  mutable std::int64_t values_ = 0;
  mutable std::int64_t gradients_ = 0;
  mutable std::vector<Eigen::VectorXd> points_;
  mutable std::vector<double> costs_;
  mutable bool has_seen_infeasible_ = false;
};

}  // namespace errmap::testing
