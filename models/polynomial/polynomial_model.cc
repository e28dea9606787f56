#include "models/polynomial/polynomial_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "models/row_scratch.h"

namespace errmap::models {

using Eigen::Index;

PolynomialModel::PolynomialModel(PolynomialForm form, Index num_parameters)
    : form_(std::move(form)), num_parameters_(num_parameters) {
  constexpr int kMostPower = 64;
  const auto refuse = [](const std::string& why) {
    throw std::invalid_argument("PolynomialModel: " + why);
  };
  const Index p = form_.input_offset.size();
  if (form_.input_scale.size() != p) {
    refuse("input_offset and input_scale differ in size");
  }
  if (!form_.input_offset.allFinite() || !form_.input_scale.allFinite() ||
      !std::isfinite(form_.intercept)) {
    refuse("offsets, scales and intercept must be finite");
  }
  const Index num_terms = static_cast<Index>(form_.terms.size());
  if (num_parameters_ < num_terms || num_parameters_ > num_terms + 1) {
    refuse(std::to_string(num_parameters_) + " parameters do not go with " +
           std::to_string(num_terms) + " terms and an intercept");
  }
  for (const PolynomialTerm& term : form_.terms) {
    if (static_cast<Index>(term.powers.size()) != p) {
      refuse("a term has " + std::to_string(term.powers.size()) +
             " powers for " + std::to_string(p) + " inputs");
    }
    if (!std::isfinite(term.coefficient)) {
      refuse("coefficients must be finite");
    }
    for (const int power : term.powers) {
      if (power < 0 || power > kMostPower) {
        refuse("a power must be 0 to " + std::to_string(kMostPower) +
               ", found " + std::to_string(power));
      }
      highest_power_ = std::max(highest_power_, power);
    }
  }
  for (const PolynomialTerm& term : form_.terms) {
    SparseTerm sparse{{}, term.coefficient};
    for (std::size_t i = 0; i < term.powers.size(); ++i) {
      if (term.powers[i] > 0) {
        sparse.factors.push_back(static_cast<Index>(i) * highest_power_ +
                                 term.powers[i] - 1);
      }
    }
    sparse_terms_.push_back(std::move(sparse));
  }
}

double PolynomialModel::DoPredictRow(const double* inputs) const {
  const Index num_inputs = form_.input_offset.size();
  // powers[i * highest + k - 1] = k-th power of scaled input i.
  RowScratch powers(static_cast<std::size_t>(num_inputs * highest_power_));
  for (Index i = 0; i < num_inputs; ++i) {
    const double scaled =
        (inputs[i] - form_.input_offset[i]) * form_.input_scale[i];
    double power = 1.0;
    for (int k = 0; k < highest_power_; ++k) {
      power *= scaled;
      powers[static_cast<std::size_t>(i * highest_power_ + k)] = power;
    }
  }
  double sum = form_.intercept;
  for (const SparseTerm& term : sparse_terms_) {
    double product = term.coefficient;
    for (const Index factor : term.factors) {
      product *= powers[static_cast<std::size_t>(factor)];
    }
    sum += product;
  }
  return sum;
}

PredictionCost CostOf(const PolynomialForm& form) {
  PredictionCost cost;
  for (const PolynomialTerm& term : form.terms) {
    cost.multiplications += std::accumulate(
        term.powers.begin(), term.powers.end(), Eigen::Index{0});
  }
  return cost;
}

}  // namespace errmap::models
