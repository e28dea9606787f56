#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "models/record.h"
#include "models/study/judgement/choice.h"
#include "models/study/judgement/confidence.h"
#include "models/study/judgement/holdout_comparison.h"

// The judgement: the models compared with each other on held-out rows.

namespace errmap::models {

struct WilcoxonRecord {
  double statistic = kNotKnown;
  double p = kNotKnown;
  bool exact = false;
};

struct MeanTestRecord {
  double statistic = kNotKnown;
  double df = kNotKnown;
  double p = kNotKnown;
};

/// Allows for memory between units that the data do not exclude
/// (ar1_t_test.h).
struct MemoryTestRecord {
  double statistic = kNotKnown;
  double df = kNotKnown;
  double p = kNotKnown;
  double p_holm = kNotKnown;
  double memory = kNotKnown;
};

struct PairTestsRecord {
  WilcoxonRecord wilcoxon;
  MemoryTestRecord memory_t;
  MeanTestRecord block_t;
  std::optional<MeanTestRecord> corrected_t;
  std::optional<MeanTestRecord> diebold_mariano;
};

/// Two models under one hold-out.
struct PairRecord {
  std::string a;
  std::string b;
  std::string holdout;
  double rmse_a = kNotKnown;
  double rmse_b = kNotKnown;
  double difference = kNotKnown;
  IntervalRecord ci95 = {kNotKnown, kNotKnown};  // of the difference
  double p = kNotKnown;
  double p_holm = kNotKnown;
  std::int64_t holm_pairs = 0;  // in Holm's adjustment; 1: its own turn
  std::string test;
  bool exact = false;
  double smallest_p = kNotKnown;
  std::string unit_of_analysis;
  std::int64_t units = 0;
  double lag1 = kNotKnown;
  double memory = kNotKnown;  // between units, which p and ci95 allow for
  bool correlated = false;
  bool established = false;
  Confidence confidence = Confidence::kNotShown;
  PairTestsRecord tests;
};

/// Share of wins over repeated splits of the groups.
struct StabilityRecord {
  std::string holdout;
  std::int64_t repeats = 0;
  std::vector<WinShare> wins;
};

struct VerdictRecord {
  std::string holdout;
  Choice choice = Choice::kBaseline;
  std::string model;
  std::optional<std::string> rival = {};
  std::optional<Confidence> against_rival = {};  // if the model is better
  std::optional<std::string> best_baseline = {};
  std::optional<Obstacle> obstacle = {};
  bool established = false;
  Confidence confidence = Confidence::kNotShown;
  std::string why = {};
};

// The effect of re-zeroing on the error with a map and without one.

struct RezeroedModelRecord {
  std::string model;
  double rmse = kNotKnown;
  double never = kNotKnown;  // the same rows without re-zeroing
};

/// See RezeroRule and RezeroWorth.
struct RezeroRecord {
  std::string rule;             // as given
  std::string when;             // "interval", "session", "probe"
  double interval = kNotKnown;  // s; only for "interval"
  double noise = kNotKnown;
  std::string holdout;
  std::int64_t probes = 0;
  std::int64_t scored_rows = 0;
  double no_map = kNotKnown;
  std::vector<RezeroedModelRecord> models = {};
};

}  // namespace errmap::models
