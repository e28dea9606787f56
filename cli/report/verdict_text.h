#pragma once

#include <string>

#include "cli/report/report_view.h"

namespace errmap::cli {

// What a record says, in sentences. Nothing is decided here.

/// What a 95 % interval of an RMSE is worth, as measured by
/// tests/benchmarks/confidence_study.cc.
extern const char* const kIntervalCoverage;

/// Puts the sentences into `record`, which has all else: of the gap, the
/// verdicts, the memorisation checks and the recommendation.
void AddSentences(models::ComponentRecord* record);

/// The sentences in paragraphs, wrapped for a terminal.
std::string VerdictParagraphs(const models::ComponentRecord& record);

/// What a goal was held against: "RMSE 4.98 um, sd 0.2 um about an offset of
/// 4.97 um"; "" without a goal.
std::string GoalFigures(const models::ResultRecord& result,
                        const ErrorText& error);

}  // namespace errmap::cli
