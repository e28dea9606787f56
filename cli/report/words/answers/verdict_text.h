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

/// What measurements would make the answer surer: "cycles with t1 below 20 or
/// above 27"; "" where nothing is known to.
std::string MeasureNext(const models::ComponentRecord& record);

/// The verdict of each hold-out and the remarks that the answer has no room
/// for, for --details; without those of the next steps, where these are shown.
std::string VerdictParagraphs(const models::ComponentRecord& record,
                              std::size_t width,
                              bool next_steps);

}  // namespace errmap::report
