#include "data/tables/column_names.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "data/text.h"

namespace errmap::data {

NamedColumns NameColumns(const std::vector<std::string>& names) {
  const std::unordered_set<std::string> given(names.begin(), names.end());
  const bool by_number = std::ranges::all_of(names, &std::string::empty);
  std::unordered_set<std::string> taken;
  NamedColumns named;
  for (const std::string& text : names) {
    const std::size_t number = named.columns.size() + 1;
    const bool has_name = by_number || !text.empty();
    std::string name = text.empty() ? "column_" + std::to_string(number) : text;
    if (taken.contains(name)) {
      const std::string first = name;
      for (int i = 2; taken.contains(name) || given.contains(name); ++i) {
        name = first + "_" + std::to_string(i);
      }
      if (has_name) named.again.push_back(QuotedName(name));
    }
    taken.insert(name);
    CsvColumn& column = named.columns.emplace_back();
    column.name = std::move(name);
    column.has_name = has_name;
    if (has_name) named.num_named = number;
  }
  return named;
}

}  // namespace errmap::data
