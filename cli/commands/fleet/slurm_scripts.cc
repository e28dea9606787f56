#include "cli/commands/fleet/slurm_scripts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace errmap::cli {
namespace {

std::string Quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

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

}  // namespace

std::string ShardsScript(const SlurmJob& job) {
  return fmt::format(
      "#!/bin/sh\n"
      "# Each task does one share of {1} components. A task that is begun "
      "again, by\n# Slurm or by hand, goes on where it was.\n"
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
      Quoted(job.program),
      job.plan.components,
      job.tasks - 1,
      job.cpus,
      TimeLimit(job),
      job.folder,
      Quoted(job.config),
      Quoted(job.store),
      job.tasks);
}

std::string MergeScript(const SlurmJob& job) {
  return fmt::format(
      "#!/bin/sh\n"
      "# Puts the shares together and says what is missing.\n"
      "#SBATCH --job-name=errmap-merge\n"
      "#SBATCH --ntasks=1\n"
      "#SBATCH --time=00:10:00\n"
      "#SBATCH --requeue\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --output=\"{}/%x-%j.log\"\n"
      "exec {} merge {}\n",
      job.folder,
      Quoted(job.program),
      Quoted(job.store));
}

std::string SubmitScript(const SlurmJob& job) {
  // afterany: a share that fails must not keep the others from being put
  // together (behind afterok the merge would wait for ever).
  return fmt::format(
      "#!/bin/sh\n"
      "set -eu\n"
      "# A node of which Slurm was not told how much memory it has (1 MB) "
      "refuses any\n# --mem: it is asked for where some node has so much.\n"
      "largest=$(sinfo -h -o %m 2>/dev/null | tr -d + | sort -n | tail -n 1)\n"
      "mem=\n"
      "if [ \"${{largest:-0}}\" -ge {1} ]; then mem=--mem={1}M; fi\n"
      "shards=$(sbatch --parsable $mem {0}/shards.sh)\n"
      "merge=$(sbatch --parsable --dependency=\"afterany:${{shards%%;*}}\" "
      "{0}/merge.sh)\n"
      "echo \"shares: job ${{shards%%;*}}, merge: job ${{merge%%;*}}\"\n",
      Quoted(job.folder),
      Mebibytes(job));
}

}  // namespace errmap::cli
