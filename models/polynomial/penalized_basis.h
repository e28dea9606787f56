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

/// Share of its trained range by which an input may exceed it before a shrunk
/// map becomes straight in it. Beyond, a parabola predicts nothing useful,
/// while a straight line through the same data still holds: measured in
/// uncertainty/measured.md. Exact least squares (Eq. 7 to 9 and similar) are
/// limited only by their guards.
inline constexpr double kBendMargin = 0.1;

/// Terms over rows in one view, for ridge and lasso. Products are formed from
/// inputs standardised over the training rows (mean 0, sd 1), unless `centring`
/// says otherwise. Each fit standardises the columns again.
struct PenalizedBasis {
  TermSet terms = TermSet::kLinear;
  int degree = 1;
  Centring centring = Centring::kStandardised;
  std::vector<NamedTerm> exclude;
  bool guarded = false;  // inputs and predictions clipped at the trained range
  /// Weight of differences between sessions, above 0 and at most 1
  /// (SessionOffsets). Values below 1 need folds of whole sessions.
  double between = 1.0;
};

/// Ranges of a set of rows: of their scaled inputs and their target.
struct RowRanges {
  explicit RowRanges(Eigen::Index inputs);

  void Include(const Eigen::MatrixXd& inputs, const Eigen::VectorXd& targets);
  void Include(const RowRanges& other);

  Eigen::VectorXd input_min;  // (inputs) all four are NaN without rows
  Eigen::VectorXd input_max;
  double error_min;
  double error_max;
};

/// Cross-products of a basis over each inner fold, from one pass over the rows:
/// its penalties need nothing else of the rows.
class SummedBasis {
 public:
  using Rows = std::vector<Eigen::Index>;

  /// `folds` are needed if they choose the penalty; null if it is given. Throws
  /// std::invalid_argument for too many terms or missing folds, and with
  /// FitInterrupted's message if context.stop interrupts it.
  SummedBasis(std::shared_ptr<const ViewedRows> viewed,
              const PenalizedBasis& basis,
              const InnerFolds* folds,
              const FitContext& context);

  const PolynomialDesign& design() const { return design_; }
  /// Empty if the penalty is given.
  const std::optional<InnerFolds>& inner() const { return folds_; }

  /// Returns the path for all rows, or for those that predict a fold.
  fitting::PenalizedPath PathOf(fitting::Penalty penalty,
                                std::optional<Eigen::Index> fold) const;
  /// Returns a path's solutions for `strengths`, descending. Rows are fitted
  /// less a share of their offsets; the intercepts are those of the errors.
  fitting::PenalizedPath::Solutions Solve(
      const fitting::PenalizedPath& path,
      const std::vector<double>& strengths) const;
  /// Returns a ridge's solution for all rows, strength > 0, to full precision.
  fitting::PenalizedPath::Solutions SolveRefined(
      const fitting::PenalizedPath& path, double strength) const;

  /// Calls `take` with rows of a fold and their predictions (rows x solutions),
  /// block by block, clipped if guarded.
  void PredictFold(
      Eigen::Index fold,
      const fitting::PenalizedPath::Solutions& solutions,
      const std::function<void(const Rows&, const Eigen::MatrixXd&)>& take)
      const;

  Eigen::VectorXd Targets(const Rows& rows) const;
  Eigen::VectorXd Weights(const Rows& rows) const;  // (0): all 1

 private:
  // True if the rows of fold `of` are among those that predict `fold`.
  bool Predicts(Eigen::Index of, Eigen::Index fold) const;
  // Sums over the rows that predict a fold.
  fitting::CrossProducts TrainingOf(Eigen::Index fold) const;
  Eigen::MatrixXd Inputs(const Rows& rows) const;  // scaled
  Eigen::MatrixXd Terms(const Eigen::MatrixXd& inputs) const;
  // Terms with powers see inputs clipped near the range of the fold's training
  // rows, as in MapOfCandidate.
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
  std::vector<Rows> members_;  // rows of each fold
  std::vector<fitting::CrossProducts> sums_;
  std::vector<RowRanges> ranges_;
  fitting::CrossProducts all_;
};

}  // namespace errmap::models
