#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/map_experience.h"
#include "stats/eigen.h"

namespace errmap::models {

struct Holdout;

/// Distances of thermal states (m x s) from the trained ones.
struct StateMeasures {
  VectorXd distance;  // (m) to the nearest trained state, whitened
  VectorXd leverage;  // (m) of a linear map in the scores
  /// (m x s) Each column minus its value expected from the others, over the
  /// standard deviation of this difference in the factor model.
  MatrixXd relation;
  MatrixXd expected;  // (m x s) from the others, input's unit
};
StateMeasures MeasureStates(const Applicability& trained,
                            const MatrixXd& states);

/// Returns the applicability of a map fitted to these rows; empty if all its
/// inputs are positions or there are fewer than three rows.
std::optional<Applicability> MakeApplicability(const FittedModel& fitted,
                                               const data::Dataset& training);

/// The reason why a row is outside the training data.
enum class Outside {
  kNo,
  kRange,     // a column or derived input leaves its range by
              // more than 2 % of it
  kRelation,  // a column is not where the others say it should be
  kDistance,  // far from every trained state
  kLeverage,  // far from their mean
};
/// "no", "range", "relation", "distance", "leverage".
std::string_view ToString(Outside outside);

/// The most severe reason why a row is outside.
struct RowFlag {
  Outside why = Outside::kNo;
  /// For kRange and kRelation: the column or derived input.
  data::ColumnInfo column;
  double value = 0.0;     // of that column, its unit; else distance or leverage
  double low = 0.0;       // where it should be
  double high = 0.0;      // likewise
  double severity = 1.0;  // above 1: 2 is a whole range, or limit, beyond

  bool outside() const { return why != Outside::kNo; }
};

/// Returns a flag per row of `inputs` (m x inputs of the map, in their units)
/// and `form_inputs` (m x inputs of the form, FittedModel::FormInputs). Without
/// an applicability, only the columns' ranges count.
std::vector<RowFlag> FlagRows(const FittedModel& fitted,
                              const MatrixXd& inputs,
                              const MatrixXd& form_inputs);

/// Returns, for each held-out row in the order of the folds, true if it is
/// inside its fold's training data.
std::vector<bool> InsideOfFolds(const FittedModel& fitted,
                                const data::Dataset& dataset,
                                const Holdout& holdout);

}  // namespace errmap::models
