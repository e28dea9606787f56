#include "models/netcg/random_weights.h"

#include <algorithm>
#include <cstdlib>

namespace errmap::models {

using Eigen::Index;

Uni::Uni(std::int64_t seed, Digits digits) {
  const int mdig = static_cast<int>(digits);
  const std::int64_t half = std::int64_t{1} << (mdig - 2);
  largest_ = half + (half - 1);
  const std::int64_t m2 = std::int64_t{1} << (mdig / 2);
  std::int64_t jseed = std::min<std::int64_t>(std::abs(seed), largest_);
  if (jseed % 2 == 0) --jseed;
  constexpr std::int64_t kMultiplier = 9069;
  const std::int64_t k0 = kMultiplier % m2;
  const std::int64_t k1 = kMultiplier / m2;
  std::int64_t j0 = jseed % m2;
  std::int64_t j1 = jseed / m2;
  for (std::int64_t& m : m_) {
    jseed = j0 * k0;
    j1 = (jseed / m2 + j0 * k1 + j1 * k0) % (m2 / 2);
    j0 = jseed % m2;
    m = j0 + m2 * j1;
  }
}

float Uni::Next() {
  std::int64_t k = m_[i_] - m_[j_];
  if (k < 0) k += largest_;
  m_[j_] = k;
  i_ = i_ == 0 ? m_.size() - 1 : i_ - 1;
  j_ = j_ == 0 ? m_.size() - 1 : j_ - 1;
  return static_cast<float>(k) / static_cast<float>(largest_);
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

}  // namespace errmap::models
