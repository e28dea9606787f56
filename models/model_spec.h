#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace errmap::models {

/// A model as the user writes it: "net:scg:hidden=60:wfactor=1.3e-3".
struct ModelSpec {
  std::string text;  // as given
  std::string type;  // "net:scg": the words before the first option
  std::vector<std::pair<std::string, std::string>> options;  // in order
};

/// Splits a SPEC at colons outside double quotes; quotes are taken off values
/// (but not in formula, include and exclude, whose names may need them).
/// Throws std::invalid_argument: empty, open quote, a word after an option, an
/// option given twice.
ModelSpec ParseModelSpec(std::string_view text);

/// Splits a list ("zero,net:scg") at commas outside double quotes; an item
/// wholly in quotes keeps them. Throws std::invalid_argument on an empty place.
std::vector<std::string> SplitList(std::string_view text);

/// A spec has an option that its model does not have.
class UnknownOption : public std::invalid_argument {
 public:
  UnknownOption(const std::string& what, std::vector<std::string> known)
      : std::invalid_argument(what), known_(std::move(known)) {}
  /// Those that the model has.
  const std::vector<std::string>& known() const { return known_; }

 private:
  std::vector<std::string> known_;
};

/// Reads the options of a spec one by one, each with its range, and refuses
/// what is left over.
class SpecOptions {
 public:
  explicit SpecOptions(const ModelSpec& spec) : spec_(spec) {}

  /// The value of `key`, or `fallback` where it is not given. Each throws
  /// std::invalid_argument naming option, value and range.
  std::int64_t TakeInteger(const std::string& key,
                           std::int64_t fallback,
                           std::int64_t least,
                           std::int64_t most);
  double TakeNumber(const std::string& key,
                    double fallback,
                    double least,
                    double most);
  std::string TakeText(const std::string& key, const std::string& fallback);
  bool Has(const std::string& key) { return Find(key) != nullptr; }
  /// True where the value of `key` is `word`, such as the cv of hidden=cv,
  /// which it may be besides the numbers that are taken next.
  bool IsWord(const std::string& key, std::string_view word);
  /// One of `allowed`, as its index.
  std::size_t TakeChoice(const std::string& key,
                         std::size_t fallback,
                         const std::vector<std::string>& allowed);

  /// Throws UnknownOption naming the first option never taken and those that
  /// this model has.
  void RefuseOthers() const;

 private:
  const std::string* Find(const std::string& key);
  // "cv or " of a key that may be that word.
  std::string WordBefore(const std::string& key) const;
  [[noreturn]] void Refuse(const std::string& why) const;

  const ModelSpec& spec_;
  std::vector<std::string> known_;
  std::vector<std::pair<std::string, std::string>> words_;  // of IsWord
};

}  // namespace errmap::models
