#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "cli/desk/plan/study_plan.h"
#include "models/study/study.h"

namespace errmap::desk {

/// How long a study will still take, learnt from its fits, and the best map so
/// far. A fit's share of the work is RoughFitSeconds of its kind and rows; what
/// that really takes is learnt of each model; where there is none of it yet, of
/// models of its kind, as far as these were as much work. Fits of an earlier
/// run teach as those of this one do. Safe to use from any thread.
class StudyForecast {
 public:
  StudyForecast(const StudyPlan& plan, int jobs);

  /// `component`: which of the plan.
  void Note(std::size_t component, const models::FitProgress& fit);
  double SecondsLeft() const;
  struct Best {
    std::string map;      // "poly:eq8 1.90 um"; "" before the first is through
    std::string holdout;  // the last that does not judge among neighbours
  };
  /// Of the component at work.
  Best BestSoFar() const;

 private:
  struct Work {
    double rough = 0.0;    // of what is done
    double seconds = 0.0;  // that it took
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
    std::size_t holdout = 0;  // by which the best so far is called so
    std::string holdout_name;
    data::Unit unit;
  };

  // Seconds per rough second of a model's fits.
  double Rate(const OfModel& model) const;

  int jobs_;
  mutable std::mutex mutex_;  // of all that follows
  std::vector<OfComponent> components_;
  std::map<models::ModelKind, Work> of_kinds_;
  int fits_left_ = 0;
  std::size_t at_work_ = 0;
  Best best_;
  double best_rmse_ = 0.0;
};

}  // namespace errmap::desk
