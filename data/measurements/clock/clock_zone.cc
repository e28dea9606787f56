#include "data/measurements/clock/clock_zone.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "data/text.h"

namespace errmap::data {
namespace {

constexpr double kSecondsOfHour = 3600.0;

struct Zone {
  std::string_view letters;
  double hours = 0.0;
  bool is_summer = false;
};

// Letters that name one zone in most of the world.
const Zone* FindZone(std::string_view letters) {
  static constexpr auto kZones = std::to_array<Zone>({
      {"Z", 0.0},          {"UTC", 0.0},        {"GMT", 0.0},
      {"WET", 0.0},        {"WEST", 1.0, true}, {"BST", 1.0, true},
      {"CET", 1.0},        {"CEST", 2.0, true}, {"MEZ", 1.0},
      {"MESZ", 2.0, true}, {"EET", 2.0},        {"EEST", 3.0, true},
      {"MSK", 3.0},        {"JST", 9.0},        {"KST", 9.0},
      {"EST", -5.0},       {"EDT", -4.0, true}, {"CDT", -5.0, true},
      {"MDT", -6.0, true}, {"PST", -8.0},       {"PDT", -7.0, true},
  });
  const auto* const zone = std::ranges::find(kZones, letters, &Zone::letters);
  return zone == kZones.end() ? nullptr : zone;
}

bool IsLetter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// Hours of "+02:00", "-5", "+0530" at the front of a text.
std::optional<double> OffsetAt(std::string_view text) {
  if (text.empty() || (text[0] != '+' && text[0] != '-')) return std::nullopt;
  std::string digits;
  for (const char c : text.substr(1)) {
    if (IsDigit(c)) {
      digits += c;
    } else if (c != ':') {
      break;
    }
  }
  if (digits.empty() || digits.size() > 4) return std::nullopt;
  const std::size_t of_hours = digits.size() > 2 ? digits.size() - 2 : 2;
  double hours = std::stod(digits.substr(0, of_hours));
  if (digits.size() > 2) hours += std::stod(digits.substr(of_hours)) / 60.0;
  return text[0] == '-' ? -hours : hours;
}

// Behind a time of day; what ParseDateTime leaves of it.
std::optional<double> HoursInCell(std::string_view cell) {
  const std::size_t time = cell.find(':');
  if (time == cell.npos) return std::nullopt;
  std::size_t end = cell.size();
  while (end > time && IsLetter(cell[end - 1])) --end;
  if (const Zone* zone = FindZone(cell.substr(end))) {
    return zone->hours - (zone->is_summer ? 1.0 : 0.0);
  }
  const std::size_t sign = cell.find_first_of("+-", time);
  const bool is_offset = sign != cell.npos && cell.size() - sign <= 6 &&
                         (cell[sign] == '+' || cell.size() - sign != 5) &&
                         OffsetAt(cell.substr(sign));
  return is_offset ? std::optional(0.0) : std::nullopt;
}

std::optional<double> HoursInName(std::string_view name) {
  for (std::size_t at = 0; at < name.size();) {
    std::size_t end = at;
    while (end < name.size() && IsLetter(name[end])) ++end;
    const std::string_view word = name.substr(at, end - at);
    if (const Zone* zone =
            FindZone(EqualsIgnoringCase(word, "utc") ? "UTC" : word)) {
      return zone->hours + OffsetAt(name.substr(end)).value_or(0.0);
    }
    at = end + 1;
  }
  return std::nullopt;
}

std::optional<double> HoursOf(const CsvColumn& column) {
  if (column.is_text()) {
    for (const std::string& text : column.texts) {
      if (const auto hours = HoursInCell(text)) return hours;
    }
  }
  return HoursInName(column.name);
}

}  // namespace

bool IsSummerTime(std::string_view letters) {
  const Zone* const zone = FindZone(letters);
  return zone != nullptr && zone->is_summer;
}

std::optional<double> SecondsAheadOfUtc(
    const CsvTable& table, const std::vector<std::ptrdiff_t>& columns) {
  for (const std::ptrdiff_t column : columns) {
    if (column < 0) continue;
    if (const auto hours = HoursOf(table.At(column)))
      return kSecondsOfHour * *hours;
  }
  return std::nullopt;
}

}  // namespace errmap::data
