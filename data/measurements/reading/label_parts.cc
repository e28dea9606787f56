#include "data/measurements/reading/label_parts.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "data/columns.h"
#include "data/counted_labels.h"

namespace errmap::data {

std::string SessionsNamedIn(std::string_view labels) {
  return "session of " + std::string(labels);
}

std::optional<CsvColumn> FindSessionsInLabels(
    const CsvTable& table,
    const CsvColumn& labels,
    const std::vector<Eigen::Index>& rows,
    std::size_t least) {
  constexpr std::size_t kMostLabels = 5000;
  const LabelsOfRows found = LabelsOf(table, labels, rows, kMostLabels);
  const std::size_t num = found.labels.size();
  if (found.codes.size() != rows.size() || num < 2 * least ||
      num > kMostLabels ||
      !std::ranges::is_sorted(found.codes)) {  // each in one piece
    return std::nullopt;
  }
  const std::vector<std::string> sessions =
      SessionsOfCounted(found.labels, least);
  if (sessions.empty()) return std::nullopt;
  std::vector<std::string> words = {""};
  std::vector<std::ptrdiff_t> code_of;
  for (const std::string& session : sessions) {
    if (session != words.back() || words.size() == 1) words.push_back(session);
    code_of.push_back(std::ssize(words) - 1);
  }
  std::vector<std::ptrdiff_t> codes(table.num_rows, 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    codes[static_cast<std::size_t>(rows[i])] = code_of[found.codes[i]];
  }
  CsvColumn column =
      WordColumn(SessionsNamedIn(labels.name), codes, std::move(words));
  DropUnusedTexts(&column);
  return column;
}

}  // namespace errmap::data
