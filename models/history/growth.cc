#include "models/history/growth.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace errmap::models {

using Eigen::Index;

std::map<Index, std::vector<Index>> RowsOfSessions(const data::Dataset& rows) {
  std::map<Index, std::vector<Index>> sessions;
  const std::vector<Index> codes = rows.session_codes();
  for (std::size_t i = 0; i < codes.size(); ++i) {
    sessions[codes[i]].push_back(static_cast<Index>(i));
  }
  return sessions;
}

std::vector<bool> ColumnsThatOnlyGrow(const data::Dataset& rows) {
  constexpr std::size_t kFewestSessions = 3;
  constexpr double kHardly = 0.1;
  std::vector<bool> only_grow(static_cast<std::size_t>(rows.num_inputs()),
                              false);
  const auto sessions = RowsOfSessions(rows);
  if (sessions.size() < kFewestSessions) return only_grow;
  for (Index j = 0; j < rows.num_inputs(); ++j) {
    const auto column = rows.input_values().col(j);
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double mean_before = std::numeric_limits<double>::quiet_NaN();
    double returned = 0.0;  // shares of the later sessions
    bool rises = true;
    bool falls = true;
    for (const auto& [session, places] : sessions) {
      const Eigen::ArrayXd values = column(places);
      if (!std::isnan(mean_before)) {
        rises = rises && values.mean() > mean_before;
        falls = falls && values.mean() < mean_before;
        returned += (values >= low && values <= high).cast<double>().mean();
      }
      mean_before = values.mean();
      low = std::min(low, values.minCoeff());
      high = std::max(high, values.maxCoeff());
    }
    only_grow[static_cast<std::size_t>(j)] =
        (rises || falls) &&
        returned < kHardly * static_cast<double>(sessions.size() - 1);
  }
  return only_grow;
}

}  // namespace errmap::models
