#include "tests/fuzz/readers.h"

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "cli/command.h"
#include "cli/study_file/study_file.h"
#include "data/csv.h"
#include "data/dataset.h"
#include "data/input_error.h"
#include "data/pattern_file.h"
#include "models/model_file.h"
#include "models/netcg/run_file.h"
#include "models/netcg/weights_file.h"
#include "models/recipe_catalog.h"
#include "models/study/fit_record.h"
#include "models/study/study_record.h"
#include "stats/holdout.h"

namespace errmap::fuzz {
namespace {

// A property that does not hold ends the run as a crash does.
void Require(bool holds) {
  if (!holds) std::abort();
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
  models::ToJsonText(models::FromJsonText(bytes));
}

void ReadJournal(std::string_view bytes) {
  try {
    models::LabelFromText(bytes);
  } catch (const data::InputError&) {
  }
  models::FitFromText(bytes);
}

void ReadStudy(std::string_view bytes) {
  cli::ParseStudyFile(std::string(bytes), "study.toml", {});
}

void ReadNetcg(std::string_view bytes) {
  models::ParseRunFile(bytes, "netcg.in");
}

void ReadWeights(std::string_view bytes) {
  models::ParseWeights(bytes, "weights");
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

const std::vector<Reader>& Readers() {
  static const std::vector<Reader> readers = {
      {"csv", Refusable<ReadCsv>},
      {"patterns", Refusable<ReadPatterns>},
      {"holdout", Refusable<ReadHoldout>},
      {"spec", Refusable<ReadSpec>},
      {"model", Refusable<ReadModel>},
      {"results", Refusable<ReadResults>},
      {"journal", Refusable<ReadJournal>},
      {"study", Refusable<ReadStudy>},
      {"netcg", Refusable<ReadNetcg>},
      {"weights", Refusable<ReadWeights>},
  };
  return readers;
}

}  // namespace errmap::fuzz
