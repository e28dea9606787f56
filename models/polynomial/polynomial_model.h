#pragma once

#include <vector>

#include "models/error_model.h"

namespace errmap::models {

/// Returns true if a term with these powers is curved in the inputs that are
/// limited to a range. Such a term reads these inputs clipped to their range.
bool Bends(const std::vector<BendRange>& within,
           const std::vector<int>& powers);

/// Polynomial map (NISTIR 5367, Eq. 7-9 and beyond); without terms, a constant.
class PolynomialModel final : public ErrorModel {
 public:
  /// `num_parameters` is the number fitted: the terms, and the intercept unless
  /// it is fixed (the zero map has none). Throws std::invalid_argument if
  /// shapes do not agree, a power is negative or above 64, or a number is not
  /// finite.
  PolynomialModel(PolynomialForm form, Index num_parameters);

  Index num_inputs() const override { return form_.input_offset.size(); }
  Index num_parameters() const override { return num_parameters_; }
  ModelDescription Describe() const override { return form_; }
  const PolynomialForm& form() const { return form_; }

 private:
  // A term as a list of factors, each an index into the row's powers.
  struct SparseTerm {
    std::vector<Index> factors;
    double coefficient;
  };

  double DoPredictRow(const double* inputs) const override;

  PolynomialForm form_;
  struct HeldInput {
    Index input;
    double lowest;  // scaled
    double highest;
  };

  Index num_parameters_;
  int highest_power_ = 0;
  std::vector<HeldInput> held_;
  std::vector<SparseTerm> sparse_terms_;
};

}  // namespace errmap::models
