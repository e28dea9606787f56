#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "fitting/least_squares/linear_least_squares.h"
#include "models/polynomial/polynomial_basis.h"
#include "models/polynomial/term_set.h"
#include "models/scaling.h"
#include "stats/eigen.h"

namespace errmap::models {

struct FitContext;

/// Returns the scaling of the columns `inputs` of `training` for `terms`: after
/// any centring, it makes each input's largest absolute value 1 (or its sd, if
/// it is standardised).
ColumnScaling PolynomialScaling(const data::Dataset& training,
                                const std::vector<Index>& inputs,
                                const std::vector<TermPowers>& terms,
                                Centring centring);

/// Terms over the rows of a data set, computed when needed. The references must
/// outlive it.
class PolynomialDesign {
 public:
  PolynomialDesign(const data::Dataset& dataset,
                   std::vector<Index> inputs,
                   ColumnScaling scaling,
                   std::vector<TermPowers> terms);

  Index rows() const { return dataset_.num_rows(); }
  Index num_terms() const { return std::ssize(terms_); }
  const data::Dataset& dataset() const { return dataset_; }
  const std::vector<Index>& inputs() const { return inputs_; }
  const ColumnScaling& scaling() const { return scaling_; }
  const std::vector<TermPowers>& terms() const { return terms_; }
  std::vector<std::string> TermNames() const;
  /// Returns one of them; with very many terms, all take a second.
  std::string NameOf(Index term) const;

  /// Return the terms (b x k) of these rows.
  MatrixXd Rows(const std::vector<Index>& rows) const;
  MatrixXd Rows(Index first, Index count) const;

  /// Returns the intercept's column and terms (n x (k + 1)) and response (n) in
  /// 106 bits, from the decimals before rounding to double.
  fitting::ExtendedSystem Exact() const;
  /// Returns the length of the effect of rounding the data to double on a
  /// combination (k + 1) of the intercept's column and the terms, with weights.
  double Noise(const VectorXd& combination) const;

 private:
  std::vector<std::string> InputNames() const;

  const data::Dataset& dataset_;
  std::vector<Index> inputs_;
  ColumnScaling scaling_;
  std::vector<TermPowers> terms_;
};

/// Input of least squares from a design: its rows, or triangles that represent
/// them (fitting/least_squares/triangular_reduction.h).
struct DesignRows {
  MatrixXd terms;      // (r x k)
  VectorXd response;   // (r)
  VectorXd weights;    // (r) or (0)
  VectorXd intercept;  // (r); (0) if rows are observations
  double observations = 0.0;
  /// (r) part of each row; (0) if no parts were requested.
  std::vector<Index> parts;

  bool are_observations() const { return intercept.size() == 0; }
  /// Returns the regression problem of these rows, which must outlive it.
  fitting::RegressionProblem Problem() const {
    return {terms, response, weights, intercept, observations};
  }
};

/// Returns the rows themselves if they have at most `most_values` numbers,
/// else a triangle for each part: rows of equal code in `parts` (n, or
/// empty: one part). Triangles include the weights. Throws
/// fitting::Interrupted if interrupted while a triangle is computed.
DesignRows CollectRows(const PolynomialDesign& design,
                       const std::vector<Index>& parts,
                       double most_values,
                       int threads);

/// Returns the same with the limits of `context`. The triangle of all rows is
/// computed once for the recipes that share these rows.
DesignRows CollectRows(const PolynomialDesign& design,
                       const std::vector<Index>& parts,
                       const FitContext& context);

/// Returns true if CollectRows turns such a design into triangles.
bool NeedsTriangle(Index rows, Index terms, double most_values);

/// Returns `context`, but preferring a triangle if the design has more than
/// `most_values` numbers and few columns. One pass then costs less than many
/// passes over rows that do not fit the cache.
FitContext PreferTriangle(const PolynomialDesign& design,
                          double most_values,
                          const FitContext& context);

}  // namespace errmap::models
