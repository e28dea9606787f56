#include "data/units.h"

#include <array>
#include <cstddef>

#include "data/text.h"

namespace errmap::data {
namespace {

struct KnownUnit {
  std::string_view suffix;  // as column names carry it
  std::string_view symbol;
  Quantity quantity;
  double display_scale;
};

constexpr auto kKnownUnits = std::to_array<KnownUnit>({
    {"nm", "nm", Quantity::kLength, 1e-3},
    {"um", "um", Quantity::kLength, 1.0},
    {"\u00b5m", "um", Quantity::kLength, 1.0},  // micro sign
    {"\u03bcm", "um", Quantity::kLength, 1.0},  // Greek mu
    {"mm", "mm", Quantity::kLength, 1e3},
    {"cm", "cm", Quantity::kLength, 1e4},
    {"m", "m", Quantity::kLength, 1e6},
    {"arcsec", "arcsec", Quantity::kAngle, 1.0},
    {"urad", "urad", Quantity::kAngle, 1.0},
    {"mrad", "mrad", Quantity::kAngle, 1.0},
    {"rad", "rad", Quantity::kAngle, 1.0},
    {"deg", "deg", Quantity::kAngle, 1.0},
    {"degC", "degC", Quantity::kTemperature, 1.0},
    {"K", "K", Quantity::kTemperature, 1.0},
    {"degF", "degF", Quantity::kTemperature, 1.0},
    {"ms", "ms", Quantity::kOther, 1.0},
    {"s", "s", Quantity::kOther, 1.0},
    {"min", "min", Quantity::kOther, 1.0},
    {"h", "h", Quantity::kOther, 1.0},
    {"rpm", "rpm", Quantity::kOther, 1.0},
    {"N", "N", Quantity::kOther, 1.0},
    {"V", "V", Quantity::kOther, 1.0},
    {"A", "A", Quantity::kOther, 1.0},
    {"W", "W", Quantity::kOther, 1.0},
    {"bar", "bar", Quantity::kOther, 1.0},
    {"pct", "pct", Quantity::kOther, 1.0},
    {"percent", "percent", Quantity::kOther, 1.0},
});

const KnownUnit* FindSuffix(std::string_view suffix) {
  for (const KnownUnit& unit : kKnownUnits) {
    if (unit.suffix == suffix) return &unit;
  }
  return nullptr;
}

// Position of the underscore before a known suffix, or npos.
std::size_t SuffixStart(std::string_view name) {
  const std::size_t underscore = name.rfind('_');
  if (underscore == std::string_view::npos ||
      FindSuffix(name.substr(underscore + 1)) == nullptr) {
    return std::string_view::npos;
  }
  return underscore;
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

Unit MakeUnit(const KnownUnit& known) {
  return {.symbol = std::string(known.symbol),
          .quantity = known.quantity,
          .display_scale = known.display_scale,
          .display_symbol = known.quantity == Quantity::kLength
                                ? "um"
                                : std::string(known.symbol)};
}

}  // namespace

Unit UnitOfColumn(std::string_view name) {
  if (const std::size_t start = SuffixStart(name);
      start != std::string_view::npos) {
    return MakeUnit(*FindSuffix(name.substr(start + 1)));
  }
  if (StartsWithIgnoringCase(name, "position") ||
      StartsWithIgnoringCase(name, "error")) {
    return UnitOfSymbol("mm");
  }
  return UnitOfSymbol(NamesTemperature(name) ? "degC" : "");
}

Unit UnitOfSymbol(std::string_view symbol) {
  if (const KnownUnit* const known = FindSuffix(symbol); known != nullptr) {
    return MakeUnit(*known);
  }
  Unit unit;
  unit.symbol = symbol;
  unit.display_symbol = symbol;
  return unit;
}

std::string StemOfColumn(std::string_view name) {
  std::string_view stem = name.substr(0, SuffixStart(name));
  if (!stem.empty() && IsDigit(stem.back())) {
    while (!stem.empty() && IsDigit(stem.back())) stem.remove_suffix(1);
    if (stem.ends_with('_')) stem.remove_suffix(1);
  }
  // A name that is all number and unit says nothing of its quantity.
  return std::string(stem.empty() ? name : stem);
}

}  // namespace errmap::data
