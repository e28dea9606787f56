#pragma once

namespace errmap::stats {

/// P(F > f) for an F distribution with `df1` and `df2` degrees of freedom; 1
/// for f <= 0, 0 for an infinite f, NaN where f is NaN or a degree of freedom
/// is not above 0.
double FTestPValue(double f, double df1, double df2);

/// P(|T| > |t|) for Student's t with `df` degrees of freedom; NaN likewise.
double StudentTwoSidedP(double t, double df);

/// The t with P(|T| <= t) = `confidence`, such as 0.95; NaN where df <= 0.
/// Throws std::invalid_argument unless 0 < confidence < 1.
double StudentTwoSidedQuantile(double confidence, double df);

}  // namespace errmap::stats
