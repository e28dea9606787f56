#pragma once

#include <string>
#include <string_view>

#include "data/units.h"

namespace errmap::data {

/// How the unit of a column came to be known.
enum class UnitSource {
  kNone,      // the name says nothing: no unit
  kAssumed,   // by the kind of name: "position" in mm, "t12" in degC
  kStated,    // the name carries it: "error_mm", "error [µm]"
  kUnread,    // a bare word that may mean a unit ("t1_C", "flow_m³"): no unit
  kDoubtful,  // several units, or one with a number ("error_10um"): no unit
  kUnknown,   // in brackets or parentheses, and no unit that we know: no unit
};

/// A column name taken apart.
struct Header {
  std::string base;       // less its unit: "disp_ch1" of "disp_ch1 [um]"
  std::string unit_text;  // as the name has it, "" where it has none
  Unit unit;
  UnitSource source = UnitSource::kNone;
};

/// Reads a column name. A unit stands in brackets of any kind, or bare after
/// `_`, a space, `-`, `.`, `,` or `/` at the end: "error [µm]", "error {um}",
/// "error um", "error_UM". Letters count in any case (single letters and short
/// symbols that are no length exactly as usual: "x_V", "t1_K"), micro signs in
/// either code point. C, F, m, in, ft and " are names when bare ("T_in",
/// "pos_c"), units in brackets only. A unit over a unit (`/`, `_per_`) is one
/// of Quantity::kOther. A unit of errors (lengths, angles) counts anywhere
/// where it is the only one: "error_um_mean", "Error in um (mean)".
Header ReadHeader(std::string_view name);

/// ReadHeader(name).unit.
Unit UnitOfColumn(std::string_view name);

/// Column name less its unit suffix and the digits before it:
/// "disp_ch1_um" -> "disp_ch", "error_mm" -> "error". Two columns of one stem
/// measure the same quantity.
std::string StemOfColumn(std::string_view name);

/// Whether a column holds positions by its name: "position_mm", "Position";
/// with a length or an angle also "Sollposition [mm]", "x_pos_mm".
bool NamesPosition(std::string_view name);

}  // namespace errmap::data
