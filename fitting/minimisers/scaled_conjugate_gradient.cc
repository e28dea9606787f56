#include "fitting/minimisers/scaled_conjugate_gradient.h"

#include <stdexcept>
#include <utility>

#include "fitting/minimisers/scg_variants.h"

namespace errmap::fitting {
namespace {

void RequirePositive(const char* field, double value) {
  if (!(value > 0.0)) {
    throw std::invalid_argument(
        "ScaledConjugateGradientOptions: " + std::string(field) +
        " must be above 0, found " + std::to_string(value));
  }
}

}  // namespace

std::string_view ToString(ScgVariant variant) {
  return variant == ScgVariant::kMoller ? "moller" : "netcg";
}

void ScaledConjugateGradientOptions::Validate() const {
  stopping.Validate();
  RequirePositive("initial_lambda", initial_lambda);
  RequirePositive("sigma", sigma);
}

template <typename Scalar>
BasicScaledConjugateGradient<Scalar>::BasicScaledConjugateGradient(
    ScaledConjugateGradientOptions options)
    : options_(std::move(options)) {
  options_.Validate();
}

template <typename Scalar>
Minimum BasicScaledConjugateGradient<Scalar>::DoMinimize(
    const BasicObjective<Scalar>& f,
    const Vector& x0,
    const RunControl& run) const {
  return options_.variant == ScgVariant::kMoller
             ? MinimizeByMoller(options_, f, x0, run)
             : MinimizeByNetcg(options_, f, x0, run);
}

template class BasicScaledConjugateGradient<double>;
template class BasicScaledConjugateGradient<float>;

}  // namespace errmap::fitting
