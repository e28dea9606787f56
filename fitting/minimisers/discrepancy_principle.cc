#include "fitting/minimisers/discrepancy_principle.h"

#include <cmath>
#include <utility>

#include "stats/require.h"

namespace errmap::fitting {
namespace {

// Of alpha_k = alpha0 q^k, Eq. (133), and its search.
constexpr double kFirstAlpha = 0.1;
constexpr double kRatio = 0.25;
constexpr double kLeastAlpha = 1e-12;
constexpr double kTolerance = 0.01;  // relative width of the last bracket

bool EndsTheSearch(const Minimum& minimum) {
  return minimum.summary.termination == Termination::kFailed ||
         minimum.summary.termination == Termination::kInterrupted;
}

}  // namespace

DiscrepancyChoice ChooseByDiscrepancy(
    double delta,
    const VectorXd& start,
    const std::function<Minimum(double, const VectorXd&)>& minimize,
    const std::function<double(const VectorXd&)>& misfit) {
  stats::Require(delta > 0.0 && std::isfinite(delta),
                 "ChooseByDiscrepancy: delta must be above 0",
                 delta);
  DiscrepancyChoice best;
  bool goes_on = true;
  // Keeps what is within delta at the largest alpha, else the smallest misfit.
  const auto attempt = [&](double alpha, const VectorXd& from) {
    Minimum minimum = minimize(alpha, from);
    const double now = misfit(minimum.x);
    best.steps.push_back({alpha, now});
    goes_on = !EndsTheSearch(minimum);
    const bool reached = now <= delta;
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
  double alpha = kFirstAlpha;
  last = attempt(alpha, last);
  while (goes_on && !best.reached && alpha * kRatio >= kLeastAlpha) {
    alpha *= kRatio;
    last = attempt(alpha, last);
  }
  if (!best.reached) return best;
  // From here on alpha rises, and each fit starts within delta.
  double upper = best.alpha / kRatio;
  while (goes_on && best.steps.size() > 1 && upper <= kFirstAlpha) {
    attempt(upper, best.minimum.x);
    if (best.alpha != upper) break;
    upper /= kRatio;
  }
  while (goes_on && best.alpha < kFirstAlpha &&
         upper > best.alpha * (1.0 + kTolerance)) {
    const double middle = std::sqrt(upper * best.alpha);
    attempt(middle, best.minimum.x);
    if (best.alpha != middle) upper = middle;
  }
  return best;
}

}  // namespace errmap::fitting
