#include "data/measurements/clock/row_columns.h"

#include "data/text.h"

namespace errmap::data {

bool RowColumns::IsMeasured(std::size_t column) const {
  const std::string& name = table_.columns[column].name;
  return name == selection_.target || name == selection_.weight;
}

std::size_t RowColumns::NamedColumn(const std::string& name,
                                    const std::string& argument) const {
  const std::size_t index = RequireColumn(table_, name, argument);
  if (!IsMeasured(index)) return index;
  throw InputError(PrintablePath(table_.file) + ": column " +
                   QuotedName(table_.columns[index].name) +
                   " is the target or the weight; name another with " +
                   argument);
}

void RowColumns::PassOver(bool named,
                          const std::string& why,
                          const std::string& remedy,
                          std::vector<std::string>* remarks) {
  if (named) throw InputError(why + "; " + remedy);
  Skip(why, remarks);
}

bool RowColumns::MayBeMissing(std::size_t column,
                              std::size_t row,
                              bool named,
                              std::vector<std::string>* remarks) const {
  if (selection_.missing == MissingPolicy::kDropRows) return true;
  if (named) {
    RefuseMissingCell(table_, {column, ColumnUse::kOther}, row);
    return true;
  }
  Skip(table_.Where(row, table_.columns[column].name) + ": no value there",
       remarks);
  return false;
}

}  // namespace errmap::data
