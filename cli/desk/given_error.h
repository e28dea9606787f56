#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "data/units.h"
#include "models/study/rezero/rezero_rule.h"

namespace errmap::desk {

/// A size of errors as people give it: "2um" says its unit, a bare number is
/// in that of the target, which is known only with the data.
struct GivenError {
  double value = std::numeric_limits<double>::quiet_NaN();  // NaN: not given
  data::Unit unit = {};                                     // "": the target's

  bool is_given() const { return std::isfinite(value); }
  bool has_unit() const { return !unit.symbol.empty(); }
  /// "2 um", "0.002".
  std::string Text() const;
};

/// Of "0.002", "2um", "2 µm", "5arcsec". Throws std::invalid_argument, to
/// follow the name of what is given: "must be ..., found ...".
GivenError ParseGivenError(std::string_view text, bool may_be_zero);

/// The value in `target`, NaN where none is given. Throws
/// std::invalid_argument where it has a unit of another quantity.
double InUnitOf(const data::Unit& target, const GivenError& given);

/// Checks the words of --rezero as far as they can be without data. Throws
/// std::invalid_argument, to follow the name of what is given.
void CheckRezero(std::string_view text);

/// The rule, its noise in `target`. Throws std::invalid_argument.
models::RezeroRule RezeroIn(const data::Unit& target, std::string_view text);

}  // namespace errmap::desk
