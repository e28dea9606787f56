#include "cli/shell/remedies.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <regex>

namespace errmap::cli {
namespace {

// The message with quotations struck out, each as long as it was. An apostrophe
// within a word opens none.
std::string WithoutQuotations(std::string_view message) {
  std::string plain(message);
  for (std::size_t at = 0; at < plain.size(); ++at) {
    const bool opens =
        (plain[at] == '\'' || plain[at] == '"') &&
        (at == 0 ||
         std::isalnum(static_cast<unsigned char>(plain[at - 1])) == 0);
    const std::size_t end = opens ? plain.find(plain[at], at + 1) : plain.npos;
    if (end == plain.npos) continue;
    plain.replace(at, end + 1 - at, end + 1 - at, '_');
    at = end;
  }
  return plain;
}

bool AdvisesAnother(std::string_view clause,
                    const std::function<bool(std::string_view)>& has) {
  for (std::size_t at = clause.find("--"); at != clause.npos;) {
    const std::size_t end = std::min(
        clause.find_first_not_of("-abcdefghijklmnopqrstuvwxyz0123456789", at),
        clause.size());
    const bool begins = at == 0 || clause[at - 1] == ' ';
    if (begins && end > at + 2 && !has(clause.substr(at, end - at))) {
      return true;
    }
    at = clause.find("--", end);
  }
  return false;
}

}  // namespace

std::string WithOwnRemedies(
    std::string_view message,
    const std::function<bool(std::string_view option)>& has) {
  static const std::regex separator(", or |; ");
  const std::string plain = WithoutQuotations(message);
  std::string kept;
  std::string_view before;    // the separator of the first that was left out
  std::size_t separated = 0;  // where the clause's own separator begins
  std::size_t begin = 0;      // the clause itself
  for (std::sregex_iterator next(plain.begin(), plain.end(), separator), none;;
       ++next) {
    const std::size_t end = next == none
                                ? plain.size()
                                : static_cast<std::size_t>(next->position());
    const std::string_view clause = message.substr(begin, end - begin);
    const std::string_view own = message.substr(separated, begin - separated);
    if (begin > 0 && clause.find("errmap ") == clause.npos &&
        AdvisesAnother(std::string_view(plain).substr(begin, end - begin),
                       has)) {
      if (before.empty()) before = own;
    } else {
      kept.append(before.empty() ? own : before).append(clause);
      before = "";
    }
    if (next == none) return kept;
    separated = end;
    begin = end + static_cast<std::size_t>(next->length());
  }
}

}  // namespace errmap::cli
