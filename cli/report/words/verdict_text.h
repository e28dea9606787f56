#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cli/report/report_view.h"

namespace errmap::report {

// What a record says, in sentences. Nothing is decided here.

/// What a 95 % interval of an RMSE is worth, as measured by
/// tests/benchmarks/confidence_study.cc.
extern const char* const kIntervalCoverage;

/// Puts the sentences into `record`, which has all else: of the gap, the
/// verdicts, the memorisation checks and the recommendation.
/// Throws data::InputError where it has not.
void AddSentences(models::ComponentRecord* record);

/// The record in the units' symbols and words of pages: "0.5 µm" where a
/// terminal has "0.5 um".
models::StudyRecord WithPageUnits(models::StudyRecord record);

/// What is told with a recommendation first, most important first.
std::vector<const models::RemarkRecord*> ToldFirst(
    const models::RecommendationRecord& advice);

/// The recommendation and what is told with it first, most important first.
std::vector<std::string> FirstWords(const models::ComponentRecord& record);

/// As many of these sentences as eight lines hold.
inline constexpr std::size_t kMostVerdictLines = 8;
std::vector<std::string> SaidFirst(const models::ComponentRecord& record,
                                   std::size_t width);

/// What measurements would make the answer surer: "cycles with t1 below 20 or
/// above 27"; "" where nothing is known to.
std::string MeasureNext(const models::ComponentRecord& record);

/// Every sentence that these have not, nor the next steps where they are shown,
/// in paragraphs.
std::string VerdictParagraphs(const models::ComponentRecord& record,
                              std::size_t width,
                              bool next_steps);

}  // namespace errmap::report
