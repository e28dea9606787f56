#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/report/report_view.h"

namespace errmap::report {

/// One message of the first answer: "without a map", "11.5 um; 94 % removed".
struct AnswerLine {
  std::string label;  // at most 15 characters
  std::string text;   // the figure first
  enum class Tone { kPlain, kGood, kBad } tone = Tone::kPlain;
};

/// What a reader has to know first: which map, how wrong, how sure, what next.
/// Screens, pages, Markdown and Python show these lines and no others.
struct FirstAnswer {
  std::string use;  // "Use blend, an average of maps."
  std::vector<AnswerLine> lines;

  /// The map and its error: "Use blend, an average of maps. Unseen cycles: 0.70
  /// um RMSE (95 %: 0.59 to 0.83)."
  std::string Sentence() const;
};

/// The answer of one component, most important first, in its display unit.
/// Throws data::InputError where the record lacks a figure.
FirstAnswer FirstAnswerOf(const models::ComponentRecord& record);

/// The answer on a terminal of `width` columns, labels in a column, in at most
/// 12 lines and 110 words with those `above` it: a message that no longer fits
/// is left out.
std::vector<std::string> AnswerLines(
    const FirstAnswer& answer,
    std::size_t width,
    const std::vector<std::string>& above = {});

}  // namespace errmap::report
