#include "data/units.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "data/text.h"

namespace errmap::data {
namespace {

// Value in the quantity's base unit (um, rad, K, s, ppm) = (value + offset) *
// factor. Names are separated by spaces.
struct KnownUnit {
  std::string_view symbol;
  Quantity quantity = Quantity::kOther;
  double factor = 1.0;
  std::string_view names = {};        // besides the symbol
  std::string_view in_brackets = {};  // names that count nowhere else
  bool symbol_is_a_word = false;      // bare, it is a name: "T_in"
  double offset = 0.0;
};

constexpr double kZeroCelsius = 273.15;     // K
constexpr double kZeroFahrenheit = 459.67;  // degF above absolute zero
constexpr double kDegree = std::numbers::pi / 180.0;

using enum Quantity;
constexpr auto kKnownUnits = std::to_array<KnownUnit>({
    {"pm", kLength, 1e-6, "picometer picometre"},
    {"nm", kLength, 1e-3, "nanometer nanometre"},
    {"um",
     kLength,
     1.0,
     "micron microns micrometer micrometers micrometre micrometres mikrometer "
     "mikron мкм 微米",
     "u 0.001mm 1/1000mm 10^-3mm x10^-3mm 1e-6m 10^-6m"},
    {"mm",
     kLength,
     1e3,
     "millimeter millimeters millimetre millimetres мм 毫米"},
    {"cm", kLength, 1e4, "centimeter centimetre"},
    {"m", kLength, 1e6, "meter meters metre metres", "", true},
    {"in", kLength, 25400.0, "inch inches zoll", "", true},
    {"ft", kLength, 304800.0, "feet", "", true},
    {"mil", kLength, 25.4, "mils thou", "0.001in 0.001inch"},
    {"uin", kLength, 0.0254, "microinch microinches"},
    {"0.1mm", kLength, 100.0, "", "1/10mm"},
    {"0.01mm", kLength, 10.0, "", "1/100mm"},
    {"0.1um", kLength, 0.1, "", "1/10um"},
    {"0.0001in", kLength, 2.54, "", "tenths 0.0001inch"},
    {"arcsec",
     kAngle,
     kDegree / 3600.0,
     "arcsecs arcsecond arcseconds bogensekunde bogensekunden",
     "\" \u2033 ''"},
    {"arcmin",
     kAngle,
     kDegree / 60.0,
     "arcmins arcminute arcminutes bogenminute bogenminuten",
     "' \u2032"},
    {"mrad", kAngle, 1e-3, "milliradian milliradians"},
    {"urad", kAngle, 1e-6, "microrad microradian microradians"},
    {"rad", kAngle, 1.0, "radian radians"},
    {"deg", kAngle, kDegree, "degree degrees \u00b0"},
    {"mdeg", kAngle, kDegree / 1000.0, "millidegree millidegrees m\u00b0"},
    {"degC",
     kTemperature,
     1.0,
     "celsius \u00b0C degreesC gradC gradCelsius 摄氏度",
     "C",
     false,
     kZeroCelsius},
    {"K", kTemperature, 1.0, "kelvin"},
    {"degF",
     kTemperature,
     5.0 / 9.0,
     "fahrenheit \u00b0F degreesF",
     "F",
     false,
     kZeroFahrenheit},
    {"100ns", kTime, 1e-7},
    {"10ms", kTime, 1e-2},
    {"100ms", kTime, 0.1},
    {"us", kTime, 1e-6},
    {"ms", kTime, 1e-3},
    {"s", kTime, 1.0, "sec seconds sekunden"},
    {"min", kTime, 60.0, "minutes"},
    {"h", kTime, 3600.0, "hr hours"},
    {"ppm", kRatio, 1.0},
    {"um/m", kRatio, 1.0},
    {"pct", kRatio, 1e4},
    {"percent", kRatio, 1e4},
    {"%", kRatio, 1e4, "%RH %rF"},
    {"rpm", kOther, 1.0, "1/min U/min r/min rev/min min-1 min^-1"},
    {"Hz"},
    {"N"},
    {"kN"},
    {"Nm"},
    {"V", kOther, 1.0, "VDC VAC volt volts", "Vdc"},
    {"mV"},
    {"uV"},
    {"Ohm", kOther, 1.0, "ohms \u03a9 \u2126"},
    {"mOhm", kOther, 1.0, "m\u03a9 m\u2126"},
    {"kOhm", kOther, 1.0, "k\u03a9 k\u2126"},
    {"A"},
    {"mA"},
    {"W"},
    {"kW"},
    {"g"},
    {"kg"},
    {"mg"},
    {"ug"},
    {"bar"},
    {"mbar"},
    {"psi"},
    {"steps", kOther, 1.0, "", "step schritte", true},
    {"counts", kOther, 1.0, "", "count cts ticks", true},
    {"Pa"},
    {"hPa"},
    {"kPa"},
    {"MPa"},
});

// Units that measure something here, yet nothing that we convert; and parts of
// units such as "mg_per_m3". Bare words otherwise: "error_l" is the left one.
constexpr std::string_view kPartsOfRates = "l ml rev m2 m3 mm2 mm3 cm2 cm3 1";

void ReplaceAll(std::string_view from, std::string_view to, std::string* text) {
  for (std::size_t at = 0; (at = text->find(from, at)) != std::string::npos;
       at += to.size()) {
    text->replace(at, from.size(), to);
  }
}

// The case that a bare symbol stands in matters where it is short and the
// quantity is none that errors have: "x_V" is in volts, "x_v" a name.
bool AnyCaseServes(const KnownUnit& unit, UnitPlace place) {
  constexpr std::size_t kShort = 2;
  return place == UnitPlace::kBracketed || unit.symbol.size() > kShort ||
         unit.quantity == Quantity::kLength;
}

// Known units by all that they are called, of several the first: a header is
// read many times, and most names are not units.
using UnitsByName = std::map<std::string, const KnownUnit*, std::less<>>;

UnitsByName NamedUnits(UnitPlace place, bool any_case) {
  UnitsByName units;
  for (const KnownUnit& unit : kKnownUnits) {
    const auto add = [&](std::string_view names) {
      for (const std::string_view name : SplitWords(names)) {
        units.emplace(any_case ? LowerCase(name) : std::string(name), &unit);
      }
    };
    const bool symbol_counts =
        place == UnitPlace::kBracketed || !unit.symbol_is_a_word;
    if (symbol_counts && (!any_case || AnyCaseServes(unit, place))) {
      add(unit.symbol);
    }
    add(unit.names);
    if (place == UnitPlace::kBracketed) add(unit.in_brackets);
  }
  return units;
}

const KnownUnit* FindKnown(std::string_view normalised, UnitPlace place) {
  static const std::array<UnitsByName, 4> kUnits = {
      NamedUnits(UnitPlace::kBare, false),
      NamedUnits(UnitPlace::kBare, true),
      NamedUnits(UnitPlace::kBracketed, false),
      NamedUnits(UnitPlace::kBracketed, true)};
  if (normalised.empty()) return nullptr;
  const std::size_t first = place == UnitPlace::kBare ? 0 : 2;
  // "Nm" before "nm": as written first, then in any case.
  auto unit = kUnits[first].find(normalised);
  if (unit != kUnits[first].end()) return unit->second;
  unit = kUnits[first + 1].find(LowerCase(normalised));
  return unit != kUnits[first + 1].end() ? unit->second : nullptr;
}

Unit MakeUnit(const KnownUnit& known) {
  const bool is_length = known.quantity == Quantity::kLength;
  return {.symbol = std::string(known.symbol),
          .quantity = known.quantity,
          .display_scale = is_length ? known.factor : 1.0,
          .display_symbol = is_length ? "um" : std::string(known.symbol)};
}

Unit OtherUnit(std::string_view symbol) {
  Unit unit;
  unit.symbol = symbol;
  unit.display_symbol = symbol;
  return unit;
}

bool IsPartOfRate(std::string_view text) {
  return FindKnown(text, UnitPlace::kBracketed) != nullptr ||
         IsOneOf(text, kPartsOfRates);
}

// "mg/m3" of "mg_per_m3" or "mg/m3", else "".
std::string RateOf(std::string_view normalised) {
  std::string text(normalised);
  ReplaceAll("_per_", "/", &text);
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return "";
  const std::string_view part(text);
  return IsPartOfRate(part.substr(0, slash)) &&
                 IsPartOfRate(part.substr(slash + 1))
             ? text
             : "";
}

const KnownUnit* FindSymbol(std::string_view symbol) {
  const auto* const found =
      std::ranges::find(kKnownUnits, symbol, &KnownUnit::symbol);
  return found == kKnownUnits.end() ? nullptr : found;
}

}  // namespace

std::string NormalisedUnit(std::string_view text) {
  std::string unit(Trimmed(text));
  if (StartsWithIgnoringCase(unit, "in ")) unit.erase(0, 3);
  ReplaceAll("\u00b5", "u", &unit);       // micro sign
  ReplaceAll("\u03bc", "u", &unit);       // Greek mu
  ReplaceAll("\u00ba", "\u00b0", &unit);  // ordinal for degree
  ReplaceAll("\u2103",
             "\u00b0"
             "C",
             &unit);  // one character each
  ReplaceAll("\u2109",
             "\u00b0"
             "F",
             &unit);
  ReplaceAll("\u339b", "um", &unit);  // one character each
  ReplaceAll("\u339c", "mm", &unit);
  ReplaceAll("\u00d7", "x", &unit);
  if (unit.starts_with("x ") || unit.starts_with("x0")) unit.erase(0, 1);
  ReplaceAll("\u00b2", "2", &unit);
  ReplaceAll("\u00b3", "3", &unit);
  ReplaceAll(" ", "", &unit);
  ReplaceAll(",", ".", &unit);
  return unit;
}

std::optional<Unit> FindUnit(std::string_view normalised, UnitPlace place) {
  const KnownUnit* const known = FindKnown(normalised, place);
  return known == nullptr ? std::nullopt : std::optional(MakeUnit(*known));
}

std::optional<Unit> ReadUnit(std::string_view text, UnitPlace place) {
  const std::string normalised = NormalisedUnit(text);
  if (auto known = FindUnit(normalised, place)) return known;
  if (place == UnitPlace::kBracketed &&
      (normalised == "-" || normalised == "1")) {
    return Unit{};
  }
  const std::string rate = RateOf(normalised);
  if (rate.empty()) return std::nullopt;
  const std::optional<Unit> known = FindUnit(rate, place);
  return known ? known : OtherUnit(rate);
}

bool IsUnitOfErrors(const Unit& unit) {
  return IsOneOf(unit.symbol, "nm 0.1um um uin 0.0001in arcsec urad");
}

Unit UnitOfSymbol(std::string_view symbol) {
  const KnownUnit* const known = FindSymbol(symbol);
  return known == nullptr ? OtherUnit(symbol) : MakeUnit(*known);
}

std::string KnownUnits() {
  std::string list;
  for (const KnownUnit& unit : kKnownUnits) {
    list += list.empty() ? "" : ", ";
    list += unit.symbol;
  }
  return list;
}

std::vector<Unit> UnitsOf(Quantity quantity) {
  std::vector<Unit> units;
  for (const KnownUnit& unit : kKnownUnits) {
    if (unit.quantity == quantity) units.push_back(MakeUnit(unit));
  }
  return units;
}

bool AreConvertible(const Unit& from, const Unit& to) {
  if (from.symbol == to.symbol) return true;
  return FindSymbol(from.symbol) != nullptr &&
         FindSymbol(to.symbol) != nullptr && from.quantity == to.quantity &&
         from.quantity != Quantity::kOther;
}

double Converted(double value, const Unit& from, const Unit& to) {
  if (from.symbol == to.symbol) return value;
  if (!AreConvertible(from, to)) {
    throw std::invalid_argument("errmap::data::Converted: " + from.symbol +
                                " cannot be written in " + to.symbol);
  }
  const KnownUnit& a = *FindSymbol(from.symbol);
  const KnownUnit& b = *FindSymbol(to.symbol);
  return (value + a.offset) * a.factor / b.factor - b.offset;
}

}  // namespace errmap::data
