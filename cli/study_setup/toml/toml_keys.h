#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/study_setup/given_error.h"
#include "cli/study_setup/toml/toml_parser.h"

namespace errmap::study_setup {

/// Prefix of a source name for a change KEY=VALUE instead of a file.
inline constexpr std::string_view kOverride = "KEY=VALUE ";
/// Returns the source name of such a change for messages.
std::string NameOfOverride(std::string_view change);

/// Returns "FILE:LINE:COLUMN: ", the beginning of a message.
std::string Place(const std::string& file, const toml::source_region& at);

/// Throws data::InputError with the place, or std::invalid_argument for a
/// change KEY=VALUE.
[[noreturn]] void Refuse(const std::string& file,
                         const toml::source_region& at,
                         const std::string& what);

/// Returns the value of an integer or a floating-point number.
double NumberOf(const toml::node& node);

/// Parses a TOML document. Throws data::InputError with the place of an error.
toml::table ParseToml(const std::string& text, const std::string& path);

/// Reads a table of a file key by key. Calls Refuse with the place of an error.
/// Keeps references to `table` and `file`.
class Keys {
 public:
  Keys(const toml::table& table, std::string where, const std::string& file);

  void AllowOnly(const std::vector<std::string>& known) const;
  const toml::node* Find(std::string_view key) const { return table_.get(key); }

  // If the key is absent, each leaves its target unchanged.
  /// `check` may be null; it refuses by throwing std::invalid_argument.
  void TakeText(std::string_view key,
                std::string* text,
                void (*check)(const std::string&) = nullptr) const;
  void TakeFlag(std::string_view key, bool* flag) const;
  /// Takes a number above 0 (at least 0 if `may_be_zero`), or a text with a
  /// number and its unit.
  void TakeError(std::string_view key,
                 bool may_be_zero,
                 GivenError* error) const;
  void TakeSeed(std::uint64_t* seed) const;

  /// Takes a list of texts. `check` (may be empty) refuses one by throwing
  /// std::invalid_argument.
  void TakeList(
      std::string_view key,
      std::vector<std::string>* list,
      const std::function<void(const std::string&)>& check = {}) const;

  /// Returns the tables headed [[key]]; none if the key is absent.
  std::vector<const toml::table*> Tables(std::string_view key) const;

  [[noreturn]] void RefuseType(std::string_view key,
                               const toml::node& node,
                               std::string_view wanted) const;
  [[noreturn]] void RefuseTable(const std::string& what) const;

 private:
  const toml::table& table_;
  std::string where_;
  const std::string& file_;
};

}  // namespace errmap::study_setup
