#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

// The results of a study, for people and for other programs. Everything is
// drawn from the record, without decisions: a record that models::FromJsonText
// read from results.json gives the same bytes as a new one.
//
//   auto x = models::CompareMaps("xdown.csv", {}, {.jobs = 2});
//   auto record = report::MakeRecord({x}, 1);
//   Write("results.json", models::ToJsonText(record));
//   Write("report.html", report::ReportHtml(record));

namespace errmap::report {

/// Makes the record, with sentences, of components studied with one seed. Its
/// provenance has the program and the components' files; the caller adds
/// command line and configuration. `jobs`: number of threads for residuals,
/// without effect on the result.
models::StudyRecord MakeRecord(
    const std::vector<models::ComponentStudy>& components,
    std::uint64_t seed,
    int jobs = 1);

/// Returns the first answer in lines of at most `columns`: which map, its
/// error, how sure, what next; or why there is no map.
std::string VerdictText(const models::ComponentRecord& component,
                        std::size_t columns = 80);

/// Returns the output of `errmap compare` for a terminal of `columns`: verdict,
/// table and next steps; with several components one row each.
std::string ScreenText(const models::StudyRecord& record,
                       std::size_t columns = 80);

/// Returns the table of results, a row per component, hold-out and model, as
/// "csv" with full precision or as "md". Returns nothing if no table format
/// (report/table.h) has this name.
std::optional<std::string> TableText(const models::StudyRecord& record,
                                     std::string_view format);

/// Returns report.html: one page with its figures, without network access. For
/// an incomplete or failed study, it says what is missing.
std::string ReportHtml(const models::StudyRecord& record);

/// Returns report.md: the answer, the tables and the equations, for
/// repositories; no figures.
std::string ReportMarkdown(const models::StudyRecord& record);

/// Returns residuals.csv: one line for each hold-out, fold and test row, with
/// group, target and each model's prediction (empty if it failed).
std::string ResidualsCsv(const models::ComponentStudy& study);

}  // namespace errmap::report
