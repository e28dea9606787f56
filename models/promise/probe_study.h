#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/study/record/study_record.h"
#include "models/study/study.h"

namespace errmap::models {

/// What probes of a session would make of maps on the sessions held out: each
/// is moved by the offset that its first probes show (session_offset.h), the
/// gain taken from the other sessions alone.
struct ProbeStudy {
  struct Row {
    std::string model;
    std::vector<double> rmse;  // as `numbers`, target's unit
  };
  std::string holdout;
  std::string unit;                   // "day"
  double spacing = 0.0;               // of the probes, s; or in rows
  std::string time_unit;              // of spacing: "s" or "rows"
  std::vector<Eigen::Index> numbers;  // of probes per session
  Eigen::Index scored_rows = 0;
  std::vector<Row> rows;
};

/// Of the models that were judged under `holdout`, which holds whole units
/// out. Probes are a session's rows at `spacing` from its first on. The rows
/// that the largest number takes are left out of the score for every number;
/// `zero` among the models tells what probes do without a map. Throws
/// std::invalid_argument on no numbers, a spacing that is not above 0, rows
/// without sessions, or where no row is left to score.
ProbeStudy StudyProbes(const data::Dataset& dataset,
                       const Holdout& holdout,
                       std::size_t holdout_index,
                       const StudyResult& study,
                       std::vector<Eigen::Index> numbers,
                       double spacing);

ProbesRecord MakeRecord(const ProbeStudy& study);

}  // namespace errmap::models
