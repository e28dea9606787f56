#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/study/judgement/judgement.h"
#include "models/study/record/provenance_record.h"
#include "models/study/record/recommendation_record.h"
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

/// Refits `recipe` to the training rows of every fold of `holdout` without one
/// of their sessions (a different one in each fold). Compares its error on the
/// fold's test rows with that in `result`. Needs 4 to 50 whole sessions held
/// out (with more, another one is not worth a fit). Returns nothing otherwise,
/// or if a fit fails. Fits run on options.jobs threads, without effect on the
/// result.
std::optional<SessionWorth> WorthOfASession(const data::Dataset& dataset,
                                            const Holdout& holdout,
                                            const ModelRecipe& recipe,
                                            const HoldoutResult& result,
                                            const StudyOptions& options);

/// Removes the sensors of `fitted` (the map of all rows) from the folds' maps
/// in `result`. A linear regression on the fold's training rows replaces a
/// sensor's reading by its estimate from the map's other inputs. Nothing is
/// refitted, so a map fitted without the sensor may do better. Uses every n-th
/// held-out row if all would take more than some seconds. Returns nothing for a
/// map without sensors, results without maps, readings whose squares overflow,
/// too long a log for a map with a memory, or if `stop` is set.
std::optional<SensorImportance> ImportanceOfSensors(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const HoldoutResult& result,
    const FittedModel& fitted,
    const std::atomic<bool>* stop);

}  // namespace errmap::models
