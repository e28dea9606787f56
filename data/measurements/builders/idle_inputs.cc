#include "data/measurements/builders/idle_inputs.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>

#include "data/argument_name.h"
#include "data/measurements/column_checks.h"

namespace errmap::data {
namespace {

// The share of rows with one value from which an input is worth a word.
constexpr Eigen::Index kIdlePercent = 90;

}  // namespace

IdleInput HowIdle(const Eigen::Ref<const Eigen::VectorXd>& values) {
  // The only value that more than half of the rows can have (Boyer and
  // Moore, 1981): it outlasts all others that cancel it one for one.
  double candidate = 0.0;
  Eigen::Index lead = 0;
  for (const double value : values) {
    if (lead == 0) candidate = value;
    lead += value == candidate ? 1 : -1;
  }
  const Eigen::Index count = (values.array() == candidate).count();
  const Eigen::Index m = values.size();
  if (100 * count < kIdlePercent * m) return {};
  return {.how = CsvNumber(candidate + 0.0) + " in " +
                 (count == m ? "all " : std::to_string(count) + " of ") +
                 std::to_string(m) + " rows",
          .dead = count == m};
}

bool CountsOn(const Eigen::Ref<const Eigen::VectorXd>& values,
              const std::vector<Eigen::Index>& sessions) {
  double highest = -std::numeric_limits<double>::infinity();
  double before = highest;  // of the sessions before
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    if (i > 0 && sessions[i] != sessions[i - 1]) before = highest;
    const double value = values[static_cast<Eigen::Index>(i)];
    if (value <= before) return false;
    highest = std::max(highest, value);
  }
  return true;
}

bool NeverFalls(const Eigen::Ref<const Eigen::VectorXd>& values) {
  constexpr Eigen::Index kFewestRows = 24;
  const Eigen::Index last = values.size() - 1;
  if (last < kFewestRows) return false;
  const auto steps = values.tail(last) - values.head(last);
  return (steps.array() >= 0.0).all() &&
         4 * (steps.array() > 0.0).count() > values.size();
}

bool AreNumbersThatNeverReturn(const Eigen::Ref<const Eigen::VectorXd>& values,
                               const std::vector<Eigen::Index>& sessions) {
  constexpr int kFewestSessions = 3;
  const double sign = values[values.size() - 1] < values[0] ? -1.0 : 1.0;
  int num_sessions = 1;
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values[i] != std::floor(values[i])) return false;
    if (i == 0) continue;
    const double step = sign * (values[i] - values[i - 1]);
    const auto row = static_cast<std::size_t>(i);
    const bool begins = sessions[row] != sessions[row - 1];
    if (step < 0.0 || (begins && step == 0.0)) return false;
    num_sessions += begins ? 1 : 0;
  }
  return num_sessions >= kFewestSessions;
}

bool HasTwoValues(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::set<double> found;
  for (const double value : values) {
    if (!std::isnan(value)) found.insert(value);
    if (found.size() > 2) return false;
  }
  return found.size() == 2;
}

RepeatedInputs::Found RepeatedInputs::Look(const Dataset::Parts& parts) {
  const auto used = static_cast<Eigen::Index>(parts.inputs.size()) - 1;
  Found found;
  const auto values = parts.input_values.col(used);
  const std::string name = NameInRemark(parts.inputs[used].name);
  if (values == parts.target_values) {
    found.remarks.push_back("input " + name + " repeats the target " +
                            NameInRemark(parts.target.name) +
                            " value for value; " +
                            ArgumentName("exclude", name) + " leaves it out");
  }
  std::vector<Eigen::Index>& alike =
      inputs_by_sum_[std::accumulate(values.begin(), values.end(), 0.0)];
  for (const Eigen::Index other : alike) {
    if (parts.input_values.col(other) != values) continue;
    found.repeats = parts.inputs[other].name;
    return found;
  }
  alike.push_back(used);
  return found;
}

}  // namespace errmap::data
