#include "data/tables/shapes/sign_notes.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "data/column_words.h"

namespace errmap::data {
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
