#include "data/column_header.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data/text.h"

namespace errmap::data {
namespace {

// Bare words that are units for sure, though none that we know.
constexpr std::string_view kForeignUnits =
    "furlong furlongs fathom fathoms yard yards mile miles angstrom angstroms "
    "gon gradian gradians parsec tenths mm2 mm3 cm2 cm3";

bool IsDigits(std::string_view text) {
  return !text.empty() &&
         text.find_first_not_of("0123456789") == std::string_view::npos;
}

// "28-0316a2794bff": a DS18B20 (28) or another thermometer on a 1-Wire bus.
bool IsOneWireThermometer(std::string_view name) {
  constexpr std::size_t kSize = 15;
  return name.size() == kSize && name[2] == '-' &&
         IsOneOf(name.substr(0, 2), "10 22 28 3b 42") &&
         name.find_first_not_of("0123456789abcdefABCDEF", 3) == name.npos;
}

// "t12", "tc03", "temp", "temp3", "temp_bed", "temperature_1".
bool NamesTemperature(std::string_view name) {
  if (IsOneWireThermometer(name)) return true;
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
    std::optional<Unit> known;
    if (counted == (letter > 0)) {
      known = FindUnit(NormalisedUnit(word.substr(letter)), UnitPlace::kBare);
    }
    if (known &&
        (known->quantity == Quantity::kLength ||
         (known->quantity == Quantity::kAngle && known->symbol != "deg" &&
          known->symbol != "rad")) &&
        std::ranges::none_of(words, [&](const UnitWord& other) {
          return other.unit.symbol == known->symbol;
        })) {
      words.push_back({.at = at, .text = word, .unit = *known});
    }
    at = end + 1;
  }
  return words;
}

// A bare last word that is not a unit, yet may be meant as one: one that counts
// in brackets only and could be the unit of such a column, one of another
// system, or no word at all ("kg·m²").
bool MayMeanUnit(std::string_view word, const Unit& assumed) {
  if (IsOneOf(word, kForeignUnits)) return true;
  const std::optional<Unit> unit = FindUnit(word, UnitPlace::kBracketed);
  if (unit) {
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
  constexpr std::string_view kPosition = "position";
  if (StartsWithIgnoringCase(name, kPosition)) {
    return header.source != UnitSource::kStated ||
           header.unit.quantity != Quantity::kTemperature;
  }
  if (header.source != UnitSource::kStated || !IsLengthOrAngle(header.unit)) {
    return false;
  }
  const std::vector<std::string_view> words =
      SplitWords(header.base, kSeparators);
  return std::ranges::any_of(words, [&](std::string_view word) {
    return EqualsIgnoringCase(word, "pos") ||
           EndsWithIgnoringCase(word, kPosition);
  });
}

namespace {

Header Stated(std::string base, std::string_view unit_text, const Unit& unit) {
  return {.base = std::move(base),
          .unit_text = std::string(unit_text),
          .unit = unit,
          .source = UnitSource::kStated};
}

// By a word within the name, if there is one. Of several units, and of one with
// a number, nobody can tell which is meant.
std::optional<Header> ReadUnitWithin(std::string_view name) {
  std::vector<UnitWord> words = UnitWords(name, false);
  if (words.size() == 1) {
    const UnitWord& word = words.front();
    if (word.text == name) return std::nullopt;
    const std::string before = WithoutSeparators(name.substr(0, word.at));
    constexpr std::string_view kCloses = "_ -.,/)]}>";
    const std::size_t rest =
        std::min(name.find_first_not_of(kCloses, word.at + word.text.size()),
                 name.size());
    return Stated(before.substr(0, before.find_last_not_of("_ ([{<") + 1) +
                      (rest < name.size() ? "_" : "") +
                      std::string(name.substr(rest)),
                  word.text,
                  word.unit);
  }
  if (words.empty()) words = UnitWords(name, true);
  if (words.empty()) return std::nullopt;
  std::vector<std::string> doubtful;
  for (const UnitWord& word : words) doubtful.emplace_back(word.text);
  return Header{.base = std::string(name),
                .unit_text = JoinWords(doubtful, ", "),
                .unit = {},
                .source = UnitSource::kDoubtful};
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
  if (ReadUnit(a, UnitPlace::kBare) && is_factor(b)) return name.substr(from);
  if (!ReadUnit(b, UnitPlace::kBare)) return "";
  if (is_factor(a)) return name.substr(from);
  if (a != "of" || from < 2) return "";
  from = name.find_last_of(' ', from - 2) + 1;
  return IsOneOf(name.substr(from, name.find(' ', from) - from),
                 "tenths hundredths thousandths")
             ? name.substr(from)
             : "";
}

// "T1_C", "T_bed_F": the letter counts behind the name of a temperature.
std::optional<Header> ReadDegrees(std::string_view name, std::size_t last) {
  if (last == std::string_view::npos) return std::nullopt;
  const std::string_view base = name.substr(0, last);
  const std::string_view letter = name.substr(last + 1);
  if ((letter != "C" && letter != "F") ||
      !(NamesTemperature(base) || StartsWithIgnoringCase(base, "t_"))) {
    return std::nullopt;
  }
  return Stated(
      std::string(base), letter, UnitOfSymbol(letter == "F" ? "degF" : "degC"));
}

}  // namespace

Header ReadHeader(std::string_view name) {
  name = Trimmed(name);
  // R writes "error [um]" as "error..um.".
  while (name.size() > 1 && name.ends_with('.')) name.remove_suffix(1);
  Header header;
  // A serial number, and no newtons.
  if (name.ends_with("S/N")) {
    header.base = name;
    return header;
  }
  if (const std::size_t open = BracketStart(name);
      open != std::string_view::npos) {
    header.base = WithoutSeparators(name.substr(0, open));
    header.unit_text = name.substr(open + 1, name.size() - open - 2);
    // Braces and angle brackets hold other things, too.
    const bool is_for_units = name[open] == '[' || name[open] == '(';
    if (const auto unit = ReadUnit(header.unit_text, UnitPlace::kBracketed)) {
      // A thermometer's degrees are not an angle: "Temp. [°]".
      const Unit assumed = AssumedUnit(header.base);
      header.unit =
          unit->symbol == "deg" && assumed.quantity == Quantity::kTemperature
              ? assumed
              : *unit;
      header.source = UnitSource::kStated;
      return header;
    }
    if (auto within = ReadUnitWithin(name.substr(0, open)))
      return *std::move(within);
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
    const std::optional<Unit> unit = ReadUnit(joined, UnitPlace::kBracketed);
    if (unit) header.unit = *unit;
    header.source = unit ? UnitSource::kStated : UnitSource::kUnknown;
    return header;
  }
  // The longest ending that is a unit: "um/m" before "m".
  for (std::size_t at = name.find_first_of(kSeparators);
       at != std::string_view::npos;
       at = name.find_first_of(kSeparators, at + 1)) {
    const std::string_view ending = name.substr(at + 1);
    const std::optional<Unit> unit = ReadUnit(ending, UnitPlace::kBare);
    if (!unit) continue;
    if (const auto words = UnitWords(name, false);
        words.size() > 1 && words.back().text == ending) {
      return *ReadUnitWithin(name);
    }
    return Stated(WithoutSeparators(name.substr(0, at)), ending, *unit);
  }
  if (auto within = ReadUnitWithin(name)) return *std::move(within);
  header.base = name;
  header.unit = AssumedUnit(name);
  const std::size_t last = name.find_last_of(kSeparators.substr(0, 2));
  if (auto degrees = ReadDegrees(name, last)) return *std::move(degrees);
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

Unit UnitOfColumn(std::string_view name) { return ReadHeader(name).unit; }

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

bool HasUnit(std::string_view name) {
  constexpr std::size_t kMostLetters = 4;
  const Header header = ReadHeader(name);
  return !header.unit.symbol.empty() ||
         (header.source == UnitSource::kUnknown &&
          header.unit_text.size() <= kMostLetters &&
          !IsOneOf(header.unit_text, "no no. nr nr. num") &&
          std::ranges::any_of(header.unit_text, [](unsigned char c) {
            return std::isalpha(c) != 0;
          }));
}

}  // namespace errmap::data
