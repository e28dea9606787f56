#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/report/figures.h"
#include "cli/report/json_access.h"
#include "cli/report/output_folder.h"
#include "cli/report/report_files.h"
#include "cli/report/report_html.h"
#include "cli/report/report_markdown.h"
#include "cli/study_file/data_arguments.h"
#include "data/atomic_file.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

struct ReportArguments {
  std::string folder;
  std::string figures;
  std::string image = "svg";
  std::string format;
};

ImageFormat FormatNamed(const std::string& name) {
  if (name == "pdf") return ImageFormat::kPdf;
  return name == "png" ? ImageFormat::kPng : ImageFormat::kSvg;
}

Json ReadResults(const std::string& folder) {
  const std::string path =
      (std::filesystem::path(folder) / "results.json").string();
  Json results = Json::parse(data::ReadFile(path), nullptr, false);
  const std::string shown = data::PrintablePath(path);
  if (results.is_discarded()) {
    throw data::InputError(shown +
                           ": is no JSON; errmap compare --out writes it");
  }
  constexpr const char* kSchema = "errmap-results-1";
  const std::string schema = TextAt(results, "schema");
  if (schema != kSchema) {
    throw data::InputError(fmt::format(
        "{}: schema is {}, this version reads {}; run errmap compare again",
        shown,
        schema.empty() ? "not there" : data::QuotedText(schema),
        kSchema));
  }
  return results;
}

int RunReport(const ReportArguments& arguments) {
  const Json results = ReadResults(arguments.folder);
  // Better now than after the figures are drawn.
  if (!arguments.figures.empty()) PrepareFolder(arguments.figures);
  if (arguments.format == "md") {
    fmt::print("{}", ReportMarkdown(results));
  } else if (arguments.format == "html") {
    FigureSet figures = MakeFigures(results);
    DrawFigures(&figures);
    if (!figures.failure.empty()) Say("no figures: " + figures.failure);
    fmt::print("{}", ReportHtml(results, figures));
  } else {
    const std::string remark = WriteReport(results, arguments.folder);
    if (!remark.empty()) Say(remark);
  }
  if (arguments.figures.empty()) return kDone;
  const std::vector<std::string> failures =
      WriteFigures(MakeFigures(results, true),
                   FormatNamed(arguments.image),
                   arguments.figures);
  for (const std::string& failure : failures) Say(failure);
  return failures.empty() ? kDone : kOtherFailure;
}

}  // namespace

void AddReportCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App* command = app->add_subcommand(
      "report", "Draw the report of a comparison anew, without fitting");
  command
      ->add_option("DIR",
                   arguments->folder,
                   "Folder that errmap compare --out wrote: report.html and "
                   "report.md are drawn from its results.json")
      ->required()
      ->type_name("");
  command
      ->add_option("--figures",
                   arguments->figures,
                   "Also write every figure here, with its gnuplot script and "
                   "data")
      ->type_name("DIR2");
  command->add_option("--image", arguments->image, "svg, pdf or png")
      ->check(CLI::IsMember({"svg", "pdf", "png"}))
      ->type_name("svg|pdf|png")
      ->capture_default_str();
  command
      ->add_option("--format",
                   arguments->format,
                   "Print html or md instead of writing into DIR")
      ->check(CLI::IsMember({"html", "md"}))
      ->type_name("html|md");
  command->footer(
      "Exit status: 0 done, 1 a figure asked for could not be drawn, 2 wrong "
      "command line, 3 unusable results.json.\n"
      "Example: errmap report study --figures paper --image pdf");
  command->callback([arguments, run] { run->status = RunReport(*arguments); });
}

}  // namespace errmap::cli
