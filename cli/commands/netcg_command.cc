#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/format_option.h"
#include "cli/json_blocks.h"
#include "cli/output/claimed_folder.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/shell/terminal.h"
#include "data/files/atomic_file.h"
#include "data/files/prepare_folder.h"
#include "data/text.h"
#include "models/netcg/netcg_files.h"
#include "models/netcg/netcg_json.h"
#include "models/netcg/report_study.h"

namespace errmap::cli {
namespace {

struct NetcgArguments {
  std::string file;
  std::string study;
  std::string precision = "single";
  std::string format = "table";
  bool corrected = false;
  bool full_weights = false;
  bool force = false;
  bool quiet = false;
  models::NetcgStudyOptions options;  // options.netcg of a run file, too
};

// `print`: how text is printed; a study's is that of its file, byte by byte.
void Print(Json document,
           const std::string& text,
           bool as_json,
           const std::string& command_line,
           void (*print)(std::string_view)) {
  if (!as_json) {
    print(text);
    return;
  }
  document["provenance"] = ProvenanceJson(command_line, {}, {});
  PrintResult(DumpJson(document));
}

// Writes into the folder of --out, where there is one; files of a run file
// without it are named by that file. Devices that it names are written to.
void WriteFiles(const std::vector<models::NetcgRecord>& records,
                const NetcgArguments& arguments,
                const std::vector<std::string>& inputs) {
  const std::string& out = arguments.options.netcg.out;
  if (out.empty()) {
    models::WriteNetcgFiles(records);
    return;
  }
  // A later run may write what an earlier one wrote.
  std::map<std::string, std::string> contents;
  for (const models::NetcgRecord& record : records) {
    for (const models::NetcgOutputFile& file : record.files) {
      const auto name = std::filesystem::path(file.path).lexically_relative(
          std::filesystem::path(out).lexically_normal());
      if (name.empty() || *name.begin() == "..") {
        data::WriteFileAtomically(file.path, file.content);
      } else {
        contents[name.string()] = file.content;
      }
    }
  }
  std::vector<std::string> names;
  for (const auto& [name, content] : contents) names.push_back(name);
  ClaimedFolder folder(out, names, inputs, arguments.force);
  for (const auto& [name, content] : contents) folder.Write(name, content);
  folder.Finish();
}

int RunFile(const NetcgArguments& arguments, const std::string& command_line) {
  const std::string& out = arguments.options.netcg.out;
  // Before the work, not after it.
  if (!out.empty()) data::PrepareFolder(out);
  const models::NetcgOptions& options = arguments.options.netcg;
  const bool as_json = arguments.format == "json";
  const auto records = models::RunNetcgFile(
      arguments.file,
      options,
      [&](const models::NetcgSpecification& run,
          std::size_t number,
          std::size_t count) {
        if (arguments.quiet || count == 1) return;
        constexpr std::size_t kTitle = 80;
        Say(fmt::format("run {} of {}: {}",
                        number + 1,
                        count,
                        data::Printable(run.title, kTitle)));
      });
  WriteFiles(records, arguments, {arguments.file});
  Print(as_json ? models::NetcgJson(arguments.file, records, options) : Json(),
        as_json ? "" : models::NetcgText(records, options),
        as_json,
        command_line,
        PrintFitted);
  return kDone;
}

int RunStudy(const NetcgArguments& arguments, const std::string& command_line) {
  const bool as_json = arguments.format == "json";
  const std::string& out = arguments.options.netcg.out;
  // Before the work, not after it.
  if (!out.empty()) data::PrepareFolder(out);
  const models::NetcgStudy study =
      models::RunReportStudy(arguments.study, arguments.options);
  const std::string text = models::StudyText(study);
  if (!out.empty()) {
    std::vector<models::NetcgRecord> records;
    for (const models::NetcgStudyRun& run : study.runs) {
      records.push_back(run.record);
    }
    records.emplace_back().files = study.inputs;
    records.back().files.push_back(
        {(std::filesystem::path(out) / "table4.txt").string(), text});
    WriteFiles(records, arguments, {});
    if (!arguments.quiet) {
      Say(
          fmt::format("reports, weights, patterns and netcg.in, which runs "
                      "them again, are in {}",
                      data::PrintablePath(out)));
    }
  }
  Print(as_json ? models::NetcgStudyJson(study) : Json(),
        text,
        as_json,
        command_line,
        PrintResult);
  return kDone;
}

int RunNetcgCommand(NetcgArguments* arguments,
                    const std::string& command_line) {
  if (arguments->file.empty() == arguments->study.empty()) {
    throw UsageError(
        "netcg needs a run file or --study DIR, and not both; see errmap netcg "
        "--help");
  }
  models::NetcgOptions& options = arguments->options.netcg;
  if (arguments->precision == "double") {
    options.precision = models::NetcgPrecision::kDouble;
  }
  if (arguments->corrected) {
    options.statistics = models::NetcgStatistics::kCorrected;
  }
  if (arguments->full_weights) {
    options.weight_digits = models::WeightDigits::kFull;
  }
  return arguments->study.empty() ? RunFile(*arguments, command_line)
                                  : RunStudy(*arguments, command_line);
}

}  // namespace

void AddNetcgCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<NetcgArguments>();
  models::NetcgStudyOptions& options = arguments->options;
  CLI::App* command = AddCommand(
      app,
      "netcg",
      "Run the report's own program of 1995, with its errors or without");
  AddOption(command,
            "RUNFILE FILE",
            arguments->file,
            "Run specification file as Appendix A reads it (netcg.in); "
            "names in it are relative to its folder");
  AddOption(command,
            "--study DIR",
            arguments->study,
            "Instead, the report's nine experiments (Tables 3 and 4) on "
            "a folder of errmap simulate turning-centre");
  AddOption(command,
            "--precision",
            arguments->precision,
            "Arithmetic: single is the program's own")
      .OneOf({"single", "double"})
      .ShowDefault();
  AddFlag(command,
          "--corrected",
          arguments->corrected,
          "Right statistics in the report files, and the training "
          "run's scaling in testing runs");
  AddOption(command,
            "--training FILE",
            options.netcg.training_file,
            "Pattern file that the weights of testing runs were trained "
            "on, where nothing else tells its scaling");
  AddFlag(command,
          "--full-weights",
          arguments->full_weights,
          "Weights files with all digits and the scaling, in place "
          "of six digits");
  AddOption(command,
            "--out DIR",
            options.netcg.out,
            "Folder to write to, in place of the run file's");
  AddOption(command,
            "--iterations",
            options.iterations,
            "Iterations of each experiment of --study")
      .Range(1, 1000000)
      .ShowDefault();
  AddOption(command,
            "--jobs N",
            options.jobs,
            "Experiments of --study at a time; 0: one per processor")
      .Range(0, 1024)
      .ShowDefault();
  AddFormatOption(command, &arguments->format);
  AddForceFlag(command, &arguments->force);
  AddFlag(command, "--quiet", arguments->quiet, "No remarks on stderr");
  MarkSeldom(command,
             {"--precision",
              "--training",
              "--full-weights",
              "--iterations",
              "--jobs"});
  SetFooter(
      command,
      models::NetcgErrata() +
          "\nExample: errmap netcg netcg.in --precision double --out results");
  OnRun(command, [arguments, run] {
    run->status = RunNetcgCommand(arguments.get(), run->command_line);
  });
}

}  // namespace errmap::cli
