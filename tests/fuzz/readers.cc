#include "tests/fuzz/readers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "cli/command.h"
#include "cli/machine/machine_file.h"
#include "cli/netcg/netcg_files.h"
#include "cli/netcg/run_file.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/report.h"
#include "cli/study_setup/toml/study_file.h"
#include "data/column_header.h"
#include "data/csv.h"
#include "data/formats/pattern_file.h"
#include "data/input_error.h"
#include "data/measurements/clock/date_time.h"
#include "data/measurements/dataset.h"
#include "data/sha256.h"
#include "models/model_file.h"
#include "models/recipe_catalog.h"
#include "models/study/given_predictions.h"
#include "models/study/journal/fit_record.h"
#include "models/study/journal/kept_fits.h"
#include "models/study/record/study_record.h"
#include "models/study/split_file.h"
#include "stats/holdout.h"
#include "tests/fuzz/scratch_folder.h"

namespace errmap::fuzz {
namespace {

// 12 rows in 4 groups, as files that go with the data are judged by.
data::Dataset TwelveRows() {
  constexpr Eigen::Index kRows = 12;
  data::Dataset::Parts parts;
  parts.source = "d.csv";
  parts.inputs = {{"position_mm", data::UnitOfColumn("position_mm")}};
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  parts.input_values = Eigen::VectorXd::LinSpaced(kRows, 0.0, 11.0);
  parts.target_values = Eigen::VectorXd::LinSpaced(kRows, 0.0, 1.0);
  parts.groups = {"cycle", {"1", "2", "3", "4"}, {}};
  for (Eigen::Index row = 0; row < kRows; ++row) {
    parts.groups.codes.push_back(row / 3);
  }
  return data::Dataset(std::move(parts));
}

void ReadCsv(std::string_view bytes) {
  const data::CsvTable table = data::ParseCsv(std::string(bytes), "f.csv");
  for (const data::CsvColumn& column : table.columns) {
    Require(column.values.size() == table.columns.front().values.size());
  }
  data::MakeDataset(table, {});
}

void ReadPatterns(std::string_view bytes) {
  for (const char* name : {"f.dat", "f.tab", "f.csv"}) {
    try {
      data::ParsePatterns(bytes, name);
    } catch (const data::InputError&) {
    }
  }
}

void ReadSplit(std::string_view bytes) {
  static const data::Dataset dataset = TwelveRows();
  const std::vector<models::Holdout> holdouts = models::ReadSplitFile(
      data::ParseCsv(std::string(bytes), "s.csv"), dataset);
  // What was read is written, and says the same.
  const std::string text = models::SplitFileText(holdouts, dataset);
  Require(models::SplitFileText(
              models::ReadSplitFile(data::ParseCsv(text, "s.csv"), dataset),
              dataset) == text);
}

void ReadPredictions(std::string_view bytes) {
  static const data::Dataset dataset = TwelveRows();
  static const std::vector<models::Holdout> holdouts = [] {
    std::vector<models::Holdout> made;
    for (const char* spec : {"every:3", "groups:2"}) {
      made.push_back(
          models::MakeHoldout(stats::ParseHoldout(spec), dataset, 1));
    }
    return made;
  }();
  const models::GivenPredictions given = models::ReadGivenPredictions(
      "elsewhere", data::ParseCsv(std::string(bytes), "p.csv"));
  const models::ModelResult judged =
      models::JudgeGivenPredictions(given, dataset, holdouts);
  Require(judged.holdouts.size() == holdouts.size());
}

void ReadMachine(std::string_view bytes) {
  static const ScratchFolder folder;
  machine::ReadMachineOutline(folder.Write("machine.toml", bytes));
}

void ReadFileList(std::string_view bytes) {
  static const ScratchFolder folder;
  folder.Write(cli::ClaimedFolder::kListName, bytes);
  folder.Write("results.json", "{}");
  cli::ClaimedFolder(folder.path(), {"results.json"}, {}, false);
}

void ReadHeaders(std::string_view bytes) {
  const data::Header header = data::ReadHeader(bytes);
  Require(header.base.size() <= bytes.size());
  data::StemOfColumn(bytes);
  data::NamesPosition(bytes);
  const auto time = data::ParseDateTime(bytes);
  Require(!time || std::isfinite(time->seconds));
}

void ReadHoldout(std::string_view bytes) {
  const stats::HoldoutSpec spec = stats::ParseHoldout(bytes);
  if (spec.kind == stats::HoldoutKind::kFile) return;
  constexpr Eigen::Index kRows = 12;
  const std::vector<Eigen::Index> codes = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3};
  for (const stats::Fold& fold : stats::MakeFolds(spec, kRows, codes, 1)) {
    for (const Eigen::Index row : fold.test) Require(row >= 0 && row < kRows);
  }
}

void ReadSpec(std::string_view bytes) {
  if (bytes.starts_with("file:")) return;  // of a reader of its own
  Require(models::MakeRecipe(bytes)->name() == bytes);
}

void ReadModel(std::string_view bytes) {
  const models::FittedModel fitted =
      models::ModelFromJson(std::string(bytes), "m.json");
  // What was read is written and read again to the same bytes.
  const std::string text = models::ModelToJson(fitted, {});
  Require(models::ModelToJson(models::ModelFromJson(text, "m.json"), {}) ==
          text);
}

void ReadResults(std::string_view bytes) {
  const models::StudyRecord record = models::FromJsonText(bytes);
  models::ToJsonText(record);
  report::ReportHtml(record);
  report::ReportMarkdown(record);
  report::ScreenText(record);
  report::TableText(record, "csv");
}

// Sums are public, so a forger writes them.
void ReadKeptFit(std::string_view bytes) {
  data::Sha256Stream stream;
  stream.Add("key");
  stream.Add(bytes);
  models::FitFromBytes("key", stream.Finish() + std::string(bytes));
}

void ReadStudy(std::string_view bytes) {
  study_setup::ParseStudyFile(std::string(bytes), "study.toml", {});
}

void ReadNetcg(std::string_view bytes) {
  netcg::ParseRunFile(bytes, "netcg.in");
}

void ReadWeights(std::string_view bytes) {
  netcg::ParseWeights(bytes, "weights");
}

// What a reader may refuse a text by.
template <void (*kRead)(std::string_view)>
void Refusable(std::string_view bytes) {
  try {
    kRead(bytes);
  } catch (const data::InputError&) {
  } catch (const cli::UsageError&) {
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

void Require(bool holds) {
  if (!holds) std::abort();
}

const std::vector<Reader>& Readers() {
  static const std::vector<Reader> readers = {
      {"csv", Refusable<ReadCsv>},
      {"patterns", Refusable<ReadPatterns>},
      {"holdout", Refusable<ReadHoldout>},
      {"spec", Refusable<ReadSpec>},
      {"model", Refusable<ReadModel>},
      {"results", Refusable<ReadResults>},
      {"journal", Refusable<ReadKeptFit>},
      {"study", Refusable<ReadStudy>},
      {"netcg", Refusable<ReadNetcg>},
      {"weights", Refusable<ReadWeights>},
      {"split", Refusable<ReadSplit>},
      {"predictions", Refusable<ReadPredictions>},
      {"machine", Refusable<ReadMachine>},
      {"file_list", Refusable<ReadFileList>},
      {"header", Refusable<ReadHeaders>},
      {"arguments", RunWithArguments},
      {"compare", CompareSmallModels},
  };
  return readers;
}

}  // namespace errmap::fuzz
