#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace errmap::cli {

/// Exit statuses that scripts depend on.
enum ExitStatus : int {
  kDone = 0,
  kOtherFailure = 1,
  kWrongCommandLine = 2,
  kUnusableInput = 3,
  kEveryFitFailed = 4,
  kNothingJudged = 5,
  kInterrupted = 130,
};

/// The command line is wrong; what() has the fault and the remedy.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One run of the program.
struct Run {
  /// The command line without options that do not change results (--jobs,
  /// --out, -o, --output, --format, --shard, --quiet, --all, --details,
  /// --resume, --no-cache, --force, --keep-paths), quoted for a shell: for
  /// provenance.
  std::string command_line;
  int status = kDone;
};

using AddCommandTo = void (*)(CLI::App* app, Run* run);

/// Each function adds its command to `app`. When chosen, the command runs and
/// leaves its exit status in `run`, which must outlive the parse.
void AddCompareCommand(CLI::App* app, Run* run);
void AddInitCommand(CLI::App* app, Run* run);
void AddReadCommand(CLI::App* app, Run* run);
void AddLearnCommand(CLI::App* app, Run* run);
void AddFitCommand(CLI::App* app, Run* run);
void AddPredictCommand(CLI::App* app, Run* run);
void AddEvaluateCommand(CLI::App* app, Run* run);
void AddResidualsCommand(CLI::App* app, Run* run);
void AddReportCommand(CLI::App* app, Run* run);
void AddCertifyCommand(CLI::App* app, Run* run);
void AddCheckCommand(CLI::App* app, Run* run);
void AddWhenCommand(CLI::App* app, Run* run);
void AddExportCommand(CLI::App* app, Run* run);
void AddCostCommand(CLI::App* app, Run* run);
void AddUpdateCommand(CLI::App* app, Run* run);
void AddModelsCommand(CLI::App* app, Run* run);

/// Runs the command line and returns the exit status: 0 done, 2 the command
/// line is wrong, 3 the input is unusable, 4 every fit failed, 5 not judged
/// or in doubt, 130 interrupted, 1 anything else. Errors are one line on
/// stderr.
int RunApplication(int argc, char** argv);

/// Runs a command within another program that holds a HostedRun: `words` are
/// the command and its arguments.
int RunHosted(std::vector<std::string> words);

}  // namespace errmap::cli
