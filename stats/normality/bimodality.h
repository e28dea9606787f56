#pragma once

#include <Eigen/Core>

namespace errmap::stats {

/// Hartigan's dip of `ascending` (n >= 1): the largest distance between its
/// distribution function and that of the nearest unimodal distribution (J. A.
/// Hartigan & P. M. Hartigan, Annals of Statistics 13, 1985; the steps of AS
/// 217, with the minorant and majorant found afresh for each interval). At
/// least 1/(2n); 0 for n = 0.
double DipStatistic(const Eigen::Ref<const Eigen::VectorXd>& ascending);

/// Probability of a dip of at least this in n uniform values, the unimodal
/// distribution with the largest dips: for others, the normal among them, it
/// is too large, so a small one is safe evidence of two modes. From simulated
/// quantiles (simulated_quantiles.h): 0.001 stands for at most 0.001, and 1
/// for n < 4, where any sample is unimodal enough.
double DipProbability(double dip, Eigen::Index n);

}  // namespace errmap::stats
