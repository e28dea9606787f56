#include "data/tables/odd_rows.h"

#include <algorithm>

#include "data/argument_name.h"

namespace errmap::data {
namespace {

std::string ExpectedText(const CsvLayout& layout) {
  return (layout.header_line == 0 ? "the other rows' " : "the header's ") +
         std::to_string(layout.width);
}

}  // namespace

std::string FieldsText(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " field" : " fields");
}

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
         " left out for another number of cells than " + ExpectedText(layout) +
         ": " + LinesText();
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
           FieldsText(first.cells) + ", in all rows, where the header has " +
           std::to_string(layout.width) +
           "; give it a name for each, or take the others out";
  } else if (is_one) {
    what =
        "line " + std::to_string(first.first) + " (data row " +
        std::to_string(first_row_) + "): " + FieldsText(first.cells) +
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
    lines.push_back("blank lines between rows are passed over, in " +
                    std::to_string(blank_) +
                    (blank_ == 1 ? " place" : " places"));
  }
  if (names_ > 0) {
    lines.push_back("the names stand between the rows again, " +
                    std::to_string(names_) +
                    (names_ == 1 ? " time" : " times") +
                    ": what is below them is read as the same table");
  }
  if (!words_.empty()) {
    lines.push_back(std::to_string(words_.size()) +
                    (words_.size() == 1 ? " line" : " lines") +
                    " of words among the rows: " + QuotedText(words_.front()) +
                    (words_.size() == 1 ? "" : ", ..."));
  }
  return lines;
}

}  // namespace errmap::data
