#include "data/measurements/reading/label_parts.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "data/columns.h"
#include "data/text.h"

namespace errmap::data {
namespace {

constexpr std::size_t kMostLabels = 5000;

struct Label {
  std::string session;  // the label without its number
  double number = 0.0;
};

// A label with one of its numbers, counted from the end, taken out; of a number
// of three digits or more the last two may count.
std::optional<Label> Split(const std::string& text,
                           std::size_t from_end,
                           bool last_two) {
  constexpr std::string_view kDigits = "0123456789";
  std::size_t end = text.size();
  std::size_t begin = end;
  for (std::size_t i = 0; i <= from_end; ++i) {
    end = text.find_last_of(kDigits, begin == 0 ? text.npos : begin - 1);
    if (begin == 0 || end == text.npos) return std::nullopt;
    begin = text.find_last_not_of(kDigits, end);
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

// Whether each session has numbers one after the other, from the same one on.
bool CountAnew(const std::vector<Label>& labels, std::size_t least) {
  std::set<std::string> seen;
  std::size_t length = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool goes_on = i > 0 && labels[i].session == labels[i - 1].session;
    if (goes_on ? labels[i].number != labels[i - 1].number + 1.0
                : labels[i].number != labels[0].number || length == 1 ||
                      !seen.insert(labels[i].session).second) {
      return false;
    }
    length = goes_on ? length + 1 : 1;
  }
  return seen.size() >= least && length > 1;
}

// Words without what parts them from the number.
std::string WithoutSeparators(const std::string& text) {
  constexpr std::string_view kSeparators = " -_./,:()#";
  const std::size_t first = text.find_first_not_of(kSeparators);
  if (first == text.npos) return text;
  return text.substr(first, text.find_last_not_of(kSeparators) + 1 - first);
}

}  // namespace

std::string SessionsNamedIn(std::string_view labels) {
  return "session of " + std::string(labels);
}

std::optional<CsvColumn> FindSessionsInLabels(
    const CsvTable& table,
    const CsvColumn& labels,
    const std::vector<Eigen::Index>& rows,
    std::size_t least) {
  const LabelsOfRows found = LabelsOf(table, labels, rows, kMostLabels);
  const std::size_t num = found.labels.size();
  if (found.codes.size() != rows.size() || num < 2 * least ||
      num > kMostLabels ||
      !std::ranges::is_sorted(found.codes)) {  // each in one piece
    return std::nullopt;
  }
  for (const auto& [from_end, last_two] :
       {std::pair(0U, false), {1U, false}, {2U, false}, {0U, true}}) {
    std::vector<Label> split;
    for (const std::string& text : found.labels) {
      auto label = Split(text, from_end, last_two);
      if (!label) break;
      split.push_back(std::move(*label));
    }
    if (split.size() != num || !CountAnew(split, least)) continue;
    std::vector<std::ptrdiff_t> codes(table.num_rows, 0);
    std::vector<std::string> words = {""};
    std::vector<std::ptrdiff_t> code_of(num);
    for (std::size_t i = 0; i < num; ++i) {
      if (i == 0 || split[i].session != split[i - 1].session) {
        words.push_back(WithoutSeparators(split[i].session));
      }
      code_of[i] = std::ssize(words) - 1;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      codes[static_cast<std::size_t>(rows[i])] = code_of[found.codes[i]];
    }
    CsvColumn sessions =
        WordColumn(SessionsNamedIn(labels.name), codes, std::move(words));
    DropUnusedTexts(&sessions);
    return sessions;
  }
  return std::nullopt;
}

}  // namespace errmap::data
