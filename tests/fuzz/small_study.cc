#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "cli/report/documents/study_table.h"
#include "cli/study_setup/plan/study_plan.h"
#include "cli/study_setup/plan/study_run.h"
#include "data/csv.h"
#include "data/input_error.h"
#include "models/study/record/study_record.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/scratch_folder.h"

namespace errmap::fuzz {
namespace {

// Takes numbers off the front of bytes; zeros where there are none left.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}

  bool AtEnd() const { return bytes_.empty(); }

  std::uint64_t Take(std::size_t count) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count && !bytes_.empty(); ++i) {
      value = value << 8U | static_cast<unsigned char>(bytes_[0]);
      bytes_.remove_prefix(1);
    }
    return value;
  }

  // From `least` on, `count` of them.
  int Choose(int least, int count) {
    return least + static_cast<int>(Take(1)) % count;
  }

 private:
  std::string_view bytes_;
};

// Cells by row and column.
using Cells = std::vector<std::vector<double>>;

Cells Noise(int groups, int per_group, int sensors, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] {
    return static_cast<double>(random() >> 11U) * 0x1p-53 - 0.5;
  };
  Cells cells;
  for (int row = 0; row < groups * per_group; ++row) {
    auto& line = cells.emplace_back();
    line = {static_cast<double>(row / per_group),
            static_cast<double>(row % per_group)};
    for (int sensor = 0; sensor < sensors; ++sensor) {
      line.push_back(20.0 + uniform());
    }
    line.push_back(1e-3 * (uniform() + uniform() + uniform()));
  }
  return cells;
}

// A number that the bytes choose: of any bits, or one of those that trouble.
double ChosenNumber(Bytes* bytes) {
  static const std::vector<double> odd = {
      0.0, -0.0, 1.0, 1e300, -1e300, 1e-300, 5e-324, 1e160, 1e15, 0.1};
  const auto choice = static_cast<std::size_t>(bytes->Take(1));
  if (choice < odd.size()) return odd[choice];
  const auto value = std::bit_cast<double>(bytes->Take(8));
  return std::isfinite(value) ? value : 0.0;
}

std::string CsvText(const Cells& cells, int sensors) {
  std::string text = "cycle,position_mm,";
  for (int i = 0; i < sensors; ++i) {
    text += "t" + std::to_string(i) + "_degC,";
  }
  text += "error_mm\n";
  for (const auto& line : cells) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      text += (i == 0 ? "" : ",") + data::CsvNumber(line[i]);
    }
    text += '\n';
  }
  return text;
}

void Judge(const std::string& file, bool is_noise) {
  static const std::vector<std::string> models = {
      "mean",
      "poly:position",
      "poly:eq8",
      "poly:stepwise:degree=2",
      "poly:ridge:degree=2",
      "net:scg:hidden=2:iterations=5:wfactor=1e-3"};
  study_setup::StudyConfig config;
  config.holdouts = {"every:3", "groups:3", "leave-one-group-out"};
  config.models = models;
  config.components.emplace_back().data = file;
  const study_setup::StudyRun run =
      study_setup::RunPlan(study_setup::PlanStudy(config));
  const models::StudyRecord record = study_setup::RecordOf(run);
  const std::string text = models::ToJsonText(record);
  Require(models::ToJsonText(models::FromJsonText(text)) == text);
  Require(!report::StudyTable(record, {}).text.empty());
  if (!is_noise) return;
  const models::ComponentStudy& comparison = run.components.at(0);
  for (std::size_t h = 0; h < comparison.holdouts.size(); ++h) {
    const auto& verdict = comparison.judgement.verdicts[h];
    if (!comparison.holdouts[h].whole_groups || !verdict ||
        !verdict->established()) {
      continue;
    }
    Require(verdict->choice == models::Choice::kBaseline ||
            verdict->choice == models::Choice::kNoPracticalDifference);
  }
}

}  // namespace

void CompareSmallModels(std::string_view text) {
  Bytes bytes(text);
  const std::uint64_t seed = bytes.Take(4);
  // Fewer than twelve cannot be told from one session.
  const int groups = bytes.Choose(3, 8);
  const int per_group = bytes.Choose(4, 5);
  const int sensors = bytes.Choose(0, 3);
  Cells cells = Noise(groups, per_group, sensors, seed);
  const bool is_noise = bytes.AtEnd();
  while (!bytes.AtEnd()) {
    auto& line = cells[static_cast<std::size_t>(bytes.Take(1)) % cells.size()];
    line[static_cast<std::size_t>(bytes.Take(1)) % line.size()] =
        ChosenNumber(&bytes);
  }
  static const ScratchFolder folder;
  try {
    Judge(folder.Write("d.csv", CsvText(cells, sensors)), is_noise);
  } catch (const data::InputError&) {
  } catch (const cli::UsageError&) {
  }
}

}  // namespace errmap::fuzz
