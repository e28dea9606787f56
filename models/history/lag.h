#pragma once

namespace errmap::models {

/// (1 - exp(-u)) / u, the mean of a decay over a step of u >= 0 time constants,
/// to a few ulp; 1 where u = 0. With it a first-order lag y, whose input goes
/// straight from x0 to x1 in that step, is exact:
///
///   y += u m (x0 - y) + (1 - m) (x1 - x0),   m = MeanDecay(u).
///
/// So it lags a ramp by its time constant however far readings lie apart, and a
/// map trained by the minute holds in a control that steps by the millisecond.
double MeanDecay(double u);

/// Below this a series serves: of a step that is short against the time
/// constant the difference would keep no digits, and IEC 61131-3 has no expm1,
/// so that exported programs write the same. Its first term left out is 1e-17.
inline constexpr double kMeanDecaySeriesBelow = 0.0625;
/// 1 - u/2 (1 - u/3 (... (1 - u/kMeanDecaySeriesTerms))).
inline constexpr int kMeanDecaySeriesTerms = 9;

}  // namespace errmap::models
