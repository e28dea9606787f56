#include "data/tables/column_names.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "data/input_error.h"
#include "data/tables/cells/csv_cells.h"
#include "data/tables/cells/unit_cells.h"
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

namespace {

std::vector<std::string> CellsOf(std::string_view line, char delimiter) {
  CsvCells cells(line, [](std::size_t) { return std::string(); });
  cells.delimiter = delimiter;
  std::vector<std::string> texts;
  try {
    do {
      texts.emplace_back(cells.Next());
    } while (cells.PassEnd());
  } catch (const InputError&) {
    texts.clear();
  }
  return texts;
}

// The cells of a comment of so many columns; else of another number, or none.
std::vector<std::string> CellsOfComment(std::string_view text,
                                        char delimiter,
                                        std::size_t columns) {
  // "#" alone is the name of a column that counts.
  std::string_view words = text;
  words.remove_prefix(std::min(words.find_first_not_of("# \t"), words.size()));
  // "columns: time;X", "units: s;mm".
  const std::size_t label = words.find(": ");
  const bool has_label = label < words.find(' ');
  const bool is_name = !has_label && text.size() > 1 && text[1] == delimiter;
  if (!is_name) text = words;
  if (has_label) text.remove_prefix(label + 2);
  std::vector<std::string> cells = CellsOf(text, delimiter);
  // "# day cycle", where blanks part the columns: the sign is not a name.
  if (is_name && delimiter == ' ' && cells.size() == columns + 1) {
    cells.erase(cells.begin());
  }
  // The rows may end in a separator.
  if (cells.size() + 1 == columns && is_name) cells.emplace_back();
  return cells;
}

}  // namespace

CommentNames FindNamesInComments(std::string_view above,
                                 char delimiter,
                                 const NumberColumns& columns) {
  CommentNames found;
  std::vector<std::string> units;
  const char* const end = above.data() + above.size();
  std::size_t line = 1;
  for (const char* begin = above.data(); begin != end; ++line) {
    const char* const stop = std::find_if(begin, end, IsLineEnd);
    std::string_view text(begin, static_cast<std::size_t>(stop - begin));
    begin = PastLineEnd(stop, end);
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark)) {
      text.remove_prefix(kByteOrderMark.size());
    }
    if (!text.starts_with('#')) continue;
    std::vector<std::string> cells =
        CellsOfComment(text, delimiter, columns.width());
    if (cells.size() != columns.width() || !columns.MayBeNames(cells)) continue;
    if (AreUnitCells(cells)) {
      units = std::move(cells);
    } else {
      found = {.names = std::move(cells), .line = line};
    }
  }
  for (std::size_t i = 0; found.line > 0 && i < units.size(); ++i) {
    AddUnitOfCell(units[i], &found.names[i]);
  }
  return found;
}

}  // namespace errmap::data
