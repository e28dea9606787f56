#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "data/files/atomic_file.h"
#include "models/file/checksum.h"
#include "models/file/model_json.h"
#include "models/history/history.h"
#include "models/map_experience.h"
#include "models/model_file.h"
#include "models/record_json.h"
#include "models/version.h"

namespace errmap::models {
namespace {

using Json = ModelJson;

Json HistoryToJson(const History& history) {
  Json json = ToJson(history);
  for (std::size_t i = 0; i < history.derived.size(); ++i) {
    if (RunsInTime(history.derived[i].filter)) continue;
    json["derived"][i].erase("tau");
    json["derived"][i].erase("between");
  }
  return json;
}

Json IntervalToJson(const PredictionInterval& interval) {
  Json json = {{"holdout", interval.holdout},
               {"unit", interval.unit},
               {"groups", interval.units}};
  Json at_least = Json::array();
  Json inside = Json::object();
  Json outside = Json::object();
  for (const PredictionInterval::Level& level : interval.levels) {
    const std::string key = CoverageKey(level.coverage);
    json[key] = std::isfinite(level.half_width) ? Json(level.half_width)
                                                : Json(nullptr);
    if (level.at_least) at_least.push_back(key);
    if (level.inside < level.outside) {
      inside[key] = level.inside;
      outside[key] = level.outside;
    }
  }
  json["at_least"] = std::move(at_least);
  if (!inside.empty()) {
    json["inside"] = std::move(inside);
    json["outside"] = std::move(outside);
  }
  if (interval.of_sessions) json["whole"] = kWholeSessions;
  if (interval.good_for > 0) {
    json["lag1"] = interval.lag1;
    json["good_for"] = interval.good_for;
  }
  return json;
}

// Digits of numbers on which no prediction depends.
constexpr int kDigits = 6;

Json Rounded(Json json) {
  if (json.is_number_float()) {
    const std::string text =
        fmt::format("{:.{}g}", json.get<double>(), kDigits);
    return std::strtod(text.c_str(), nullptr);
  }
  if (json.is_structured()) {
    for (Json& part : json) part = Rounded(std::move(part));
  }
  return json;
}

Json ApplicabilityToJson(const Applicability& trained,
                         const std::vector<TrainedInput>& inputs) {
  Json json = Rounded(ToJson(trained));
  for (Json& column : json["columns"]) {
    column = inputs[column.get<std::size_t>()].column.name;
  }
  return json;
}

Json FiltersToJson(const std::vector<data::ColumnFilter>& where) {
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
  Json document = {
      {"schema", kModelSchema},
      {"version", Version()},
      {"name", fitted.name},
      {"kind", ToString(fitted.kind)},
      {"target",
       {{"name", fitted.target.name}, {"unit", fitted.target.unit.symbol}}},
      {"inputs", ToJson(fitted.inputs)},
      {"parameters", fitted.model->num_parameters()}};
  WriteForm(*fitted.model, fitted.equation, &document);
  if (fitted.align != data::Alignment::kNone) {
    document["target"]["align"] = data::ToString(fitted.align);
  }
  if (!fitted.where.empty()) document["where"] = FiltersToJson(fitted.where);
  document["history"] =
      fitted.history != nullptr ? HistoryToJson(*fitted.history) : Json();
  document["guards"] = ToJson(fitted.guards);
  document["interval"] =
      fitted.interval ? IntervalToJson(*fitted.interval) : Json();
  document["applicability"] =
      fitted.applicability != nullptr
          ? ApplicabilityToJson(*fitted.applicability, fitted.inputs)
          : Json();
  document["held_out"] =
      fitted.held_out != nullptr ? Rounded(ToJson(*fitted.held_out)) : Json();
  document["learnt"] =
      fitted.learnt != nullptr ? ToJson(*fitted.learnt) : Json();
  document["reading"] =
      fitted.reading != nullptr ? ToJson(*fitted.reading) : Json();
  document["provenance"] = Json::object();
  for (const auto& [key, value] : provenance) {
    document["provenance"][key] = value;
  }
  constexpr int kIndent = 1;
  return WithChecksum(document.dump(kIndent));
}

void SaveModel(const FittedModel& fitted,
               const Provenance& provenance,
               const std::string& path) {
  data::WriteFileAtomically(path, ModelToJson(fitted, provenance));
}

}  // namespace errmap::models
