#include "models/uncertainty/held_out_errors.h"

#include <algorithm>
#include <utility>

#include "models/session/zero_schedule.h"
#include "models/study/judgement/units_of_analysis.h"
#include "stats/error_metrics.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

// A day at every tenth minute; twice as many units as the 95 % interval needs.
constexpr Index kMostRows = 48;
constexpr Index kMostUnits = 40;

// The held-out rows of each unit, in order of time.
std::vector<std::vector<Index>> PlacesOfUnits(const std::vector<Index>& codes,
                                              const VectorXd& elapsed) {
  auto places = stats::IndicesByCode(codes);
  for (std::vector<Index>& of_unit : places) {
    std::ranges::stable_sort(of_unit, {}, [&](Index i) { return elapsed[i]; });
  }
  return places;
}

// Kept rows of each unit.
using KeptRows = std::vector<std::vector<Index>>;

// Of the map's inputs the temperature that tells most, beside the errors it is
// of.
void AddTemperature(const HeldOutRows& held,
                    const std::vector<TrainedInput>& of_map,
                    const VectorXd& residuals,
                    const KeptRows& kept,
                    HeldOutErrors* errors) {
  std::vector<Index> columns;
  for (const TrainedInput& input : of_map) {
    if (input.column.unit.quantity != data::Quantity::kTemperature) continue;
    const Index column = held.source->FindInput(input.column.name);
    if (column >= 0) columns.push_back(column);
  }
  const MatrixXd temperatures = held.source->input_values()(held.rows, columns);
  const Index telling = TellingTemperature(temperatures, residuals, kept);
  if (telling < 0) return;
  const Index column = columns[static_cast<std::size_t>(telling)];
  errors->temperature =
      held.source->inputs()[static_cast<std::size_t>(column)].name;
  for (std::size_t u = 0; u < kept.size(); ++u) {
    errors->units[u].temperature = temperatures.col(telling)(kept[u]);
  }
}

}  // namespace

VectorXd ElapsedOf(const data::Dataset& dataset) {
  VectorXd elapsed = VectorXd::Zero(dataset.num_rows());
  const data::SessionLog* log = dataset.log().get();
  if (log == nullptr) return elapsed;
  const std::vector<Index> sessions = dataset.session_codes();
  for (Index row = 0; row < elapsed.size(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    const Index first = log->first_rows[static_cast<std::size_t>(sessions[at])];
    elapsed[row] = log->time[dataset.log_rows()[at]] - log->time[first];
  }
  return elapsed;
}

std::optional<HeldOutErrors> HeldOutErrorsOf(
    const data::Dataset& dataset,
    const Holdout& holdout,
    const HoldoutResult& result,
    const std::vector<TrainedInput>& inputs) {
  if (!result.ok() || holdout.among_neighbours) return std::nullopt;
  const HeldOutRows held = GatherHeldOut(dataset, holdout);
  UnitsOfAnalysis units;
  const std::vector<Index> codes = AssignUnits(holdout, held, &units);
  const VectorXd residuals = ResidualsOf(held, result);
  if (units.labels.size() < 2 || !residuals.allFinite()) return std::nullopt;
  const data::Dataset& source = *held.source;
  const VectorXd predicted = source.target_values()(held.rows) - residuals;
  const VectorXd elapsed = ElapsedOf(source)(held.rows);
  const Index position = FindPosition(source, "");
  HeldOutErrors errors;
  errors.rmse = stats::RootMeanSquare(residuals);
  if (source.log() != nullptr) errors.time_unit = source.log()->time_unit;
  if (position >= 0) {
    errors.position = source.inputs()[static_cast<std::size_t>(position)].name;
  }
  const auto places = PlacesOfUnits(codes, elapsed);
  KeptRows kept_of;
  for (const Index u : stats::SpreadSample(std::ssize(places), kMostUnits)) {
    const std::vector<Index>& all = places[static_cast<std::size_t>(u)];
    const std::vector<Index>& kept =
        kept_of.emplace_back(stats::SpreadSample(all, kMostRows));
    HeldOutErrors::Unit unit{.label = units.labels[static_cast<std::size_t>(u)],
                             .rmse = stats::RootMeanSquare(residuals(all)),
                             .elapsed = elapsed(kept),
                             .position = {},
                             .residuals = residuals(kept)};
    unit.predicted = predicted(kept);
    if (position >= 0) {
      std::vector<Index> rows;
      for (const Index i : kept) {
        rows.push_back(held.rows[static_cast<std::size_t>(i)]);
      }
      unit.position = source.input_values().col(position)(rows);
    }
    errors.units.push_back(std::move(unit));
  }
  if (units.are_sessions) {
    AddTemperature(held, inputs, residuals, kept_of, &errors);
  }
  return errors;
}

}  // namespace errmap::models
