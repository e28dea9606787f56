#pragma once

#include <string>

namespace errmap::data {

/// FORTRAN edit descriptors, as written by today's compilers (gfortran 12). A
/// value wider than its field extends it instead of becoming asterisks.

/// Iw: "   397".
std::string EditI(long long value, int width);
/// Fw.d: " 0.001".
std::string EditF(double value, int width, int decimals);
/// Ew.d: "  0.145119E+01"; an exponent of three digits displaces the E.
std::string EditE(double value, int width, int digits);
/// 1PEw.d: "   1.300E-03".
std::string Edit1PE(double value, int width, int digits);
/// Gw.d: Fw.d with `digits` significant digits and four blanks after it if 0.1
/// <= |value| < 10^digits or the value is 0, else Ew.d.
std::string EditG(double value, int width, int digits);
/// A real number as written by WRITE(*, *), with all digits of its precision: "
/// 0.331210256 " and " 9.8869840267804862E-002".
std::string ListDirected(float value);
std::string ListDirected(double value);
/// The same for an integer, in twelve columns.
std::string ListDirected(long long value);

}  // namespace errmap::data
