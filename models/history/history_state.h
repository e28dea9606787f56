#pragma once

#include <vector>

#include <Eigen/Core>

#include "data/measurements/dataset.h"
#include "models/history/history.h"

namespace errmap::models {

/// The filters of a history at work, reading by reading: what a controller
/// runs. It keeps nothing but `state`.
class HistoryState {
 public:
  /// `columns`: of the readings, in their order. Throws std::invalid_argument
  /// for an input that neither is a column nor derived before, a name that
  /// stands twice, a tau that is not above 0, or the sine of what is no angle.
  HistoryState(const History& history,
               const std::vector<data::ColumnInfo>& columns);

  /// Begins a session: filters in the steady state of these readings (one per
  /// column), the zero taken here. A reading that is NaN is not known yet: what
  /// depends on it begins with its first number. Throws std::invalid_argument
  /// on another number of readings.
  void Start(const Eigen::Ref<const Eigen::VectorXd>& readings);

  /// Goes on by `dt` (unit of time, at least 0) to these readings; one that is
  /// NaN holds its last value. dt = 0 leaves the filters as they are, the
  /// readings replacing the earlier ones. Throws std::invalid_argument on a dt
  /// below 0 or NaN, another number of readings, or before Start.
  void Step(double dt, const Eigen::Ref<const Eigen::VectorXd>& readings);

  /// Takes the zero here, in place of where the session began.
  void TakeZero();

  /// What the form reads now, one per form input; NaN where not known.
  const Eigen::VectorXd& form_inputs() const { return form_inputs_; }
  /// Columns and units of the same.
  const std::vector<data::ColumnInfo>& form_columns() const {
    return form_columns_;
  }

  /// Readings held, filters and zeros (columns + derived inputs): all there is
  /// to keep over a restart. Empty before Start.
  Eigen::VectorXd state() const;
  /// Goes on from what state() gave. Throws std::invalid_argument on another
  /// size.
  void set_state(const Eigen::VectorXd& state);

 private:
  struct Node {
    Filter filter = Filter::kEma;
    Eigen::Index source = 0;  // into values_
    std::size_t tau = 0;      // of kEma: into taus_
    Between between = Between::kLinear;
    double factor = 1.0;  // of sine and cosine: radians per unit
  };

  void SetReadings(const Eigen::Ref<const Eigen::VectorXd>& readings);
  /// Everything that the memory says, which goes on by gains_ where time
  /// `passes`.
  void Update(bool passes);

  Eigen::Index num_columns_ = 0;
  std::vector<Node> nodes_;
  /// Of the step at hand, as in models/history/lag.h.
  struct Gains {
    double decay = 0.0;  // u m
    double ramp = 0.0;   // 1 - m
  };
  std::vector<double> taus_;  // distinct
  std::vector<Gains> gains_;
  std::vector<Eigen::Index> form_sources_;
  std::vector<data::ColumnInfo> form_columns_;
  bool started_ = false;
  Eigen::VectorXd values_;    // (columns + derived inputs)
  Eigen::VectorXd previous_;  // the same before the step at hand
  Eigen::VectorXd memory_;    // (derived inputs) filter or zero
  Eigen::VectorXd form_inputs_;
};

}  // namespace errmap::models
