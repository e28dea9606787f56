#include "data/tables/odd_rows.h"

#include <algorithm>

#include "data/argument_name.h"
#include "data/text.h"

namespace errmap::data {
namespace {

std::string ExpectedText(const CsvLayout& layout) {
  return (layout.header_line == 0 ? "the other rows' " : "the header's ") +
         std::to_string(layout.width);
}

}  // namespace

void OddRowList::Add(std::size_t line,
                     std::size_t cells,
                     std::size_t num_rows) {
  ++count_;
  if (!runs_.empty() && runs_.back().last + 1 == line &&
      runs_.back().cells == cells) {
    runs_.back().last = line;
  } else {
    runs_.push_back({line, line, cells});
  }
  if (first_row_ == kNoRow) first_row_ = num_rows;
}

std::string OddRowList::LinesText() const {
  constexpr std::size_t kMostShown = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(runs_.size(), kMostShown); ++i) {
    const Run& run = runs_[i];
    const std::string first = std::to_string(run.first);
    list += (i == 0 ? "" : ", ") +
            (run.first == run.last ? "line " + first + " has "
                                   : "lines " + first + " to " +
                                         std::to_string(run.last) + " have ") +
            std::to_string(run.cells);
  }
  if (runs_.size() > kMostShown) list += ", and so on";
  return list;
}

std::string OddRowList::LeftOutText(const CsvLayout& layout) const {
  return (count_ == 1 ? "1 row is" : std::to_string(count_) + " rows are") +
         " left out, since the number of cells differs from " +
         ExpectedText(layout) + ": " + LinesText();
}

std::string OddRowList::RefusalText(const CsvLayout& layout,
                                    std::size_t num_rows,
                                    OddRows odd,
                                    char delimiter) const {
  const Run& first = runs_.front();
  const bool is_one = count_ == 1;
  const bool is_all = num_rows == 0 && runs_.size() == 1 && !is_one;
  std::string what;
  if (is_all) {
    what = "line " + std::to_string(first.first) + ": " +
           CountText(first.cells, "field") +
           ", in all rows, where the header has " +
           std::to_string(layout.width) +
           "; give it a name for each, or take the others out";
  } else if (is_one) {
    what =
        "line " + std::to_string(first.first) + " (data row " +
        std::to_string(first_row_) + "): " + CountText(first.cells, "field") +
        " where " +
        (layout.header_line == 0 ? "the other rows have " : "the header has ") +
        std::to_string(layout.width) + "; complete the row or remove it";
  } else {
    what = std::to_string(count_) + " rows have another number of cells than " +
           ExpectedText(layout) + ": " + LinesText() +
           "; complete them or remove them";
  }
  if (odd == OddRows::kOffer && num_rows > 0) {
    what += ", or leave " + std::string(is_one ? "it" : "them") + " out with " +
            ArgumentName("missing", "drop-rows");
  }
  if (delimiter == ',' && first.cells > layout.width && first_row_ == 0) {
    what +=
        " (if these are decimal commas, write decimal points or separate the "
        "columns with ; or tab)";
  }
  return what;
}

std::vector<std::string> OddRowList::PassedOver() const {
  std::vector<std::string> lines;
  if (blank_ > 0) {
    lines.push_back("blank lines between rows are skipped, in " +
                    CountText(blank_, "place"));
  }
  if (names_ > 0) {
    lines.push_back("the names are repeated between the rows, " +
                    CountText(names_, "time") +
                    ": what is below them is read as the same table");
  }
  if (marked_ > 0) {
    lines.push_back("rows behind # are passed over: " +
                    std::to_string(marked_));
  }
  if (!words_.empty()) {
    lines.push_back(CountText(words_.size(), "line") +
                    " of words among the rows: " + QuotedText(words_.front()) +
                    (words_.size() == 1 ? "" : ", ..."));
  }
  return lines;
}

}  // namespace errmap::data
