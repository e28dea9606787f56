#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

enum class Quantity { kLength, kAngle, kTemperature, kTime, kRatio, kOther };

/// Physical unit of a column.
struct Unit {
  std::string symbol;  // "mm", "degC", "arcsec", "" if none
  Quantity quantity = Quantity::kOther;
  /// Factor from `symbol` to the unit in which people read errors. Lengths are
  /// read in um (mm: 1000, um: 1), all else as it is (1).
  double display_scale = 1.0;
  std::string display_symbol;  // "um" for lengths, else `symbol`

  bool operator==(const Unit&) const = default;
};

inline bool IsLengthOrAngle(const Unit& unit) {
  return unit.quantity == Quantity::kLength ||
         unit.quantity == Quantity::kAngle;
}

/// Whether errors are stated in a unit and positions hardly ever: um, arcsec.
bool IsUnitOfErrors(const Unit& unit);

/// Where the text of a unit stands: many short ones count in brackets only.
enum class UnitPlace { kBare, kBracketed };

/// One spelling of what is written in many: "degC" of "deg C", "um" of "µm".
std::string NormalisedUnit(std::string_view text);

/// The unit that is called so, by its symbol or a name; nothing where none is.
std::optional<Unit> FindUnit(std::string_view normalised, UnitPlace place);

/// The unit of a text that is nothing else, however it is spelt: one that is
/// known, none ("-", "1"), or a unit over a unit; nothing where it is no unit.
std::optional<Unit> ReadUnit(std::string_view text, UnitPlace place);

/// Unit of a symbol as a model file stores it; unknown symbols keep their text
/// and are of Quantity::kOther.
Unit UnitOfSymbol(std::string_view symbol);

/// The units known, for messages: "nm, um, mm, ...".
std::string KnownUnits();

/// Those of a quantity that values can be converted between.
std::vector<Unit> UnitsOf(Quantity quantity);

/// Whether values in one unit can be written in the other.
bool AreConvertible(const Unit& from, const Unit& to);

/// A value in `from` as one in `to`. Throws std::invalid_argument unless the
/// units are convertible.
double Converted(double value, const Unit& from, const Unit& to);

}  // namespace errmap::data
