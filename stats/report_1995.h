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

/// Statistics of `residuals` (n >= 1, one output) in the arithmetic of
/// NISTIR 5367, Appendix A: single precision throughout, sums divided by loop
/// variables left at their limits plus one ((n+1)*2 in place of n), the error
/// function by the program's rational approximation, the K-S series cut where
/// the program cuts it. It shows what the report saw; it estimates nothing.
/// Throws std::invalid_argument for n = 0.
Report1995Statistics ComputeAsPrinted1995(
    const Eigen::Ref<const Eigen::VectorXd>& residuals);

/// "R-SQ of nonlinear fit" as that program prints it: sum (predicted - m)^2 /
/// sum (target - m)^2 about m = sum of targets / (2 (n + 1)), half the mean;
/// no part of the residuals enters. Throws std::invalid_argument unless
/// `targets` and `predicted` have one size n >= 1.
double RSquaredAsPrinted1995(
    const Eigen::Ref<const Eigen::VectorXd>& targets,
    const Eigen::Ref<const Eigen::VectorXd>& predicted);

}  // namespace errmap::stats
