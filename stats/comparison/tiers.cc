#include "stats/comparison/tiers.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "stats/indices.h"
#include "stats/require.h"

namespace errmap::stats {
namespace {

void Check(const VectorXd& rmse, const MatrixXd& bounds) {
  if (bounds.rows() != rmse.size() || bounds.cols() != rmse.size()) {
    throw std::invalid_argument("FormTiers: bounds of " +
                                std::to_string(bounds.rows()) + " x " +
                                std::to_string(bounds.cols()) + " models for " +
                                std::to_string(rmse.size()) + " RMSE");
  }
  if (!rmse.allFinite()) {
    throw std::invalid_argument("FormTiers: an RMSE is not finite");
  }
}

bool IsEqual(double rmse, double best) {
  constexpr double kTieRounding = 1e-12;
  return rmse <= best * (1.0 + kTieRounding);
}

}  // namespace

double Margin::Of(double best_rmse) const {
  return std::max(share * best_rmse, indifference);
}

void Margin::Validate() const {
  Require(share >= 0.0 && std::isfinite(share),
          "Margin: share must be finite and at least 0",
          share);
  Require(indifference >= 0.0 && std::isfinite(indifference),
          "Margin: indifference must be finite and at least 0",
          indifference);
}

std::vector<std::vector<Index>> FormTiers(const VectorXd& rmse,
                                          const MatrixXd& excess_at_most,
                                          const Margin& margin) {
  Check(rmse, excess_at_most);
  margin.Validate();
  std::vector<Index> left = AllIndices(rmse.size());
  std::stable_sort(left.begin(), left.end(), [&rmse](Index a, Index b) {
    return rmse[a] < rmse[b];
  });
  std::vector<std::vector<Index>> tiers;
  while (!left.empty()) {
    const Index best = left.front();
    const double allowed = margin.Of(rmse[best]);
    const auto others =
        std::stable_partition(left.begin(), left.end(), [&](Index model) {
          return IsEqual(rmse[model], rmse[best]) ||
                 excess_at_most(model, best) <= allowed;
        });
    tiers.emplace_back(left.begin(), others);
    left.erase(left.begin(), others);
  }
  return tiers;
}

}  // namespace errmap::stats
