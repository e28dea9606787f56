#include "fitting/minimisers/scaled_conjugate_gradient.h"

#include "fitting/minimisers/scg_moller.h"
#include "fitting/minimisers/scg_netcg.h"
#include "stats/require.h"

namespace errmap::fitting {

std::string_view ToString(ScgVariant variant) {
  return variant == ScgVariant::kMoller ? "moller" : "netcg";
}

void ScaledConjugateGradientOptions::Validate() const {
  stopping.Validate();
  stats::Require(
      initial_lambda > 0.0,
      "ScaledConjugateGradientOptions: initial_lambda must be above 0",
      initial_lambda);
  stats::Require(sigma > 0.0,
                 "ScaledConjugateGradientOptions: sigma must be above 0",
                 sigma);
}

template <typename Scalar>
Minimum BasicScaledConjugateGradient<Scalar>::DoMinimize(
    const BasicObjective<Scalar>& f,
    const Vector& x0,
    const RunControl& run) const {
  return this->options_.variant == ScgVariant::kMoller
             ? MollerRun<Scalar>(this->options_, f, x0, run).Minimize()
             : NetcgRun<Scalar>(this->options_, f, x0, run).Minimize();
}

template class BasicScaledConjugateGradient<double>;
template class BasicScaledConjugateGradient<float>;

}  // namespace errmap::fitting
