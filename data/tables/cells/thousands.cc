#include "data/tables/cells/thousands.h"

#include <algorithm>
#include <string>

#include "data/text.h"

namespace errmap::data {

bool MayPartThousands(std::string_view number, std::size_t point) {
  const std::string_view behind = number.substr(point + 1);
  if (behind.size() != 3 ||
      behind.find_first_not_of("0123456789") != std::string_view::npos) {
    return false;
  }
  std::string_view before = number.substr(0, point);
  if (before.starts_with('-') || before.starts_with('+')) {
    before.remove_prefix(1);
  }
  return !before.empty() && before.size() <= 3 && before.front() != '0';
}

bool PartThousands(std::vector<ColumnShape>* shapes, CsvTable* table) {
  bool any = false;
  for (std::size_t i = 0; i < shapes->size(); ++i) {
    ColumnShape& shape = (*shapes)[i];
    // Beside numbers of three digits the next have a mark after the first;
    // those of four have none, so that it is not the file's way. Thousands go
    // on from the whole numbers: 0, 133.333, 266.667, 400 are thirds.
    constexpr double kThreeDigits = 100.0;
    constexpr double kFourDigits = 1000.0;
    constexpr double kNext = 10.0;
    const CsvColumn& column = table->columns[i];
    const char mark = column.first_decimal_comma >= 0 ? ',' : '.';
    const bool has_groups = shape.groups_mark == mark;
    if (!shape.any_parted || !shape.all_threes ||
        !(has_groups || shape.most_whole > shape.most_parted)) {
      continue;
    }
    const bool go_on =
        kFourDigits * shape.least_parted <= kNext * shape.most_whole;
    const auto first =
        std::max(column.first_decimal_comma, column.first_decimal_point);
    const double value = column.values[first];
    std::string remark = "column " + QuotedName(column.name);
    const std::string as_thousands = CsvNumber(kFourDigits * value);
    const auto line = table->LineOfRow(static_cast<std::size_t>(first));
    std::string where = " (line ";
    where.append(std::to_string(line)).append(")");
    if (has_groups || (go_on && shape.most_whole >= kThreeDigits &&
                       shape.most_whole < kFourDigits)) {
      shape.by_thousands = true;
      any = true;
      remark.append(" is read with marks between thousands, as ")
          .append(has_groups ? "others have two: "
                             : "its other numbers are whole: ")
          .append(as_thousands)
          .append(where);
    } else {
      remark.append(" has numbers with three decimals among whole ones: ")
          .append(CsvNumber(value))
          .append(where)
          .append("; if its mark parts thousands, write ")
          .append(as_thousands);
    }
    table->Remark(remark);
  }
  return any;
}

}  // namespace errmap::data
