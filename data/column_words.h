#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// What a column's name may say of it, in English, German, French, Italian,
/// Spanish and a dozen more languages.
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
  kDirection,   // "direction", "approach", "Richtung", "sens"
  kCycle,       // "cycle", "Zyklus", "Takt", "ciclo"
  kSession,     // "session", "day", "Tag", "shift", "jour"
  kRun,         // "run", "Lauf": a session, or one traverse
  kDay,         // of the sessions, those of the calendar
  kCounter,     // "index", "record", "Nr.": numbers or dates the rows
  kIdentifier,  // "S/N", "firmware", "Anzahl Messwerte": no quantity of a
                // machine
  kComputed,    // "residual", "fit", "tolerance": made of errors
  kSpread,      // "std", "sigma", "uncertainty"
  kPart,        // "machine", "tool": which of several
  kComponent,   // "axis", "slide": what errors are of
  kPlace,       // "station", "point": numbers places along the axis
};

/// In small letters without accents: "zuruck" of "Zurück".
std::string PlainText(std::string_view text);

/// The words of a name in small letters without accents, its unit left out:
/// "x", "pos" of "X_Pos [mm]".
std::vector<std::string> WordsOf(std::string_view column);

/// Whether one of the words of a text (WordsOf) stands in a list, which blanks
/// part.
bool HasWordOf(std::string_view text, std::string_view list);

/// Whether one of these words (WordsOf) is such a word, or a longer one with it
/// in it ("positionsabweichung").
bool SayAny(const std::vector<std::string>& words, Word word);
bool Says(std::string_view column, Word word);

/// Whether a word (of WordsOf) is such a one, or more of them ("cycles").
bool IsWord(std::string_view said, Word word);

/// Whether a column is a temperature by its unit, or by its words where it has
/// none: "No. 1 [degC]", "Temp. Nr. 1".
bool StatesTemperature(std::string_view column);

/// Whether all of a name is such a word, but for "no", "number" and alike:
/// "Cycle No." counts cycles, "elapsed_cycles" is something else. A temperature
/// is called nothing else.
bool IsCalled(std::string_view column, Word word);

/// Whether such a word, or several that follow one another ("s_n" of "Probe
/// S/N"), stands in a name.
bool SaysPhrase(std::string_view column, Word word);

/// What a name says of the sign of an error: 1, an error ("deviation",
/// "actual - nominal", "EXX"); -1, its opposite ("correction", "minus error",
/// "nominal - actual", a difference of words unknown here); 0, of no error.
int ErrorSign(std::string_view column);

/// Whether a name begins as that of an error does, and is none of a
/// temperature ("Error amp. [degC]").
bool BeginsAsError(std::string_view column);

/// Whether a column is in a unit that only errors have, and no axis of one
/// letter, which may be a position in it.
bool IsInUnitOfErrors(std::string_view column);

/// Whether a column is a position by its name: "position_mm", "x_pos_mm",
/// "Sollposition [mm]", "X [mm]".
bool IsCalledPosition(std::string_view name);

/// Whether a name is that of a linear axis and no more: "X", "z [mm]", "axis".
bool IsAxisLetter(std::string_view column);

/// Whether a name is that of an axis as it was read: "Y act [mm]", "Z_ist_mm".
bool IsReadAxis(std::string_view column);

}  // namespace errmap::data
