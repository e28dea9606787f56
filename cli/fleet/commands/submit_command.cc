#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <spawn.h>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <sys/wait.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/fleet/commands/compare_fleet.h"
#include "cli/fleet/run/fleet_run.h"
#include "cli/report/shell_word.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "data/files/atomic_file.h"
#include "data/files/prepare_folder.h"
#include "data/text.h"

extern char** environ;

namespace errmap::cli {
namespace {

namespace fs = std::filesystem;

struct SubmitArguments {
  std::string scheduler;
  std::string config;
  std::string store;
  std::int64_t tasks = 0;
  int cpus = 1;
  bool now = false;
  bool force = false;
};

// A job array of Slurm's that does the shares of a fleet, and a job behind it
// that puts them together, each a shell script that people may read and change.
struct SlurmJob {
  std::string program;  // absolute, as all paths
  std::string config;
  std::string store;
  std::string folder;  // of the scripts and the logs
  std::int64_t tasks = 1;
  int cpus = 1;
  fleet::FleetPlan plan;
};

// hours:minutes:seconds. The estimate is good to a factor of three.
std::string TimeLimit(const SlurmJob& job) {
  constexpr double kMargin = 6.0;
  constexpr double kLeastSeconds = 600.0;
  constexpr double kMostSeconds = 7.0 * 24.0 * 3600.0;
  const double seconds = std::clamp(
      kMargin * job.plan.seconds / static_cast<double>(job.tasks * job.cpus),
      kLeastSeconds,
      kMostSeconds);
  const auto minutes = static_cast<long long>(std::ceil(seconds / 60.0));
  return fmt::format("{:02}:{:02}:00", minutes / 60, minutes % 60);
}

long long Mebibytes(const SlurmJob& job) {
  constexpr double kMargin = 2.0;
  constexpr double kStep = 256.0;
  const double least = std::max(job.plan.largest_mib, kStep);
  return std::llround(kStep * std::ceil(kMargin * least * job.cpus / kStep));
}

std::string ShardsScript(const SlurmJob& job) {
  return fmt::format(
      "#!/bin/sh\n"
      "# Each task does one share of {1} components. A task that is begun "
      "again, by\n# Slurm or by hand, continues where it stopped.\n"
      "#SBATCH --job-name=errmap\n"
      "#SBATCH --array=0-{2}\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --cpus-per-task={3}\n"
      "#SBATCH --time={4}\n"
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --output=\"{5}/%x-%A_%a.log\"\n"
      "exec {0} compare --config {6} --out {7} \\\n"
      "  --shard \"$SLURM_ARRAY_TASK_ID/{8}\" --jobs {3}\n",
      report::ShellQuoted(job.program),
      job.plan.components,
      job.tasks - 1,
      job.cpus,
      TimeLimit(job),
      job.folder,
      report::ShellQuoted(job.config),
      report::ShellQuoted(job.store),
      job.tasks);
}

std::string MergeScript(const SlurmJob& job) {
  return fmt::format(
      "#!/bin/sh\n"
      "# Joins the shares and says what is missing.\n"
      "#SBATCH --job-name=errmap-merge\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --time=00:10:00\n"
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --output=\"{}/%x-%j.log\"\n"
      "exec {} merge {}\n",
      job.folder,
      report::ShellQuoted(job.program),
      report::ShellQuoted(job.store));
}

std::string SubmitScript(const SlurmJob& job) {
  // afterany: a share that fails must not keep the others from being put
  // together (behind afterok the merge would wait for ever).
  return fmt::format(
      "#!/bin/sh\n"
      "set -eu\n"
      "# A node whose memory Slurm does not know (1 MB) refuses any --mem, so "
      "it is\n# requested only if some node has that much.\n"
      "largest=$(sinfo -h -o %m 2>/dev/null | tr -d + | sort -n | tail -n 1)\n"
      "mem=\n"
      "if [ \"${{largest:-0}}\" -ge {1} ]; then mem=--mem={1}M; fi\n"
      "shards=$(sbatch --parsable $mem {0}/shards.sh)\n"
      "merge=$(sbatch --parsable --dependency=\"afterany:${{shards%%;*}}\" "
      "{0}/merge.sh)\n"
      "echo \"shares: job ${{shards%%;*}}, merge: job ${{merge%%;*}}\"\n",
      report::ShellQuoted(job.folder),
      Mebibytes(job));
}

// Runs a shell script with our own standard streams; its exit status.
int RunScript(const std::string& path) {
  std::string shell = "sh";
  std::string word = path;
  char* const argv[] = {shell.data(), word.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, "sh", nullptr, nullptr, argv, environ);
  if (error != 0) {
    throw std::system_error(error, std::generic_category(), "cannot run sh");
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : kOtherFailure;
}

int RunSubmit(const SubmitArguments& arguments,
              const std::string& command_line) {
  const fleet::FleetStudy study = fleet::Expanded(
      fleet::WithPatterns(study_setup::ReadStudyFile(arguments.config)));
  const fleet::StorePaths store{arguments.store};
  ClaimStore(store, arguments.force);
  const std::string folder = (fs::absolute(arguments.store) / "slurm").string();
  const SlurmJob job{.program = fs::read_symlink("/proc/self/exe").string(),
                     .config = fs::absolute(arguments.config).string(),
                     .store = fs::absolute(arguments.store).string(),
                     .folder = folder,
                     .tasks = arguments.tasks,
                     .cpus = arguments.cpus,
                     .plan = fleet::PlanFleet(study.config)};
  fleet::WriteFleet(store, fleet::FleetOf(study, command_line));
  data::PrepareFolder(folder);
  data::WriteFileAtomically(folder + "/shards.sh", ShardsScript(job));
  data::WriteFileAtomically(folder + "/merge.sh", MergeScript(job));
  data::WriteFileAtomically(folder + "/submit.sh", SubmitScript(job));
  for (const std::string& line : job.plan.unusable) Warn("unusable: " + line);
  if (arguments.now) {
    return RunScript(folder + "/submit.sh") == 0 ? kDone : kOtherFailure;
  }
  PrintFitted(
      fmt::format("{0}/shards.sh, merge.sh and submit.sh are written; check "
                  "them, then run sh {0}/submit.sh\n",
                  data::PrintablePath(folder)));
  return kDone;
}

}  // namespace

void AddSubmitCommand(CLI::App* app, Run* run) {
  const Command<SubmitArguments> command(
      app, run, "submit", "Write scripts that run a fleet study on a cluster");
  AddOption(command, "SCHEDULER", command->scheduler)
      .About("slurm: a job array")
      .Required()
      .OneOf({"slurm"})
      .Value("NAME");
  AddOption(command, "--config FILE.toml", command->config)
      .About("Study file")
      .Required();
  AddOption(command, "--out DIR", command->store)
      .About("Store to fill")
      .Required();
  AddOption(command, "--tasks N", command->tasks)
      .About("Tasks of the array")
      .Required()
      .Range(1, 100000);
  AddOption(command, "--cpus N", command->cpus)
      .About("Processors of each task")
      .Range(1, 1024)
      .ShowDefault();
  AddFlag(command, "--now", command->now).About("Also submit them");
  AddForceFlag(command, &command->force);
  SetFooter(
      command,
      "Writes three scripts into DIR/slurm. shards.sh is a job array, "
      "merge.sh runs after it even if tasks failed, and submit.sh submits "
      "both. Time and memory are those of a dry run, with margins. Memory is "
      "requested only if a node reports that it has that much.\nExit status: 0 "
      "done, 1 sbatch refused, 3 unusable study file.\nExample: errmap submit "
      "slurm --config fleet.toml --out fleet --tasks 64 --cpus 4");
  command.Runs(RunSubmit);
}

}  // namespace errmap::cli
