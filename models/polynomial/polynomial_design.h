#pragma once

#include <atomic>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "fitting/least_squares/linear_least_squares.h"
#include "models/polynomial/polynomial_basis.h"
#include "models/polynomial/term_set.h"
#include "models/scaling.h"

namespace errmap::models {

struct FitContext;

/// Scaling of the columns `inputs` of `training` for `terms`: each input's
/// largest size, after centring or not, becomes 1 (its sd, where it is
/// standardised).
ColumnScaling PolynomialScaling(const data::Dataset& training,
                                const std::vector<Eigen::Index>& inputs,
                                const std::vector<TermPowers>& terms,
                                Centring centring);

/// Terms over the rows of a data set, formed when they are needed. References
/// must outlive it.
class PolynomialDesign {
 public:
  PolynomialDesign(const data::Dataset& dataset,
                   std::vector<Eigen::Index> inputs,
                   ColumnScaling scaling,
                   std::vector<TermPowers> terms);

  Eigen::Index rows() const { return dataset_.num_rows(); }
  Eigen::Index num_terms() const {
    return static_cast<Eigen::Index>(terms_.size());
  }
  const data::Dataset& dataset() const { return dataset_; }
  const std::vector<Eigen::Index>& inputs() const { return inputs_; }
  const ColumnScaling& scaling() const { return scaling_; }
  const std::vector<TermPowers>& terms() const { return terms_; }
  std::vector<std::string> TermNames() const;
  /// One of them: of very many, all take a second.
  std::string NameOf(Eigen::Index term) const;

  /// Scaled inputs (n x p).
  Eigen::MatrixXd ScaledInputs() const;
  /// Terms (b x k) of these rows.
  Eigen::MatrixXd Rows(const std::vector<Eigen::Index>& rows) const;
  Eigen::MatrixXd Rows(Eigen::Index first, Eigen::Index count) const;

  /// Intercept's column, terms (n x (k + 1)) and response (n), formed in 106
  /// bits from the decimals that the data are roundings of.
  fitting::ExtendedSystem Exact() const;
  /// Length of what rounding of the data to double may do to a combination of
  /// the intercept's column and the terms (k + 1), weights worked in.
  double Noise(const Eigen::VectorXd& combination) const;

 private:
  std::vector<std::string> InputNames() const;

  const data::Dataset& dataset_;
  std::vector<Eigen::Index> inputs_;
  ColumnScaling scaling_;
  std::vector<TermPowers> terms_;
};

/// What least squares needs of a design: its rows, or triangles that stand for
/// them (fitting/least_squares/triangular_reduction.h).
struct DesignRows {
  Eigen::MatrixXd terms;      // (r x k)
  Eigen::VectorXd response;   // (r)
  Eigen::VectorXd weights;    // (r) or (0)
  Eigen::VectorXd intercept;  // (r); (0) where rows are observations
  double observations = 0.0;
  /// (r) part that each row belongs to; (0) where no parts were asked for.
  std::vector<Eigen::Index> parts;

  bool are_observations() const { return intercept.size() == 0; }
};

/// The rows themselves while they hold no more than `most_values` numbers,
/// else a triangle for each part: rows of equal code in `parts` (n, or empty:
/// one part) stay together. Weights are worked into triangles. Throws
/// std::invalid_argument ("interrupted") where `stop` becomes true on the way
/// to a triangle.
DesignRows CollectRows(const PolynomialDesign& design,
                       const std::vector<Eigen::Index>& parts,
                       double most_values,
                       int threads,
                       const std::atomic<bool>* stop = nullptr);

/// The same by what `context` says. The triangle of all rows is made once for
/// the recipes that share the work of these rows.
DesignRows CollectRows(const PolynomialDesign& design,
                       const std::vector<Eigen::Index>& parts,
                       const FitContext& context);

/// True where CollectRows makes triangles of such a design.
bool NeedsTriangle(Eigen::Index rows, Eigen::Index terms, double most_values);

/// `context`, but with a triangle where the design has more than `most_values`
/// numbers and few columns: one pass then costs less than the many that least
/// squares would make over rows that no cache holds.
FitContext PreferTriangle(const PolynomialDesign& design,
                          double most_values,
                          const FitContext& context);

}  // namespace errmap::models
