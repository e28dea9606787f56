#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/study/judgement/judgement.h"
#include "models/study/record/provenance_record.h"
#include "models/study/record/worth.h"
#include "models/study/rezero/rezeroed_study.h"
#include "models/study/study.h"

namespace errmap::models {

/// One component's study with all data for its outputs.
struct ComponentStudy {
  std::string name;                    // of the component
  std::vector<InputFileRecord> files;  // of the measurements, in order
  double goal = 0.0;                   // target's unit; NaN: none
  double indifference = 0.0;           // target's unit
  /// The rule for re-zeroing maps when they are judged; empty: none.
  std::optional<RezeroRule> rezero = {};
  Choose choose = Choose::kAuto;
  Prefer prefer = Prefer::kLeastError;
  data::PreparedDataset data;
  std::vector<Holdout> holdouts = {};
  StudyResult study = {};
  /// Index of the first of `num_added` baselines that were added to the
  /// requested models.
  std::size_t first_added = 0;
  std::size_t num_added = 0;
  Judgement judgement = {};
  std::optional<RezeroWorth> rezero_worth = {};
  // For the recommended map:
  std::optional<SessionWorth> session_worth = {};
  std::optional<SensorImportance> importance = {};
};

}  // namespace errmap::models
