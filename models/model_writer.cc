#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "models/history/history.h"
#include "models/map_experience.h"
#include "models/model_file.h"
#include "models/model_json.h"
#include "models/version.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Json = ModelJson;

Json ToJson(const History& history) {
  Json derived = Json::array();
  for (const DerivedInput& input : history.derived) {
    Json entry = {{"name", input.column.name},
                  {"unit", input.column.unit.symbol},
                  {"of", input.of},
                  {"filter", ToString(input.filter)}};
    if (input.filter == Filter::kEma) {
      entry["tau"] = input.tau;
      entry["between"] = ToString(input.between);
    }
    derived.push_back(std::move(entry));
  }
  Json row_changes = Json::array();
  for (const RowChange& change : history.row_changes) {
    row_changes.push_back({{"column", change.column},
                           {"largest", change.largest},
                           {"mean", change.mean}});
  }
  return {{"time_unit", history.time_unit},
          {"session", history.session},
          {"latest_start",
           std::isfinite(history.latest_start) ? Json(history.latest_start)
                                               : Json()},
          {"row_changes", std::move(row_changes)},
          {"longest_step",
           std::isfinite(history.longest_step) ? Json(history.longest_step)
                                               : Json()},
          {"derived", std::move(derived)},
          {"form_inputs", history.form_inputs}};
}

Json ToJson(const Guards& guards) {
  return {{"input_margin", guards.input_margin},
          {"error_margin", guards.error_margin},
          {"input_min", NumbersToJson(guards.input_min)},
          {"input_max", NumbersToJson(guards.input_max)},
          {"error_min", guards.error_min},
          {"error_max", guards.error_max}};
}

Json ToJson(const PredictionInterval& interval) {
  Json json = {{"holdout", interval.holdout},
               {"unit", interval.unit},
               {"groups", interval.units}};
  Json at_least = Json::array();
  for (const PredictionInterval::Level& level : interval.levels) {
    const std::string key = CoverageKey(level.coverage);
    json[key] = std::isfinite(level.half_width) ? Json(level.half_width)
                                                : Json(nullptr);
    if (level.at_least) at_least.push_back(key);
  }
  json["at_least"] = std::move(at_least);
  if (interval.of_sessions) json["whole"] = kWholeSessions;
  return json;
}

// What no prediction depends on is written with so many digits.
constexpr int kDigits = 6;

double Rounded(double value) {
  return std::strtod(fmt::format("{:.{}g}", value, kDigits).c_str(), nullptr);
}

Eigen::VectorXd Rounded(const Eigen::VectorXd& values) {
  return values.unaryExpr([](double value) { return Rounded(value); });
}

Eigen::MatrixXd Rounded(const Eigen::MatrixXd& values) {
  return values.unaryExpr([](double value) { return Rounded(value); });
}

Json ToJson(const Applicability& trained,
            const std::vector<TrainedInput>& inputs) {
  Json derived = Json::array();
  for (const Applicability::Derived& input : trained.derived) {
    derived.push_back({{"name", input.column.name},
                       {"unit", input.column.unit.symbol},
                       {"min", input.min},
                       {"max", input.max}});
  }
  Json columns = Json::array();
  for (const Index column : trained.columns) {
    columns.push_back(inputs[static_cast<std::size_t>(column)].column.name);
  }
  return {{"derived", std::move(derived)},
          {"columns", std::move(columns)},
          {"rows", trained.rows},
          {"mean", NumbersToJson(Rounded(trained.mean))},
          {"scale", NumbersToJson(Rounded(trained.scale))},
          {"directions", NumbersToJson(Rounded(trained.directions))},
          {"rest", NumbersToJson(Rounded(trained.rest))},
          {"states", NumbersToJson(Rounded(trained.states))},
          {"distance_limit", Rounded(trained.distance_limit)},
          {"leverage_limit", Rounded(trained.leverage_limit)},
          {"relation_limit", NumbersToJson(Rounded(trained.relation_limit))}};
}

Json ToJson(const HeldOutErrors& errors) {
  Json units = Json::array();
  for (const HeldOutErrors::Unit& unit : errors.units) {
    units.push_back({{"label", unit.label},
                     {"rmse", Rounded(unit.rmse)},
                     {"elapsed", NumbersToJson(Rounded(unit.elapsed))},
                     {"position", NumbersToJson(Rounded(unit.position))},
                     {"residuals", NumbersToJson(Rounded(unit.residuals))}});
  }
  return {{"time_unit", errors.time_unit},
          {"position", errors.position},
          {"rmse", Rounded(errors.rmse)},
          {"units", std::move(units)}};
}

Json ToJson(const std::vector<data::ColumnFilter>& where) {
  Json filters = Json::array();
  for (const data::ColumnFilter& filter : where) {
    Json& json = filters.emplace_back(Json{{"column", filter.column}});
    if (const auto* const number = std::get_if<double>(&filter.value)) {
      json["number"] = *number;
    } else {
      json["text"] = std::get<std::string>(filter.value);
    }
  }
  return filters;
}

}  // namespace

std::string ModelToJson(const FittedModel& fitted,
                        const Provenance& provenance) {
  Json inputs = Json::array();
  for (const TrainedInput& input : fitted.inputs) {
    inputs.push_back({{"name", input.column.name},
                      {"unit", input.column.unit.symbol},
                      {"min", input.min},
                      {"max", input.max},
                      {"mean", input.mean},
                      {"sd", input.sd}});
  }
  Json document = {
      {"schema", kModelSchema},
      {"version", Version()},
      {"name", fitted.name},
      {"kind", ToString(fitted.kind)},
      {"target",
       {{"name", fitted.target.name}, {"unit", fitted.target.unit.symbol}}},
      {"inputs", std::move(inputs)},
      {"parameters", fitted.model->num_parameters()}};
  WriteForm(*fitted.model, fitted.equation, &document);
  if (fitted.align != data::Alignment::kNone) {
    document["target"]["align"] = data::ToString(fitted.align);
  }
  if (!fitted.where.empty()) document["where"] = ToJson(fitted.where);
  document["history"] =
      fitted.history != nullptr ? ToJson(*fitted.history) : Json();
  document["guards"] = fitted.guards ? ToJson(*fitted.guards) : Json();
  document["interval"] = fitted.interval ? ToJson(*fitted.interval) : Json();
  document["applicability"] = fitted.applicability != nullptr
                                  ? ToJson(*fitted.applicability, fitted.inputs)
                                  : Json();
  document["held_out"] =
      fitted.held_out != nullptr ? ToJson(*fitted.held_out) : Json();
  document["provenance"] = Json::object();
  for (const auto& [key, value] : provenance) {
    document["provenance"][key] = value;
  }
  constexpr int kIndent = 1;
  return document.dump(kIndent) + "\n";
}

}  // namespace errmap::models
