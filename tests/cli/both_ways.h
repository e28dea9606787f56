#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

namespace errmap {

/// 160 rows of 4 days that go both ways along an axis.
inline std::string RowsOfBothWays() {
  std::string text = "day,x_mm,t_degC,error_um\n";
  for (int i = 0; i < 160; ++i) {
    const int at = i % 10 < 5 ? i % 10 : 9 - i % 10;
    const double warm = 20.0 + 0.05 * (i % 40) + i / 40;
    text += fmt::format("{},{},{:.2f},{:.3f}\n",
                        i / 40,
                        50 * at,
                        warm,
                        at + 3.0 * (warm - 20.0) + (i % 10 < 5 ? 0.0 : 4.0) +
                            0.2 * std::sin(12.9898 * i * i));
  }
  return text;
}

}  // namespace errmap
