#pragma once

#include <string>
#include <string_view>

#include "data/units.h"

namespace errmap::data {

/// How the unit of a column is known.
enum class UnitSource {
  kNone,      // the name says nothing: no unit
  kAssumed,   // by the kind of name: "position" in mm, "t12" in degC
  kStated,    // the name carries it: "error_mm", "error [µm]"
  kUnread,    // a bare word that may mean a unit ("x_C", "flow_m³"): no unit
  kDoubtful,  // several units, or one with a number ("error_10um"): no unit
  kUnknown,   // in brackets or parentheses, but not a known unit: no unit
};

/// A column name, split into its parts.
struct Header {
  std::string base;       // without unit: "disp_ch1" of "disp_ch1 [um]"
  std::string unit_text;  // as the name has it, "" where it has none
  Unit unit;
  UnitSource source = UnitSource::kNone;
};

/// Reads a column name. A unit is given in brackets of any kind, or bare after
/// `_`, a space, `-`, `.`, `,` or `/` at the end: "error [µm]", "error {um}",
/// "error um", "error_UM". Upper and lower case are equal, except for single
/// letters and short symbols of other quantities than length ("x_V", "t1_K").
/// Both code points of the micro sign are accepted. C, F, m, in, ft and " are
/// units only in brackets; bare, they are names ("T_in", "pos_c"). The
/// exceptions are C and F after the name of a temperature ("T1_C", "T_bed_F").
/// A quotient of units (`/`, `_per_`) is of Quantity::kOther. A unit of errors
/// (lengths, angles) counts anywhere in the name if it is the only unit:
/// "error_um_mean", "Error in um (mean)".
Header ReadHeader(std::string_view name);

/// ReadHeader(name).unit.
Unit UnitOfColumn(std::string_view name);

/// True if a column has a unit, known or not: "[kWh]", but not "(MATLAB)" or
/// "(No.)".
bool HasUnit(std::string_view name);

/// Returns the column name without its unit suffix and the digits before it:
/// "disp_ch1_um" -> "disp_ch", "error_mm" -> "error". Two columns with the same
/// stem measure the same quantity.
std::string StemOfColumn(std::string_view name);

/// True if a column's name says that it holds positions: "position_mm",
/// "Position"; with a length or an angle also "Sollposition [mm]", "x_pos_mm".
bool NamesPosition(std::string_view name);

}  // namespace errmap::data
