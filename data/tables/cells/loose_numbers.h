#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"
#include "data/tables/cells/csv_cells.h"

namespace errmap::data {

/// What makes a cell no number for programs; the rarest counts.
enum class Loose { kNone, kDash, kMarks, kRemark, kMinusBehind, kExponent };

/// A number as people write it, which no program reads: thousands parted by
/// blanks, apostrophes or the other decimal mark ("25 000.5", "25'000",
/// "1.234.567,8"), a minus that is a dash or stands behind, a remark ("1.5 #
/// door"), Fortran's exponent ("1.5D-03"). `other_mark`: one group of thousands
/// is enough ("25,000" where points are decimal). Where a mark could be decimal
/// it is none of these (kNone), and no value is given.
Loose ReadLooseNumber(std::string_view cell,
                      bool decimal_comma,
                      bool other_mark,
                      NumberForm* form);

/// "-1.49D-03", as Fortran writes it.
bool ReadFortranNumber(std::string_view cell,
                       bool decimal_comma,
                       NumberForm* form);

/// What a cell says before its number: the axis "X" of a program's "X-215.9" or
/// "N10 G1 X-215.9", "T1" of "T1=21.42"; no text where there is nothing.
struct CellLabel {
  std::string text = {};
  bool is_axis = false;
};
/// Takes it off the cell.
CellLabel TakeLabel(std::string_view* cell);

/// Those of a file, counted for its remarks.
class LooseNumbers {
 public:
  void Add(Loose kind, std::size_t line);
  /// "3 cells are read as numbers with the minus behind them, which changes
  /// their sign (the first on line 5)".
  std::vector<std::string> Remarks() const;

 private:
  struct Seen {
    std::size_t count = 0;
    std::size_t first_line = 0;
  };
  std::array<Seen, 6> seen_;  // of each Loose
};

/// Columns whose cells all are a number with one unit ("1.877 µm") or behind
/// one label ("T1=21.4") become numbers, the unit a part of the name, and the
/// label the name where there was none.
void TakeUnitsOfCells(bool decimal_comma, CsvTable* table);

}  // namespace errmap::data
