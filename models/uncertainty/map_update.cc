#include "models/uncertainty/map_update.h"

#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include "stats/error_metrics.h"

namespace errmap::models {
namespace {

MatrixXd Stacked(const MatrixXd& above, const MatrixXd& below) {
  MatrixXd all(above.rows() + below.rows(), above.cols());
  all << above, below;
  return all;
}

VectorXd Stacked(const VectorXd& above, const VectorXd& below) {
  VectorXd all(above.size() + below.size());
  all << above, below;
  return all;
}

void Append(const std::vector<Index>& more,
            Index shift,
            std::vector<Index>* all) {
  for (const Index value : more) all->push_back(value + shift);
}

std::shared_ptr<const data::SessionLog> JoinedLog(
    const data::SessionLog& first, const data::SessionLog& second) {
  if (first.time_unit != second.time_unit) {
    throw std::invalid_argument("the files have times in different units");
  }
  auto log = std::make_shared<data::SessionLog>(first);
  const auto sessions = std::ssize(first.sessions.labels);
  const Index rows = first.time.size();
  Append(second.sessions.codes, sessions, &log->sessions.codes);
  for (const std::string& label : second.sessions.labels) {
    log->sessions.labels.push_back(label + " (new)");
  }
  Append(second.first_rows, rows, &log->first_rows);
  log->time = Stacked(first.time, second.time);
  log->input_values = Stacked(first.input_values, second.input_values);
  return log;
}

// What is to be said instead of learning from new sessions explains most.
constexpr double kMuch = 2.0;

// Rows of the session, and the others.
std::pair<std::vector<Index>, std::vector<Index>> SplitAt(
    const std::vector<Index>& codes, Index session) {
  std::pair<std::vector<Index>, std::vector<Index>> split;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    (codes[i] == session ? split.first : split.second)
        .push_back(static_cast<Index>(i));
  }
  return split;
}

}  // namespace

data::Dataset Joined(const data::Dataset& first, const data::Dataset& second) {
  if (first.inputs() != second.inputs() || first.target() != second.target() ||
      first.align() != second.align()) {
    throw std::invalid_argument("the files have other inputs or targets");
  }
  if ((first.log() == nullptr) != (second.log() == nullptr)) {
    throw std::invalid_argument("sessions are known in one of the files only");
  }
  data::Dataset::Parts parts{
      .source = second.source(),
      .inputs = first.inputs(),
      .input_values = Stacked(first.input_values(), second.input_values()),
      .target = first.target(),
      .target_values = Stacked(first.target_values(), second.target_values()),
      .groups = {},
      .weights = {},
      .rows = first.rows(),
      .align = first.align()};
  // Rows of the second follow on those of the first, as in one file.
  const Index shift = first.rows().empty() ? 0 : first.rows().back() + 1;
  Append(second.rows(), shift, &parts.rows);
  if (first.log() != nullptr) {
    parts.log = JoinedLog(*first.log(), *second.log());
    parts.log_rows = first.log_rows();
    Append(second.log_rows(), first.log()->time.size(), &parts.log_rows);
  }
  return data::Dataset(std::move(parts));
}

bool UpdateTrial::is_negated() const {
  return negated_rmse < std::min({old_rmse, new_rmse}) / kMuch;
}

bool UpdateTrial::is_shifted() const {
  return shifted_rmse < std::min({old_rmse, new_rmse}) / kMuch;
}

bool UpdateTrial::better(double indifference) const {
  if (!why_failed.empty() || !(new_rmse < old_rmse - indifference) ||
      is_negated() || is_shifted()) {
    return false;
  }
  VectorXd of_old(std::ssize(sessions));
  VectorXd of_new(std::ssize(sessions));
  Index at = 0;
  for (const Session& session : sessions) {
    of_old[at] = session.old_rmse;
    of_new[at++] = session.new_rmse;
  }
  return stats::GeometricMean(of_new) < stats::GeometricMean(of_old);
}

UpdateTrial TryUpdate(const FittedModel& old_map,
                      const data::Dataset* known,
                      const data::Dataset& fresh,
                      const ModelRecipe& recipe,
                      const FitContext& context) {
  const std::vector<Index> codes = fresh.session_codes();
  const std::set<Index> sessions(codes.begin(), codes.end());
  if (sessions.size() < 2) {
    throw std::invalid_argument("needs at least two new sessions");
  }
  UpdateTrial trial;
  const VectorXd old_residuals = fresh.target_values() - old_map.Predict(fresh);
  VectorXd new_residuals(fresh.num_rows());
  VectorXd shifted(fresh.num_rows());
  for (const Index session : sessions) {
    const auto [test, rest] = SplitAt(codes, session);
    try {
      const data::Dataset others = fresh.SelectRows(rest);
      const FittedModel successor = recipe.Fit(
          known != nullptr ? Joined(*known, others) : others, context);
      const data::Dataset held = fresh.SelectRows(test);
      new_residuals(test) = held.target_values() - successor.Predict(held);
      shifted(test) = old_residuals(test).array() - old_residuals(rest).mean();
    } catch (const std::invalid_argument& error) {
      trial.why_failed = error.what();
      return trial;
    }
    trial.sessions.push_back(
        {.session =
             fresh.log()->sessions.labels[static_cast<std::size_t>(session)],
         .old_rmse = stats::RootMeanSquare(old_residuals(test)),
         .new_rmse = stats::RootMeanSquare(new_residuals(test))});
  }
  trial.old_rmse = stats::RootMeanSquare(old_residuals);
  trial.new_rmse = stats::RootMeanSquare(new_residuals);
  trial.negated_rmse =
      stats::RootMeanSquare(2.0 * fresh.target_values() - old_residuals);
  trial.shifted_rmse = stats::RootMeanSquare(shifted);
  trial.shift = old_residuals.mean();
  return trial;
}

}  // namespace errmap::models
