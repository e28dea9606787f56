#include <string>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/number_text.h"
#include "cli/shell/command_options.h"
#include "data/files/atomic_file.h"
#include "data/formats/pattern_file.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

struct ConvertArguments {
  std::string in;
  std::string out;
  bool quiet = false;
};

int RunConvert(const ConvertArguments& arguments) {
  CheckOutputName("OUT", arguments.out, {arguments.in});
  const data::PatternTable table = data::ReadPatterns(arguments.in);
  data::WriteFileAtomically(
      arguments.out,
      data::PatternText(table, data::PatternFormOf(arguments.out)));
  if (!arguments.quiet) {
    Warn(fmt::format("{} of {} and {} in {}",
                     report::Count(table.input_values.rows(), "pattern"),
                     report::Count(table.input_values.cols(), "input"),
                     report::Count(table.target_values.cols(), "target"),
                     data::PrintablePath(arguments.out)));
  }
  return kDone;
}

}  // namespace

void AddConvertCommand(CLI::App* app, Run* run) {
  const Command<ConvertArguments> command(
      app,
      run,
      "convert",
      "Convert between the report's pattern files, tables and CSV");
  AddOption(command, "IN FILE", command->in).About("File to read").Required();
  AddOption(command, "OUT FILE", command->out)
      .About(
          "File to write; its ending decides: .csv, .tab (plain table), any "
          "other for the stacked form of the report (Table 2)")
      .Required();
  AddQuietFlag(command, &command->quiet);
  SetFooter(
      command,
      R"(In a CSV file of another program, the column error* is the target. Inputs
are the position and the other numeric columns, including dead ones.
Example: errmap convert data/sets/turning_centre/six_days.csv six.pat)");
  command.Runs(RunConvert);
}

}  // namespace errmap::cli
