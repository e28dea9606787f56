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
  /// Factor from `symbol` to the display unit of errors. Lengths are shown in
  /// um (mm: 1000, um: 1), all other quantities in their own unit (1).
  double display_scale = 1.0;
  std::string display_symbol;  // "um" for lengths, else `symbol`

  bool operator==(const Unit&) const = default;
};

inline bool IsLengthOrAngle(const Unit& unit) {
  return unit.quantity == Quantity::kLength ||
         unit.quantity == Quantity::kAngle;
}

/// True for units that errors have but positions hardly ever: um, arcsec.
bool IsUnitOfErrors(const Unit& unit);

/// Notation of a unit: many short units count in brackets only.
enum class UnitPlace { kBare, kBracketed };

/// Returns one spelling for all variants: "degC" for "deg C", "um" for "µm".
std::string NormalisedUnit(std::string_view text);

/// Returns the unit with this symbol or name, if there is one.
std::optional<Unit> FindUnit(std::string_view normalised, UnitPlace place);

/// Returns the unit if the whole text is one, in any spelling: a known unit, no
/// unit ("-", "1"), or a quotient of units. Returns nothing otherwise.
std::optional<Unit> ReadUnit(std::string_view text, UnitPlace place);

/// Returns the unit of a symbol stored in a model file. An unknown symbol is
/// kept as text, with Quantity::kOther.
Unit UnitOfSymbol(std::string_view symbol);

/// Returns the known units, for messages: "nm, um, mm, ...".
std::string KnownUnits();

/// Returns the units of a quantity that can be converted into each other.
std::vector<Unit> UnitsOf(Quantity quantity);

/// True if values can be converted between the units.
bool AreConvertible(const Unit& from, const Unit& to);

/// Converts a value. Throws std::invalid_argument unless the units are
/// convertible.
double Converted(double value, const Unit& from, const Unit& to);

}  // namespace errmap::data
