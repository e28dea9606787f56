#pragma once

namespace errmap::stats {

/// Returns P(F > f) for an F distribution with `df1` and `df2` degrees of
/// freedom. 1 if f <= 0; 0 if f is infinite; NaN if f is NaN or a degree of
/// freedom is not above 0.
double FTestPValue(double f, double df1, double df2);

/// Returns P(|T| > |t|) for Student's t; NaN if t is NaN or df <= 0.
double StudentTwoSidedP(double t, double df);

/// Returns the t with P(|T| <= t) = `confidence`, such as 0.95; NaN if df <= 0.
/// Throws std::invalid_argument unless 0 < confidence < 1.
double StudentTwoSidedQuantile(double confidence, double df);

}  // namespace errmap::stats
