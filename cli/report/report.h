#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

// What a study found, for people and for other programs. All is drawn from the
// record and decides nothing: one that models::FromJsonText read from a
// results.json gives the same bytes as one that was just made.
//
//   auto x = models::CompareMaps("xdown.csv", {}, {.jobs = 2});
//   auto record = report::MakeRecord({x}, 1);
//   Write("results.json", models::ToJsonText(record));
//   Write("report.html", report::ReportHtml(record));

namespace errmap::report {

/// The record of components that were studied with one seed, put into words.
/// Its provenance has the program and the components' files; command line and
/// configuration are left to the caller. `jobs`: threads that may assess
/// residuals; it changes no bit.
models::StudyRecord MakeRecord(
    const std::vector<models::ComponentStudy>& components,
    std::uint64_t seed,
    int jobs = 1);

/// The first answer in lines of at most so many columns: which map, how wrong,
/// how sure, what next; why there is none, where there is none.
std::string VerdictText(const models::ComponentRecord& component,
                        std::size_t columns = 80);

/// What `errmap compare` shows on a terminal of so many columns: verdict, table
/// and what to do next; of several components a row each.
std::string ScreenText(const models::StudyRecord& record,
                       std::size_t columns = 80);

/// The table of what models achieved, a row per component, hold-out and model,
/// as "csv" with every figure, or as "md"; nothing where no format of tables
/// (report/table.h) has this name.
std::optional<std::string> TableText(const models::StudyRecord& record,
                                     std::string_view format);

/// report.html: one page with its figures, which needs no network. Of a study
/// that is incomplete or failed it says what is not there.
std::string ReportHtml(const models::StudyRecord& record);

/// report.md: the answer, the tables and the equations, for repositories; no
/// figures.
std::string ReportMarkdown(const models::StudyRecord& record);

}  // namespace errmap::report
