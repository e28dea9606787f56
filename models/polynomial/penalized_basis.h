#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "fitting/least_squares/cross_products.h"
#include "fitting/least_squares/penalized_path.h"
#include "models/error_model.h"
#include "models/history/view.h"
#include "models/inner_folds.h"
#include "models/polynomial/formula.h"
#include "models/polynomial/polynomial_design.h"
#include "models/polynomial/polynomial_options.h"
#include "models/polynomial/session_offsets.h"
#include "models/polynomial/term_set.h"

namespace errmap::models {

/// How much of its trained range an input may leave it by before a shrunk map
/// stops bending in it. Beyond, a parabola foretells nothing, while a straight
/// line of the same data still holds: measured in promise/measured.md. Exact
/// least squares (Eq. 7 to 9 and their kin) stay what they are as far as their
/// guards let them.
inline constexpr double kBendMargin = 0.1;

/// Terms over rows in one view, for ridge and lasso. Products are of inputs
/// standardised over the training rows (mean 0, sd 1) unless `centring` says
/// otherwise, and the columns are standardised again in each fit.
struct PenalizedBasis {
  TermSet terms = TermSet::kLinear;
  int degree = 1;
  Centring centring = Centring::kStandardised;
  std::vector<NamedTerm> exclude;
  bool guarded = false;  // inputs and predictions clipped at the trained range
  /// Weight of what differs between sessions, above 0 and at most 1
  /// (SessionOffsets); less than 1 takes folds of whole sessions.
  double between = 1.0;
};

/// Where a set of rows lies: their scaled inputs and their target.
struct RowRanges {
  explicit RowRanges(Eigen::Index inputs);

  void Include(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& targets);
  void Include(const RowRanges& other);

  Eigen::VectorXd input_min;  // (inputs) NaN without rows, as all
  Eigen::VectorXd input_max;
  double error_min;
  double error_max;
};

/// Cross-products of a basis over each inner fold, from one pass over the rows:
/// all that its penalties need of them.
class SummedBasis {
 public:
  using Rows = std::vector<Eigen::Index>;

  /// `folds` are needed where the penalty is to be chosen by them; null where
  /// it is given. Throws std::invalid_argument on too many terms or folds that
  /// are missing; interrupted by context.stop with FitInterrupted's message.
  SummedBasis(std::shared_ptr<const ViewedRows> viewed,
              const PenalizedBasis& basis,
              const InnerFolds* folds,
              const FitContext& context);

  const PolynomialDesign& design() const { return design_; }
  /// Nothing where the penalty is given.
  const std::optional<InnerFolds>& inner() const { return folds_; }

  /// Of all rows, or of those that predict a fold.
  fitting::PenalizedPath PathOf(fitting::Penalty penalty,
                                std::optional<Eigen::Index> fold) const;
  /// A path's solutions for `strengths`, falling, with the errors' intercepts:
  /// the rows are fitted less a share of their offsets.
  fitting::PenalizedPath::Solutions Solve(
      const fitting::PenalizedPath& path,
      const std::vector<double>& strengths) const;
  /// A ridge's to all rows for a strength above 0, to full precision.
  fitting::PenalizedPath::Solutions SolveRefined(
      const fitting::PenalizedPath& path, double strength) const;

  /// Gives `take` rows of a fold and their predictions (rows x solutions), some
  /// after the other, clipped where guarded.
  void PredictFold(
      Eigen::Index fold,
      const fitting::PenalizedPath::Solutions& solutions,
      const std::function<void(const Rows&, const Eigen::MatrixXd&)>& take)
      const;

  Eigen::VectorXd Targets(const Rows& rows) const;
  Eigen::VectorXd Weights(const Rows& rows) const;  // (0): all 1

 private:
  // Whether the rows of fold `of` are among those that predict `fold`.
  bool Predicts(Eigen::Index of, Eigen::Index fold) const;
  // Of the rows that predict a fold.
  fitting::CrossProducts TrainingOf(Eigen::Index fold) const;
  Eigen::MatrixXd Inputs(const Rows& rows) const;  // scaled
  Eigen::MatrixXd Terms(const Eigen::MatrixXd& inputs) const;
  // Terms that bend see inputs held near where the fold was trained, as in
  // MapOfCandidate.
  Eigen::MatrixXd GuardedTerms(const Eigen::MatrixXd& inputs,
                               const RowRanges& trained) const;
  TermRows RowsAsMeasured(const Rows& rows) const;
  TermRows RowsAsFitted(const Rows& rows) const;
  void ForBlocks(const Rows& rows,
                 const std::function<void(const Rows&)>& work) const;

  std::shared_ptr<const ViewedRows> viewed_;
  PolynomialDesign design_;
  std::vector<bool> excluded_;
  bool guarded_;
  const std::atomic<bool>* stop_;
  std::optional<InnerFolds> folds_;
  SessionOffsets offsets_;
  std::vector<Rows> members_;  // of each fold
  std::vector<fitting::CrossProducts> sums_;
  std::vector<RowRanges> ranges_;
  fitting::CrossProducts all_;
};

}  // namespace errmap::models
