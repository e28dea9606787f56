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

// Units that a line of words without a number states; "" where it has none of
// the kind, or several.
struct NotedUnits {
  std::string size;         // of lengths or angles
  std::string temperature;  // "degF"
};

NotedUnits UnitsIn(const std::string& note) {
  NotedUnits noted;
  if (HasDigit(note)) return noted;
  std::set<std::string> sizes;
  std::set<std::string> temperatures;
  constexpr std::string_view kBetween = " \t,;:.=()[]\"";
  std::string_view rest = note;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(kBetween), rest.size());
    const std::string word(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const Header header = ReadHeader("x [" + word + "]");
    // "in" is a word, too.
    if (word == "in" || header.source != UnitSource::kStated) continue;
    if (header.unit.quantity == Quantity::kTemperature) {
      temperatures.insert(header.unit.symbol);
    } else if (IsLengthOrAngle(header.unit)) {
      sizes.insert(header.unit.symbol);
    }
  }
  if (!temperatures.empty()) sizes.erase("deg");  // "degrees Fahrenheit"
  if (sizes.size() == 1) noted.size = *sizes.begin();
  if (temperatures.size() == 1) noted.temperature = *temperatures.begin();
  return noted;
}

bool IsOfAll(const std::string& note) {
  constexpr std::string_view kAll =
      "all units unit alle einheit einheiten tous toutes unite unites tutti "
      "tutte unita todos todas unidad unidades";
  return std::ranges::any_of(WordsOf(note), [&](const std::string& word) {
    return IsOneOf(word, kAll);
  });
}

// Machine tools err by less than a millimetre: the unit is not that of errors.
bool AreTooMuch(const CsvColumn& column, const std::string& unit) {
  return ReadHeader("x [" + unit + "]").unit.symbol == "mm" &&
         std::ranges::any_of(
             column.values, [](double value) { return std::abs(value) > 1.0; });
}

// The unit that a note gives a column whose name has none; "" for none.
std::string UnitFor(const CsvColumn& column,
                    const std::string& note,
                    const NotedUnits& noted) {
  const std::vector<std::string> words = WordsOf(note);
  const bool of_all = IsOfAll(note);
  const bool of_errors = SayAny(words, Word::kError);
  if (StatesTemperature(column.name) ||
      ReadHeader(column.name).unit.quantity == Quantity::kTemperature) {
    return of_all || SayAny(words, Word::kTemperature) ? noted.temperature : "";
  }
  const bool may_be_all = of_all && !of_errors;
  const bool fits_errors = !AreTooMuch(column, noted.size);
  if (ErrorSign(column.name) != 0) {
    return (of_all || of_errors) && fits_errors ? noted.size : "";
  }
  const bool is_for_positions =
      SayAny(words, Word::kPosition) ||
      (may_be_all && noted.size != "mm" &&
       !IsUnitOfErrors(ReadHeader("x [" + noted.size + "]").unit));
  return is_for_positions && !of_errors && IsCalledPosition(column.name)
             ? noted.size
             : "";
}

}  // namespace

void TakeUnitOfNotes(CsvTable* table) {
  for (const std::string& note : table->titles) {
    const NotedUnits noted = UnitsIn(note);
    bool any = false;
    for (CsvColumn& column : table->columns) {
      if (column.is_text() ||
          ReadHeader(column.name).source == UnitSource::kStated) {
        continue;
      }
      const std::string unit = UnitFor(column, note, noted);
      if (unit.empty()) continue;
      column.name = NameWithUnit(column.name, unit).value_or(column.name);
      any = true;
    }
    if (any) {
      table->remarks.push_back(PrintablePath(table->file) + ": " +
                               QuotedText(note) +
                               " gives the unit of columns that have none");
    }
  }
}

namespace {

bool SaysSign(std::string_view text) {
  constexpr std::string_view kSigns =
      "positive negative sign positiv negativ vorzeichen positif negatif signe "
      "positivo negativo segno signo";
  return std::ranges::any_of(WordsOf(text), [&](const std::string& word) {
    return IsOneOf(word, kSigns);
  });
}

// "Abweichung = Soll - Ist", or any difference that is not plainly the actual
// value less the nominal one.
bool StatesOtherDifference(const std::string& note) {
  const std::size_t sign = note.find_last_of("=:");
  if (sign == note.npos) return false;
  const std::string of = note.substr(sign + 1);
  std::vector<std::string> words = WordsOf(of);
  const auto num_minus = std::erase(words, "minus");
  if (words.size() != 2 || (num_minus != 1 && of.find('-') == of.npos)) {
    return false;
  }
  const auto are = [&](Word first, Word second) {
    return SayAny({words[0]}, first) && SayAny({words[1]}, second);
  };
  const std::string what = note.substr(0, sign);
  return are(Word::kNominal, Word::kMeasured) ||
         (!are(Word::kMeasured, Word::kNominal) &&
          (Says(what, Word::kError) || SaysSign(what)));
}

// "positive error: the axis stops short".
bool ExplainsSign(const std::string& note) {
  return Says(note, Word::kError) && SaysSign(note);
}

}  // namespace

const std::string* NoteOfOtherSign(const CsvTable& table) {
  const auto note =
      std::ranges::find_if(table.titles, [](const std::string& title) {
        return StatesOtherDifference(title) || ExplainsSign(title);
      });
  return note == table.titles.end() ? nullptr : &*note;
}

}  // namespace errmap::data
