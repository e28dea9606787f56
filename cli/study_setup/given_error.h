#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "data/measurements/dataset.h"
#include "data/units.h"
#include "models/study/rezero/rezero_rule.h"

namespace errmap::study_setup {

/// An error as the user wrote it: "2um" has a unit. A bare number is in the
/// target's unit, which only the data show.
struct GivenError {
  double value = std::numeric_limits<double>::quiet_NaN();  // NaN: not given
  data::Unit unit = {};                                     // "": the target's

  bool is_given() const { return std::isfinite(value); }
  bool has_unit() const { return !unit.symbol.empty(); }
  /// "2 um", "0.002".
  std::string Text() const;
};

/// Parses "0.002", "2um", "2 µm", "5arcsec". Throws std::invalid_argument with
/// "must be ..., found ..."; callers put the option's name before it.
GivenError ParseGivenError(std::string_view text, bool may_be_zero);

/// Returns the value in `target`, or NaN if none is given. Throws
/// std::invalid_argument if its unit is of another quantity.
double InUnitOf(const data::Unit& target, const GivenError& given);

/// Returns a remark if a bare number above `size` (RMS of the errors, target's
/// unit) was probably meant in the display unit; else "". `what`: "goal".
std::string BareNumberRemark(const char* what,
                             const GivenError& given,
                             const data::ColumnInfo& target,
                             double size);

/// Checks the text of --rezero as far as possible without data. Throws
/// std::invalid_argument; callers put the option's name before the message.
void CheckRezero(std::string_view text);

/// Returns the rule, with its noise in `target`. Throws std::invalid_argument.
models::RezeroRule RezeroIn(const data::Unit& target, std::string_view text);

}  // namespace errmap::study_setup
