#include "data/measurements/reading/describe_sessions.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace errmap::data {
namespace {

using Eigen::Index;

// Whether there are two sessions or more, of as many rows each: a clock that
// tells no dates shows a night of a day and an hour as an hour.
bool AreAlike(const FoundSessions& found) {
  std::vector<Index> counts(found.sessions.labels.size(), 0);
  for (const Index code : found.sessions.codes) {
    ++counts[static_cast<std::size_t>(code)];
  }
  return counts.size() > 1 &&
         std::ranges::count(counts, counts[0]) == std::ssize(counts);
}

double TextCode(const CsvColumn& column, std::size_t row) {
  const auto found = std::ranges::lower_bound(
      column.exceptions, row, {}, [](const auto& cell) { return cell.first; });
  return static_cast<double>(found->second);
}

}  // namespace

void DescribeSessions(const CsvTable& table,
                      const Clock& clock,
                      const Nights& nights,
                      ReadTable* read) {
  Reading::Sessions& sessions = read->reading.sessions;
  const FoundSessions& found = read->found;
  if (!found.sessions.column.empty()) {
    sessions.column = found.sessions.column;
  }
  sessions.by = found.by;
  sessions.count = std::ssize(found.sessions.labels);
  sessions.evidence = found.evidence;
  sessions.sure = found.by != "one" || nights.sure;
  if (clock.hours_alone && found.by != "column" && !AreAlike(found)) {
    sessions.sure = false;
    sessions.alternative = "more, as times of day hide whole days";
  }
  if (std::isfinite(found.gap) && found.gap > 0.0) {
    sessions.gap_s = found.gap;
  }
  if (found.by == "one" && nights.other > 0.0) {
    sessions.alternative =
        "parted by pauses above " + CsvNumber(std::round(nights.other)) + " s";
  }
  std::vector<std::int64_t> first(found.sessions.labels.size(), -1);
  std::set<std::pair<Index, double>> cycles;
  const std::ptrdiff_t group = read->roles.group;
  for (std::size_t i = 0; i < found.sessions.codes.size(); ++i) {
    const Index code = found.sessions.codes[i];
    auto& at = first[static_cast<std::size_t>(code)];
    if (at < 0) at = static_cast<std::int64_t>(read->log_rows[i]);
    if (group != kNoColumn) {
      const auto row = static_cast<std::size_t>(read->log_rows[i]);
      const CsvColumn& column = table.At(group);
      cycles.emplace(
          code, column.is_text() ? TextCode(column, row) : column.values[row]);
    }
  }
  std::ranges::sort(first);
  sessions.first_rows = std::move(first);
  if (group != kNoColumn) {
    read->reading.cycles.count = std::ssize(cycles);
  }
}

}  // namespace errmap::data
