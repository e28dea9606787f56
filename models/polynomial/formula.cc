#include "models/polynomial/formula.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include <fmt/format.h>

#include "data/text.h"

namespace errmap::models {
namespace {

constexpr int kMostPower = 12;

// Letters beyond ASCII stand for themselves.
bool IsNameCharacter(char c) {
  const auto code = static_cast<unsigned char>(c);
  return code >= 0x80 || std::isalnum(code) != 0 || c == '_' || c == '.';
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& what)
      : text_(text), what_(what) {}

  std::vector<NamedTerm> Parse() {
    std::vector<NamedTerm> terms;
    for (;;) {
      terms.push_back(Term());
      SkipBlanks();
      if (AtEnd()) return terms;
      if (text_[at_] != '+') {
        Refuse(fmt::format("'{}' where + or the end should be", Here()));
      }
      ++at_;
    }
  }

 private:
  NamedTerm Term() {
    NamedTerm term;
    SkipBlanks();
    term.position = Position();
    for (;;) {
      term.factors.push_back(Factor());
      SkipBlanks();
      if (AtEnd() || text_[at_] != '*') return term;
      ++at_;
    }
  }

  NamedTerm::Factor Factor() {
    NamedTerm::Factor factor;
    SkipBlanks();
    factor.input = Name();
    SkipBlanks();
    if (AtEnd() || text_[at_] != '^') return factor;
    ++at_;
    SkipBlanks();
    const std::size_t start = at_;
    factor.power = 0;
    while (!AtEnd() && std::isdigit(static_cast<unsigned char>(text_[at_])) &&
           at_ - start < 3) {
      factor.power = 10 * factor.power + (text_[at_] - '0');
      ++at_;
    }
    if (factor.power < 1 || factor.power > kMostPower) {
      at_ = start;
      Refuse(fmt::format("a power must be a whole number from 1 to {}{}",
                         kMostPower,
                         AtEnd() ? "" : fmt::format(", found '{}'", Here())));
    }
    return factor;
  }

  std::string Name() {
    if (AtEnd()) Refuse("ends where a name should be");
    if (text_[at_] == '"') {
      const std::size_t close = text_.find('"', at_ + 1);
      if (close == text_.npos) Refuse("a double quote is never closed");
      std::string name(text_.substr(at_ + 1, close - at_ - 1));
      if (name.empty()) Refuse("an empty name");
      at_ = close + 1;
      return name;
    }
    const std::size_t start = at_;
    while (!AtEnd() && IsNameCharacter(text_[at_])) ++at_;
    std::string name(text_.substr(start, at_ - start));
    if (name.empty()) {
      Refuse(
          fmt::format("'{}' where a name should be (odd names go in double "
                      "quotes)",
                      Here()));
    }
    const bool number = std::all_of(name.begin(), name.end(), [](char c) {
      return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.';
    });
    if (number) {
      at_ = start;
      Refuse(
          fmt::format("the number '{}' where a name should be; coefficients "
                      "and intercept are fitted",
                      name));
    }
    return name;
  }

  void SkipBlanks() {
    while (!AtEnd() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  bool AtEnd() const { return at_ >= text_.size(); }
  // The character here, with the bytes that belong to it.
  std::string Here() const {
    std::size_t end = at_ + 1;
    while (end < text_.size() &&
           (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) {
      ++end;
    }
    return std::string(text_.substr(at_, end - at_));
  }
  std::size_t Position() const {
    return 1 + static_cast<std::size_t>(std::count_if(
                   text_.begin(),
                   text_.begin() + static_cast<std::ptrdiff_t>(at_),
                   [](char c) {
                     return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
                   }));
  }

  [[noreturn]] void Refuse(const std::string& why) const {
    throw std::invalid_argument(
        fmt::format("{} '{}', position {}: {}", what_, text_, Position(), why));
  }

  std::string_view text_;
  const std::string& what_;
  std::size_t at_ = 0;
};

// "; did you mean 'position_mm'?", where one is near.
std::string DidYouMean(const std::string& name,
                       const std::vector<std::string>& names) {
  const std::string nearest = data::NearestName(name, names);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace

std::vector<NamedTerm> ParseTerms(std::string_view text,
                                  const std::string& what) {
  return Parser(text, what).Parse();
}

std::vector<TermPowers> ResolveTerms(const std::vector<NamedTerm>& terms,
                                     const std::vector<std::string>& names,
                                     const std::string& what) {
  std::vector<TermPowers> resolved;
  for (const NamedTerm& term : terms) {
    TermPowers powers(names.size(), 0);
    for (const NamedTerm::Factor& factor : term.factors) {
      const auto found = std::find(names.begin(), names.end(), factor.input);
      if (found == names.end()) {
        throw std::invalid_argument(
            fmt::format("{}, position {}: '{}' is not an input; there {} {}{}",
                        what,
                        term.position,
                        factor.input,
                        names.size() == 1 ? "is" : "are",
                        data::JoinWords(names, ", "),
                        DidYouMean(factor.input, names)));
      }
      powers[static_cast<std::size_t>(found - names.begin())] += factor.power;
    }
    for (const int power : powers) {
      if (power > kMostPower) {
        throw std::invalid_argument(
            fmt::format("{}, position {}: a power above {}",
                        what,
                        term.position,
                        kMostPower));
      }
    }
    if (std::find(resolved.begin(), resolved.end(), powers) != resolved.end()) {
      throw std::invalid_argument(
          fmt::format("{}, position {}: {} stands twice",
                      what,
                      term.position,
                      TermName(powers, names)));
    }
    resolved.push_back(std::move(powers));
  }
  return resolved;
}

std::string TermsText(const std::vector<NamedTerm>& terms) {
  std::vector<std::string> products;
  for (const NamedTerm& term : terms) {
    std::vector<std::string> factors;
    for (const NamedTerm::Factor& factor : term.factors) {
      factors.push_back(TermName({factor.power}, {factor.input}));
    }
    products.push_back(data::JoinWords(factors, "*"));
  }
  return data::JoinWords(products, "+");
}

}  // namespace errmap::models
