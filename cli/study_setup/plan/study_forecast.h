#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "cli/study_setup/plan/study_plan.h"
#include "models/study/study.h"

namespace errmap::study_setup {

/// Estimates the remaining time of a study, and keeps the best map so far.
/// RoughFitSeconds gives the work of each fit. The model's finished fits show
/// the real time for that work. Before the first one, fits of similar work by
/// models of the same kind do. Fits kept from an earlier run count, too. Safe
/// to use from any thread.
class StudyForecast {
 public:
  StudyForecast(const StudyPlan& plan, int jobs);

  /// Records a finished fit. `component`: its index in the plan.
  void Note(std::size_t component, const models::FitProgress& fit);
  double SecondsLeft() const;
  struct Best {
    std::string map;      // "poly:eq8 1.90 um"; "" until one is finished
    std::string holdout;  // the last one that does not hold out neighbours
  };
  /// Returns the best map of the component that is being fitted.
  Best BestSoFar() const;

 private:
  struct Work {
    double rough = 0.0;    // rough seconds of the finished fits
    double seconds = 0.0;  // the time that they took
  };
  struct OfModel {
    std::string name;
    models::ModelKind kind = models::ModelKind::kPolynomial;
    double rough_all_rows = 0.0;
    std::vector<std::vector<double>> rough;  // by hold-out and fold
    double rough_left = 0.0;
    Work done;
  };
  struct OfComponent {
    std::vector<OfModel> models;
    std::size_t holdout = 0;  // the hold-out that decides the best so far
    std::string holdout_name;
    data::Unit unit;
  };

  // Seconds per rough second of a model's fits.
  double Rate(const OfModel& model) const;

  int jobs_;
  mutable std::mutex mutex_;  // guards all members below
  std::vector<OfComponent> components_;
  std::map<models::ModelKind, Work> of_kinds_;
  int fits_left_ = 0;
  std::size_t at_work_ = 0;
  Best best_;
  double best_rmse_ = 0.0;
};

/// Estimates the duration of a component's fits, in seconds, by counting the
/// operations of each kind of model. Good to a factor of about two.
double RoughSeconds(const models::ComponentPlan& component, int jobs);

/// Returns each model that suits the component, and the rough seconds of all
/// its fits, one after the other.
std::vector<std::pair<std::string, double>> RoughSecondsOfModels(
    const models::ComponentPlan& component);

/// Estimates the seconds of one fit to this many rows.
double RoughFitSeconds(const models::ModelRecipe& recipe,
                       const data::Dataset& dataset,
                       double rows);

/// The fastest models of a study, in the study's order. Together they take at
/// most a quarter of its time. `seconds` is the total time of their fits, run
/// one after the other.
struct FasterModels {
  std::vector<std::string> names;
  double seconds = 0.0;
};
FasterModels FasterModelsOf(const StudyPlan& plan);

/// Returns "2 s", "5 min", "3 h": a single digit, since the time is rough.
std::string RoughTimeText(double seconds);

}  // namespace errmap::study_setup
