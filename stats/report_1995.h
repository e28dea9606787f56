#pragma once

#include "stats/eigen.h"

namespace errmap::stats {

/// Residual statistics as the report's 1995 program printed them.
struct Report1995Statistics {
  Index n = 0;
  double mean = 0.0;  // sum / (2 (n + 1)): about half the true mean
  double sd = 0.0;    // about 1/sqrt(2) of the true one
  double min = 0.0;   // 1e20 if above: start of the search
  double max = 0.0;   // 1e-20 if below, so never negative
  double ks_d = 0.0;  // standardised with that mean and sd
  double ks_probability = 0.0;
};

template <typename Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <typename Scalar>
using VectorOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// Returns the statistics of `errors` (P x J, P >= 1), computed in the order of
/// NISTIR 5367, Appendix A, and in this precision (float, as in the program, or
/// double). As in the program, sums are divided by loop variables that ended
/// one past their limits ((P+1)(J+1) instead of P J). The error function is a
/// rational approximation. The K-S test uses the first output with the mean and
/// sd of all, and truncates its series where the program does. For reproducing
/// the report only. Throws std::invalid_argument if there are no errors.
template <typename Scalar>
Report1995Statistics StatisticsOf1995(const MatrixOf<Scalar>& errors);

/// Returns "R-SQ of nonlinear fit" as the program prints it: sum (predicted -
/// m)^2 / sum (target - m)^2 about m = sum of targets / ((P+1)(J+1)), which for
/// one output is about half the mean. Residuals do not enter. Throws
/// std::invalid_argument unless both (P x J) have the same size, not 0.
template <typename Scalar>
double RSquaredOf1995(const MatrixOf<Scalar>& targets,
                      const MatrixOf<Scalar>& predicted);

/// Return both for one output (n >= 1 values) in single precision.
inline Report1995Statistics ComputeAsPrinted1995(
    const Eigen::Ref<const VectorXd>& residuals) {
  return StatisticsOf1995<float>(residuals.cast<float>());
}
inline double RSquaredAsPrinted1995(
    const Eigen::Ref<const VectorXd>& targets,
    const Eigen::Ref<const VectorXd>& predicted) {
  return RSquaredOf1995<float>(targets.cast<float>(), predicted.cast<float>());
}

}  // namespace errmap::stats
