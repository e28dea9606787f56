#include "data/way_words.h"

#include <string>

#include "data/column_words.h"
#include "data/text.h"

namespace errmap::data {
namespace {

// Of the position, and of a way that may go up or down; without accents.
constexpr std::string_view kUp =
    "up upwards + 1 +1 pos positive positiv plus increasing auf aufwarts "
    "aufwaerts > \u2191";
constexpr std::string_view kDown =
    "down downwards dn - -1 neg negative negativ minus decreasing ab abwarts "
    "abwaerts < \u2193";
constexpr std::string_view kForth =
    "forward forwards fwd f vor vorwarts vorwaerts hin hinweg hinfahrt aller "
    "avanti andata ida heen tam fram zheng \u2192";
constexpr std::string_view kBack =
    "reverse rev r backward backwards bwd back return b ruck rueck zuruck "
    "zurueck ruckwarts rueckwaerts her ruckweg rueckweg ruckfahrt rueckfahrt "
    "retour indietro ritorno vuelta volta terug zpet tillbaka fan \u2190";

// "+x" is "+".
std::string PlainWay(std::string_view word) {
  std::string plain = PlainText(word);
  const bool is_axis = plain.size() == 2 &&
                       (plain[0] == '+' || plain[0] == '-') &&
                       IsAxisLetter(plain.substr(1));
  return is_axis ? plain.substr(0, 1) : plain;
}

}  // namespace

std::optional<bool> IsUpwards(std::string_view word) {
  const std::string plain = PlainWay(word);
  if (IsOneOf(plain, kUp) || IsOneOf(plain, kForth)) return true;
  if (IsOneOf(plain, kDown) || IsOneOf(plain, kBack)) return false;
  return std::nullopt;
}

std::optional<bool> FirstIsUp(std::string_view first, std::string_view second) {
  const std::string a = PlainWay(first);
  const std::string b = PlainWay(second);
  if (IsOneOf(a, kUp) && IsOneOf(b, kDown)) return true;
  if (IsOneOf(a, kDown) && IsOneOf(b, kUp)) return false;
  return std::nullopt;
}

}  // namespace errmap::data
