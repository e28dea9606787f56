#include "data/column_words.h"

#include <algorithm>
#include <array>

#include "data/column_header.h"
#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

// The words of each kind, parted by blanks, in the order of Word.
constexpr auto kWords = std::to_array<std::string_view>({
    // kError
    "error err errors xerr yerr zerr deviation dev fehler abweichung abw "
    "messfehler erreur ecart deviazione errore scarto scostamento desvio "
    "desviacion erro afwijking fout odchylka blad chyba avvikelse fel "
    "afvigelse avvik fejl hiba elteres eroare abatere napaka odstopanje "
    "odstupanje похибка відхилення σφαλμα αποκλιση feil virhe poikkeama hata "
    "sapma gosa ошибка погрешность отклонение откл 誤差 误差 偏差 오차 편차",
    // kCorrection
    "correction compensation corrective correctif corr comp korr komp "
    "korrektur kompensation correccion compensacion correzione compensazione "
    "correcao compensacao correctie compensatie korekta korekcja kompensacja "
    "korekce kompenzace korrigering hosei коррекция поправка 補正 补偿",
    // kPosition
    "position pos posn coordinate coord posicion posizione posicao quota weg "
    "stellung koordinate positie pozycja polozenie poloha pozice lage asema "
    "konum ichi travel verfahrweg положение позиция координата 位置 위치",
    // kHeight
    "height hohe hoehe hauteur altezza altura hoogte wysokosc",
    // kNominal
    "nominal nom commanded command cmd setpoint target ziel soll sollwert "
    "sollposition consigne nominale consigna theorique teorica nominaal "
    "nominalna zadana zadane theoretical theoretisch programmed programmiert "
    "desired demand demanded bor borvarde gewenst заданное номинал 指令 目標",
    // kMeasured
    "actual act meas measured encoder laser ist istwert istposition gemessen "
    "reelle mesuree mesure misurata misurato medida medido gemeten zmierzona "
    "real reel werkelijk skutecna skutecny skutecne rzeczywista feedback fbk "
    "ar arvarde измеренное факт 実測 实测",
    // kTime
    "time timestamp datetime elapsed uptime runtime laufzeit utc zeit uhrzeit "
    "zeitstempel zeitpunkt tick ticks uhr tiempo hora ora heure horodatage "
    "orario temps tempo tijd czas godzina cas tid klockslag klokken kello aika "
    "saat zaman jikoku jikan время 時刻 時間 时间 시간 시각",
    // kDate
    "date datum fecha datetime datenum data dato tarih hizuke дата 日付 日期 "
    "날짜",
    // kTemperature
    "temperature temp temperatur temperatura temperatuur teplota lampotila "
    "sicaklik sicaklig ondo температура темп 温度 온도",
    // kSpeed
    "rpm speed feed feedrate drehzahl vorschub spindelrpm spindlerpm vitesse "
    "avance velocidad velocita giri otacky obroty обороты 转速 回転数",
    // kDirection
    "direction dir bidir approach motion richtung anfahrrichtung anfahrt "
    "direccion direzione direcao sens sentido senso richting kierunek riktning "
    "retning smer suunta yon verso fangxiang направление 方向 방향",
    // kCycle
    "cycle zyklus takt ciclo cyclus cykl cykel cyklus цикл 循环 サイクル "
    "사이클",
    // kSession
    "session day shift series weekday tag messtag schicht serie messreihe "
    "wochentag jour seance giorno dia sesion sessione dag dzien день смена",
    // kShift
    "shift schicht weekday wochentag смена",
    // kRun
    "run lauf messlauf",
    // kDay
    "day tag jour giorno dia dag",
    // kWeek
    "week kalenderwoche woche kw semaine settimana semana",
    // kCounter
    "segment record index row id sample messung versuch durchgang nr no number "
    "nummer zeile test trial repeat rep reps repetition wiederholung "
    "repeticion ripetizione block batch hour hr minute min second sec stunde "
    "sekunde ms msec usec microsec nsec millis millitm millisecond microsecond "
    "nanosecond night nacht nuit notte noche week woche kw semaine settimana "
    "semana attempt tentative tentativo essai intento charge los lotto lote "
    "visit campaign kampagne sitzung warmup experiment dataset group gruppe "
    "groupe grupo gruppo groep year jahr annee anno doy hhmm hhmmss",
    // kIdentifier
    "serial sn s_n seriennummer seriennr matricola matricule employee staff "
    "personalnr personalnummer pernr badge firmware fw version revision "
    "software crc checksum prufsumme pruefsumme statuswort statusword "
    "status_word parity anzahl number_of nombre_de numero_di numero_de "
    "num_readings n_readings nr_readings",
    // kComputed
    "residual residuum residuen resid residuo residu residuel fit fits fitted "
    "predicted prediction predict pred prevision prediccion previsione "
    "forecast vorhersage prognose model modell modele modello modelled modeled "
    "tol tolerance toleranz tolleranza tolerancia oot nok nio n_i_o",
    // kSpread
    "std stdev stddev stdabw stabw sd sigma standardabweichung ecart_type "
    "deviazione_standard desviacion_estandar uncertainty unsicherheit "
    "messunsicherheit incertitude incertezza incertidumbre",
    // kPart
    "machine maschine tool werkzeug head kopf fixture pallet palette station "
    "operator",
    // kComponent
    "side axis slide component diagonal diagonale",
    // kPlace
    "station point punkt messpunkt stelle messstelle punto stazione estacion",
});
static_assert(kWords.size() == static_cast<std::size_t>(Word::kPlace) + 1);

const std::vector<std::string_view>& WordsFor(Word word) {
  static const std::vector<std::vector<std::string_view>> kSplit = [] {
    std::vector<std::vector<std::string_view>> split;
    for (const std::string_view words : kWords) {
      split.push_back(SplitWords(words));
    }
    return split;
  }();
  return kSplit[static_cast<std::size_t>(word)];
}

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c & 0x80) != 0; }

// Also of one axis: "xdev".
bool IsOrMany(std::string_view word, std::string_view known) {
  if (word == known) return true;
  if (word.size() != known.size() + 1) return false;
  return (word.ends_with('s') && word.starts_with(known)) ||
         (known.size() > 2 && (word[0] >= 'x' && word[0] <= 'z') &&
          word.ends_with(known));
}

// A short word may be part of any other: "dia" of "diameter".
bool IsOrHas(std::string_view word, std::string_view known) {
  constexpr std::size_t kLongEnough = 5;
  return IsOrMany(word, known) ||
         (known.size() >= kLongEnough && word.find(known) != word.npos);
}

// "DateTime" and "stepCount" are two words each, "ID" is one.
std::string WithGaps(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto is_upper = [&](std::size_t at) {
      return name[at] >= 'A' && name[at] <= 'Z';
    };
    if (i > 0 && is_upper(i) && name[i - 1] >= 'a' && name[i - 1] <= 'z') {
      text += ' ';
    }
    text += name[i];
  }
  return text;
}

}  // namespace

// Letters with accents of Latin-1 are two bytes of UTF-8, the first of them
// 0xC3; those of Latin Extended-A begin with 0xC4 or 0xC5; an accent of its own
// (0xCC) follows its letter. Cyrillic capitals (0xD0) are 32 letters before the
// small ones.
std::string PlainText(std::string_view text) {
  constexpr std::string_view kLatin =
      "aaaaaaaceeeeiiiidnooooo*ouuuuypsaaaaaaaceeeeiiiidnooooo/ouuuuypy";
  constexpr std::string_view kExtended =
      "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkklllllll"
      "lllnnnnnnnnnoooooooorrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs";
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool more = i + 1 < text.size();
    const std::size_t next =
        more ? static_cast<unsigned char>(text[i + 1]) & 0x3FU : 0;
    if (more && c == 0xC3) {
      plain += kLatin[next];
    } else if (more && (c == 0xC4 || c == 0xC5)) {
      plain += kExtended[64U * (c - 0xC4U) + next];
    } else if (more && c == 0xD0 && next >= 0x10 && next < 0x30) {
      plain += next < 0x20 ? '\xD0' : '\xD1';
      plain += static_cast<char>(0x80U | ((next + 0x20U) & 0x3FU));
    } else if (!more || c != 0xCC) {
      plain += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
      continue;
    }
    ++i;
  }
  return plain;
}

std::vector<std::string> WordsOf(std::string_view column) {
  const Header header = ReadHeader(column);
  const std::string plain = PlainText(WithGaps(
      header.unit_text.empty() ? column : std::string_view(header.base)));
  std::vector<std::string> words(1);
  for (const char c : plain) {
    if (IsLetter(c)) {
      words.back() += c;
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool HasWordOf(std::string_view text, std::string_view list) {
  return std::ranges::any_of(WordsOf(text), [&](const std::string& word) {
    return IsOneOf(word, list);
  });
}

bool SayAny(const std::vector<std::string>& words, Word word) {
  return std::ranges::any_of(words, [&](const std::string& said) {
    return std::ranges::any_of(WordsFor(word), [&](std::string_view known) {
      return IsOrHas(said, known);
    });
  });
}

bool Says(std::string_view column, Word word) {
  return SayAny(WordsOf(column), word);
}

bool IsWord(std::string_view said, Word word) {
  return std::ranges::any_of(WordsFor(word), [&](std::string_view known) {
    return IsOrMany(said, known);
  });
}

bool StatesTemperature(std::string_view column) {
  const Header header = ReadHeader(column);
  return header.source == UnitSource::kStated
             ? header.unit.quantity == Quantity::kTemperature
             : Says(column, Word::kTemperature);
}

bool NamesTemperature(std::string_view column) {
  return UnitOfColumn(column).quantity == Quantity::kTemperature ||
         StatesTemperature(column);
}

bool IsCalled(std::string_view column, Word word) {
  std::vector<std::string> words = WordsOf(column);
  if (word != Word::kTemperature && StatesTemperature(column)) return false;
  if (words.size() == 2 &&
      IsOneOf(words[1], "no nr num number nummer id index count n")) {
    words.pop_back();
  }
  return words.size() == 1 &&
         std::ranges::count(WordsFor(word), std::string_view(words[0])) > 0;
}

bool SaysPhrase(std::string_view column, Word word) {
  std::string said = "_";
  for (const std::string& one : WordsOf(column)) {
    said += one;
    said += '_';
  }
  return std::ranges::any_of(WordsFor(word), [&](std::string_view known) {
    std::string phrase = "_";
    phrase += known;
    phrase += '_';
    return said.find(phrase) != said.npos;
  });
}

namespace {

// The first of the words that is such a word; -1: none.
std::ptrdiff_t FirstOf(const std::vector<std::string>& words, Word word) {
  const auto found = std::ranges::find_if(
      words, [&](const std::string& said) { return SayAny({said}, word); });
  return found == words.end() ? -1 : found - words.begin();
}

// "EXX", "EBZ": the notation of ISO 230-1.
bool IsErrorSymbol(std::string_view column) {
  constexpr std::string_view kAxes = "XYZUVWABC";
  std::string base = ReadHeader(column).base;
  if (base.size() == 4 && base[1] == '_') {  // "E_xx"
    base.erase(1, 1);
    std::ranges::transform(base, base.begin(), [](char c) {
      return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    });
  }
  return base.size() == 3 && base[0] == 'E' &&
         kAxes.find(base[1]) != kAxes.npos && kAxes.find(base[2]) != kAxes.npos;
}

// The letters before a place, blanks left out, and those from one on.
std::string_view WordBefore(std::string_view text, std::size_t at) {
  while (at > 0 && text[at - 1] == ' ') --at;
  std::size_t begin = at;
  while (begin > 0 && IsLetter(text[begin - 1])) --begin;
  return text.substr(begin, at - begin);
}
std::string_view WordFrom(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] == ' ') ++at;
  std::size_t end = at;
  while (end < text.size() && IsLetter(text[end])) ++end;
  return text.substr(at, end - at);
}

bool IsLetterOfAxis(std::string_view word) {
  constexpr std::string_view kAxes = "xyzuvwabc";
  return word.size() == 1 && kAxes.find(word) != kAxes.npos;
}

// The sign of a difference in a name: 1, "actual - nominal" or "I-S"; -1, the
// other way round or of words unknown here ("encoder - laser"); 0, no
// difference ("X-error", "run-in").
int SignOfDifference(std::string_view column) {
  const std::string text = PlainText(ReadHeader(column).base);
  for (std::size_t at = text.find('-'); at != text.npos;
       at = text.find('-', at + 1)) {
    const std::string a(WordBefore(text, at));
    const std::string b(WordFrom(text, at + 1));
    if (a.empty() || b.empty() || SayAny({a}, Word::kError) ||
        SayAny({b}, Word::kError)) {
      continue;
    }
    const bool letters = a.size() == 1 && b.size() == 1 &&
                         !(IsLetterOfAxis(a) && IsLetterOfAxis(b));
    const bool apart = text[at - 1] == ' ' && text[at + 1] == ' ';
    const bool in_brackets =
        text.rfind('(', at) != text.npos && text.find(')', at) != text.npos;
    if (!letters && !apart && !in_brackets &&
        !SayAny({a, b}, Word::kMeasured) && !SayAny({a, b}, Word::kNominal)) {
      continue;
    }
    const bool is_plain =
        letters ? IsOneOf(a, "a i m r") && IsOneOf(b, "n s t c")
                : SayAny({a}, Word::kMeasured) && SayAny({b}, Word::kNominal);
    return is_plain ? 1 : -1;
  }
  return 0;
}

}  // namespace

int ErrorSign(std::string_view column) {
  const std::vector<std::string> words = WordsOf(column);
  const std::ptrdiff_t measured = FirstOf(words, Word::kMeasured);
  const std::ptrdiff_t nominal = FirstOf(words, Word::kNominal);
  const int difference = SignOfDifference(column);
  const bool is_difference = measured >= 0 && nominal >= 0;
  const bool corrects = SayAny(words, Word::kCorrection);
  if (!is_difference && !corrects && !SayAny(words, Word::kError) &&
      !IsErrorSymbol(column)) {
    return 0;
  }
  const bool is_negative = Trimmed(column).starts_with('-');
  const bool opposite =
      is_negative != corrects || difference < 0 ||
      column.find("(-1)") != column.npos || column.find("*-1") != column.npos ||
      std::ranges::any_of(words,
                          [](const std::string& word) {
                            return IsOneOf(word,
                                           "negative negativ negated minus neg "
                                           "inverse inverted invertiert "
                                           "reversed reverse opposite flipped "
                                           "umgekehrt umgekehrtes");
                          }) ||
      (difference == 0 && is_difference && nominal < measured);
  return opposite ? -1 : 1;
}

bool BeginsAsError(std::string_view column) {
  return StartsWithIgnoringCase(column, "error") && !StatesTemperature(column);
}

bool IsInUnitOfErrors(std::string_view column) {
  const Unit unit = UnitOfColumn(column);
  if (!IsUnitOfErrors(unit)) return false;
  // A reversal: B is an axis in degrees.
  const bool turns = HasWordOf(column, "a b c");
  return !IsAxisLetter(column) || (turns && unit.quantity == Quantity::kLength);
}

bool IsCalledPosition(std::string_view name) {
  const Header header = ReadHeader(name);
  const bool fits =
      header.source == UnitSource::kNone ||
      header.source == UnitSource::kAssumed ||
      (IsLengthOrAngle(header.unit) && !IsUnitOfErrors(header.unit));
  const std::vector<std::string> words = WordsOf(name);
  if (ErrorSign(name) != 0 || words.empty()) return false;
  return NamesPosition(name) ||
         (fits &&
          (SayAny(words, Word::kPosition) ||
           (words.size() <= 2 && IsWord(words.front(), Word::kHeight)) ||
           (SayAny(words, Word::kNominal) && words.size() <= 2) ||
           IsAxisLetter(name)));
}

bool IsAxisLetter(std::string_view column) {
  const std::vector<std::string> words = WordsOf(column);
  return !words.empty() && words.size() <= 2 &&
         std::ranges::all_of(words, [&](const std::string& word) {
           return IsOneOf(word, "axis achse axe asse eje") ||
                  IsLetterOfAxis(word);
         });
}

bool IsReadAxis(std::string_view column) {
  const std::vector<std::string> words = WordsOf(column);
  const Unit unit = UnitOfColumn(column);
  return (unit.symbol.empty() || IsLengthOrAngle(unit)) && words.size() == 2 &&
         std::ranges::any_of(words, IsLetterOfAxis) &&
         SayAny(words, Word::kMeasured);
}

}  // namespace errmap::data
