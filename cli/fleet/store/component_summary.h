#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "models/record.h"
#include "models/study/record/study_record.h"

// What a fleet keeps of one component's study: a file of at most 20 kB, schema
// errmap-summary-1, which alone is read when results are put together. Lengths
// are in the data file's own unit; NaN stands for what there is not.

namespace errmap::fleet {

using models::ByName;
using models::Choice;
using models::ComponentRecord;
using models::Confidence;
using models::DisplayRecord;
using models::GoalStanding;
using models::IntervalRecord;
using models::kNotKnown;
using models::LeftOut;
using models::ModelKind;
using models::ModelStatus;
using models::PromiseLevelRecord;

inline constexpr std::size_t kLongestSummary = 20000;

struct SummaryHoldoutRecord {
  std::string name;
  std::int64_t folds = 0;
  std::string unit_of_analysis;
  std::int64_t units = 0;
};

/// A model's results under one hold-out.
struct SummaryMetricsRecord {
  std::string holdout;
  std::int64_t n = 0;
  double rmse = kNotKnown;
  double sd = kNotKnown;
  double mean = kNotKnown;
  double mae = kNotKnown;
  double range = kNotKnown;
  double train_rmse = kNotKnown;
  IntervalRecord ci95 = {kNotKnown, kNotKnown};
  std::int64_t tier = 0;
  GoalStanding goal = GoalStanding::kNotJudged;
};

struct SummaryModelRecord {
  std::string name;
  ModelKind kind = ModelKind::kPolynomial;
  Choice choice = Choice::kGiven;
  ModelStatus status = ModelStatus::kFailed;
  LeftOut<std::string> why;
  LeftOut<std::int64_t> parameters;
  double fit_seconds = kNotKnown;  // of the fit to all rows
  std::vector<SummaryMetricsRecord> results;
};

struct SummaryVerdictRecord {
  std::string holdout;
  Choice choice = Choice::kBaseline;
  std::string model;
  bool established = false;
  Confidence confidence = Confidence::kNotShown;
};

struct SummaryRecommendationRecord {
  Choice choice = Choice::kBaseline;
  std::string model;
  std::string holdout;
  double rmse = kNotKnown;
  IntervalRecord ci95 = {kNotKnown, kNotKnown};
  double uncompensated = kNotKnown;  // RMSE there with no map
  double constant = kNotKnown;       // with the best constant
  GoalStanding goal = GoalStanding::kNotJudged;
  bool established = false;  // that it is better than the best baseline
  std::vector<std::string> sensors;
  LeftOut<double> longest_memory;  // of a map that remembers; its time unit
  LeftOut<bool> zeroed;            // likewise, at a session's start
  std::vector<PromiseLevelRecord> promise;
  double extrapolated_share = kNotKnown;
  std::string sentence;
};

/// The model file of the recommended map.
struct SummaryMapRecord {
  std::string sha256;
  std::int64_t bytes = 0;
};

struct ComponentSummary {
  std::string schema = "errmap-summary-1";
  std::string version;
  std::string name;
  ByName<std::string> fields;  // of its path
  /// Hash of the settings, and hash of the settings with all files that were
  /// read. If both are unchanged, the results are still valid.
  std::string asked;
  std::string key;
  ModelStatus status = ModelStatus::kFailed;
  LeftOut<std::string> why;  // it failed
  /// Names of the two components, one per direction of motion, if it was
  /// studied as two. Their summaries then have the data below.
  LeftOut<std::vector<std::string>> ways;
  std::string file;
  std::string sha256;
  std::int64_t rows = 0;
  std::int64_t sessions = 0;
  std::string target;
  std::string unit;
  DisplayRecord display;
  double goal = kNotKnown;
  double fits_seconds = kNotKnown;  // of all fits together
  std::vector<SummaryHoldoutRecord> holdouts;
  std::vector<SummaryModelRecord> models;
  std::int64_t models_left_out = 0;  // no room was left for them
  std::vector<SummaryVerdictRecord> verdicts;
  LeftOut<SummaryRecommendationRecord> recommendation;
  LeftOut<SummaryMapRecord> map;
};

/// Summarises a component that was studied. The caller adds names, hashes and
/// the map.
ComponentSummary Summarise(const ComponentRecord& component);

/// Returns one line of JSON of at most kLongestSummary bytes. If there are too
/// many models, those furthest from the recommended one are left out.
std::string ToJsonText(ComponentSummary summary);

/// Reads what ToJsonText wrote. Throws data::InputError if the text is not JSON
/// or has another schema.
ComponentSummary SummaryFromJsonText(std::string_view text);

}  // namespace errmap::fleet
