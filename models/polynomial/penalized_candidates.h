#pragma once

#include <memory>
#include <string>
#include <vector>

#include "models/history/view.h"
#include "models/option_list.h"
#include "models/polynomial/penalized_fit.h"
#include "models/polynomial/polynomial_options.h"

namespace errmap::models {

/// Options of a basis in a SPEC: views, terms, degree, centred, exclude, clip
/// and between.
OptionList<BasisOptions> BasisOptionList();

/// A family over one basis, with its held-out error.
struct BasisCandidate {
  std::shared_ptr<const ViewedRows> viewed;
  std::shared_ptr<const PenalizedFit> fit;
  TermSet terms = TermSet::kLinear;
  int degree = 1;
  Eigen::Index num_excluded = 0;
  bool guarded = false;
  std::string label;  // "ridge, history+zero, squares"
};

/// Returns every penalty over every basis of `options` that these rows allow,
/// in a fixed order; takes from context.shared what is there. Throws
/// std::invalid_argument if no basis is possible.
std::vector<BasisCandidate> JudgeBases(
    const data::Dataset& training,
    const BasisOptions& options,
    const PenaltyRule& rule,
    const std::vector<fitting::Penalty>& penalties,
    const InnerFolds& folds,
    const FitContext& context);

}  // namespace errmap::models
