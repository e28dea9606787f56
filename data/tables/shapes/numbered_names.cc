#include "data/tables/shapes/numbered_names.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/text.h"
#include "data/units.h"
#include "data/way_words.h"

namespace errmap::data {
namespace {

constexpr auto kLengths = std::to_array<std::string_view>(
    {"mm", "um", "\u00b5m", "\u03bcm", "inch", "in", "m", "deg"});
constexpr std::string_view kDigits = "0123456789";

bool IsErrorWord(std::string_view word) {
  return IsOneOf(word, "e") || IsWord(PlainText(word), Word::kError);
}

std::string QuantityOf(std::string_view before, std::string_view after) {
  std::string name(Trimmed(before));
  if (name.empty() || EqualsIgnoringCase(name, "e") ||
      EqualsIgnoringCase(name, "err")) {
    name = "error";
  }
  return name + std::string(after);
}

// Less "at", "x" or "pos" at its end.
std::string_view WithoutPlaceWord(std::string_view before) {
  const std::size_t last = before.find_last_of(" _");
  const std::string_view word =
      last == before.npos ? before : before.substr(last + 1);
  if (!IsOneOf(word, "x y z a b c u v w pos pos. position at bei")) {
    return before;
  }
  return Trimmed(before.substr(0, before.size() - word.size()));
}

// What stands before a number without "@": nothing, an axis, a position, or an
// error; thermometers have their places in their names, too. Letters directly
// before a number name one of several: "A1 deg" is the first angle.
std::optional<std::string_view> BeforePlace(std::string_view before) {
  if (before.empty() || IsOneOf(before, "x y z")) return before.substr(0, 0);
  if (std::string_view("=: _").find(before.back()) == before.npos) {
    return std::nullopt;
  }
  const bool is_line = before.ends_with('_');
  while (!before.empty() &&
         std::string_view("=: _").find(before.back()) != before.npos) {
    before.remove_suffix(1);
  }
  before = Trimmed(WithoutPlaceWord(before));
  if (before.ends_with('_')) before.remove_suffix(1);
  // "x_1" is one of several, too.
  if (before.empty()) return is_line ? std::nullopt : std::optional(before);
  const bool is_error =
      IsErrorWord(ReadHeader(before).base) || IsErrorWord(before);
  return is_error ? std::optional(before) : std::nullopt;
}

// With a decimal point between digits.
std::string WithPoints(std::string_view name) {
  std::string text(name);
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == ',' && IsDigit(text[i - 1]) && IsDigit(text[i + 1])) {
      text[i] = '.';
    }
  }
  return text;
}

// Takes "50 mm" or "x=50 mm" off the front of a text.
bool TakePlace(std::string_view* rest, PlacedName* placed) {
  const std::size_t sign = rest->find('=');
  if (sign != rest->npos && sign < rest->find_first_of(kDigits)) {
    rest->remove_prefix(sign + 1);
  }
  *rest = Trimmed(*rest);
  if (rest->starts_with('+')) rest->remove_prefix(1);
  const char* const end = rest->data() + rest->size();
  const auto [stop, error] =
      std::from_chars(rest->data(), end, placed->position);
  if (error != std::errc()) return false;
  *rest = Trimmed({stop, static_cast<std::size_t>(end - stop)});
  const auto* const unit = std::ranges::find_if(
      kLengths,
      [&](std::string_view length) { return rest->starts_with(length); });
  if (unit != kLengths.end()) {
    placed->unit = *unit;
    rest->remove_prefix(unit->size());
  }
  return true;
}

// "x 1" is one of several; "50", "50 [um]", "x50 [um]" and "X=50 [um]" may be
// positions.
bool MayBeBare(std::size_t before, bool is_marked, std::string_view rest) {
  const Header header = ReadHeader("x" + std::string(rest));
  return (before == 0 && (rest.empty() || IsLengthOrAngle(header.unit))) ||
         ((before == 1 || is_marked) && IsUnitOfErrors(header.unit));
}

// "up" and "down" of a sign that ends a name but for its unit: "Pass 1 - [um]".
// The dash of "Pass 1-um" parts name and unit.
std::string SignBehind(std::string_view name, std::string_view unit) {
  if (!unit.empty()) {
    name = name.substr(0, name.rfind(unit));
    if (!name.empty()) name.remove_suffix(1);
  }
  name = Trimmed(name);
  return name.ends_with('+') ? "up" : name.ends_with('-') ? "down" : "";
}

// The next word of a name, or its next number; "" at its end.
std::string_view TakePart(std::string_view* rest) {
  constexpr std::string_view kBetween = " _.#:=-+()";
  rest->remove_prefix(
      std::min(rest->find_first_not_of(kBetween), rest->size()));
  if (rest->empty()) return "";
  const bool digits = IsDigit(rest->front());
  std::size_t end = 0;
  while (end < rest->size() && kBetween.find((*rest)[end]) == kBetween.npos &&
         IsDigit((*rest)[end]) == digits) {
    ++end;
  }
  const std::string_view part = rest->substr(0, end);
  rest->remove_prefix(end);
  return part;
}

}  // namespace

bool IsNumericDate(std::string_view text) {
  std::size_t parts = 0;
  std::size_t longest = 0;
  const std::size_t first = text.find_first_not_of(kDigits);
  if (first == text.npos ||
      std::string_view(".-/").find(text[first]) == text.npos) {
    return false;
  }
  const char between = text[first];
  for (std::size_t at = 0; at <= text.size(); ++parts) {
    const std::size_t end = std::min(text.find(between, at), text.size());
    const std::string_view part = text.substr(at, end - at);
    const bool fits = part.size() == 4 || part.size() == 2 || part.size() == 1;
    if (!fits || part.find_first_not_of(kDigits) != part.npos) return false;
    longest = std::max(longest, part.size());
    at = end + 1;
  }
  return parts == 3 && longest >= 2;
}

std::optional<PlacedName> ReadPlacedName(std::string_view name) {
  std::string text = WithPoints(name);
  // "err_um(50)"
  const std::size_t open = text.find('(');
  if (text.ends_with(')') && open + 1 < text.size() &&
      text.find_first_of("+-0123456789") == open + 1) {
    text.pop_back();
    text[open] = '_';
  }
  name = text;
  std::size_t at = name.find('@');
  std::optional<std::string_view> before;
  const bool has_at = at != name.npos;
  if (has_at) {
    before = name.substr(0, at);
    ++at;
  } else {
    at = std::min(name.find_first_of("+-0123456789"), name.size());
    before = BeforePlace(name.substr(0, at));
  }
  if (!before) return std::nullopt;
  PlacedName placed;
  placed.is_marked = name.substr(0, at).find_first_of("@=") != name.npos;
  std::string_view rest = name.substr(at);
  if (!TakePlace(&rest, &placed)) return std::nullopt;
  if (placed.unit.empty() && has_at) placed.unit = "mm";
  if (placed.unit.empty() && before->empty() &&
      !MayBeBare(at, placed.is_marked, rest)) {
    return std::nullopt;
  }
  // What follows is the unit of the quantity: "_um", " [um]", or nothing.
  if (!rest.empty() &&
      std::string_view("_ [(").find(rest.front()) == rest.npos) {
    return std::nullopt;
  }
  placed.quantity = QuantityOf(*before, rest);
  return placed;
}

std::optional<RunName> ReadRunName(std::string_view name) {
  constexpr std::string_view kRuns =
      "j run cycle pass test series serie messreihe traverse lauf zyklus "
      "messung messlauf ciclo cyclus";
  constexpr std::string_view kLetters = "x y z m";
  const Header header = ReadHeader(name);
  RunName said{.direction = SignBehind(name, header.unit_text)};
  bool is_run = IsNumericDate(header.base);
  if (is_run) said.date = header.base;
  int* number = &said.run;
  std::string_view rest = is_run ? std::string_view() : header.base;
  for (std::string_view word = TakePart(&rest); !word.empty();
       word = TakePart(&rest)) {
    // Fans are numbered, too.
    const std::optional<bool> up =
        IsOneOf(word, "fan") ? std::nullopt : IsUpwards(word);
    if (IsDigit(word.front())) {
      std::from_chars(word.data(), word.data() + word.size(), *number);
    } else if (IsOneOf(word, kRuns)) {
      is_run = true;
      number = &said.run;
    } else if (IsCalled(word, Word::kSession)) {
      number = &said.session;
    } else if (up) {
      // "Pos 3" is a position.
      const bool is_place = IsWord(PlainText(word), Word::kPosition);
      const std::size_t next = rest.find_first_not_of(" _.#");
      if (is_place && next != rest.npos && IsDigit(rest[next])) {
        return std::nullopt;
      }
      said.direction = *up ? "up" : "down";
      said.is_letter =
          word.size() == 1 && !rest.empty() && IsDigit(rest.front());
      // "f1" may be anything, "1 fwd" is a run.
      is_run = is_run || word.size() > 1;
    } else if (!IsErrorWord(word) && !IsOneOf(word, kLetters)) {
      return std::nullopt;
    }
  }
  // "1+ (um)", "- (um)", "Day 1 (um)"
  is_run = is_run ||
           (!said.direction.empty() && IsLengthOrAngle(header.unit)) ||
           (said.session > 0 && IsUnitOfErrors(header.unit));
  if (!is_run || !(said.is_numbered() || !said.direction.empty())) {
    return std::nullopt;
  }
  said.quantity = "error";
  if (!header.unit_text.empty()) said.quantity += " [" + header.unit_text + "]";
  return said;
}

}  // namespace errmap::data
