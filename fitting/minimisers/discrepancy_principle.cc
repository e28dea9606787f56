#include "fitting/minimisers/discrepancy_principle.h"

#include <cmath>
#include <utility>

#include "stats/require.h"

namespace errmap::fitting {
namespace {

bool EndsTheSearch(const Minimum& minimum) {
  return minimum.summary.termination == Termination::kFailed ||
         minimum.summary.termination == Termination::kInterrupted;
}

}  // namespace

void DiscrepancyRules::Validate() const {
  stats::Require(delta > 0.0 && std::isfinite(delta),
                 "DiscrepancyRules: delta must be above 0",
                 delta);
  stats::Require(alpha0 > 0.0 && std::isfinite(alpha0),
                 "DiscrepancyRules: alpha0 must be above 0",
                 alpha0);
  stats::Require(
      q > 0.0 && q < 1.0, "DiscrepancyRules: q must be between 0 and 1", q);
  stats::Require(least_alpha > 0.0,
                 "DiscrepancyRules: least_alpha must be above 0",
                 least_alpha);
  stats::Require(tolerance > 0.0,
                 "DiscrepancyRules: tolerance must be above 0",
                 tolerance);
}

DiscrepancyChoice ChooseByDiscrepancy(
    const DiscrepancyRules& rules,
    const VectorXd& start,
    const std::function<Minimum(double, const VectorXd&)>& minimize,
    const std::function<double(const VectorXd&)>& misfit) {
  rules.Validate();
  DiscrepancyChoice best;
  bool goes_on = true;
  // Keeps what is within delta at the largest alpha, else the smallest misfit.
  const auto attempt = [&](double alpha, const VectorXd& from) {
    Minimum minimum = minimize(alpha, from);
    const double now = misfit(minimum.x);
    best.steps.push_back({alpha, now});
    goes_on = !EndsTheSearch(minimum);
    const bool reached = now <= rules.delta;
    if (best.steps.size() > 1 && !reached &&
        (best.reached || !(now < best.misfit))) {
      return minimum.x;
    }
    best.alpha = alpha;
    best.misfit = now;
    best.reached = reached;
    best.minimum = std::move(minimum);
    return best.minimum.x;
  };
  VectorXd last = start;
  double alpha = rules.alpha0;
  last = attempt(alpha, last);
  while (goes_on && !best.reached && alpha * rules.q >= rules.least_alpha) {
    alpha *= rules.q;
    last = attempt(alpha, last);
  }
  if (!best.reached) return best;
  // From here on alpha rises, and each fit starts within delta.
  double upper = best.alpha / rules.q;
  while (goes_on && best.steps.size() > 1 && upper <= rules.alpha0) {
    attempt(upper, best.minimum.x);
    if (best.alpha != upper) break;
    upper /= rules.q;
  }
  while (goes_on && best.alpha < rules.alpha0 &&
         upper > best.alpha * (1.0 + rules.tolerance)) {
    const double middle = std::sqrt(upper * best.alpha);
    attempt(middle, best.minimum.x);
    if (best.alpha != middle) upper = middle;
  }
  return best;
}

}  // namespace errmap::fitting
