#pragma once

namespace errmap::models {

/// Returns (1 - exp(-u)) / u, the mean of a decay over a step of u >= 0 time
/// constants, to a few ulp; 1 if u = 0. With it, a first-order lag y is exact
/// for an input that changes linearly from x0 to x1 in the step:
///
///   y += u m (x0 - y) + (1 - m) (x1 - x0),   m = MeanDecay(u).
///
/// Its lag behind a ramp is one time constant at any sampling rate. So a map
/// trained on readings each minute holds in a control that steps each
/// millisecond.
double MeanDecay(double u);

/// Below this u, a series is used. For a step much shorter than the time
/// constant, the difference would lose all digits, and IEC 61131-3 has no
/// expm1. Exported programs use the same series. The first omitted term is
/// 1e-17.
inline constexpr double kMeanDecaySeriesBelow = 0.0625;
/// 1 - u/2 (1 - u/3 (... (1 - u/kMeanDecaySeriesTerms))).
inline constexpr int kMeanDecaySeriesTerms = 9;

}  // namespace errmap::models
