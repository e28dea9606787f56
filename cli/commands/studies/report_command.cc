#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/output/claimed_folder.h"
#include "cli/output/report_files.h"
#include "cli/report/documents/report_html.h"
#include "cli/report/figures/figures.h"
#include "cli/report/report.h"
#include "cli/report/text/answers/data_words.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/slice.h"
#include "cli/study_setup/plan/component_names.h"
#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/text.h"
#include "data/throwing_as.h"
#include "models/study/record/study_record.h"

namespace errmap::cli {
namespace {

std::string ResultsPath(const std::string& folder) {
  return (std::filesystem::path(folder) / "results.json").string();
}

models::StudyRecord ReadResults(const std::string& folder) {
  const std::string path = ResultsPath(folder);
  if (std::error_code failed; !std::filesystem::exists(path, failed)) {
    throw data::InputError(fmt::format(
        "{}: no folder with results.json; errmap compare DATA.csv --out STUDY "
        "writes STUDY, and its page",
        data::PrintablePath(folder)));
  }
  const std::string text = data::ReadFile(path, data::kMostTextOfPrograms);
  return data::ThrowingAs<data::InputError, data::InputError>(
      data::PrintablePath(path) + ": ", [&] {
        models::StudyRecord record = models::FromJsonText(text);
        report::PartsOf(record);  // refuses what a slice did not write
        return record;
      });
}

// The study of that component alone.
models::StudyRecord OfComponent(models::StudyRecord record,
                                const std::string& name) {
  const auto found = std::ranges::find(
      record.components, name, &models::ComponentRecord::name);
  if (found == record.components.end()) {
    std::vector<std::string> names;
    for (const auto& component : record.components) {
      names.push_back(component.name);
    }
    const std::string nearest = data::NearestName(name, names);
    throw UsageError(fmt::format(
        "no component {} in the study{}",
        data::QuotedName(name),
        nearest.empty() ? ""
                        : "; did you mean " + data::QuotedName(nearest) + "?"));
  }
  auto& configured = record.provenance.configuration.component;
  const auto place =
      static_cast<std::size_t>(std::distance(record.components.begin(), found));
  if (place < configured.size()) configured = {configured[place]};
  std::iter_swap(record.components.begin(), found);
  record.components.erase(std::next(record.components.begin()),
                          record.components.end());
  record.others.clear();
  return record;
}

int RunReport(const ReportArguments& arguments) {
  for (const Slice& slice : Slices()) {
    if (slice.report == nullptr) continue;
    if (const auto status = slice.report(arguments)) return *status;
  }
  models::StudyRecord results = ReadResults(arguments.folder);
  if (results.doubt) Warn("warning: " + report::DoubtText(results));
  const std::string& component = arguments.component;
  std::string written;  // told once all is
  if (!component.empty()) results = OfComponent(std::move(results), component);
  if (arguments.format == "md") {
    PrintResult(report::ReportMarkdown(results));
  } else if (arguments.format == "html") {
    PrintResult(report::ReportHtml(results,
                                   FiguresInFolder(results, arguments.folder)));
  } else if (!component.empty()) {
    const std::string page =
        "components/" + study_setup::PlainOrHashedName(component) + ".html";
    ClaimedFolder folder(arguments.folder,
                         {page},
                         {ResultsPath(arguments.folder)},
                         arguments.force);
    folder.Write(page,
                 report::ReportHtml(
                     results, FiguresInFolder(results, arguments.folder)));
    folder.Finish();
    written = folder.PathOf(page) + "\n";
  } else {
    ClaimedFolder folder(arguments.folder,
                         {kReportPage, kReportText},
                         {ResultsPath(arguments.folder)},
                         arguments.force);
    WriteReport(results, &folder);
    folder.Finish();
    written = fmt::format(
        "{}\n{}\n", folder.PathOf(kReportPage), folder.PathOf(kReportText));
  }
  if (arguments.figures.empty()) {
    PrintResult(written);
    return kDone;
  }
  const std::vector<report::ReportFile> figures =
      report::FigureFiles(FiguresInFolder(results, arguments.folder));
  std::vector<std::string> names;
  for (const report::ReportFile& file : figures) names.push_back(file.name);
  ClaimedFolder folder(arguments.figures,
                       names,
                       {ResultsPath(arguments.folder)},
                       arguments.force);
  for (const report::ReportFile& file : figures) {
    folder.Write(file.name, file.text);
  }
  folder.Finish();
  PrintResult(written);
  Warn(fmt::format("{} figures as svg in {}",
                   figures.size(),
                   data::PrintablePath(arguments.figures)));
  return kDone;
}

}  // namespace

void AddReportCommand(CLI::App* app, Run* run) {
  const Command<ReportArguments> command(
      app, run, "report", "Redraw the report of a comparison, without fitting");
  AddOption(command, "DIR", command->folder)
      .About(
          "Folder that errmap compare --out wrote, or a store; report.html and "
          "report.md are redrawn from its results.json")
      .Required()
      .Value("");
  AddOption(command, "--figures DIR2", command->figures)
      .About("Also write every figure here as NAME.svg");
  AddOption(command, "--format", command->format)
      .About("Print html or md instead of writing into DIR")
      .OneOf({"html", "md"});
  AddOption(command, "--component NAME", command->component)
      .About("Draw the full page of this component, not the page of all");
  AddForceFlag(command, &command->force);
  SetFooter(
      command,
      "Exit status: 0 done, 2 wrong command line, 3 unusable results.json.\n"
      "Example: errmap report study --figures figures");
  command.Runs(RunReport);
}

}  // namespace errmap::cli
