#include "data/tables/shapes/block_titles.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

#include "data/column_words.h"
#include "data/columns.h"
#include "data/counted_labels.h"
#include "data/tables/shapes/numbered_names.h"
#include "data/text.h"
#include "data/text_index.h"

namespace errmap::data {
namespace {

// "2024-07-14" of "day 1, 2024-07-14"; "" if there is none.
std::string DateTokenIn(std::string_view text) {
  constexpr std::string_view kDigits = "0123456789";
  for (std::size_t at = text.find_first_of(kDigits); at != text.npos;) {
    const std::size_t end =
        std::min(text.find_first_not_of("0123456789-./", at), text.size());
    const std::string_view token = text.substr(at, end - at);
    if (IsNumericDate(token)) return std::string(token);
    at = text.find_first_of(kDigits, end);
  }
  return "";
}

// The line above each block, the nearest; nothing where the first has none.
std::vector<TitleLine> TitlesOfBlocks(const std::vector<TitleLine>& lines,
                                      std::size_t num_rows) {
  std::vector<TitleLine> blocks;
  for (const TitleLine& line : lines) {
    if (line.row >= num_rows) continue;
    if (!blocks.empty() && blocks.back().row == line.row) blocks.pop_back();
    blocks.push_back(line);
  }
  if (blocks.size() < 2 || blocks.front().row != 0) blocks.clear();
  return blocks;
}

bool TellBlocks(const std::vector<std::string>& labels,
                std::size_t names_again) {
  return std::set(labels.begin(), labels.end()).size() == labels.size() &&
         std::ranges::all_of(labels, [&](const std::string& label) {
           return NamesSession(label) &&
                  (names_again + 1 == labels.size() ||
                   LessNumbers(label) == LessNumbers(labels[0]));
         });
}

// Changes the labels to what tells sessions, and returns what they are.
std::string NameLabels(std::vector<std::string>* labels) {
  std::vector<std::string> dates;
  std::ranges::transform(*labels, std::back_inserter(dates), DateTokenIn);
  const std::set<std::string> distinct(dates.begin(), dates.end());
  if (!distinct.contains("") && distinct.size() == labels->size()) {
    *labels = std::move(dates);
    return "date";
  }
  if (auto days = SessionsOfCounted(*labels); !days.empty()) {
    *labels = std::move(days);
    return "session";
  }
  const auto all_say = [&](Word word) {
    return std::ranges::all_of(
        *labels, [&](const std::string& label) { return Says(label, word); });
  };
  return all_say(Word::kDay)       ? "day"
         : all_say(Word::kSession) ? "session"
         : all_say(Word::kCycle)   ? "cycle"
                                   : "run";
}

bool HasColumnOf(const CsvTable& table, const std::string& name) {
  return std::ranges::any_of(table.columns, [&](const CsvColumn& column) {
    return column.name == name || IsCalled(column.name, Word::kSession) ||
           IsCalled(column.name, name == "cycle" ? Word::kCycle : Word::kRun);
  });
}

}  // namespace

bool HoldsDate(const std::string& text) { return !DateTokenIn(text).empty(); }

bool NamesSession(const std::string& text) {
  return HoldsDate(text) || Says(text, Word::kSession) ||
         Says(text, Word::kRun) || Says(text, Word::kCycle);
}

void PartByTitles(const std::vector<TitleLine>& lines,
                  std::size_t names_again,
                  CsvTable* table) {
  const std::vector<TitleLine> blocks = TitlesOfBlocks(lines, table->num_rows);
  std::vector<std::string> labels;
  for (const TitleLine& block : blocks) labels.push_back(block.text);
  std::string name;
  const bool tell = !blocks.empty() && TellBlocks(labels, names_again);
  if (tell) name = NameLabels(&labels);
  if (!tell || HasColumnOf(*table, name)) {
    const auto told = std::ranges::find_if(lines, [](const TitleLine& line) {
      return line.row > 0 &&
             (Says(line.text, Word::kSession) || HoldsDate(line.text));
    });
    if (told != lines.end() && !tell) {
      table->Remark(
          "lines among the rows part no sessions: " + QuotedText(told->text) +
          "; a column 'day' or 'session' does");
    }
    return;
  }
  std::vector<std::ptrdiff_t> codes;
  std::vector<std::string> words;
  TextIndex index;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const std::ptrdiff_t code = index.IndexOf(labels[i], &words);
    const std::size_t end =
        i + 1 < blocks.size() ? blocks[i + 1].row : table->num_rows;
    codes.resize(end, code);
  }
  table->Remark(std::to_string(blocks.size()) +
                " lines that separate the rows are read as a column " +
                QuotedName(name) + ": " + QuotedText(blocks[0].text) + ", " +
                QuotedText(blocks[1].text) +
                (blocks.size() > 2 ? ", ..." : ""));
  table->columns.push_back(WordColumn(name, codes, std::move(words)));
}

void PartByBlankLines(const std::vector<BlankLines>& blanks, CsvTable* table) {
  constexpr std::size_t kFewestRows = 4;  // of a block
  constexpr std::size_t kFewestPlaces = 2;
  const char* const name = "block";
  std::size_t most = 0;
  for (const BlankLines& blank : blanks) most = std::max(most, blank.count);
  std::vector<std::size_t> starts{0};
  for (const BlankLines& blank : blanks) {
    if (blank.count == most && blank.row > 0) starts.push_back(blank.row);
  }
  if (starts.size() <= kFewestPlaces || table->Find(name) >= 0) return;
  starts.push_back(table->num_rows);
  std::vector<double> numbers;
  for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
    if (starts[i + 1] < starts[i] + kFewestRows) return;
    numbers.resize(starts[i + 1], static_cast<double>(i + 1));
  }
  table->columns.push_back(NumberColumn(name, std::move(numbers)));
  table->Remark(
      "the rows between blank lines are numbered in a column 'block'");
}

}  // namespace errmap::data
