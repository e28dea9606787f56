#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/json_blocks.h"
#include "cli/netcg/netcg_files.h"
#include "cli/netcg/report_study.h"
#include "cli/output/claimed_folder.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/slice.h"
#include "data/files/atomic_file.h"
#include "data/files/prepare_folder.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

struct NetcgArguments {
  std::string file;
  std::string study;
  std::string format = "table";
  bool force = false;
  bool quiet = false;
  netcg::NetcgStudyOptions options;  // options.netcg of a run file, too
};

// ---- As JSON.

Json FiguresJson(const netcg::NetcgFigures& figures) {
  return {{"mean", figures.mean},
          {"sd", figures.sd},
          {"min", figures.min},
          {"max", figures.max},
          {"r2", figures.r2},
          {"ks_d", figures.ks_d},
          {"ks_p", figures.ks_p}};
}

Json MatrixJson(const MatrixXd& values) {
  Json rows = Json::array();
  for (const auto& row : values.rowwise()) {
    rows.push_back(std::vector<double>(row.begin(), row.end()));
  }
  return rows;
}

// What a run and an experiment have in common.
Json RunJson(const netcg::NetcgRecord& record) {
  const netcg::NetcgSpecification& run = record.specification;
  const netcg::NetcgResult& result = record.result;
  Json json = {{"title", run.title},
               {"kind", run.is_training() ? "training" : "testing"},
               {"nodes", {run.inputs, run.hidden, run.outputs}},
               {"patterns", run.patterns},
               {"weights", run.num_weights()},
               {"iterations", result.iterations},
               {"ierr", run.is_training() ? Json(result.ierr) : Json(nullptr)},
               {"function_calls", result.function_calls},
               {"error", result.error},
               {"rms_error", std::sqrt(2.0 * result.error)},
               {"gradient_ratio", result.gradient_ratio},
               {"weight_change", result.weight_change},
               {"as_printed", FiguresJson(result.printed)},
               {"corrected", FiguresJson(result.corrected)},
               {"corrected_scaling",
                result.corrected_scaling == netcg::NetcgScaling::kTraining
                    ? "training"
                    : "test file"}};
  if (run.is_training()) {
    json["seconds"] = result.summary.seconds;
    json["mean_iteration_seconds"] = result.summary.mean_iteration_seconds;
    json["sd_iteration_seconds"] = result.summary.sd_iteration_seconds;
  }
  return json;
}

// errmap-netcg-1: runs of a run file.
Json RunsJson(const std::string& file,
              const std::vector<netcg::NetcgRecord>& records,
              const netcg::NetcgOptions& options) {
  Json document = {{"schema", "errmap-netcg-1"},
                   {"file", file},
                   {"precision", ToString(options.precision)}};
  Json& runs = document["runs"] = Json::array();
  for (const netcg::NetcgRecord& record : records) {
    Json run = RunJson(record);
    const netcg::NetcgFigures& printed = record.result.printed;
    run["error_curve"] = record.result.error_curve;
    run["desired"] = MatrixJson(printed.desired);
    run["predicted"] = MatrixJson(printed.predicted);
    run["predicted_corrected"] = MatrixJson(record.result.corrected.predicted);
    Json& files = run["files"] = Json::array();
    for (const auto& output : record.files) files.push_back(output.path);
    runs.push_back(run);
  }
  return document;
}

// errmap-netcg-study-1: the nine experiments beside the report's.
Json StudyJson(const netcg::NetcgStudy& study) {
  Json document = {{"schema", "errmap-netcg-study-1"},
                   {"folder", study.folder},
                   {"precision", ToString(study.options.netcg.precision)},
                   {"seconds", study.seconds}};
  Json& runs = document["runs"] = Json::array();
  for (const netcg::NetcgStudyRun& experiment : study.runs) {
    const netcg::ReportRun& report = experiment.report;
    Json run = {{"number", report.number},
                {"direction", report.down ? "down" : "up"},
                {"selection", report.selection},
                {"thermocouples", experiment.thermocouples}};
    run.update(RunJson(experiment.record));
    run["report"] = {{"patterns", report.patterns},
                     {"thermocouples_printed", report.thermocouples},
                     {"thermocouples_implied", report.implied_thermocouples()},
                     {"input_nodes_printed", report.input_nodes},
                     {"weights", report.weights},
                     {"mean", report.mean},
                     {"sd", report.sd},
                     {"sd_corrected", report.sd * std::sqrt(2.0)},
                     {"min", report.min},
                     {"max", report.max},
                     {"mean_iteration_seconds", report.iteration_seconds},
                     {"sd_iteration_seconds", report.iteration_seconds_sd},
                     {"seconds", report.elapsed_seconds}};
    runs.push_back(run);
  }
  document["notes"] = study.notes;
  return document;
}

// ---- The command.

// Writes into the folder of --out, if there is one; files of a run file
// without it are named by that file. Devices that it names are written to.
void WriteFiles(const std::vector<netcg::NetcgOutputFile>& files,
                const NetcgArguments& arguments,
                const std::vector<std::string>& inputs) {
  const std::filesystem::path out(arguments.options.netcg.out);
  // A later run may write what an earlier one wrote.
  std::map<std::string, std::string> contents;
  for (const netcg::NetcgOutputFile& file : files) {
    const auto name = std::filesystem::path(file.path).lexically_relative(
        out.lexically_normal());
    if (out.empty() || name.empty() || *name.begin() == "..") {
      data::WriteFileAtomically(file.path, file.content);
    } else {
      contents[name.string()] = file.content;
    }
  }
  if (out.empty()) return;
  std::vector<std::string> names;
  for (const auto& [name, content] : contents) names.push_back(name);
  ClaimedFolder folder(out.string(), names, inputs, arguments.force);
  for (const auto& [name, content] : contents) folder.Write(name, content);
  folder.Finish();
}

void PrintJson(Json document, const std::string& command_line) {
  document["provenance"] = ProvenanceJson(command_line, {}, {});
  PrintResult(DumpJson(document));
}

int RunFile(const NetcgArguments& arguments, const std::string& command_line) {
  const netcg::NetcgOptions& options = arguments.options.netcg;
  const auto records = netcg::RunNetcgFile(
      arguments.file,
      options,
      [&](const netcg::NetcgSpecification& run,
          std::size_t number,
          std::size_t count) {
        if (arguments.quiet || count == 1) return;
        constexpr std::size_t kTitle = 80;
        Warn(fmt::format("run {} of {}: {}",
                         number + 1,
                         count,
                         data::Printable(run.title, kTitle)));
      });
  std::vector<netcg::NetcgOutputFile> files;
  for (const netcg::NetcgRecord& record : records) {
    files.insert(files.end(), record.files.begin(), record.files.end());
  }
  WriteFiles(files, arguments, {arguments.file});
  if (arguments.format == "json") {
    PrintJson(RunsJson(arguments.file, records, options), command_line);
  } else {
    PrintFitted(netcg::NetcgText(records, options));
  }
  return kDone;
}

int RunStudy(const NetcgArguments& arguments, const std::string& command_line) {
  const std::string& out = arguments.options.netcg.out;
  netcg::NetcgStudy study =
      netcg::RunReportStudy(arguments.study, arguments.options);
  const std::string text = netcg::StudyText(study);
  if (!out.empty()) {
    study.files.push_back(
        {(std::filesystem::path(out) / "table4.txt").string(), text});
    WriteFiles(study.files, arguments, {});
    if (!arguments.quiet) {
      Warn(
          fmt::format("reports, weights, patterns and netcg.in, which runs "
                      "them again, are in {}",
                      data::PrintablePath(out)));
    }
  }
  if (arguments.format == "json") {
    PrintJson(StudyJson(study), command_line);
  } else {
    PrintResult(text);  // as in its file, byte by byte
  }
  return kDone;
}

int RunNetcgCommand(const NetcgArguments& arguments,
                    const std::string& command_line) {
  if (arguments.file.empty() == arguments.study.empty()) {
    throw UsageError(
        "netcg needs a run file or --study DIR, and not both; see errmap netcg "
        "--help");
  }
  const netcg::NetcgOptions& options = arguments.options.netcg;
  // Before the work, not after it.
  if (!options.out.empty()) data::PrepareFolder(options.out);
  return arguments.study.empty() ? RunFile(arguments, command_line)
                                 : RunStudy(arguments, command_line);
}

}  // namespace

void AddConvertCommand(CLI::App* app, Run* run);

void AddNetcgCommand(CLI::App* app, Run* run) {
  const Command<NetcgArguments> command(
      app,
      run,
      "netcg",
      "Run the program of the 1995 report, with its errors or without");
  netcg::NetcgStudyOptions& options = command->options;
  AddOption(command, "RUNFILE FILE", command->file)
      .About(
          "Run specification file as Appendix A reads it (netcg.in); names in "
          "it are relative to its folder");
  AddOption(command, "--study DIR", command->study)
      .About(
          "Instead, the report's nine experiments (Tables 3 and 4) on a folder "
          "of errmap simulate turning-centre");
  AddChoice(command,
            "--precision",
            "Arithmetic: single is the program's own",
            std::vector{netcg::NetcgPrecision::kSingle,
                        netcg::NetcgPrecision::kDouble},
            &options.netcg.precision);
  AddFlag(command,
          "--corrected",
          [&options] {
            options.netcg.statistics = netcg::NetcgStatistics::kCorrected;
          })
      .About(
          "Print correct statistics, and use the training run's scaling in "
          "testing runs");
  AddOption(command, "--training FILE", options.netcg.training_file)
      .About(
          "Pattern file on which the weights of testing runs were trained, if "
          "no other file has its scaling");
  AddFlag(
      command,
      "--full-weights",
      [&options] { options.netcg.weight_digits = netcg::WeightDigits::kFull; })
      .About(
          "Write all digits and the scaling into weights files, not six "
          "digits");
  AddOption(command, "--out DIR", options.netcg.out)
      .About("Folder to write to, in place of the run file's")
      .Under(kOutputOptions);
  AddOption(command, "--iterations", options.iterations)
      .About("Iterations of each experiment of --study")
      .Range(1, 1000000)
      .ShowDefault();
  AddOption(command, "--jobs N", options.jobs)
      .About("Experiments of --study at a time; 0: one per processor")
      .Range(0, 1024)
      .ShowDefault();
  AddFormatOption(command, &command->format);
  AddForceFlag(command, &command->force);
  AddQuietFlag(command, &command->quiet);
  MarkSeldom(command,
             {"--precision",
              "--training",
              "--full-weights",
              "--iterations",
              "--jobs"});
  SetFooter(
      command,
      netcg::NetcgErrata() +
          "\nExample: errmap netcg netcg.in --precision double --out results");
  command.Runs(RunNetcgCommand);
}

}  // namespace errmap::cli

namespace errmap::netcg {

cli::Slice AsSlice() {
  constexpr const char* kPurpose = "Laboratory";
  return {
      .commands = {{cli::AddConvertCommand, kPurpose, cli::AddCertifyCommand},
                   {cli::AddNetcgCommand, kPurpose, cli::AddCertifyCommand}}};
}

}  // namespace errmap::netcg
