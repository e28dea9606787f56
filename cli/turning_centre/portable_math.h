#pragma once

namespace errmap::turning_centre {

// The C library's sin and log differ in the last digits between versions, but
// output files must not. These use only + - * / and std::floor or std::frexp,
// which are exact or correctly rounded everywhere.

/// sin(2 pi turns), absolute error below 1e-15 for |turns| <= 1000.
double SinOfTurns(double turns);

/// cos(2 pi turns), as SinOfTurns.
double CosOfTurns(double turns);

/// Natural logarithm of a positive, finite, normal x; error below 4 units of
/// 2^-53 of max(|log x|, 1).
double PortableLog(double x);

}  // namespace errmap::turning_centre
