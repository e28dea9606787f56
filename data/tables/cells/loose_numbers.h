#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"
#include "data/tables/cells/csv_cells.h"

namespace errmap::data {

/// Reason why a cell is not a plain number; the rarest one counts.
enum class Loose {
  kNone,
  kDash,
  kMarks,
  kCurrency,
  kRemark,
  kMinusBehind,
  kExponent,
  kUncertainty,
  kParentheses,
  kFullWidth
};

/// Reads a number in a form that people write but programs do not read. It may
/// have thousands separated by blanks, apostrophes or the other decimal mark
/// ("25 000.5", "25'000", "1.234.567,8"), a sign of money ("$5.30"), a minus
/// that is a dash or comes last, a remark ("1.5 # door"), Fortran's exponent
/// ("1.5D-03"), or its uncertainty behind it ("1.5 ± 0.2", "1.50(20)"), or be
/// negative in parentheses ("(1.97)", where "(2)" is a label), or have the wide
/// digits of Japanese and Chinese. `other_mark`: one group of thousands is
/// enough ("25,000" with decimal points). If a separator could be a decimal
/// mark, returns kNone and no value. Reads plain numbers, too.
Loose ReadLooseNumber(std::string_view cell,
                      bool decimal_comma,
                      bool other_mark,
                      NumberForm* form);

/// Reads "-1.49D-03", as Fortran writes it.
bool ReadFortranNumber(std::string_view cell,
                       bool decimal_comma,
                       NumberForm* form);

/// The text before the number in a cell: the axis "X" of "X-215.9" or "N10 G1
/// X-215.9" in a program, "T1" of "T1=21.42"; empty if there is none.
struct CellLabel {
  std::string text = {};
  bool is_axis = false;
};
/// Removes that text from the cell and returns it.
CellLabel TakeLabel(std::string_view* cell);

/// Counts of such numbers in a file, for its remarks.
class LooseNumbers {
 public:
  void Add(Loose kind, std::size_t line);
  /// "3 cells are read as numbers with a minus after the number, which changes
  /// the sign (the first on line 5)".
  std::vector<std::string> Remarks() const;

 private:
  struct Seen {
    std::size_t count = 0;
    std::size_t first_line = 0;
  };
  std::array<Seen, 10> seen_;  // of each Loose
};

/// Converts columns whose numbers all have one unit ("1.877 µm") or one label
/// ("T1=21.4"), and that have more numbers than words ("<0.05 mg/l"), which
/// stay. The unit becomes part of the name. The label becomes the name if there
/// was none.
void TakeUnitsOfCells(bool decimal_comma, bool other_mark, CsvTable* table);

}  // namespace errmap::data
