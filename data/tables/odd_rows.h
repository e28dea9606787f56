#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "data/csv.h"
#include "data/tables/csv_layout.h"

namespace errmap::data {

/// Lines of a file that are not rows of its table: rows with another number of
/// cells than the header, blank lines between rows, repeated names.
class OddRowList {
 public:
  /// Records a line with this many cells; the table has `num_rows` rows so far.
  void Add(std::size_t line, std::size_t cells, std::size_t num_rows);
  bool empty() const { return runs_.empty(); }
  void AddBlank() { ++blank_; }
  void AddNames() { ++names_; }
  std::size_t num_names() const { return names_; }
  /// A row of numbers that begins with #.
  void AddMarked() { ++marked_; }
  /// A line of words in one cell.
  void AddWords(const std::string& text) { words_.push_back(text); }

  /// Remarks on blank lines, repeated names and comments between the rows.
  std::vector<std::string> PassedOver() const;

  /// "2 rows are left out, since the number of cells differs from the header's
  /// 3: line 8 has 2, line 9 has 4".
  std::string LeftOutText(const CsvLayout& layout) const;
  /// Returns a message on these lines and what to do. `num_rows` is the number
  /// of complete rows.
  std::string RefusalText(const CsvLayout& layout,
                          std::size_t num_rows,
                          OddRows odd,
                          char delimiter) const;

 private:
  // Lines in a row as one: (first, last), cells.
  struct Run {
    std::size_t first;
    std::size_t last;
    std::size_t cells;
  };
  static constexpr std::size_t kNoRow = static_cast<std::size_t>(-1);

  std::string LinesText() const;

  std::vector<Run> runs_;
  std::size_t count_ = 0;
  std::size_t blank_ = 0;
  std::size_t names_ = 0;
  std::size_t marked_ = 0;
  std::vector<std::string> words_;
  std::size_t first_row_ = kNoRow;
};

}  // namespace errmap::data
