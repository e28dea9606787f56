#include <algorithm>
#include <cmath>
#include <utility>

#include "models/polynomial/penalized_fit.h"

namespace errmap::models {

SessionOffsets::SessionOffsets(std::vector<Index> sessions,
                               Index num_terms,
                               double between)
    : kept_(std::sqrt(between)), sessions_(std::move(sessions)) {
  const Index count = 1 + std::ranges::max(sessions_);
  sums_ = {MatrixXd::Zero(count, num_terms), VectorXd::Zero(count)};
  weights_ = VectorXd::Zero(count);
}

void SessionOffsets::Include(const std::vector<Index>& rows,
                             const TermRows& design,
                             const VectorXd& weights) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<Index>(i);
    const Index session = sessions_[static_cast<std::size_t>(rows[i])];
    const double weight = weights.size() == 0 ? 1.0 : weights[row];
    weights_[session] += weight;
    sums_.terms.row(session) += weight * design.terms.row(row);
    sums_.targets[session] += weight * design.targets[row];
  }
}

void SessionOffsets::TakeFrom(const std::vector<Index>& rows,
                              TermRows* design) const {
  if (kept_ == 1.0) return;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = static_cast<Index>(i);
    const Index session = sessions_[static_cast<std::size_t>(rows[i])];
    const double share = (1.0 - kept_) / weights_[session];
    design->terms.row(row) -= share * sums_.terms.row(session);
    design->targets[row] -= share * sums_.targets[session];
  }
}

}  // namespace errmap::models
