#pragma once

#include <string>

#include "data/units.h"

namespace errmap::report {

inline constexpr double kPercent = 100.0;

/// Formats errors in the display unit, all with the same number of decimals.
class ErrorText {
 public:
  /// Chooses the decimals so that `smallest`, the smallest error that matters
  /// (in `unit`), has three significant digits.
  ErrorText(const data::Unit& unit, double smallest);

  /// "0.938"; "n/a" if not finite; "1.2e+07" if the number is too large for
  /// decimals.
  std::string operator()(double value) const;
  /// "0.938 um".
  std::string WithUnit(double value) const;
  const std::string& symbol() const { return symbol_; }

 private:
  double scale_;
  std::string symbol_;
  int decimals_;
};

/// "2 um"; the number alone if it has no unit.
std::string WithSymbol(const std::string& number, const std::string& symbol);

/// Formats a probability in a table: "0.0123", "2.1e-06", "<1e-300"; "n/a" if
/// there is none. Tables and sentences format p only with PText and PWords.
std::string PText(double p);
/// Formats it in a sentence: "0.012", "below 0.0001".
std::string PWords(double p);

/// "3 rows", "1 row".
std::string Count(long long n, const std::string& noun);

}  // namespace errmap::report
