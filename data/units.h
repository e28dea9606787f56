#pragma once

#include <string>
#include <string_view>

namespace errmap::data {

enum class Quantity { kLength, kAngle, kTemperature, kOther };

/// Physical unit of a column.
struct Unit {
  std::string symbol;  // "mm", "degC", "arcsec", "" if none
  Quantity quantity = Quantity::kOther;
  /// Value in the unit people read errors in = scale * value in `symbol`:
  /// lengths are read in um (mm: 1000, um: 1), all else as it stands (1).
  double display_scale = 1.0;
  std::string display_symbol;  // "um" for lengths, else `symbol`

  bool operator==(const Unit&) const = default;
};

/// Unit named by the suffix of a column name after its last underscore
/// ("error_mm", "t12_degC", "disp_ch1_um", "yaw_arcsec"). Without a known
/// suffix: mm where the name starts with "position" or "error", degC where it
/// is a usual name of a temperature ("t12", "tc03", "temp_bed",
/// "temperature"), else none.
Unit UnitOfColumn(std::string_view name);

/// Unit of a symbol as a model file stores it; unknown symbols keep their text
/// and are of Quantity::kOther.
Unit UnitOfSymbol(std::string_view symbol);

/// Column name less its unit suffix and the digits before it:
/// "disp_ch1_um" -> "disp_ch", "error_mm" -> "error". Two columns of one stem
/// measure the same quantity.
std::string StemOfColumn(std::string_view name);

}  // namespace errmap::data
