#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// Possible meanings of a column's name, in English, German, French, Italian,
/// Spanish and a dozen other languages.
enum class Word {
  kError,       // "error", "Abweichung", "écart", "scostamento"
  kCorrection,  // "correction", "Kompensation": an error with the other sign
  kPosition,    // "position", "Sollposition", "pos"
  kHeight,      // "height", "Höhe": a position where its unit is of one
  kNominal,     // of positions: "nominal", "Soll", "commanded"
  kMeasured,    // of positions: "actual", "Ist", "measured"
  kTime,        // "time", "Zeit", "timestamp", "heure"
  kDate,        // "date", "Datum", "fecha"
  kTemperature,
  kSpeed,       // "rpm", "feed", "Drehzahl", "Vorschub"
  kDirection,   // "direction", "approach", "Richtung", "sens"
  kCycle,       // "cycle", "Zyklus", "Takt", "ciclo"
  kSession,     // "session", "day", "Tag", "shift", "jour"
  kShift,       // of the sessions, those that return each day
  kRun,         // "run", "Lauf": a session, or one traverse
  kDay,         // of the sessions, those of the calendar
  kWeek,        // "week", "KW"
  kCounter,     // "index", "record", "Nr.": numbers or dates the rows
  kIdentifier,  // "S/N", "firmware", "Anzahl Messwerte": no quantity of a
                // machine
  kComputed,    // "residual", "fit", "tolerance": made of errors
  kSpread,      // "std", "sigma", "uncertainty"
  kPart,        // "machine", "tool": which of several
  kComponent,   // "axis", "slide": what errors are of
  kPlace,       // "station", "point": numbers places along the axis
};

/// Returns the text in lower case without accents: "zuruck" for "Zurück".
std::string PlainText(std::string_view text);

/// Returns the words of a name in lower case, without accents and unit: "x",
/// "pos" for "X_Pos [mm]".
std::vector<std::string> WordsOf(std::string_view column);

/// True if one of the words of a text (WordsOf) is in a list separated by
/// blanks.
bool HasWordOf(std::string_view text, std::string_view list);

/// True if one of these words (WordsOf) has such a meaning, or contains a word
/// that does ("positionsabweichung").
bool SayAny(const std::vector<std::string>& words, Word word);
bool Says(std::string_view column, Word word);

/// True if a word (of WordsOf) is such a word or its plural ("cycles").
bool IsWord(std::string_view said, Word word);

/// True if a column is a temperature, judged by its unit or else by its words:
/// "No. 1 [degC]", "Temp. Nr. 1".
bool StatesTemperature(std::string_view column);

/// True also if the name implies a temperature without a word for it: "T1".
bool NamesTemperature(std::string_view column);

/// True if the whole name is such a word, apart from words like "no" and
/// "number". "Cycle No." counts cycles, but "elapsed_cycles" is something else.
bool IsCalled(std::string_view column, Word word);

/// True if a name contains such a word, or a phrase of several ("s_n" of
/// "Probe S/N").
bool SaysPhrase(std::string_view column, Word word);

/// Returns the sign of an error, judged by its name. 1: an error ("deviation",
/// "EXX", "actual - nominal"). -1: its opposite ("correction", "minus error",
/// "nominal - actual", an unknown difference). 0: not an error.
int ErrorSign(std::string_view column);

/// True if a name begins like that of an error and is not a temperature ("Error
/// amp. [degC]").
bool BeginsAsError(std::string_view column);

/// True if a column has a unit that only errors have. The letter of an axis
/// does not count: it may be a position.
bool IsInUnitOfErrors(std::string_view column);

/// True if a column's name is that of a position: "position_mm", "x_pos_mm",
/// "Sollposition [mm]", "X [mm]".
bool IsCalledPosition(std::string_view name);

/// True if a name is that of a linear axis and nothing else: "X", "z [mm]",
/// "axis".
bool IsAxisLetter(std::string_view column);

/// True if a name is that of a measured axis position: "Y act [mm]",
/// "Z_ist_mm".
bool IsReadAxis(std::string_view column);

}  // namespace errmap::data
