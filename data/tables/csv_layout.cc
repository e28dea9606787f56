#include "data/tables/csv_layout.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <set>

#include "data/column_words.h"
#include "data/tables/cells/loose_numbers.h"
#include "data/tables/cells/missing_cells.h"
#include "data/tables/cells/unit_cells.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

constexpr std::size_t kNone = std::string::npos;

// Of some of a row's cells: how many are numbers, and words that stand for
// none.
struct CellCounts {
  std::size_t numbers = 0;
  std::size_t words = 0;
};

std::string NumberOf(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

class LayoutFinder {
 public:
  LayoutFinder(const CsvCells& cells,
               const CsvDialect& dialect,
               std::string_view text_above)
      : cells_(cells),
        dialect_(dialect),
        text_above_(text_above),
        records_(FirstRecords(cells)) {}

  CsvLayout Find() {
    if (records_.empty()) return OfUnreadable();
    usual_ = UsualWidth(records_, 0);
    FindNumericColumns();
    const std::size_t first = FirstDataRow();
    const std::size_t names = first == kNone ? 0 : NamesAbove(first);
    if (names != kNone) {
      TakeNames(names, first);
    } else {
      TakeNoNames(first);
    }
    FindWidth(names == kNone ? first : names + 1);
    return std::move(layout_);
  }

 private:
  // A quote in the first row is never closed: to be told by who reads on.
  CsvLayout OfUnreadable() {
    CsvCells cells = cells_;
    do {
      layout_.names.emplace_back(cells.Next());
    } while (cells.PassEnd());
    layout_.width = layout_.num_names = layout_.names.size();
    layout_.header_line = cells_.line();
    layout_.data = cells.position();
    return std::move(layout_);
  }

  bool IsNumber(std::string_view cell) const {
    NumberForm form;
    return ReadNumberForm(cell, dialect_.decimal_comma, &form) ||
           ReadLooseNumber(
               cell, dialect_.decimal_comma, dialect_.decimal_points, &form) !=
               Loose::kNone;
  }

  // In the columns that hold numbers.
  CellCounts CountsOf(const std::vector<std::string>& cells) const {
    CellCounts counts;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (i >= is_numeric_.size() || !is_numeric_[i]) continue;
      if (IsNumber(cells[i]) || HasLabel(cells[i], i)) {
        ++counts.numbers;
      } else if (!IsMissingNumber(cells[i])) {
        ++counts.words;
      }
    }
    return counts;
  }

  // What all cells of each column say before their numbers ("T1=21.4"), the
  // first one's too, or "".
  void FindLabels() {
    for (const CsvRecord& record : records_) {
      if (record.cells.size() != usual_) continue;
      const bool is_first = labels_.empty();
      labels_.resize(usual_);
      for (std::size_t i = 0; i < usual_; ++i) {
        std::string_view cell = record.cells[i];
        const std::string label = TakeLabel(&cell).text;
        if (is_first) labels_[i] = label;
        if (label != labels_[i]) labels_[i].clear();
      }
    }
  }

  bool HasLabel(std::string_view cell, std::size_t column) const {
    return !labels_[column].empty() && TakeLabel(&cell).text == labels_[column];
  }

  void FindNumericColumns() {
    FindLabels();
    std::vector<CellCounts> counts(usual_);
    std::size_t rows = 0;
    for (const CsvRecord& record : records_) {
      if (record.cells.size() != usual_) continue;
      // The first row may be names.
      if (++rows == 2) counts.assign(usual_, {});
      for (std::size_t i = 0; i < usual_; ++i) {
        if (IsNumber(record.cells[i]) || HasLabel(record.cells[i], i)) {
          ++counts[i].numbers;
        } else if (!IsMissingNumber(record.cells[i])) {
          ++counts[i].words;
        }
      }
    }
    for (const CellCounts& column : counts) {
      is_numeric_.push_back(column.numbers > 0 &&
                            column.numbers >= column.words);
      num_numeric_ += is_numeric_.back() ? 1 : 0;
    }
  }

  // The first row with more numbers than words there, as long as the others
  // or with half of their numbers ("Targets,17" is a line above the table);
  // kNone where the table has none.
  std::size_t FirstDataRow() const {
    for (std::size_t i = 0; i < records_.size(); ++i) {
      const std::vector<std::string>& cells = records_[i].cells;
      const CellCounts counts = CountsOf(cells);
      const bool is_whole =
          cells.size() + 1 >= usual_ || 2 * counts.numbers >= num_numeric_;
      if (is_whole && counts.numbers > counts.words && !AreNumberNames(i) &&
          !IsShortAboveWords(i)) {
        return i;
      }
    }
    return kNone;
  }

  // "Channel,1,2,3" in a block above the table.
  bool IsShortAboveWords(std::size_t row) const {
    if (records_[row].cells.size() >= usual_ || row + 1 >= records_.size())
      return false;
    const CellCounts below = CountsOf(records_[row + 1].cells);
    return below.words > below.numbers;
  }

  // "cycle, t1_degC, 0, 50, 100": names some of which are numbers that go one
  // way, over a row with numbers below the words.
  bool AreNumberNames(std::size_t row) const {
    if (row + 1 >= records_.size() || records_[row].cells.size() != usual_ ||
        records_[row + 1].cells.size() != usual_) {
      return false;
    }
    for (std::size_t i = 0; i < row; ++i) {
      if (MayBeNames(records_[i].cells)) return false;
    }
    std::vector<double> numbers;
    bool is_named = false;
    for (std::size_t i = 0; i < usual_; ++i) {
      const std::string& cell = records_[row].cells[i];
      const std::string& below = records_[row + 1].cells[i];
      NumberForm form;
      if (ReadNumberForm(cell, dialect_.decimal_comma, &form)) {
        numbers.push_back(form.value);
      } else if (!IsMissingNumber(cell) || (i == 0 && cell.empty())) {
        is_named =
            is_named || (!BeginsWithNumber(cell) && BeginsWithNumber(below));
      }
    }
    return is_named && GoOneWay(numbers);
  }

  static bool BeginsWithNumber(std::string_view cell) {
    return cell.find_first_of("0123456789") <=
           (cell.starts_with('-') || cell.starts_with('+') ? 1U : 0U);
  }

  static bool GoOneWay(const std::vector<double>& numbers) {
    constexpr std::size_t kFewest = 3;
    return numbers.size() >= kFewest &&
           (std::ranges::adjacent_find(numbers, std::greater_equal<>()) ==
                numbers.end() ||
            std::ranges::adjacent_find(numbers, std::less_equal<>()) ==
                numbers.end());
  }

  // A separator at the rows' ends, or columns that no row reaches, make a line
  // of names shorter by one, or longer.
  bool MayBeNames(const std::vector<std::string>& cells) const {
    const CellCounts counts = CountsOf(cells);
    return cells.size() + 1 >= usual_ && (cells.size() > 1 || usual_ == 1) &&
           counts.numbers == 0 && 2 * counts.words >= num_numeric_;
  }

  // The row of names above the first data row, or kNone.
  std::size_t NamesAbove(std::size_t first) const {
    if (first > 0 && AreNumberNames(first - 1)) return first - 1;
    for (std::size_t i = first; i-- > 0;) {
      if (!MayBeNames(records_[i].cells)) continue;
      const bool is_below_names = i > 0 && MayBeNames(records_[i - 1].cells);
      if (is_below_names && AreUnitCells(records_[i].cells)) continue;
      if (is_below_names && i > 1 && AreUnitsOfNumbers(i - 1) &&
          !CallATime(records_[i].cells) && MayBeNames(records_[i - 2].cells)) {
        return i - 2;
      }
      return i;
    }
    // One line of another length, or with numbers in it, is meant for names
    // all the same: to be told what is wrong with it.
    if (first == 1 && (records_[0].cells.size() > 1 || usual_ == 1)) return 0;
    return kNone;
  }

  // Whether a row has units for most columns of numbers.
  bool AreUnitsOfNumbers(std::size_t row) const {
    const std::vector<std::string>& cells = records_[row].cells;
    std::size_t units = 0;
    for (std::size_t i = 0; i < cells.size() && i < usual_; ++i) {
      std::string unit = AsUtf8(cells[i]);
      units += is_numeric_[i] && ReadUnitCell(&unit) && !unit.empty() ? 1 : 0;
    }
    return units >= 2 && 4 * units >= 3 * num_numeric_;
  }

  static bool CallATime(const std::vector<std::string>& cells) {
    return std::ranges::any_of(cells, [](const std::string& cell) {
      return IsCalled(cell, Word::kTime) || IsCalled(cell, Word::kDate);
    });
  }

  // Names, units, and a third row above the numbers.
  void TakeUnitsBelow(std::size_t row) {
    const std::vector<std::string>& units = records_[row + 1].cells;
    for (std::size_t i = 0; i < std::min(units.size(), usual_); ++i) {
      std::string unit = AsUtf8(units[i]);
      std::string& name = layout_.names[i];
      if (!is_numeric_[i] || !ReadUnitCell(&unit) || unit.empty()) continue;
      name = NameWithUnit(AsUtf8(name), unit).value_or(name);
    }
    layout_.data = After(row + 2);
    Say("line " + std::to_string(records_[row + 2].start.line) +
        ", below names and units, is passed over");
  }

  void TakeNames(std::size_t row, std::size_t first) {
    layout_.names = records_[row].cells;
    layout_.header_line = records_[row].start.line;
    layout_.data = After(row);
    if (first != kNone && first == row + 3 && layout_.names.size() >= usual_ &&
        AreUnitsOfNumbers(row + 1) && MayBeNames(records_[row + 2].cells)) {
      TakeUnitsBelow(row);
    }
    std::string& name = layout_.names.front();
    if (name.starts_with("$$")) name.erase(0, 2);
    if (first == row + 2) TakeNamesOfIndex(row + 1);
    TakeNamesOfBlock(row, &layout_.names);
    const std::size_t titles = TakeUpperNames(row) ? row - 1 : row;
    TakeTitles(titles);
  }

  // Whether the names say no error, and what might stand for them one.
  static bool TellAnError(const std::vector<std::string>& names,
                          const std::vector<std::string>& meant) {
    const auto is_error = [](const std::string& name) {
      return ErrorSign(AsUtf8(name)) != 0;
    };
    return std::ranges::none_of(names, is_error) &&
           std::ranges::any_of(meant, is_error);
  }

  // Units right above the names, and other names above these: "Tag", "Unit".
  bool TakeUnitsAbove(std::size_t row) {
    if (!AreUnitsOfNumbers(row - 1) || AreUnitsOfNumbers(row)) return false;
    const std::vector<std::string>& units = records_[row - 1].cells;
    std::vector<std::string> meant = layout_.names;
    if (row > 1 && records_[row - 2].cells.size() == usual_) {
      for (std::size_t i = 0; i < usual_; ++i) {
        const std::string& name = records_[row - 2].cells[i];
        if (is_numeric_[i] && !name.empty()) meant[i] = name;
      }
    }
    const bool has_others = TellAnError(layout_.names, meant);
    if (has_others) layout_.names = std::move(meant);
    for (std::size_t i = 0; i < usual_; ++i) {
      std::string unit = AsUtf8(units[i]);
      if (!is_numeric_[i] || !ReadUnitCell(&unit) || unit.empty()) continue;
      std::string& name = layout_.names[i];
      name = NameWithUnit(AsUtf8(name), unit).value_or(name);
    }
    Say("line " + std::to_string(records_[row - 1].start.line) +
        " has the units of the columns" +
        (has_others ? ", and the line above their names" : ""));
    return true;
  }

  // Names below those of the others, as pandas writes an index's:
  // "day,cycle,,," under ",,x_mm,error_um".
  void TakeNamesOfIndex(std::size_t row) {
    const std::vector<std::string>& cells = records_[row].cells;
    const bool are_apart = std::ranges::equal(
        cells, layout_.names, [](const auto& cell, const auto& name) {
          return cell.empty() != name.empty();
        });
    if (!are_apart || std::ranges::count(layout_.names, "") == 0) return;
    for (std::size_t i = 0; i < cells.size(); ++i) layout_.names[i] += cells[i];
    layout_.data = After(row);
    Say("line " + std::to_string(records_[row].start.line) +
        " names the columns that the line above does not");
  }

  // "CH1,bed,TEMP" above the table says what the column CH1 is.
  void TakeNamesOfBlock(std::size_t row, std::vector<std::string>* names) {
    std::vector<std::string> meant = *names;
    for (std::string& name : meant) {
      for (std::size_t i = 0; i < row && !name.empty(); ++i) {
        const std::vector<std::string>& cells = records_[i].cells;
        if (cells.size() > 1 && cells[0] == name && !cells[1].empty() &&
            !BeginsWithNumber(cells[1])) {
          name = cells[1];
          break;
        }
      }
    }
    if (!TellAnError(*names, meant)) return;
    Say("lines above the table name its columns");
    *names = std::move(meant);
  }

  // A second row of names right above tells apart what the lower one does not.
  bool TakeUpperNames(std::size_t row) {
    if (row == 0 || records_[row - 1].cells.size() != usual_ || usual_ < 2 ||
        layout_.names.size() != usual_) {
      return false;
    }
    if (TakeUnitsAbove(row)) return true;
    std::vector<std::string> upper = records_[row - 1].cells;
    TakeNamesOfBlock(row - 1, &upper);
    const auto num_words = std::ranges::count_if(
        upper, [](const std::string& cell) { return !cell.empty(); });
    if (num_words < 2 || CountsOf(upper).numbers > 0) return false;
    const std::set<std::string> distinct(layout_.names.begin(),
                                         layout_.names.end());
    const bool tells = distinct.size() == usual_ && !distinct.contains("") &&
                       !AreMadeOfUnits(layout_.names);
    std::string group;
    for (std::size_t i = 0; i < usual_ && !tells; ++i) {
      if (!upper[i].empty()) group = upper[i];
      std::string& name = layout_.names[i];
      const bool is_alone = std::ranges::count(records_[row].cells, name) == 1;
      std::string unit = AsUtf8(name);
      if (name.empty()) {
        name = upper[i];
      } else if (ReadUnitCell(&unit) && !unit.empty() && !upper[i].empty()) {
        name = NameWithUnit(AsUtf8(upper[i]), unit).value_or(upper[i]);
      } else if (AreMadeOfUnits(records_[row].cells) && !upper[i].empty()) {
        name.insert(0, upper[i] + " ");
      } else if (!is_alone && !group.empty()) {
        name.insert(0, group + " ");
      }
    }
    Say("line " + std::to_string(records_[row - 1].start.line) +
        " is a second row of names" + (tells ? " and passed over" : "") +
        (tells ? "" : ", which tells columns of one name apart"));
    return true;
  }

  // Two cells or more are units and nothing else.
  static bool AreMadeOfUnits(const std::vector<std::string>& cells) {
    return std::ranges::count_if(cells, [](const std::string& cell) {
             std::string text = AsUtf8(cell);
             return ReadUnitCell(&text) && !text.empty();
           }) >= 2;
  }

  void TakeNoNames(std::size_t first) {
    layout_.data = records_[first].start;
    layout_.names.assign(usual_, "");
    TakeTitles(first);
    if (TakeNamesOfComment(first)) return;
    Say("no line of names: the columns are called column_1" +
        (usual_ == 1 ? std::string() : " to column_" + std::to_string(usual_)));
  }

  // Names in the nearest comment above that has as many as there are cells.
  bool TakeNamesOfComment(std::size_t first) {
    const char* const end = records_[first].start.cursor;
    const std::string_view above(
        text_above_.data(), static_cast<std::size_t>(end - text_above_.data()));
    std::size_t line = 1;
    std::vector<std::string> units;
    for (std::size_t at = 0; at < above.size(); ++line) {
      const char* const begin = above.data() + at;
      const char* const stop = std::find_if(begin, end, IsLineEnd);
      at = static_cast<std::size_t>(PastLineEnd(stop, end) - above.data());
      std::string_view text(begin, static_cast<std::size_t>(stop - begin));
      constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
      if (text.starts_with(kByteOrderMark)) {
        text.remove_prefix(kByteOrderMark.size());
      }
      if (!text.starts_with('#')) continue;
      // "#" alone is the name of a column that counts.
      std::string_view words = text;
      words.remove_prefix(
          std::min(words.find_first_not_of("# \t"), words.size()));
      // "columns: time;X", "units: s;mm".
      const std::size_t label = words.find(": ");
      const bool has_label = label < words.find(' ');
      const bool is_name =
          !has_label && text.size() > 1 && text[1] == dialect_.delimiter;
      if (!is_name) text = words;
      if (has_label) text.remove_prefix(label + 2);
      std::vector<std::string> cells = CellsOf(text);
      // "# day cycle", where blanks part the columns: the sign is no name.
      if (is_name && dialect_.delimiter == ' ' && cells.size() == usual_ + 1) {
        cells.erase(cells.begin());
      }
      // The rows may end in a separator.
      if (cells.size() + 1 == usual_ && is_name) cells.emplace_back();
      if (cells.size() != usual_ || !MayBeNames(cells)) continue;
      if (AreUnitCells(cells)) {
        units = cells;
        continue;
      }
      layout_.names = cells;
      layout_.header_line = line;
    }
    if (layout_.header_line == 0) return false;
    for (std::size_t i = 0; i < units.size(); ++i) {
      std::string unit = AsUtf8(units[i]);
      if (!ReadUnitCell(&unit) || unit.empty()) continue;
      std::string& name = layout_.names[i];
      name = NameWithUnit(AsUtf8(name), unit).value_or(name);
    }
    layout_.num_names = usual_;
    Say("the names of the columns are those of the comment on line " +
        std::to_string(layout_.header_line));
    return true;
  }

  std::vector<std::string> CellsOf(std::string_view line) const {
    CsvCells cells(line, [](std::size_t) { return std::string(); });
    cells.delimiter = dialect_.delimiter;
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

  void TakeTitles(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<std::string> words = records_[i].cells;
      while (words.size() > 1 && words.back().empty()) words.pop_back();
      const std::string between(1, dialect_.delimiter);
      std::string title = AsUtf8(JoinWords(words, between));
      if (!title.empty()) layout_.titles.push_back(std::move(title));
    }
    if (layout_.titles.empty()) return;
    constexpr std::size_t kMostShown = 8;
    std::string list;
    for (const std::string& title : layout_.titles) {
      if (&title - layout_.titles.data() == kMostShown) break;
      list += (list.empty() ? "" : ", ") + QuotedText(title);
    }
    if (layout_.titles.size() > kMostShown) list += " and more";
    Say(NumberOf(layout_.titles.size(), "line") + " above the table: " + list);
  }

  // Cells of a row, by the rows from `first` on.
  void FindWidth(std::size_t first) {
    std::vector<std::string>& names = layout_.names;
    layout_.num_names = names.size();
    layout_.width = names.size();
    if (first >= records_.size()) return;
    const std::size_t usual = UsualWidth(records_, first);
    if (usual > names.size()) {
      if (AreEmptyBeyond(names.size(), usual, first)) {
        names.resize(usual);
        layout_.width = usual;
      } else if (usual == names.size() + 1 && NumberRows(first, usual)) {
        names.insert(names.begin(), "row");
        layout_.num_names = usual;
        layout_.width = usual;
        Say("the names begin over the second column: the first numbers the "
            "rows");
      }
      return;
    }
    if (usual == names.size()) return;
    // Below other lines that begin with the sign of remarks: ";time;X".
    if (usual + 1 == names.size() && names.front().empty() &&
        std::ranges::count(names, "") == 1 && dialect_.delimiter == ';' &&
        std::any_of(records_.cbegin(), At(first - 1), [](const auto& record) {
          return record.cells.front().empty() ||
                 record.cells.front().starts_with('%');
        })) {
      names.erase(names.begin());
      layout_.num_names = layout_.width = usual;
      return;
    }
    const bool all_alike =
        records_.size() - first > 1 &&
        std::all_of(At(first), records_.cend(), [&](const CsvRecord& record) {
          return record.cells.size() == usual;
        });
    const auto beyond = names.begin() + static_cast<std::ptrdiff_t>(usual);
    if (std::all_of(beyond, names.end(), [](const std::string& name) {
          return name.empty();
        })) {
      layout_.width = usual;
    } else if (all_alike && std::find(names.begin(), beyond, "") == beyond &&
               std::none_of(beyond, names.end(), HasUnit)) {
      layout_.width = usual;
      Say("the rows end before " + NumberOf(names.size() - usual, "column") +
          " (" + QuotedName(AsUtf8(*beyond)) +
          (beyond + 1 == names.end() ? "" : ", ...") + "), which stay" +
          (beyond + 1 == names.end() ? "s" : "") + " empty");
    }
  }

  // 1, 2, 3, ... before the cells that have names, as R writes a table.
  bool NumberRows(std::size_t first, std::size_t usual) const {
    double next = NAN;
    return std::all_of(
        At(first), records_.cend(), [&](const CsvRecord& record) {
          double number = NAN;
          const bool goes_on = record.cells.size() == usual &&
                               ParseNumber(record.cells[0], &number) &&
                               (std::isnan(next) || number == next);
          next = number + 1.0;
          return goes_on;
        });
  }

  // A column with a unit is meant to have numbers.
  static bool HasUnit(const std::string& name) {
    return AreUnitCells({name}) ||
           ReadHeader(AsUtf8(name)).source != UnitSource::kNone;
  }

  bool AreEmptyBeyond(std::size_t width,
                      std::size_t usual,
                      std::size_t first) const {
    return std::all_of(
        At(first), records_.cend(), [&](const CsvRecord& record) {
          return record.cells.size() != usual ||
                 std::all_of(
                     record.cells.begin() + static_cast<std::ptrdiff_t>(width),
                     record.cells.end(),
                     [](const std::string& cell) { return cell.empty(); });
        });
  }

  std::vector<CsvRecord>::const_iterator At(std::size_t row) const {
    return records_.begin() + static_cast<std::ptrdiff_t>(row);
  }

  CsvCells::Position After(std::size_t row) const {
    CsvCells cells = cells_;
    cells.GoTo(records_[row].start);
    do {
      cells.Next();
    } while (cells.PassEnd());
    return cells.position();
  }

  void Say(const std::string& line) { layout_.remarks.push_back(line); }

  const CsvCells& cells_;
  const CsvDialect& dialect_;
  std::string_view text_above_;
  std::vector<CsvRecord> records_;
  std::size_t usual_ = 1;            // cells of most rows
  std::vector<std::string> labels_;  // (usual_) before all cells' numbers
  std::vector<bool> is_numeric_;     // (usual_) most cells are numbers
  std::size_t num_numeric_ = 0;
  CsvLayout layout_;
};

}  // namespace

CsvLayout FindLayout(const CsvCells& cells,
                     const CsvDialect& dialect,
                     std::string_view text_above) {
  return LayoutFinder(cells, dialect, text_above).Find();
}

}  // namespace errmap::data
