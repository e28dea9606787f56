#include "stats/normality/bimodality.h"

#include <algorithm>
#include <vector>

#include "stats/normality/simulated_quantiles.h"

namespace errmap::stats {
namespace {

using Vertices = std::vector<Index>;

// Slope of the chord between two values' steps; 0 for a vertical one, whose
// points all lie at its foot.
double Slope(const VectorXd& x, Index from, Index to) {
  const double width = x[to] - x[from];
  return width > 0.0 ? static_cast<double>(to - from) / width : 0.0;
}

// Vertices from `low` to `high`, ascending, of the hull of the points (x_i, i):
// below them (the greatest convex minorant) or above (the least concave
// majorant). One pass with a stack.
Vertices Hull(const VectorXd& x, Index low, Index high, bool below) {
  Vertices hull;
  for (Index i = low; i <= high; ++i) {
    while (hull.size() >= 2) {
      const Index last = hull[hull.size() - 1];
      const Index before = hull[hull.size() - 2];
      const double turn =
          (x[last] - x[before]) * static_cast<double>(i - last) -
          (x[i] - x[last]) * static_cast<double>(last - before);
      if (below ? turn > 0.0 : turn < 0.0) break;
      hull.pop_back();
    }
    hull.push_back(i);
  }
  return hull;
}

// The place where majorant and minorant are farthest apart.
struct WidestGap {
  double width = 0.0;        // in steps of 1/n
  std::size_t minorant = 0;  // last vertex of the minorant before it
  std::size_t majorant = 0;  // first vertex of the majorant behind it
};

WidestGap FindWidestGap(const VectorXd& x,
                        const Vertices& minorant,
                        const Vertices& majorant) {
  if (minorant.size() == 2 && majorant.size() == 2) {
    return {.width = 1.0, .minorant = 0, .majorant = 1};
  }
  WidestGap widest;
  std::size_t g = 1;
  std::size_t h = 1;
  do {
    const Index below = minorant[g];
    const Index above = majorant[h];
    if (below > above) {  // at a vertex of the majorant
      const Index from = minorant[g - 1];
      const double gap = static_cast<double>(above - from + 1) -
                         (x[above] - x[from]) * Slope(x, from, below);
      if (gap >= widest.width) widest = {gap, g - 1, h};
      ++h;
    } else {
      const Index from = majorant[h - 1];
      const double gap = (x[below] - x[from]) * Slope(x, from, above) -
                         static_cast<double>(below - from - 1);
      if (gap >= widest.width) widest = {gap, g, h};
      ++g;
    }
    g = std::min(g, minorant.size() - 1);
    h = std::min(h, majorant.size() - 1);
  } while (minorant[g] != majorant[h]);
  return widest;
}

// Largest distance of the steps from the minorant between its vertices `first`
// and `last`, or from the majorant.
double LargestDeparture(const VectorXd& x,
                        const Vertices& hull,
                        std::size_t first,
                        std::size_t last,
                        bool below) {
  double largest = 0.0;
  for (std::size_t v = first; v < last; ++v) {
    const Index from = hull[v];
    const double slope = Slope(x, from, hull[v + 1]);
    double departure = 1.0;
    for (Index i = from; i <= hull[v + 1]; ++i) {
      const double chord = (x[i] - x[from]) * slope;
      const double steps = static_cast<double>(i - from);
      departure = std::max(departure,
                           below ? steps + 1.0 - chord : chord - steps + 1.0);
    }
    largest = std::max(largest, departure);
  }
  return largest;
}

}  // namespace

double DipStatistic(const Eigen::Ref<const VectorXd>& ascending) {
  const Index n = ascending.size();
  if (n == 0) return 0.0;
  const VectorXd x = ascending;
  Index low = 0;
  Index high = n - 1;
  double twice_dip = 1.0;  // in steps of 1/n
  while (n > 1 && x[low] < x[high]) {
    const Vertices minorant = Hull(x, low, high, true);
    const Vertices majorant = Hull(x, low, high, false);
    const WidestGap gap = FindWidestGap(x, minorant, majorant);
    if (gap.width < twice_dip) break;
    twice_dip =
        std::max({twice_dip,
                  LargestDeparture(x, minorant, 0, gap.minorant, true),
                  LargestDeparture(
                      x, majorant, gap.majorant, majorant.size() - 1, false)});
    // The modal interval shrinks to the gap.
    const Index new_low = minorant[gap.minorant];
    const Index new_high = majorant[gap.majorant];
    if (new_low == low && new_high == high) break;
    low = new_low;
    high = new_high;
  }
  return twice_dip / (2.0 * static_cast<double>(n));
}

double DipProbability(double dip, Index n) {
  if (n < kFewestSimulated) return 1.0;
  return SimulatedProbability(SimulatedStatistic::kDip, dip, n);
}

}  // namespace errmap::stats
