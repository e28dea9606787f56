#include "data/counted_labels.h"

#include <optional>
#include <set>
#include <utility>

#include "data/text.h"

namespace errmap::data {
namespace {

constexpr std::string_view kNumerals = "0123456789";

struct Label {
  std::string session;  // the label without its number
  double number = 0.0;
};

// A label with one of its numbers, counted from the end, taken out; of a number
// of three digits or more the last two may count.
std::optional<Label> Split(const std::string& text,
                           std::size_t from_end,
                           bool last_two) {
  std::size_t end = text.size();
  std::size_t begin = end;
  for (std::size_t i = 0; i <= from_end; ++i) {
    end = text.find_last_of(kNumerals, begin == 0 ? text.npos : begin - 1);
    if (begin == 0 || end == text.npos) return std::nullopt;
    begin = text.find_last_not_of(kNumerals, end);
    begin = begin == text.npos ? 0 : begin + 1;
  }
  if (last_two) {
    if (end - begin < 2) return std::nullopt;
    begin = end - 1;
  }
  Label label{.session = text.substr(0, begin) + text.substr(end + 1)};
  return ParseNumber(text.substr(begin, end + 1 - begin), &label.number)
             ? std::optional(std::move(label))
             : std::nullopt;
}

// Whether each session has numbers that count on, from the same one.
bool CountAnew(const std::vector<Label>& labels, std::size_t least) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool goes_on = i > 0 && labels[i].session == labels[i - 1].session;
    if (goes_on ? labels[i].number <= labels[i - 1].number
                : labels[i].number != labels[0].number ||
                      !seen.insert(labels[i].session).second) {
      return false;
    }
  }
  return seen.size() >= least && seen.size() < labels.size();
}

// "D1" of "D1C": what is counted says nothing of the session.
std::string NameOf(const std::string& session) {
  constexpr std::string_view kSeparators = " \t-_./,;:()#";
  const std::size_t digit = session.find_last_of(kNumerals);
  const std::size_t last =
      digit != session.npos ? digit : session.find_last_not_of(kSeparators);
  if (last == session.npos) return session;
  const std::size_t first = session.find_first_not_of(kSeparators);
  return session.substr(first, last + 1 - first);
}

}  // namespace

std::string LessNumbers(std::string_view label) {
  std::string rest(label);
  std::erase_if(rest,
                [](char c) { return kNumerals.find(c) != kNumerals.npos; });
  return rest;
}

std::vector<std::string> SessionsOfCounted(
    const std::vector<std::string>& labels, std::size_t least) {
  for (const auto& [from_end, last_two] :
       {std::pair(0U, false), {1U, false}, {2U, false}, {0U, true}}) {
    std::vector<Label> split;
    for (const std::string& text : labels) {
      auto label = Split(text, from_end, last_two);
      if (!label) break;
      split.push_back(std::move(*label));
    }
    if (split.size() != labels.size() || !CountAnew(split, least)) continue;
    std::vector<std::string> sessions;
    for (const Label& label : split) sessions.push_back(NameOf(label.session));
    return sessions;
  }
  return {};
}

}  // namespace errmap::data
