#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "models/learning/learning_curve.h"
#include "models/learning/next_states.h"
#include "models/learning/sensor_curve.h"
#include "models/study/record/study_record.h"

// The results of errmap learn as plain data, schema errmap-learn-1: each member
// is a key. Lengths are in the target's unit; NaN stands for a missing value.

namespace errmap::models {

struct LearningPointRecord {
  std::int64_t units = 0;  // number learnt from
  double rmse = kNotKnown;
  double low = kNotKnown;  // 90 %
  double high = kNotKnown;
};

/// Quantiles at 5, 50 and 95 %; NaN stands for infinity.
using QuantilesRecord = std::array<double, 3>;

struct LearningLawRecord {
  QuantilesRecord exponent = {kNotKnown, kNotKnown, kNotKnown};
  QuantilesRecord floor = {kNotKnown, kNotKnown, kNotKnown};
  QuantilesRecord at_all_units = {kNotKnown, kNotKnown, kNotKnown};
  QuantilesRecord at_twice_the_units = {kNotKnown, kNotKnown, kNotKnown};
  std::optional<QuantilesRecord> units_for_goal;  // if there is a goal
  double never_reaches_goal = kNotKnown;
};

struct LearningModelRecord {
  std::string model;
  std::optional<std::string> why_failed;
  std::vector<LearningPointRecord> points;
  std::optional<LearningLawRecord> law;
};

struct LearningCurvesRecord {
  std::string unit;  // of learning: "day", "cycle"
  std::int64_t units = 0;
  double goal = kNotKnown;
  std::vector<LearningModelRecord> models;
};

struct LearningSourceRecord {
  std::vector<InputFileRecord> inputs;
};

inline constexpr std::string_view kLearningSchema = "errmap-learn-1";

/// The values of LearningRecord::by: curves over units, or over sensors.
inline constexpr std::array<std::string_view, 3> kLearntBy = {
    "sessions", "cycles", "sensors"};

struct LearningRecord {
  std::string schema = std::string(kLearningSchema);
  std::string file;
  std::string target;
  std::string unit;
  std::optional<std::string> by;  // one of kLearntBy
  std::optional<LearningCurvesRecord> curves;
  std::optional<SensorCurve> sensors;
  std::optional<std::vector<NextState>> next;
  /// Only the parts that readers need are read.
  LeftOut<LearningSourceRecord> provenance;
};

/// `goal` is in the target's unit; NaN: none.
LearningCurvesRecord MakeRecord(const LearningPlan& plan,
                                const std::vector<LearningCurve>& curves,
                                double goal);

/// Reads a file of errmap learn. Throws data::InputError if the text is not
/// JSON or of another schema.
LearningRecord LearningFromJsonText(std::string_view text);

}  // namespace errmap::models
