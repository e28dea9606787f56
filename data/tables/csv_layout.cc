#include "data/tables/csv_layout.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/tables/cells/missing_cells.h"
#include "data/tables/cells/unit_cells.h"
#include "data/tables/column_names.h"
#include "data/tables/number_columns.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

constexpr std::size_t kNone = std::string::npos;

class LayoutFinder {
 public:
  LayoutFinder(const CsvCells& cells,
               const CsvDialect& dialect,
               std::string_view text_above)
      : cells_(cells),
        dialect_(dialect),
        text_above_(text_above),
        records_(FirstRecords(cells)),
        usual_(records_.empty() ? 1 : UsualWidth(records_, 0)),
        columns_(records_, usual_, dialect) {}

  CsvLayout Find() {
    if (records_.empty()) return OfUnreadable();
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

  // The first row with more numbers than words there, as long as the others
  // or with half of their numbers ("Targets,17" is a line above the table);
  // kNone where the table has none.
  std::size_t FirstDataRow() const {
    for (std::size_t i = 0; i < records_.size(); ++i) {
      const std::vector<std::string>& cells = records_[i].cells;
      const CellCounts counts = columns_.CountsOf(cells);
      const bool is_whole =
          cells.size() + 1 >= usual_ || 2 * counts.numbers >= columns_.count();
      if (is_whole && counts.numbers > counts.words && !AreNumberNames(i) &&
          !IsAboveWords(i)) {
        return i;
      }
    }
    return kNone;
  }

  // "Channel,1,2,3" in a block above the table, ",2010,,2020" above the names.
  bool IsAboveWords(std::size_t row) const {
    if (row + 1 >= records_.size()) return false;
    const CellCounts below = columns_.CountsOf(records_[row + 1].cells);
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
      if (columns_.MayBeNames(records_[i].cells)) return false;
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

  // The row of names above the first data row, or kNone.
  std::size_t NamesAbove(std::size_t first) const {
    if (first > 0 && AreNumberNames(first - 1)) return first - 1;
    for (std::size_t i = first; i-- > 0;) {
      if (!columns_.MayBeNames(records_[i].cells) ||
          AreRules(records_[i].cells)) {
        continue;
      }
      const bool is_below_names =
          i > 0 && columns_.MayBeNames(records_[i - 1].cells);
      if (is_below_names && AreUnitCells(records_[i].cells)) continue;
      if (is_below_names && i > 1 && columns_.AreUnits(records_[i - 1].cells) &&
          !CallATime(records_[i].cells) &&
          columns_.MayBeNames(records_[i - 2].cells)) {
        return i - 2;
      }
      return i;
    }
    // One line of another length, or with numbers in it, is meant for names
    // all the same: to be told what is wrong with it.
    if (first == 1 && (records_[0].cells.size() > 1 || usual_ == 1)) return 0;
    return kNone;
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
      if (columns_.Holds(i)) AddUnitOfCell(units[i], &layout_.names[i]);
    }
    layout_.data = After(row + 2);
    Say("line " + std::to_string(records_[row + 2].start.line) +
        ", below names and units, is skipped");
  }

  void TakeNames(std::size_t row, std::size_t first) {
    layout_.names = records_[row].cells;
    layout_.header_line = records_[row].start.line;
    layout_.data = After(row);
    if (first != kNone && first == row + 3 && layout_.names.size() >= usual_ &&
        columns_.AreUnits(records_[row + 1].cells) &&
        columns_.MayBeNames(records_[row + 2].cells)) {
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
    if (!columns_.AreUnits(records_[row - 1].cells) ||
        columns_.AreUnits(records_[row].cells))
      return false;
    const std::vector<std::string>& units = records_[row - 1].cells;
    std::vector<std::string> meant = layout_.names;
    if (row > 1 && records_[row - 2].cells.size() == usual_) {
      for (std::size_t i = 0; i < usual_; ++i) {
        const std::string& name = records_[row - 2].cells[i];
        if (columns_.Holds(i) && !name.empty()) meant[i] = name;
      }
    }
    const bool has_others = TellAnError(layout_.names, meant);
    if (has_others) layout_.names = std::move(meant);
    for (std::size_t i = 0; i < usual_; ++i) {
      if (columns_.Holds(i)) AddUnitOfCell(units[i], &layout_.names[i]);
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
    if (num_words < 2 || columns_.CountsOf(upper).numbers > 0) return false;
    const std::set<std::string> distinct(layout_.names.begin(),
                                         layout_.names.end());
    const bool tells = distinct.size() == usual_ && !distinct.contains("") &&
                       !AreMadeOfUnits(layout_.names);
    // "Date,2024-03-01"
    if (tells && usual_ > 3 && upper[0] + upper[1] == JoinWords(upper, "")) {
      return false;
    }
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
        " is a second row of names" + (tells ? " and is skipped" : "") +
        (tells ? "" : ", which distinguishes columns of the same name"));
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
    const char* const end = records_[first].start.cursor;
    CommentNames said = FindNamesInComments(
        text_above_.substr(0,
                           static_cast<std::size_t>(end - text_above_.data())),
        dialect_.delimiter,
        columns_);
    if (said.line > 0) {
      layout_.names = std::move(said.names);
      layout_.header_line = said.line;
      layout_.num_names = usual_;
      Say("the names of the columns are those of the comment on line " +
          std::to_string(said.line));
      return;
    }
    Say("no line of names: the columns are called column_1" +
        (usual_ == 1 ? std::string() : " to column_" + std::to_string(usual_)));
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
    Say(CountText(layout_.titles.size(), "line") + " above the table: " + list);
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
      Say("the rows end before " + CountText(names.size() - usual, "column") +
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
  std::size_t usual_;  // cells of most rows
  NumberColumns columns_;
  CsvLayout layout_;
};

}  // namespace

CsvLayout FindLayout(const CsvCells& cells,
                     const CsvDialect& dialect,
                     std::string_view text_above) {
  return LayoutFinder(cells, dialect, text_above).Find();
}

}  // namespace errmap::data
