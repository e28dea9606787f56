#include "models/learning/learning_record.h"

#include <cmath>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "models/record_json.h"

namespace errmap::models {
namespace {

QuantilesRecord QuantilesOf(const PowerLaw::Quantiles& quantiles) {
  QuantilesRecord record = {quantiles.low, quantiles.median, quantiles.high};
  for (double& value : record) {
    if (!std::isfinite(value)) value = kNotKnown;
  }
  return record;
}

LearningLawRecord LawOf(const PowerLaw& law, double units, double goal) {
  LearningLawRecord record{
      .exponent = QuantilesOf(law.Exponent()),
      .floor = QuantilesOf(law.Floor()),
      .at_all_units = QuantilesOf(law.ErrorAt(units)),
      .at_twice_the_units = QuantilesOf(law.ErrorAt(2.0 * units)),
      .units_for_goal = {}};
  if (std::isfinite(goal)) {
    record.units_for_goal = QuantilesOf(law.UnitsFor(goal));
    record.never_reaches_goal = law.NeverReaches(goal);
  }
  return record;
}

}  // namespace

LearningCurvesRecord MakeRecord(const LearningPlan& plan,
                                const std::vector<LearningCurve>& curves,
                                double goal) {
  LearningCurvesRecord record{
      .unit = plan.unit, .units = plan.num_units, .goal = goal, .models = {}};
  for (const LearningCurve& curve : curves) {
    LearningModelRecord& model = record.models.emplace_back();
    model.model = curve.model;
    if (!curve.why_failed.empty()) model.why_failed = curve.why_failed;
    for (const LearningCurve::Point& point : curve.points) {
      model.points.push_back({point.size, point.rmse, point.low, point.high});
    }
    if (curve.law) {
      model.law = LawOf(*curve.law, static_cast<double>(plan.num_units), goal);
    }
  }
  return record;
}

LearningRecord LearningFromJsonText(std::string_view text) {
  return RecordFromText<LearningRecord>(
      text,
      kLearningSchema,
      fmt::format("errmap learn with {} rewrites it",
                  data::ArgumentName("out")));
}

}  // namespace errmap::models
