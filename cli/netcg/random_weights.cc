#include "cli/netcg/random_weights.h"

#include <algorithm>
#include <cstdlib>

namespace errmap::netcg {
namespace {

constexpr std::int64_t kLargest = 0x7fffffff;
constexpr std::int64_t kM2 = 0x10000;

}  // namespace

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
