#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "models/history/view.h"
#include "models/polynomial/penalized_basis.h"

namespace errmap::models {

/// Bases that a penalised family may take, and how its penalty is chosen: what
/// a SPEC of poly:ridge, poly:lasso and blend says of them.
struct PenalizedChoices {
  ViewOptions view;
  std::optional<TermSet> terms;  // empty: those that serve, where a view is
                                 // given, else full
  int degree = 0;                // 0: that of the terms
  Centring centring = Centring::kStandardised;
  std::vector<NamedTerm> exclude;
  std::optional<bool> clip;  // empty: where a view is given
  PenaltyRule rule;

  /// Takes view options, terms, degree, centred, exclude and clip.
  static PenalizedChoices Take(SpecOptions* options);
  void Describe(std::vector<EffectiveOption>* options) const;

  /// Whether more than one basis may be judged.
  bool chooses_basis() const;
  bool guarded() const { return clip.value_or(view.given); }
};

/// A family over one basis, judged.
struct BasisCandidate {
  std::shared_ptr<const ViewedRows> viewed;
  std::shared_ptr<const PenalizedFit> fit;
  TermSet terms = TermSet::kLinear;
  int degree = 1;
  Eigen::Index num_excluded = 0;
  bool guarded = false;
  std::string label;  // "ridge, history+zero, squares"
};

/// Every penalty over every basis of `choices` that these rows allow, in a
/// fixed order; what context.shared has is taken from there. Throws
/// std::invalid_argument where no basis is possible.
std::vector<BasisCandidate> JudgeBases(
    const data::Dataset& training,
    const PenalizedChoices& choices,
    const std::vector<fitting::Penalty>& penalties,
    const InnerFolds& folds,
    const FitContext& context);

}  // namespace errmap::models
