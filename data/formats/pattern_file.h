#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace errmap::data {

/// The content of a pattern file of the report's 1995 program.
struct PatternTable {
  /// "Scale factor for unit conversion if necessary": the program reads it but
  /// never applies it.
  double scale = 1.0;
  std::vector<std::string> inputs;   // (I) names: "position_mm", "t00_degC"
  std::vector<std::string> targets;  // (J) names: "error_mm"
  std::vector<long long> index;      // (P) of the stacked form's rows, else (0)
  Eigen::MatrixXd input_values;      // (P x I)
  Eigen::MatrixXd target_values;     // (P x J)
};

/// The forms, recognised by the file's extension.
enum class PatternForm {
  kStacked,  // any other ending: NISTIR 5367, Table 2
  kPlain,    // ".tab"
  kCsv,      // ".csv"
};
PatternForm PatternFormOf(std::string_view path);

/// Reads a pattern file in one of these forms:
/// - stacked: patterns, inputs, outputs, scale factor; a line of titles; per
///   pattern its index, position, targets and the first three thermocouples;
///   then blocks of up to six thermocouples, each below a line of their numbers
///   (40 of them: 3 + 6 x 6 + 1);
/// - plain: the same first line; names of inputs and targets; a row per
/// pattern;
/// - CSV: as PatternText writes it; else a data file such as
///   `errmap simulate` makes: its target, and as inputs the position and the
///   other numeric columns (MakeDataset), dead ones too.
/// Throws InputError naming file, line, what was expected and found.
PatternTable ReadPatterns(const std::string& path);

/// Reads a pattern file from text in memory; `name` decides the form.
PatternTable ParsePatterns(std::string_view text, const std::string& name);

/// Returns the text of a table in that form. The stacked form has the report's
/// columns, but a number that they would round gets all its digits. So each
/// form reads back to the same numbers, and its text is reproduced byte for
/// byte. Throws std::invalid_argument if the table has no inputs or targets.
std::string PatternText(const PatternTable& table, PatternForm form);

}  // namespace errmap::data
