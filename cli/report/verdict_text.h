#pragma once

#include <string>
#include <vector>

#include "cli/shell/number_text.h"
#include "cli/study_file/comparison.h"

namespace errmap::cli {

/// What hold-out `h` says: the lowest error with its interval, the tier, and
/// whether the choice is more than chance.
std::string VerdictSentence(const Comparison& comparison, std::size_t h);

/// Which map to use and its error on rows never seen; "" where nothing could
/// be judged.
std::string RecommendationSentence(const Comparison& comparison);

/// Why that map, a sentence each.
std::vector<std::string> Reasons(const Comparison& comparison);

/// What a user must know before trusting it, a sentence each.
std::vector<std::string> Caveats(const Comparison& comparison);

/// "every:3 flatters poly:full:degree=6 (0.487 -> 10.254 um, 21 times)"; ""
/// where no model is flattered or no such hold-outs are there.
std::string GapSentence(const Comparison& comparison);

/// Whether a net learns noise, with the figures; "" for other models.
std::string MemorisationSentence(const models::ModelResult& model);

/// What a 95 % interval of an RMSE is worth, as measured by
/// tests/benchmarks/confidence_study.cc.
extern const char* const kIntervalCoverage;

/// All of it in paragraphs, wrapped for a terminal.
std::string VerdictParagraphs(const Comparison& comparison);

/// The digits that errors of this comparison are shown with.
ErrorText ErrorTextFor(const Comparison& comparison);

/// "cycles", "blocks of rows": what the tests count.
std::string PluralOfUnit(const models::UnitsOfAnalysis& units);

/// What a goal was held against: "RMSE 4.98 um, sd 0.2 um about an offset of
/// 4.97 um"; "" without a goal.
std::string GoalFigures(const models::GoalJudgement& judged,
                        const ErrorText& error);

}  // namespace errmap::cli
