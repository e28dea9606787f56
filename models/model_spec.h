#pragma once

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

/// Splits a SPEC at colons outside double quotes. Removes the quotes around
/// values, except in formula, include and exclude, whose names may need them.
/// Throws std::invalid_argument: empty, open quote, a word after an option, an
/// option given twice.
ModelSpec ParseModelSpec(std::string_view text);

/// Splits a list ("zero,net:scg") at commas outside double quotes; an item
/// wholly in quotes keeps them. Throws std::invalid_argument if an item is
/// empty.
std::vector<std::string> SplitList(std::string_view text);

/// Throws std::invalid_argument, "model '<spec>': <why>".
[[noreturn]] void RefuseSpec(std::string_view spec, const std::string& why);

}  // namespace errmap::models
