#include "stats/comparison/holm.h"

#include <algorithm>
#include <cmath>

namespace errmap::stats {

std::vector<double> AdjustByHolm(const std::vector<double>& p) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!std::isnan(p[i])) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&p](std::size_t a, std::size_t b) {
    return p[a] < p[b];
  });
  std::vector<double> adjusted = p;
  double largest = 0.0;
  for (std::size_t step = 0; step < order.size(); ++step) {
    const double remaining = static_cast<double>(order.size() - step);
    largest = std::max(largest, std::min(1.0, remaining * p[order[step]]));
    adjusted[order[step]] = largest;
  }
  return adjusted;
}

}  // namespace errmap::stats
