#pragma once

#include <string>
#include <vector>

#include "cli/comparison.h"

namespace errmap::cli {

/// "Under every:3, net:scg has the lowest error: 0.321 um RMSE; next is ..."
std::string VerdictSentence(const Comparison& comparison,
                            const models::Verdict& verdict);

/// Which model to use and why, in one or two sentences; "" where nothing was
/// fitted.
std::string RecommendationSentence(const Comparison& comparison);

/// What a user must know before trusting it, a sentence each.
std::vector<std::string> Caveats(const Comparison& comparison);

/// All of it as a paragraph, wrapped for a terminal.
std::string VerdictParagraph(const Comparison& comparison);

/// The digits that errors of this comparison are shown with.
class ErrorText ErrorTextFor(const Comparison& comparison);

}  // namespace errmap::cli
