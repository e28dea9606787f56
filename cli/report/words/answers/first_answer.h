#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/report/words/answers/remarks.h"

namespace errmap::report {

/// What a reader has to know first: which map, how wrong, how sure, what next.
/// Pages and Markdown show every line; a terminal shows what AnswerLines has
/// room for, and the others with --details.
struct FirstAnswer {
  std::string use;  // "Use blend, an average of maps."
  std::vector<Remark> lines;

  /// The map and its error: "Use blend, an average of maps. Unseen cycles: 0.70
  /// um RMSE (95 %: 0.59 to 0.83)."
  std::string Sentence() const;
};

/// The answer of one component, most important first, in its display unit.
/// Throws data::InputError where the record lacks a figure.
FirstAnswer FirstAnswerOf(const models::ComponentRecord& record);

/// On a terminal of `width` columns, the label first.
std::vector<std::string> LabelledLines(const Remark& remark, std::size_t width);

/// What a terminal shows of an answer.
struct ShownAnswer {
  std::vector<std::string> lines;
  std::vector<Remark> left_out;  // for which there is no room
};

/// The answer on a terminal of `width` columns, labels in a column. With the
/// lines `above` it, it has at most 12 lines and 110 words, or those that must
/// be shown (the error, a given goal, caveats) if they alone need more. What
/// else no longer fits is left out.
ShownAnswer AnswerLines(const FirstAnswer& answer,
                        std::size_t width,
                        const std::vector<std::string>& above = {});

}  // namespace errmap::report
