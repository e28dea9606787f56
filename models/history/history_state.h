#pragma once

#include <vector>

#include "data/measurements/dataset.h"
#include "models/history/history.h"
#include "stats/eigen.h"

namespace errmap::models {

/// Runs the filters of a history reading by reading, as a controller does.
class HistoryState {
 public:
  /// `columns` are those of the readings. Throws std::invalid_argument if an
  /// input is neither a column nor derived before, or if a name is duplicated.
  /// Also if a tau is not above 0, or a sine is not of an angle.
  HistoryState(const History& history,
               const std::vector<data::ColumnInfo>& columns);

  /// Begins a session: filters start in the steady state of these readings (one
  /// per column), and the zero is taken here. NaN means not yet known: values
  /// that depend on it start with the first known reading. Throws
  /// std::invalid_argument if the number of readings is wrong.
  void Start(const Eigen::Ref<const VectorXd>& readings);

  /// Advances by `dt` (unit of time, at least 0) to these readings. A reading
  /// of NaN keeps its last value. dt = 0 leaves the filters unchanged and
  /// replaces the earlier readings. Throws std::invalid_argument if dt is below
  /// 0 or NaN, the number of readings is wrong, or Start was not called.
  void Step(double dt, const Eigen::Ref<const VectorXd>& readings);

  /// Takes the zero here instead of at the start of the session.
  void TakeZero();

  /// Returns the form's inputs now; NaN if unknown.
  const VectorXd& form_inputs() const { return form_inputs_; }
  /// Returns their columns and units.
  const std::vector<data::ColumnInfo>& form_columns() const {
    return form_columns_;
  }

 private:
  struct Node {
    Filter filter = Filter::kEma;
    Index source = 0;     // index into values_
    std::size_t tau = 0;  // of kEma: index into taus_
    Between between = Between::kLinear;
    double factor = 1.0;  // sine and cosine: radians per unit
  };

  void SetReadings(const Eigen::Ref<const VectorXd>& readings);
  /// Computes all derived values; advances the filters by gains_ if time
  /// `passes`.
  void Update(bool passes);

  Index num_columns_ = 0;
  std::vector<Node> nodes_;
  /// Gains of the current step, as in models/history/lag.h.
  struct Gains {
    double decay = 0.0;  // u m
    double ramp = 0.0;   // 1 - m
  };
  std::vector<double> taus_;  // distinct
  std::vector<Gains> gains_;
  std::vector<Index> form_sources_;
  std::vector<data::ColumnInfo> form_columns_;
  bool started_ = false;
  VectorXd values_;    // (columns + derived inputs)
  VectorXd previous_;  // the same before the current step
  VectorXd memory_;    // (derived inputs) filter or zero
  VectorXd form_inputs_;
};

}  // namespace errmap::models
