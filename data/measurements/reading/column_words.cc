#include "data/measurements/reading/column_words.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "data/text.h"
#include "data/units.h"

namespace errmap::data {
namespace {

using KnownWords = std::span<const std::string_view>;

constexpr auto kErrors = std::to_array<std::string_view>({"error",
                                                          "err",
                                                          "errors",
                                                          "fehler",
                                                          "abweichung",
                                                          "deviation",
                                                          "dev",
                                                          "erreur",
                                                          "ecart",
                                                          "deviazione",
                                                          "errore",
                                                          "scarto",
                                                          "desvio",
                                                          "desviacion",
                                                          "scostamento",
                                                          "messfehler"});
constexpr auto kCorrections = std::to_array<std::string_view>({"correction",
                                                               "compensation",
                                                               "korrektur",
                                                               "kompensation",
                                                               "correccion",
                                                               "compensacion",
                                                               "correzione",
                                                               "compensazione",
                                                               "corr",
                                                               "comp"});
constexpr auto kPositions = std::to_array<std::string_view>(
    {"position", "pos", "posicion", "posizione", "posn", "weg", "stellung"});
constexpr auto kNominals = std::to_array<std::string_view>({"nominal",
                                                            "soll",
                                                            "sollwert",
                                                            "sollposition",
                                                            "commanded",
                                                            "command",
                                                            "cmd",
                                                            "setpoint",
                                                            "consigne",
                                                            "nominale",
                                                            "consigna"});
constexpr auto kMeasured = std::to_array<std::string_view>({"actual",
                                                            "measured",
                                                            "ist",
                                                            "istwert",
                                                            "istposition",
                                                            "encoder",
                                                            "reelle",
                                                            "mesuree",
                                                            "misurata",
                                                            "medida"});
constexpr auto kTimes = std::to_array<std::string_view>({"time",
                                                         "timestamp",
                                                         "datetime",
                                                         "zeit",
                                                         "uhrzeit",
                                                         "zeitstempel",
                                                         "zeitpunkt",
                                                         "tiempo",
                                                         "hora",
                                                         "ora",
                                                         "heure",
                                                         "horodatage",
                                                         "orario",
                                                         "uhr",
                                                         "utc"});
constexpr auto kDates = std::to_array<std::string_view>(
    {"date", "datum", "fecha", "datetime", "data"});
constexpr auto kTemperatures = std::to_array<std::string_view>(
    {"temperature", "temp", "temperatur", "temperatura"});
constexpr auto kDirections = std::to_array<std::string_view>({"direction",
                                                              "dir",
                                                              "approach",
                                                              "motion",
                                                              "richtung",
                                                              "anfahrrichtung",
                                                              "direccion",
                                                              "direzione",
                                                              "sens",
                                                              "sentido",
                                                              "senso"});
constexpr auto kCycles =
    std::to_array<std::string_view>({"cycle", "zyklus", "takt", "ciclo"});
constexpr auto kSessions = std::to_array<std::string_view>({"session",
                                                            "day",
                                                            "tag",
                                                            "shift",
                                                            "schicht",
                                                            "jour",
                                                            "seance",
                                                            "giorno",
                                                            "dia",
                                                            "sesion",
                                                            "sessione",
                                                            "messtag"});
constexpr auto kRuns =
    std::to_array<std::string_view>({"run", "lauf", "messlauf"});

KnownWords WordsFor(Word word) {
  switch (word) {
    case Word::kError:
      return kErrors;
    case Word::kCorrection:
      return kCorrections;
    case Word::kPosition:
      return kPositions;
    case Word::kNominal:
      return kNominals;
    case Word::kMeasured:
      return kMeasured;
    case Word::kTime:
      return kTimes;
    case Word::kDate:
      return kDates;
    case Word::kTemperature:
      return kTemperatures;
    case Word::kDirection:
      return kDirections;
    case Word::kCycle:
      return kCycles;
    case Word::kSession:
      return kSessions;
    case Word::kRun:
      return kRuns;
  }
  return {};
}

// Small letters without accents; the letters of Latin-1 are two bytes of UTF-8,
// the first of them 0xC3.
std::string Plain(std::string_view text) {
  constexpr std::string_view kLatin =
      "aaaaaaaceeeeiiiidnooooo*ouuuuypsaaaaaaaceeeeiiiidnooooo/ouuuuypy";
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c == 0xC3 && i + 1 < text.size()) {
      plain += kLatin[static_cast<unsigned char>(text[++i]) & 0x3FU];
    } else {
      plain += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    }
  }
  return plain;
}

bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c & 0x80) != 0; }

// A short word may be part of any other: "dia" of "diameter".
bool IsOrHas(std::string_view word, std::string_view known) {
  constexpr std::size_t kLongEnough = 5;
  if (word == known) return true;
  if (word.size() == known.size() + 1 && word.ends_with('s') &&
      word.starts_with(known)) {
    return true;
  }
  return known.size() >= kLongEnough && word.find(known) != word.npos;
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

std::vector<std::string> WordsOf(std::string_view column) {
  const Header header = ReadHeader(column);
  const std::string plain = Plain(WithGaps(
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

bool IsCalled(std::string_view column, Word word) {
  constexpr auto kNumber = std::to_array<std::string_view>(
      {"no", "nr", "num", "number", "nummer", "id", "index", "count", "n"});
  std::vector<std::string> words = WordsOf(column);
  if (words.size() == 2 && std::ranges::count(kNumber, words[1]) > 0) {
    words.pop_back();
  }
  return words.size() == 1 &&
         std::ranges::count(WordsFor(word), std::string_view(words[0])) > 0;
}

bool IsAxisLetter(std::string_view column) {
  constexpr std::string_view kAxes = "xyzuvwabc";
  constexpr auto kWords =
      std::to_array<std::string_view>({"axis", "achse", "axe", "asse", "eje"});
  const std::vector<std::string> words = WordsOf(column);
  return !words.empty() && words.size() <= 2 &&
         std::ranges::all_of(words, [&](const std::string& word) {
           return std::ranges::count(kWords, std::string_view(word)) > 0 ||
                  (word.size() == 1 && kAxes.find(word) != kAxes.npos);
         });
}

}  // namespace errmap::data
