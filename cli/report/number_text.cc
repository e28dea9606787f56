#include "cli/report/number_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace errmap::report {

ErrorText::ErrorText(const data::Unit& unit, double smallest)
    : scale_(unit.display_scale), symbol_(unit.display_symbol), decimals_(3) {
  constexpr int kMostDecimals = 9;
  const double shown = std::abs(smallest * scale_);
  if (std::isfinite(shown) && shown > 0.0) {
    decimals_ = std::clamp(
        2 - static_cast<int>(std::floor(std::log10(shown))), 0, kMostDecimals);
  }
}

std::string ErrorText::operator()(double value) const {
  constexpr double kTooLarge = 1e6;
  const double shown = value * scale_;
  if (!std::isfinite(shown)) return "n/a";
  if (std::abs(shown) >= kTooLarge) return fmt::format("{:.3g}", shown);
  const std::string text = fmt::format("{:.{}f}", shown, decimals_);
  const bool is_zero = text.find_first_of("123456789") == text.npos;
  return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::string ErrorText::WithUnit(double value) const {
  return WithSymbol((*this)(value), symbol_);
}

std::string WithSymbol(const std::string& number, const std::string& symbol) {
  return symbol.empty() ? number : number + " " + symbol;
}

std::string PText(double p) {
  constexpr double kFixedFrom = 1e-4;
  constexpr double kSmallest = 1e-300;
  if (std::isnan(p)) return "n/a";
  if (p < kSmallest) return "<1e-300";
  return p < kFixedFrom ? fmt::format("{:.1e}", p) : fmt::format("{:.4f}", p);
}

std::string PWords(double p) {
  constexpr double kSmallest = 1e-4;
  return p < kSmallest ? "below 0.0001" : fmt::format("{:.2g}", p);
}

std::string Count(long long n, const std::string& noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

}  // namespace errmap::report
