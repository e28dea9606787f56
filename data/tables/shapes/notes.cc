#include "data/tables/shapes/notes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "data/column_header.h"
#include "data/column_words.h"
#include "data/tables/cells/unit_cells.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

// A line that states units, and of what; "" for no unit of a kind, or several.
struct UnitNote {
  std::string size;         // of lengths or angles
  std::string temperature;  // "degF"
  bool of_all = false;
  bool of_errors = false;
  bool of_positions = false;
  bool of_temperatures = false;
  std::string column = {};  // "t" of "t in s", which has this unit
  std::string unit = {};
};

// Only words without a number state them.
void ReadUnits(const std::string& text, UnitNote* note) {
  if (HasDigit(text)) return;
  std::set<std::string> sizes;
  std::set<std::string> temperatures;
  constexpr std::string_view kBetween = " \t,;:.=()[]\"";
  for (const std::string_view word : SplitWords(text, kBetween)) {
    const std::optional<Unit> unit = ReadUnit(word, UnitPlace::kBracketed);
    if (word == "in" || !unit) continue;  // "in" is a word, too
    if (unit->quantity == Quantity::kTemperature) {
      temperatures.insert(unit->symbol);
    } else if (IsLengthOrAngle(*unit)) {
      sizes.insert(unit->symbol);
    }
  }
  if (!temperatures.empty()) sizes.erase("deg");  // "degrees Fahrenheit"
  if (sizes.size() == 1) note->size = *sizes.begin();
  if (temperatures.size() == 1) note->temperature = *temperatures.begin();
}

std::optional<UnitNote> ReadUnitNote(const std::string& text) {
  UnitNote note;
  ReadUnits(text, &note);
  const std::size_t in = text.find(" in ");
  const auto unit = in == text.npos ? std::nullopt
                                    : ReadUnit(Trimmed(text.substr(in + 4)),
                                               UnitPlace::kBracketed);
  if (unit) {
    note.column = Trimmed(text.substr(0, in));
    note.unit = unit->symbol;
  }
  if (note.size.empty() && note.temperature.empty() && note.unit.empty()) {
    return std::nullopt;
  }
  const std::vector<std::string> words = WordsOf(text);
  note.of_all = HasWordOf(
      text,
      "all units unit alle einheit einheiten tous toutes unite unites tutti "
      "tutte unita todos todas unidad unidades");
  note.of_errors = SayAny(words, Word::kError);
  note.of_positions = SayAny(words, Word::kPosition);
  note.of_temperatures = SayAny(words, Word::kTemperature);
  return note;
}

// Of a line, and of its parts: "x in mm, errors in um".
std::vector<UnitNote> ReadUnitNotes(const std::string& text) {
  std::vector<std::string_view> parts = SplitWords(text, ",;");
  parts.insert(parts.begin(), text);
  std::vector<UnitNote> notes;
  for (const std::string_view part : parts) {
    if (auto note = ReadUnitNote(std::string(part))) {
      notes.push_back(*std::move(note));
    }
  }
  return notes;
}

// The units of "units: h, mm, um"; "" for what is none.
std::vector<std::string> UnitsListed(std::string_view text) {
  std::vector<std::string> units;
  for (const std::string_view part :
       SplitWords(text.substr(text.find(':') + 1), ",;")) {
    const auto unit = ReadUnit(Trimmed(part), UnitPlace::kBracketed);
    units.push_back(unit ? unit->symbol : "");
  }
  return units;
}

// Machine tools err by less than a millimetre: the unit is not that of errors.
bool AreTooMuch(const CsvColumn& column, const std::string& unit) {
  return unit == "mm" && std::ranges::any_of(column.values, [](double value) {
           return std::abs(value) > 1.0;
         });
}

// The unit that a note gives a column whose name has none; "" for none.
std::string UnitFor(const CsvColumn& column, const UnitNote& note) {
  if (NamesTemperature(column.name)) {
    return note.of_all || note.of_temperatures ? note.temperature : "";
  }
  if (ErrorSign(column.name) != 0) {
    const bool is_meant = note.of_all || note.of_errors;
    return is_meant && !AreTooMuch(column, note.size) ? note.size : "";
  }
  // All lengths in mm or um may be those of errors.
  const bool is_of_axis =
      note.of_positions || (note.of_all && note.size != "mm" &&
                            !IsUnitOfErrors(UnitOfSymbol(note.size)));
  return is_of_axis && !note.of_errors && IsCalledPosition(column.name)
             ? note.size
             : "";
}

// The first that the notes give.
std::string UnitFor(const CsvColumn& column,
                    const std::vector<UnitNote>& notes) {
  for (const UnitNote& note : notes) {
    if (column.name == note.column) return note.unit;
    if (auto unit = UnitFor(column, note); !unit.empty()) return unit;
  }
  return "";
}

}  // namespace

void TakeUnitsOfNotes(CsvTable* table) {
  for (const std::string& text : table->titles) {
    const std::vector<UnitNote> notes = ReadUnitNotes(text);
    if (notes.empty()) continue;
    const std::vector<std::string> listed = UnitsListed(text);
    const bool is_list = listed.size() == table->columns.size();
    bool any = false;
    for (std::size_t i = 0; i < table->columns.size(); ++i) {
      CsvColumn& column = table->columns[i];
      if (column.is_text() ||
          ReadHeader(column.name).source == UnitSource::kStated) {
        continue;
      }
      const std::string unit = is_list ? listed[i] : UnitFor(column, notes);
      if (unit.empty()) continue;
      column.name = NameWithUnit(column.name, unit).value_or(column.name);
      any = true;
    }
    if (any) {
      table->Remark(QuotedText(text) +
                    " gives the unit of columns that have none");
    }
  }
}

namespace {

bool SaysSign(std::string_view text) {
  return HasWordOf(
      text,
      "positive negative sign positiv negativ vorzeichen positif negatif signe "
      "positivo negativo segno signo");
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
