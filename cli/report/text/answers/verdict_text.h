#pragma once

#include <cstddef>
#include <string>

#include "cli/report/report_view.h"

namespace errmap::report {

// What a record says, in sentences. Nothing is decided here.

/// The coverage of a 95 % interval of an RMSE, as measured by
/// tests/benchmarks/confidence_study.cc.
extern const char* const kIntervalCoverage;

/// Adds the sentences to `record`, which must already have the gap, verdicts,
/// memorisation checks and recommendation. Throws data::InputError if it does
/// not.
void AddSentences(models::ComponentRecord* record);

/// Returns a copy of the record with the unit symbols of pages: "0.5 µm" for a
/// terminal's "0.5 um".
models::StudyRecord WithPageUnits(models::StudyRecord record);

/// Returns which measurements would make the answer more certain: "cycles with
/// t1 below 20 or above 27"; "" if none is known.
std::string MeasureNext(const models::ComponentRecord& record);

/// Returns, for --details, the verdict of each hold-out and the remarks that
/// the answer leaves out. Omits those of the next steps if `next_steps`.
std::string VerdictParagraphs(const models::ComponentRecord& record,
                              std::size_t width,
                              bool next_steps);

}  // namespace errmap::report
