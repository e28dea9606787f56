#include "models/polynomial/polynomial_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "models/row_scratch.h"

namespace errmap::models {

bool Bends(const std::vector<BendRange>& within,
           const std::vector<int>& powers) {
  int degree = 0;
  for (const BendRange& range : within) {
    degree += powers[static_cast<std::size_t>(range.input)];
  }
  return degree > 1;
}

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
  const Index num_terms = std::ssize(form_.terms);
  if (num_parameters_ < num_terms || num_parameters_ > num_terms + 1) {
    refuse(std::to_string(num_parameters_) + " parameters do not go with " +
           std::to_string(num_terms) + " terms and an intercept");
  }
  for (const PolynomialTerm& term : form_.terms) {
    if (std::ssize(term.powers) != p) {
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
  std::vector<Index> held_at(static_cast<std::size_t>(p), -1);
  for (const BendRange& range : form_.bends_within) {
    const Index input = range.input;
    if (input < 0 || input >= p || !(range.min <= range.max)) {
      refuse("bends_within names an input that is not there, or no range");
    }
    // Scaled as in exported programs: (x - offset) * scale.
    const auto scaled = [&](double value) {
      return (value - form_.input_offset[input]) * form_.input_scale[input];
    };
    const auto [lowest, highest] =
        std::minmax({scaled(range.min), scaled(range.max)});
    held_at[static_cast<std::size_t>(input)] = p + std::ssize(held_);
    held_.push_back({input, lowest, highest});
  }
  for (const PolynomialTerm& term : form_.terms) {
    SparseTerm sparse{{}, term.coefficient};
    const bool bends = Bends(form_.bends_within, term.powers);
    for (std::size_t i = 0; i < term.powers.size(); ++i) {
      if (term.powers[i] > 0) {
        const Index place =
            bends && held_at[i] >= 0 ? held_at[i] : static_cast<Index>(i);
        sparse.factors.push_back(place * highest_power_ + term.powers[i] - 1);
      }
    }
    sparse_terms_.push_back(std::move(sparse));
  }
}

double PolynomialModel::DoPredictRow(const double* inputs) const {
  const Index num_inputs = form_.input_offset.size();
  const auto num_held = std::ssize(held_);
  // powers[i * highest + k - 1] = k-th power of scaled input i; after all of
  // them those of the inputs that are held.
  RowScratch powers(
      static_cast<std::size_t>((num_inputs + num_held) * highest_power_));
  const auto raise = [&](Index place, double scaled) {
    double power = 1.0;
    for (int k = 0; k < highest_power_; ++k) {
      power *= scaled;
      powers[static_cast<std::size_t>(place * highest_power_ + k)] = power;
    }
  };
  const auto scaled = [&](Index i) {
    return (inputs[i] - form_.input_offset[i]) * form_.input_scale[i];
  };
  for (Index i = 0; i < num_inputs; ++i) raise(i, scaled(i));
  for (Index h = 0; h < num_held; ++h) {
    const HeldInput& held = held_[static_cast<std::size_t>(h)];
    raise(num_inputs + h,
          std::min(std::max(scaled(held.input), held.lowest), held.highest));
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
    cost.multiplications +=
        std::accumulate(term.powers.begin(), term.powers.end(), Index{0});
  }
  return cost;
}

}  // namespace errmap::models
