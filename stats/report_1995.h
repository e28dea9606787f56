#pragma once

#include <Eigen/Core>

namespace errmap::stats {

/// Residual statistics as the report's 1995 program printed them.
struct Report1995Statistics {
  Eigen::Index n = 0;
  double mean = 0.0;  // sum / (2 (n + 1)): about half the true mean
  double sd = 0.0;    // about 1/sqrt(2) of the true one
  double min = 0.0;   // 1e20 if above: where the search begins
  double max = 0.0;   // 1e-20 if below, so never negative
  double ks_d = 0.0;  // standardised with that mean and sd
  double ks_probability = 0.0;
};

template <typename Scalar>
using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <typename Scalar>
using VectorOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// Statistics of `errors` (P x J, P >= 1) in the order of NISTIR 5367,
/// Appendix A, and in this precision (float, the program's own, or double):
/// sums divided by loop variables left at their limits plus one ((P+1)(J+1) in
/// place of P J), the error function by the program's rational approximation,
/// the K-S test of the first output with the mean and sd of all, its series cut
/// where the program cuts it. It shows what the report saw; it estimates
/// nothing. Throws std::invalid_argument for no errors.
template <typename Scalar>
Report1995Statistics StatisticsOf1995(const MatrixOf<Scalar>& errors);

/// "R-SQ of nonlinear fit" as that program prints it: sum (predicted - m)^2 /
/// sum (target - m)^2 about m = sum of targets / ((P+1)(J+1)), for one output
/// half the mean; no part of the residuals enters. Throws
/// std::invalid_argument unless both (P x J) have one size, not 0.
template <typename Scalar>
double RSquaredOf1995(const MatrixOf<Scalar>& targets,
                      const MatrixOf<Scalar>& predicted);

/// The same of one output's `residuals` (n >= 1) in single precision.
inline Report1995Statistics ComputeAsPrinted1995(
    const Eigen::Ref<const Eigen::VectorXd>& residuals) {
  return StatisticsOf1995<float>(residuals.cast<float>());
}
inline double RSquaredAsPrinted1995(
    const Eigen::Ref<const Eigen::VectorXd>& targets,
    const Eigen::Ref<const Eigen::VectorXd>& predicted) {
  return RSquaredOf1995<float>(targets.cast<float>(), predicted.cast<float>());
}

}  // namespace errmap::stats
