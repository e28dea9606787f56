#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/report/text/answers/remarks.h"

namespace errmap::report {

/// A line of the first answer: which map, how wrong, how sure, what next. Pages
/// and Markdown show every line. A terminal shows the lines that AnswerLines
/// has room for, and the others with --details.
struct FirstAnswer {
  std::string use;  // "Use blend, an average of maps."
  std::vector<Remark> lines;

  /// The map and its error: "Use blend, an average of maps. Unseen cycles: 0.70
  /// um RMSE (95 %: 0.59 to 0.83)."
  std::string Sentence() const;
};

/// Returns the answer for one component, most important first, in its display
/// unit. Throws data::InputError if the record lacks a figure.
FirstAnswer FirstAnswerOf(const models::ComponentRecord& record);

/// Formats a line for a terminal of `width` columns, the label first.
std::vector<std::string> LabelledLines(const Remark& remark, std::size_t width);

/// The part of an answer that a terminal shows.
struct ShownAnswer {
  std::vector<std::string> lines;
  std::vector<Remark> left_out;  // for which there is no room
};

/// Returns the answer for a terminal of `width` columns, labels in a column.
/// With the lines `above` it, it has at most 12 lines and 110 words. It exceeds
/// that only if the required lines (error, given goal, caveats) need more.
/// Other lines that do not fit are left out.
ShownAnswer AnswerLines(const FirstAnswer& answer,
                        std::size_t width,
                        const std::vector<std::string>& above = {});

}  // namespace errmap::report
