#include "data/tables/shapes/title_notes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "data/column_words.h"
#include "data/tables/cells/unit_cells.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

// The only unit of lengths or angles that a line of words without a number
// states, where it says that it is that of all or of errors.
std::optional<std::string> UnitIn(const std::string& note) {
  if (HasDigit(note)) return std::nullopt;
  std::set<std::string> units;
  bool states = false;
  constexpr std::string_view kBetween = " \t,;:.=()[]\"";
  std::string_view rest = note;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(kBetween), rest.size());
    const std::string word(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    states =
        states || IsOneOf(word,
                          "all units unit alle einheit einheiten tous toutes "
                          "unité unités tutti tutte unità todos todas unidad "
                          "unidades");
    const Header header = ReadHeader("x [" + word + "]");
    // "in" is a word, too.
    if (word == "in" || header.source != UnitSource::kStated ||
        !IsLengthOrAngle(header.unit)) {
      continue;
    }
    units.insert(word);
  }
  states = states || SayAny(WordsOf(note), Word::kError);
  if (!states || units.size() != 1) return std::nullopt;
  return *units.begin();
}

// Machine tools err by less than a millimetre: the unit is not that of errors.
bool AreTooMuch(const CsvColumn& column, const std::string& unit) {
  return ReadHeader("x [" + unit + "]").unit.symbol == "mm" &&
         std::ranges::any_of(
             column.values, [](double value) { return std::abs(value) > 1.0; });
}

}  // namespace

void TakeUnitOfNotes(CsvTable* table) {
  for (const std::string& note : table->titles) {
    const std::optional<std::string> unit = UnitIn(note);
    if (!unit) continue;
    const bool of_errors = SayAny(WordsOf(note), Word::kError);
    bool any = false;
    for (CsvColumn& column : table->columns) {
      const bool is_meant =
          ErrorSign(column.name) != 0 ||
          (!of_errors && *unit != "mm" &&
           !IsUnitOfErrors(ReadHeader("x [" + *unit + "]").unit) &&
           IsCalledPosition(column.name));
      if (!is_meant || column.is_text() || AreTooMuch(column, *unit) ||
          ReadHeader(column.name).source == UnitSource::kStated) {
        continue;
      }
      column.name = NameWithUnit(column.name, *unit).value_or(column.name);
      any = true;
    }
    if (any) {
      table->remarks.push_back(PrintablePath(table->file) + ": " +
                               QuotedText(note) +
                               " gives the unit of columns that have none");
    }
    return;
  }
}

const std::string* NoteOfOppositeSign(const CsvTable& table) {
  const auto note =
      std::ranges::find_if(table.titles, [](const std::string& title) {
        const std::size_t sign = title.find_last_of("=:");
        if (sign == title.npos) return false;
        const std::string of = title.substr(sign + 1);
        std::vector<std::string> words = WordsOf(of);
        const auto num_minus = std::erase(words, "minus");
        return words.size() == 2 &&
               (num_minus == 1 || of.find('-') != of.npos) &&
               SayAny({words[0]}, Word::kNominal) &&
               SayAny({words[1]}, Word::kMeasured);
      });
  return note == table.titles.end() ? nullptr : &*note;
}

}  // namespace errmap::data
