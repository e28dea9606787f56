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
  Quantity quantity;
  double factor;
  double offset;
  std::string_view names;         // besides the symbol
  std::string_view in_brackets;   // names that count nowhere else
  bool symbol_is_a_word = false;  // bare, it is a name: "T_in"
};

constexpr double kZeroCelsius = 273.15;     // K
constexpr double kZeroFahrenheit = 459.67;  // degF above absolute zero
constexpr double kDegree = std::numbers::pi / 180.0;

using enum Quantity;
constexpr auto kKnownUnits = std::to_array<KnownUnit>({
    {"nm", kLength, 1e-3, 0, "nanometer nanometre", ""},
    {"um",
     kLength,
     1.0,
     0,
     "micron microns micrometer micrometers micrometre micrometres mikrometer "
     "mikron мкм",
     "u 0.001mm 1/1000mm 10^-3mm x10^-3mm 1e-6m 10^-6m"},
    {"mm",
     kLength,
     1e3,
     0,
     "millimeter millimeters millimetre millimetres мм",
     ""},
    {"cm", kLength, 1e4, 0, "centimeter centimetre", ""},
    {"m", kLength, 1e6, 0, "meter meters metre metres", "", true},
    {"in", kLength, 25400.0, 0, "inch inches zoll", "", true},
    {"ft", kLength, 304800.0, 0, "feet", "", true},
    {"mil", kLength, 25.4, 0, "mils thou", "0.001in 0.001inch"},
    {"uin", kLength, 0.0254, 0, "microinch microinches", ""},
    {"0.1um", kLength, 0.1, 0, "", "1/10um"},
    {"0.0001in", kLength, 2.54, 0, "", "tenths 0.0001inch"},
    {"arcsec",
     kAngle,
     kDegree / 3600.0,
     0,
     "arcsecs arcsecond arcseconds bogensekunde bogensekunden",
     "\" \u2033 ''"},
    {"arcmin",
     kAngle,
     kDegree / 60.0,
     0,
     "arcmins arcminute arcminutes bogenminute bogenminuten",
     "' \u2032"},
    {"mrad", kAngle, 1e-3, 0, "milliradian milliradians", ""},
    {"urad", kAngle, 1e-6, 0, "microrad microradian microradians", ""},
    {"rad", kAngle, 1.0, 0, "radian radians", ""},
    {"deg", kAngle, kDegree, 0, "degree degrees \u00b0", ""},
    {"degC",
     kTemperature,
     1.0,
     kZeroCelsius,
     "celsius \u00b0C degreesC gradC gradCelsius",
     "C"},
    {"K", kTemperature, 1.0, 0, "kelvin", ""},
    {"degF",
     kTemperature,
     5.0 / 9.0,
     kZeroFahrenheit,
     "fahrenheit \u00b0F degreesF",
     "F"},
    {"100ns", kTime, 1e-7, 0, "", ""},
    {"us", kTime, 1e-6, 0, "", ""},
    {"ms", kTime, 1e-3, 0, "", ""},
    {"s", kTime, 1.0, 0, "sec seconds sekunden", ""},
    {"min", kTime, 60.0, 0, "minutes", ""},
    {"h", kTime, 3600.0, 0, "hr hours", ""},
    {"ppm", kRatio, 1.0, 0, "", ""},
    {"um/m", kRatio, 1.0, 0, "", ""},
    {"pct", kRatio, 1e4, 0, "", ""},
    {"percent", kRatio, 1e4, 0, "", ""},
    {"%", kRatio, 1e4, 0, "%RH %rF", ""},
    {"rpm", kOther, 1.0, 0, "1/min U/min r/min rev/min min-1 min^-1", ""},
    {"Hz", kOther, 1.0, 0, "", ""},
    {"N", kOther, 1.0, 0, "", ""},
    {"kN", kOther, 1.0, 0, "", ""},
    {"Nm", kOther, 1.0, 0, "", ""},
    {"V", kOther, 1.0, 0, "VDC VAC volt volts", "Vdc"},
    {"mV", kOther, 1.0, 0, "", ""},
    {"uV", kOther, 1.0, 0, "", ""},
    {"Ohm", kOther, 1.0, 0, "ohms \u03a9 \u2126", ""},
    {"mOhm", kOther, 1.0, 0, "m\u03a9 m\u2126", ""},
    {"kOhm", kOther, 1.0, 0, "k\u03a9 k\u2126", ""},
    {"A", kOther, 1.0, 0, "", ""},
    {"mA", kOther, 1.0, 0, "", ""},
    {"W", kOther, 1.0, 0, "", ""},
    {"kW", kOther, 1.0, 0, "", ""},
    {"g", kOther, 1.0, 0, "", ""},
    {"kg", kOther, 1.0, 0, "", ""},
    {"mg", kOther, 1.0, 0, "", ""},
    {"ug", kOther, 1.0, 0, "", ""},
    {"bar", kOther, 1.0, 0, "", ""},
    {"mbar", kOther, 1.0, 0, "", ""},
    {"psi", kOther, 1.0, 0, "", ""},
    {"steps", kOther, 1.0, 0, "", "step schritte", true},
    {"counts", kOther, 1.0, 0, "", "count cts ticks", true},
    {"Pa", kOther, 1.0, 0, "", ""},
    {"hPa", kOther, 1.0, 0, "", ""},
    {"kPa", kOther, 1.0, 0, "", ""},
    {"MPa", kOther, 1.0, 0, "", ""},
});

// Units that measure something here, yet nothing that we convert; and parts of
// units such as "mg_per_m3". Bare words otherwise: "error_l" is the left one.
constexpr std::string_view kPartsOfRates = " l ml rev m2 m3 mm2 mm3 cm2 cm3 1 ";

// Bare words that are units for sure, though none that we know.
constexpr std::string_view kForeignUnits =
    " furlong furlongs fathom fathoms yard yards mile miles angstrom angstroms "
    "gon gradian gradians parsec tenths mm2 mm3 cm2 cm3 ";

bool HasWord(std::string_view words, std::string_view word) {
  return !word.empty() &&
         words.find(" " + std::string(word) + " ") != std::string_view::npos;
}

void ReplaceAll(std::string_view from, std::string_view to, std::string* text) {
  for (std::size_t at = 0; (at = text->find(from, at)) != std::string::npos;
       at += to.size()) {
    text->replace(at, from.size(), to);
  }
}

std::string LowerCase(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

// One spelling of what is written in many: "deg C", "µm", "in mm".
std::string Normalised(std::string_view text) {
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

enum class Place { kBare, kBracketed };

// The case that a bare symbol stands in matters where it is short and the
// quantity is none that errors have: "x_V" is in volts, "x_v" a name.
bool AnyCaseServes(const KnownUnit& unit, Place place) {
  constexpr std::size_t kShort = 2;
  return place == Place::kBracketed || unit.symbol.size() > kShort ||
         unit.quantity == Quantity::kLength;
}

// Known units by all that they are called, of several the first: a header is
// read many times, and most names are no unit.
using UnitsByName = std::map<std::string, const KnownUnit*, std::less<>>;

UnitsByName NamedUnits(Place place, bool any_case) {
  UnitsByName units;
  for (const KnownUnit& unit : kKnownUnits) {
    const auto add = [&](std::string_view names) {
      for (const std::string_view name : SplitWords(names)) {
        units.emplace(any_case ? LowerCase(name) : std::string(name), &unit);
      }
    };
    const bool symbol_counts =
        place == Place::kBracketed || !unit.symbol_is_a_word;
    if (symbol_counts && (!any_case || AnyCaseServes(unit, place))) {
      add(unit.symbol);
    }
    add(unit.names);
    if (place == Place::kBracketed) add(unit.in_brackets);
  }
  return units;
}

const KnownUnit* FindUnit(std::string_view normalised, Place place) {
  static const std::array<UnitsByName, 4> kUnits = {
      NamedUnits(Place::kBare, false),
      NamedUnits(Place::kBare, true),
      NamedUnits(Place::kBracketed, false),
      NamedUnits(Place::kBracketed, true)};
  if (normalised.empty()) return nullptr;
  const std::size_t first = place == Place::kBare ? 0 : 2;
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
  return FindUnit(text, Place::kBracketed) != nullptr ||
         HasWord(kPartsOfRates, LowerCase(text));
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

// The unit of a text that is nothing else, or false.
bool ReadUnit(std::string_view text, Place place, Unit* unit) {
  const std::string normalised = Normalised(text);
  if (const KnownUnit* known = FindUnit(normalised, place); known != nullptr) {
    *unit = MakeUnit(*known);
    return true;
  }
  if (place == Place::kBracketed && (normalised == "-" || normalised == "1")) {
    *unit = Unit{};
    return true;
  }
  const std::string rate = RateOf(normalised);
  if (rate.empty()) return false;
  const KnownUnit* const known = FindUnit(rate, place);
  *unit = known != nullptr ? MakeUnit(*known) : OtherUnit(rate);
  return true;
}

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool IsDigits(std::string_view text) {
  return !text.empty() &&
         text.find_first_not_of("0123456789") == std::string_view::npos;
}

// "t12", "tc03", "temp", "temp3", "temp_bed", "temperature_1".
bool NamesTemperature(std::string_view name) {
  for (const std::string_view letters : {"tc", "t"}) {
    if (StartsWithIgnoringCase(name, letters) &&
        IsDigits(name.substr(letters.size()))) {
      return true;
    }
  }
  for (const std::string_view word : {"temperature", "temp"}) {
    if (!StartsWithIgnoringCase(name, word)) continue;
    const std::string_view rest = name.substr(word.size());
    // "tempo" and "template" are other words.
    if (rest.empty() || rest.front() == '_' || IsDigit(rest.front())) {
      return true;
    }
  }
  return false;
}

const KnownUnit* FindSymbol(const Unit& unit) {
  const auto* const found =
      std::ranges::find(kKnownUnits, unit.symbol, &KnownUnit::symbol);
  return found == kKnownUnits.end() ? nullptr : found;
}

// What a name without a unit is taken for, by its kind.
Unit AssumedUnit(std::string_view base) {
  if (StartsWithIgnoringCase(base, "position") ||
      StartsWithIgnoringCase(base, "error")) {
    return UnitOfSymbol("mm");
  }
  return UnitOfSymbol(NamesTemperature(base) ? "degC" : "");
}

constexpr std::string_view kSeparators = "_ -.,/";

std::string WithoutSeparators(std::string_view text) {
  const std::size_t last = text.find_last_not_of(kSeparators);
  return std::string(
      text.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

// The group in brackets of any kind that ends the name, or npos.
std::size_t BracketStart(std::string_view name) {
  if (name.empty()) return std::string_view::npos;
  constexpr std::string_view kOpen = "[({<";
  constexpr std::string_view kClose = "])}>";
  const std::size_t kind = kClose.find(name.back());
  if (kind == std::string_view::npos) return std::string_view::npos;
  const std::size_t at = name.rfind(kOpen[kind]);
  // "a [[b]]" holds no unit: brackets within brackets are part of a name.
  const bool nested = at != std::string_view::npos &&
                      name.substr(at, name.size() - at - 1).find(name.back()) !=
                          std::string_view::npos;
  return nested ? std::string_view::npos : at;
}

// A word within a name that is a unit of errors: "um" of "error_um_mean".
struct UnitWord {
  std::size_t at;
  std::string_view text;
  Unit unit;
};

// Those of a name, each unit once; `counted`: with digits before it, "10um".
std::vector<UnitWord> UnitWords(std::string_view name, bool counted) {
  constexpr std::string_view kBetween = "_ -.,/()[]{}<>";
  std::vector<UnitWord> words;
  for (std::size_t at = 0; at < name.size();) {
    const std::size_t end =
        std::min(name.find_first_of(kBetween, at), name.size());
    const std::string_view word = name.substr(at, end - at);
    const std::size_t letter =
        std::min(word.find_first_not_of("0123456789"), word.size());
    const KnownUnit* const known =
        counted == (letter > 0)
            ? FindUnit(Normalised(word.substr(letter)), Place::kBare)
            : nullptr;
    if (known != nullptr &&
        (known->quantity == Quantity::kLength ||
         (known->quantity == Quantity::kAngle && known->symbol != "deg" &&
          known->symbol != "rad")) &&
        std::ranges::none_of(words, [&](const UnitWord& other) {
          return other.unit.symbol == known->symbol;
        })) {
      words.push_back({.at = at, .text = word, .unit = MakeUnit(*known)});
    }
    at = end + 1;
  }
  return words;
}

// A bare last word that is no unit, yet may be meant as one: one that counts in
// brackets only and could be the unit of such a column, one of another system,
// or no word at all ("kg·m²").
bool MayMeanUnit(std::string_view word, const Unit& assumed) {
  if (HasWord(kForeignUnits, LowerCase(word))) return true;
  const KnownUnit* const unit = FindUnit(word, Place::kBracketed);
  if (unit != nullptr) {
    if (!assumed.symbol.empty()) {
      return unit->quantity == assumed.quantity &&
             unit->symbol != assumed.symbol;
    }
    return word == "K" || word == "C" || word == "F" || word == "m";
  }
  for (const std::string_view sign :
       {"\u00b5", "\u03bc", "\u00b0", "\u00b2", "\u00b3", "^", "%", "/"}) {
    if (word.find(sign) != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace

bool NamesPosition(std::string_view name) {
  const Header header = ReadHeader(name);
  if (StartsWithIgnoringCase(name, "position")) {
    return header.source != UnitSource::kStated ||
           header.unit.quantity != Quantity::kTemperature;
  }
  if (header.source != UnitSource::kStated || !IsLengthOrAngle(header.unit)) {
    return false;
  }
  const std::string base = LowerCase(header.base);
  for (std::size_t at = 0; at < base.size();) {
    const std::size_t end =
        std::min(base.find_first_of(kSeparators, at), base.size());
    const std::string_view word = std::string_view(base).substr(at, end - at);
    if (word == "pos" || word.ends_with("position")) return true;
    at = end + 1;
  }
  return false;
}

namespace {

// By a word within the name; false where there is none. Of several units, and
// of one with a number, nobody can tell which is meant.
bool ReadUnitWithin(std::string_view name, Header* header) {
  const std::vector<UnitWord> words = UnitWords(name, false);
  if (words.size() == 1) {
    const UnitWord& word = words.front();
    if (word.text == name) return false;
    const std::string before = WithoutSeparators(name.substr(0, word.at));
    constexpr std::string_view kCloses = "_ -.,/)]}>";
    const std::size_t rest =
        std::min(name.find_first_not_of(kCloses, word.at + word.text.size()),
                 name.size());
    header->base = before.substr(0, before.find_last_not_of("_ ([{<") + 1) +
                   (rest < name.size() ? "_" : "") +
                   std::string(name.substr(rest));
    header->unit_text = word.text;
    header->unit = word.unit;
    header->source = UnitSource::kStated;
    return true;
  }
  std::vector<UnitWord> doubtful =
      words.empty() ? UnitWords(name, true) : words;
  if (doubtful.empty()) return false;
  header->base = name;
  header->unit_text.clear();
  for (const UnitWord& word : doubtful) {
    header->unit_text += header->unit_text.empty() ? "" : ", ";
    header->unit_text += word.text;
  }
  header->unit = Unit{};
  header->source = UnitSource::kDoubtful;
  return true;
}

// A unit and a factor beside it at the end of a name: "1/1000 mm", "10^-3 mm",
// "hundredths of mm", "mm x1000"; else "".
std::string_view ScaledUnit(std::string_view name) {
  const std::size_t last = name.find_last_of(' ');
  if (last == name.npos || last == 0) return "";
  std::size_t from = name.find_last_of(' ', last - 1) + 1;  // 0: the first
  const std::string_view a = name.substr(from, last - from);
  const std::string_view b = name.substr(last + 1);
  const auto is_factor = [](std::string_view word) {
    return word.find_first_of("0123456789") != word.npos &&
           (word.find_first_of("/^*") != word.npos || word.starts_with('x'));
  };
  Unit unit;
  if (ReadUnit(a, Place::kBare, &unit) && is_factor(b))
    return name.substr(from);
  if (!ReadUnit(b, Place::kBare, &unit)) return "";
  if (is_factor(a)) return name.substr(from);
  if (a != "of" || from < 2) return "";
  from = name.find_last_of(' ', from - 2) + 1;
  return IsOneOf(LowerCase(name.substr(from, name.find(' ', from) - from)),
                 "tenths hundredths thousandths")
             ? name.substr(from)
             : "";
}

}  // namespace

Header ReadHeader(std::string_view name) {
  name = Trimmed(name);
  // R writes "error [um]" as "error..um.".
  while (name.size() > 1 && name.ends_with('.')) name.remove_suffix(1);
  Header header;
  if (const std::size_t open = BracketStart(name);
      open != std::string_view::npos) {
    header.base = WithoutSeparators(name.substr(0, open));
    header.unit_text = name.substr(open + 1, name.size() - open - 2);
    // Braces and angle brackets hold other things, too.
    const bool is_for_units = name[open] == '[' || name[open] == '(';
    if (ReadUnit(header.unit_text, Place::kBracketed, &header.unit)) {
      header.source = UnitSource::kStated;
      return header;
    }
    if (ReadUnitWithin(name.substr(0, open), &header)) return header;
    if (is_for_units) {
      header.source = UnitSource::kUnknown;
      return header;
    }
    header.unit_text.clear();
  }
  if (const std::string_view scaled = ScaledUnit(name); !scaled.empty()) {
    header.base =
        WithoutSeparators(name.substr(0, name.size() - scaled.size()));
    header.unit_text = scaled;
    std::string joined(scaled);
    std::erase(joined, ' ');
    header.source = ReadUnit(joined, Place::kBracketed, &header.unit)
                        ? UnitSource::kStated
                        : UnitSource::kUnknown;
    return header;
  }
  // The longest ending that is a unit: "um/m" before "m".
  for (std::size_t at = name.find_first_of(kSeparators);
       at != std::string_view::npos;
       at = name.find_first_of(kSeparators, at + 1)) {
    const std::string_view ending = name.substr(at + 1);
    if (!ReadUnit(ending, Place::kBare, &header.unit)) continue;
    header.base = WithoutSeparators(name.substr(0, at));
    header.unit_text = ending;
    header.source = UnitSource::kStated;
    if (const auto words = UnitWords(name, false);
        words.size() > 1 && words.back().text == ending) {
      ReadUnitWithin(name, &header);
    }
    return header;
  }
  if (ReadUnitWithin(name, &header)) return header;
  header.base = name;
  header.unit = AssumedUnit(name);
  const std::size_t last = name.find_last_of(kSeparators.substr(0, 2));
  // "T_in" is an inlet's, "x_in" a position in inches.
  const bool is_position =
      last != std::string_view::npos &&
      IsOneOf(name.substr(0, last), "x y z u v w pos posn") &&
      IsOneOf(name.substr(last + 1), "in ft");
  if (is_position || (last != std::string_view::npos &&
                      MayMeanUnit(name.substr(last + 1), header.unit))) {
    header.unit_text = name.substr(last + 1);
    header.unit = Unit{};
    header.source = UnitSource::kUnread;
  } else if (!header.unit.symbol.empty()) {
    header.source = UnitSource::kAssumed;
  }
  return header;
}

bool IsUnitOfErrors(const Unit& unit) {
  return IsOneOf(unit.symbol, "nm 0.1um um uin 0.0001in arcsec urad");
}

Unit UnitOfColumn(std::string_view name) { return ReadHeader(name).unit; }

Unit UnitOfSymbol(std::string_view symbol) {
  for (const KnownUnit& unit : kKnownUnits) {
    if (unit.symbol == symbol) return MakeUnit(unit);
  }
  return OtherUnit(symbol);
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
  return FindSymbol(from) != nullptr && FindSymbol(to) != nullptr &&
         from.quantity == to.quantity && from.quantity != Quantity::kOther;
}

double Converted(double value, const Unit& from, const Unit& to) {
  if (from.symbol == to.symbol) return value;
  if (!AreConvertible(from, to)) {
    throw std::invalid_argument("errmap::data::Converted: " + from.symbol +
                                " cannot be written in " + to.symbol);
  }
  const KnownUnit& a = *FindSymbol(from);
  const KnownUnit& b = *FindSymbol(to);
  return (value + a.offset) * a.factor / b.factor - b.offset;
}

std::string StemOfColumn(std::string_view name) {
  const Header header = ReadHeader(name);
  std::string_view stem = header.base;
  if (!stem.empty() && IsDigit(stem.back())) {
    while (!stem.empty() && IsDigit(stem.back())) stem.remove_suffix(1);
    if (stem.ends_with('_') || stem.ends_with(' ')) stem.remove_suffix(1);
  }
  // A name that is all number and unit says nothing of its quantity.
  return std::string(stem.empty() ? name : stem);
}

}  // namespace errmap::data
