#include "models/kinematics/tool_tip_spread.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stats/distributions.h"
#include "stats/satterthwaite_dof.h"

namespace errmap::models {
namespace {

using Eigen::MatrixX3d;
void CheckSpread(const std::vector<HeldOutToolTip>& sessions, double coverage) {
  if (sessions.size() < 2 || !(coverage > 0.0 && coverage < 1.0)) {
    throw std::invalid_argument(
        "ToolTipHalfWidths: needs two sessions and a coverage between 0 and 1");
  }
  for (const HeldOutToolTip& session : sessions) {
    if (session.errors.rows() == 0 ||
        session.errors.rows() != session.half_widths.rows()) {
      throw std::invalid_argument(
          "ToolTipHalfWidths: errors and half-widths of a session differ in "
          "number, or there are none");
    }
  }
}

bool IsKnown(const MatrixX3d& half_widths, Index direction) {
  return (half_widths.col(direction).array() > 0.0).all() &&
         half_widths.col(direction).allFinite();
}

// Student's t times the root of the mean of the sessions' `mean_squares`.
double Spread(const VectorXd& mean_squares, double coverage) {
  return std::sqrt(mean_squares.mean()) *
         stats::StudentQuantile(0.5 * (1.0 + coverage),
                                stats::SatterthwaiteDof(mean_squares));
}

}  // namespace

MatrixX3d ToolTipHalfWidths(const std::vector<HeldOutToolTip>& sessions,
                            const MatrixX3d& first_order,
                            double coverage) {
  CheckSpread(sessions, coverage);
  MatrixX3d half_widths = MatrixX3d::Ones(first_order.rows(), 3);
  for (Index d = 0; d < 3; ++d) {
    const bool has_shape =
        IsKnown(first_order, d) &&
        std::ranges::all_of(sessions, [&](const HeldOutToolTip& session) {
          return IsKnown(session.half_widths, d);
        });
    VectorXd mean_squares(std::ssize(sessions));
    Index s = 0;
    for (const HeldOutToolTip& session : sessions) {
      VectorXd errors = session.errors.col(d);
      if (has_shape) errors = errors.cwiseQuotient(session.half_widths.col(d));
      mean_squares[s++] =
          errors.squaredNorm() / static_cast<double>(errors.size());
    }
    if (has_shape) half_widths.col(d) = first_order.col(d);
    half_widths.col(d) *= Spread(mean_squares, coverage);
  }
  return half_widths;
}

}  // namespace errmap::models
