#include "data/measurements/axis/directions.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/text.h"
#include "data/way_words.h"

namespace errmap::data {

using Eigen::Index;

namespace {

// Whether a column of this name holds 1, "yes" or alike in rows that go up, or
// in those that go down; nothing if its name is not a direction.
std::optional<bool> WayOfFlag(std::string_view name) {
  std::optional<bool> up;
  for (const std::string& word : WordsOf(name)) {
    const bool forth = IsOneOf(word, "up forward forwards fwd hinweg vorwarts");
    const bool back = IsOneOf(word,
                              "down backward backwards bwd reverse reversed "
                              "rev return ruckweg ruckwarts");
    if (forth || back) {
      up = forth;
    } else if (word != "is") {
      return std::nullopt;
    }
  }
  return up;
}

bool IsYes(std::string_view label) {
  return IsOneOf(label, "1 true yes y ja j oui si x on");
}

}  // namespace

std::ptrdiff_t NamedDirection(const CsvTable& table,
                              const DatasetSelection& selection,
                              const std::vector<Index>& rows) {
  const std::ptrdiff_t named = table.Find(selection.direction);
  if (named >= 0) return named;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const CsvColumn& column = table.columns[i];
    if (column.name == selection.target || column.name == selection.weight ||
        !(Says(column.name, Word::kDirection) || WayOfFlag(column.name)) ||
        !UnitOfColumn(column.name).symbol.empty()) {
      continue;
    }
    const std::vector<std::string> labels =
        LabelsOf(table, column, rows, 2).labels;
    // One word alone has to be one for a direction.
    const bool tells = labels.size() == 2
                           ? std::ranges::count(labels, "") == 0
                           : labels.size() == 1 && IsUpwards(labels[0]);
    if (tells) return static_cast<std::ptrdiff_t>(i);
  }
  return -1;
}

std::ptrdiff_t DirectionByValues(const CsvTable& table,
                                 std::size_t target,
                                 const std::vector<Index>& rows,
                                 const Motion& motion) {
  constexpr std::size_t kFewestPercent = 90;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (i == target) continue;
    const CsvColumn& column = table.columns[i];
    const auto [labels, codes] = LabelsOf(table, column, rows, 2);
    std::size_t agree = 0;
    for (std::size_t k = 0; k < codes.size(); ++k) {
      const bool goes_alike = motion.directions[k] == motion.directions[0];
      agree += (codes[k] == 0) == goes_alike ? 1 : 0;
    }
    if (labels.size() == 2 && std::ranges::count(labels, "") == 0 &&
        100 * agree >= kFewestPercent * rows.size()) {
      return static_cast<std::ptrdiff_t>(i);
    }
  }
  return -1;
}

std::vector<ColumnFilter> DirectionsOf(const Reading& reading,
                                       const DatasetSelection& selection) {
  std::vector<ColumnFilter> filters;
  if (IsUpwards(selection.direction)) return filters;
  if (!reading.direction.column || reading.direction.values.size() != 2) {
    return filters;
  }
  for (const ColumnFilter& filter : selection.where) {
    if (filter.column == *reading.direction.column) return filters;
  }
  for (const std::string& label : reading.direction.labels) {
    filters.push_back({.column = *reading.direction.column, .value = label});
  }
  return filters;
}

namespace {

// Of each label, in order of appearance: rows that go up less those that go
// down.
std::vector<Index> CountUps(const CsvTable& table,
                            const CsvColumn& column,
                            const std::vector<Index>& rows,
                            const Motion& motion,
                            std::vector<std::string>* labels) {
  LabelsOfRows found = LabelsOf(table, column, rows, kNoLimit);
  std::vector<Index> ups(found.labels.size(), 0);
  for (std::size_t i = 0; i < motion.directions.size(); ++i) {
    ups[found.codes[i]] += motion.directions[i];
  }
  *labels = std::move(found.labels);
  return ups;
}

}  // namespace

Reading::Direction ReadDirection(const CsvTable& table,
                                 const CsvColumn& column,
                                 const std::vector<Index>& rows,
                                 const Motion& motion,
                                 bool ordered) {
  Reading::Direction direction{.column = column.name,
                               .by = "column",
                               .evidence = Evidence::kName,
                               .sure = true};
  std::vector<std::string>& labels = direction.labels;
  const std::vector<Index> ups = CountUps(table, column, rows, motion, &labels);
  if (labels.size() != 2) {
    direction.values = labels;
    if (labels.size() != 1) return direction;
    std::optional<bool> up = IsUpwards(labels[0]);
    if (motion.is_commanded && ordered && ups[0] != 0) {
      up = ups[0] > 0;  // "R" may be reverse, or to the right
    }
    if (up) direction.values = {*up ? "up" : "down"};
    return direction;
  }
  std::optional<bool> first_is_up;
  if (ups[0] != ups[1]) first_is_up = ups[0] > ups[1];
  const bool moves = motion.both_ways && ordered;
  bool contradicts = false;
  if (const auto said = FirstIsUp(labels[0], labels[1])) {
    contradicts = moves && first_is_up == !*said;
    first_is_up = said;
  } else if (!moves) {
    const std::optional<bool> flag = WayOfFlag(column.name);
    if (flag && IsYes(labels[0]) != IsYes(labels[1])) {
      first_is_up = *flag == IsYes(labels[0]);
    } else if (const auto way = IsUpwards(labels[0])) {
      first_is_up = way;
    }
  }
  direction.sure = first_is_up.has_value() && !contradicts;
  if (first_is_up && !*first_is_up) std::swap(labels[0], labels[1]);
  direction.values = {"up", "down"};
  return direction;
}

std::optional<std::size_t> PlaceOfWay(const Reading::Direction& found,
                                      const std::string& wanted) {
  const auto label = std::ranges::find(found.labels, wanted);
  if (label != found.labels.end()) {
    return static_cast<std::size_t>(label - found.labels.begin());
  }
  const std::optional<bool> upwards = IsUpwards(wanted);
  const auto value =
      std::ranges::find_if(found.values, [&](const std::string& way) {
        return EqualsIgnoringCase(way, wanted) ||
               (upwards && IsUpwards(way) == upwards);
      });
  if (value == found.values.end()) return std::nullopt;
  return static_cast<std::size_t>(value - found.values.begin());
}

CsvColumn DirectionColumn(const CsvTable& table,
                          const std::vector<Index>& rows,
                          const Motion& motion) {
  std::vector<Index> codes(table.num_rows, 2);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    codes[rows[i]] = motion.directions[i] > 0 ? 0 : 1;
  }
  return WordColumn(kDirectionColumn, codes, {"up", "down", ""});
}

}  // namespace errmap::data
