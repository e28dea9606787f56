#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fitting/least_squares/cross_products.h"
#include "fitting/least_squares/penalized_path.h"
#include "models/error_model.h"
#include "models/history/view.h"
#include "models/inner_folds.h"
#include "models/option_list.h"
#include "models/polynomial/formula.h"
#include "models/polynomial/polynomial_design.h"
#include "models/polynomial/polynomial_options.h"
#include "models/polynomial/term_set.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Some rows of the design matrix, with their targets.
struct TermRows {
  MatrixXd terms;    // (rows x k)
  VectorXd targets;  // (rows)
};

/// Least squares in which the rows of a session share an offset: squares of
/// differences between sessions have weight `between` relative to changes
/// within one. Before the fit, 1 - sqrt(between) times the session's mean is
/// subtracted from each row (Fuller and Battese 1973).
class SessionOffsets {
 public:
  /// Leaves rows as they are.
  SessionOffsets() = default;
  /// `sessions` has a code for each row. Every row must be included once before
  /// any is fitted.
  SessionOffsets(std::vector<Index> sessions, Index num_terms, double between);

  /// `rows` are indices into all rows; `weights` (rows), or (0): all 1.
  void Include(const std::vector<Index>& rows,
               const TermRows& design,
               const VectorXd& weights);
  void TakeFrom(const std::vector<Index>& rows, TermRows* design) const;
  /// Returns the share of a constant that remains in the rows.
  double kept() const { return kept_; }

 private:
  double kept_ = 1.0;
  std::vector<Index> sessions_;
  TermRows sums_;     // (sessions) weighted
  VectorXd weights_;  // (sessions)
};

/// Where an input is outside its trained range by more than this share of it, a
/// shrunk map is linear in the input. Further out, a parabola predicts nothing
/// useful, while a straight line through the same data still holds
/// (models/uncertainty/measured.md). Exact least squares (Eq. 7 to 9 and
/// similar) are limited only by their guards.
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
  explicit RowRanges(Index inputs);

  void Include(const MatrixXd& inputs, const VectorXd& targets);
  void Include(const RowRanges& other);

  VectorXd input_min;  // (inputs) all four are NaN without rows
  VectorXd input_max;
  double error_min;
  double error_max;
};

/// Cross-products of a basis over each inner fold, from one pass over the rows.
/// All penalties need only these.
class SummedBasis {
 public:
  using Rows = std::vector<Index>;

  /// `folds` are needed if they choose the penalty; null if it is given. Throws
  /// std::invalid_argument for too many terms or missing folds, and
  /// fitting::Interrupted if interrupted.
  SummedBasis(std::shared_ptr<const ViewedRows> viewed,
              const PenalizedBasis& basis,
              const InnerFolds* folds);

  const PolynomialDesign& design() const { return design_; }
  /// Empty if the penalty is given.
  const std::optional<InnerFolds>& inner() const { return folds_; }

  /// Returns the path for all rows, or for the training rows of a fold.
  fitting::PenalizedPath PathOf(fitting::Penalty penalty,
                                std::optional<Index> fold) const;
  /// Returns a path's solutions for `strengths`, descending. The fit subtracts
  /// a share of the session offsets; the intercepts are those of the errors
  /// themselves.
  fitting::PenalizedPath::Solutions Solve(
      const fitting::PenalizedPath& path,
      const std::vector<double>& strengths) const;
  /// Returns a ridge's solution for all rows, strength > 0, to full precision.
  fitting::PenalizedPath::Solutions SolveRefined(
      const fitting::PenalizedPath& path, double strength) const;

  /// Calls `take` with rows of a fold and their predictions (rows x solutions),
  /// block by block, clipped if guarded.
  void PredictFold(
      Index fold,
      const fitting::PenalizedPath::Solutions& solutions,
      const std::function<void(const Rows&, const MatrixXd&)>& take) const;

  VectorXd Targets(const Rows& rows) const;
  VectorXd Weights(const Rows& rows) const;  // (0): all 1

 private:
  // True if the rows of fold `of` are among those that predict `fold`.
  bool Predicts(Index of, Index fold) const;
  // Sums over the rows that predict a fold.
  fitting::CrossProducts TrainingOf(Index fold) const;
  MatrixXd Inputs(const Rows& rows) const;  // scaled
  MatrixXd Terms(const MatrixXd& inputs) const;
  // Terms with powers see inputs clipped near the range of the fold's training
  // rows, as in MapOfCandidate.
  MatrixXd GuardedTerms(const MatrixXd& inputs, const RowRanges& trained) const;
  TermRows RowsAsMeasured(const Rows& rows) const;
  TermRows RowsAsFitted(const Rows& rows) const;
  void ForBlocks(const Rows& rows,
                 const std::function<void(const Rows&)>& work) const;

  std::shared_ptr<const ViewedRows> viewed_;
  PolynomialDesign design_;
  std::vector<bool> excluded_;
  bool guarded_;
  std::optional<InnerFolds> folds_;
  SessionOffsets offsets_;
  std::vector<Rows> members_;  // rows of each fold
  std::vector<fitting::CrossProducts> sums_;
  std::vector<RowRanges> ranges_;
  fitting::CrossProducts all_;
};

/// Held-out errors along the penalties of one family, and its fit to all rows
/// with the chosen penalty.
struct PenalizedCandidate {
  fitting::Penalty penalty = fitting::Penalty::kRidge;
  double strength = 0.0;
  double degrees_of_freedom = 0.0;
  // From inner hold-outs, strongest penalty first; empty if `strength` was
  // given.
  std::vector<double> strengths;
  std::vector<double> mean_squared_errors;  // TypicalError
  std::vector<double> standard_errors;      // of those means, across folds
  /// Root of the mean squared error at the chosen strength; NaN without inner
  /// hold-outs.
  double held_out_rmse = 0.0;
  double intercept = 0.0;
  VectorXd coefficients;  // (terms) for the scaled inputs of the design
};

/// A candidate and the basis of its coefficients, without the rows, which would
/// need too much memory for all folds.
struct PenalizedFit {
  std::vector<Index> inputs;  // those of the viewed rows
  ColumnScaling scaling;
  std::vector<TermPowers> terms;
  PenalizedCandidate candidate;

  /// `viewed` are the fitted rows; they must outlive the design.
  PolynomialDesign DesignOf(const ViewedRows& viewed) const {
    return {*viewed.rows, inputs, scaling, terms};
  }
};

/// Fits a penalty to a basis. If the basis requests it, held-out rows are
/// clipped to the ranges of their fold's training rows. Errors far below
/// `indifference` (target's unit) count as equal. A ridge search ends early if
/// its first three strengths all have an RMSE above `promising`. Throws
/// std::invalid_argument if folds are missing.
std::shared_ptr<const PenalizedFit> FitPenalty(const SummedBasis& basis,
                                               fitting::Penalty penalty,
                                               const PenaltyRule& rule,
                                               double indifference,
                                               double promising);

/// Returns the map of a candidate over the basis `design` of `viewed`, with
/// history and guards. `raw` are the training rows before any view.
FittedModel MapOfCandidate(const std::string& name,
                           const data::Dataset& raw,
                           const ViewedRows& viewed,
                           const PolynomialDesign& design,
                           const PenalizedCandidate& candidate,
                           bool guarded);

/// Options of a basis in a SPEC: views, terms, degree, centred, exclude, clip
/// and between.
OptionList<BasisOptions> BasisOptionList();

/// A family over one basis, with its held-out error.
struct BasisCandidate {
  std::shared_ptr<const ViewedRows> viewed;
  std::shared_ptr<const PenalizedFit> fit;
  TermSet terms = TermSet::kLinear;
  int degree = 1;
  Index num_excluded = 0;
  bool guarded = false;
  std::string label;  // "ridge, history+zero, squares"
};

/// Returns every penalty over every basis of `options` that these rows allow,
/// in a fixed order. Reuses those in context.shared. Throws
/// std::invalid_argument if no basis is possible.
std::vector<BasisCandidate> JudgeBases(
    const data::Dataset& training,
    const BasisOptions& options,
    const PenaltyRule& rule,
    const std::vector<fitting::Penalty>& penalties,
    const InnerFolds& folds,
    const FitContext& context);

}  // namespace errmap::models
