#include "data/tables/counted_labels.h"

#include <algorithm>
#include <charconv>
#include <set>

namespace errmap::data {
namespace {

constexpr std::string_view kNumerals = "0123456789";
constexpr std::string_view kBetweenParts = " \t_-.,;:#/()";

// "day1" and 12 of "day1_run12".
struct Counted {
  std::string prefix;  // "": it ends in no number, or nothing counts before it
  int number = 0;
};

Counted ReadCounted(std::string_view label) {
  constexpr std::size_t kMostDigits = 4;  // of what counts
  const auto trim = [&label] {
    const std::size_t last = label.find_last_not_of(kBetweenParts);
    label = label.substr(0, last == label.npos ? 0 : last + 1);
  };
  trim();
  const std::size_t last = label.find_last_not_of(kNumerals);
  if (last == label.npos || label.size() - last - 1 > kMostDigits) return {};
  Counted counted;
  std::from_chars(
      label.data() + last + 1, label.data() + label.size(), counted.number);
  const bool has_number = last + 1 < label.size();
  label = label.substr(0, last + 1);
  // What is counted ("run") says nothing of the prefix.
  const std::size_t digit = label.find_last_of(kNumerals);
  if (!has_number || digit == label.npos) return {};
  label = label.substr(0, digit + 1);
  counted.prefix = label;
  return counted;
}

}  // namespace

std::string LessNumbers(std::string_view label) {
  std::string rest(label);
  std::erase_if(rest,
                [](char c) { return kNumerals.find(c) != kNumerals.npos; });
  return rest;
}

std::vector<std::string> PrefixesOfCounted(
    const std::vector<std::string>& labels) {
  std::vector<std::string> prefixes;
  std::set<std::string> begun;
  int first = 0;
  int last = 0;
  for (const std::string& label : labels) {
    const Counted counted = ReadCounted(label);
    if (counted.prefix.empty()) return {};
    if (prefixes.empty()) first = counted.number;
    const bool is_new = prefixes.empty() || counted.prefix != prefixes.back();
    if (LessNumbers(label) != LessNumbers(labels[0]) ||
        (is_new && !begun.insert(counted.prefix).second) ||
        (is_new ? counted.number != first : counted.number <= last)) {
      return {};
    }
    last = counted.number;
    prefixes.push_back(counted.prefix);
  }
  if (begun.size() < 2 || begun.size() == labels.size()) return {};
  return prefixes;
}

}  // namespace errmap::data
