#include "cli/fleet/commands/launcher.h"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "cli/command.h"
#include "data/text.h"

namespace errmap::cli {
namespace {

constexpr std::int64_t kMostShares = 1000000;

std::optional<std::int64_t> Whole(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return number;
}

bool IsShare(const fleet::Share& share) {
  return share.count >= 1 && share.count <= kMostShares && share.index >= 0 &&
         share.index < share.count;
}

class Launcher {
 public:
  explicit Launcher(const Environment& environment)
      : environment_(environment) {}

  fleet::Share Find() const {
    for (const auto& [rank, size] :
         {std::pair("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"),
          std::pair("PMI_RANK", "PMI_SIZE")}) {
      if (IsSet(rank)) return Checked(rank, Get(rank), Get(size));
    }
    if (IsSet("SLURM_PROCID") && IsSet("SLURM_NTASKS") &&
        Get("SLURM_NTASKS") > 1) {
      return Checked("SLURM_PROCID", Get("SLURM_PROCID"), Get("SLURM_NTASKS"));
    }
    if (IsSet("SLURM_ARRAY_TASK_ID")) return FromArray();
    throw UsageError(
        "--shard env: no launcher's variables are set (OMPI_COMM_WORLD_RANK, "
        "PMI_RANK, SLURM_PROCID, SLURM_ARRAY_TASK_ID); write --shard I/N");
  }

 private:
  bool IsSet(const char* name) const { return environment_(name) != nullptr; }

  std::int64_t Get(const char* name) const {
    const char* const text = environment_(name);
    const auto number = text == nullptr ? std::nullopt : Whole(text);
    if (number) return *number;
    throw UsageError(
        fmt::format("--shard env: {} is {}, no whole number; write --shard I/N",
                    name,
                    text == nullptr ? "not set" : data::QuotedText(text)));
  }

  static fleet::Share Checked(const char* name,
                              std::int64_t index,
                              std::int64_t count) {
    const fleet::Share share{.index = index, .count = count};
    if (IsShare(share)) return share;
    throw UsageError(fmt::format(
        "--shard env: {} {} of {} is not a share; write --shard I/N",
        name,
        index,
        count));
  }

  fleet::Share FromArray() const {
    const std::int64_t first = Get("SLURM_ARRAY_TASK_MIN");
    const std::int64_t last = Get("SLURM_ARRAY_TASK_MAX");
    const std::int64_t count = Get("SLURM_ARRAY_TASK_COUNT");
    const std::int64_t step =
        IsSet("SLURM_ARRAY_TASK_STEP") ? Get("SLURM_ARRAY_TASK_STEP") : 1;
    if (step < 1 || (last - first) / step + 1 != count) {
      throw UsageError(fmt::format(
          "--shard env: this job array has {} of the tasks {} to {}: shares "
          "would be left out; write --shard $SLURM_ARRAY_TASK_ID/N with N of "
          "the whole array",
          count,
          first,
          last));
    }
    return Checked("SLURM_ARRAY_TASK_ID",
                   (Get("SLURM_ARRAY_TASK_ID") - first) / step,
                   count);
  }

  const Environment& environment_;
};

}  // namespace

fleet::Share ShareOf(const std::string& text, const Environment& environment) {
  if (text == "env") return Launcher(environment).Find();
  const std::size_t slash = text.find('/');
  if (slash != text.npos) {
    const auto index = Whole(std::string_view(text).substr(0, slash));
    const auto count = Whole(std::string_view(text).substr(slash + 1));
    if (index && count) {
      const fleet::Share share{.index = *index, .count = *count};
      if (IsShare(share)) return share;
    }
  }
  throw UsageError(
      fmt::format("--shard {}: give I/N, I from 0 to N - 1, or env",
                  data::QuotedText(text)));
}

}  // namespace errmap::cli
