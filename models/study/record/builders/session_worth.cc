#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "fitting/interruption.h"
#include "fitting/parallel_for.h"
#include "models/study/record/component_study.h"

namespace errmap::models {
namespace {

using data::Dataset;
constexpr Index kFewestSessions = 4;
// One more than these takes at most 2 % off an error that falls as fast as
// their number grows, and its loss drowns in what the fits differ by.
constexpr Index kMostSessions = 50;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// How a fold's error grows when its training rows lose a session.
struct Loss {
  double log_ratio = kNaN;
  Index sessions = 0;  // in the fold's training rows
};

std::vector<Index> SessionsOf(const std::vector<Index>& rows,
                              const std::vector<Index>& codes) {
  std::vector<Index> sessions;
  for (const Index row : rows) {
    sessions.push_back(codes[static_cast<std::size_t>(row)]);
  }
  std::ranges::sort(sessions);
  sessions.erase(std::unique(sessions.begin(), sessions.end()), sessions.end());
  return sessions;
}

Loss LossOfFold(const Dataset& dataset,
                const stats::Fold& fold,
                std::size_t number,
                const ModelRecipe& recipe,
                double rmse,
                const FitContext& context) {
  const std::vector<Index> codes = dataset.session_codes();
  const std::vector<Index> sessions = SessionsOf(fold.train, codes);
  Loss loss{.sessions = std::ssize(sessions)};
  if (sessions.size() < 2) return loss;
  const Index dropped = sessions[number % sessions.size()];
  std::vector<Index> rows;
  std::ranges::copy_if(fold.train, std::back_inserter(rows), [&](Index row) {
    return codes[static_cast<std::size_t>(row)] != dropped;
  });
  try {
    const FittedModel fitted = recipe.Fit(dataset.SelectRows(rows), context);
    const Dataset test = dataset.SelectRows(fold.test);
    const VectorXd errors = test.target_values() - fitted.Predict(test);
    loss.log_ratio = std::log(
        std::sqrt(errors.squaredNorm() / static_cast<double>(errors.size())) /
        rmse);
  } catch (const std::invalid_argument&) {
    // What is left cannot be fitted.
  }
  return loss;
}

}  // namespace

std::optional<SessionWorth> WorthOfASession(const Dataset& dataset,
                                            const Holdout& holdout,
                                            const ModelRecipe& recipe,
                                            const HoldoutResult& result,
                                            const StudyOptions& options) {
  if (!holdout.whole_sessions || holdout.test_data != nullptr ||
      dataset.num_sessions() < kFewestSessions ||
      dataset.num_sessions() > kMostSessions || !result.ok()) {
    return std::nullopt;
  }
  FitContext context{.seed = options.seed,
                     .indifference = options.indifference};
  context.inner_holdout = holdout.inner;
  const fitting::InterruptionScope interruptible(options.stop);
  std::vector<Loss> losses(holdout.folds.size());
  fitting::ParallelFor(options.jobs, losses.size(), [&](std::size_t i) {
    losses[i] = LossOfFold(dataset,
                           holdout.folds[i],
                           i,
                           recipe,
                           result.folds[i].test_rmse,
                           context);
  });
  if (fitting::IsInterrupted()) return std::nullopt;
  double log_ratio = 0.0;
  double log_sessions = 0.0;
  for (const Loss& loss : losses) {
    if (!std::isfinite(loss.log_ratio)) return std::nullopt;
    const auto sessions = static_cast<double>(loss.sessions);
    log_ratio += loss.log_ratio;
    log_sessions += std::log(sessions / (sessions - 1.0));
  }
  const auto folds = static_cast<double>(losses.size());
  const double exponent = std::max(0.0, log_ratio / log_sessions);
  const auto all = static_cast<double>(dataset.num_sessions());
  return SessionWorth{
      .sessions = dataset.num_sessions(),
      .folds = std::ssize(losses),
      .ratio_of_one_fewer = std::exp(log_ratio / folds),
      .ratio_of_one_more = std::pow(all / (all + 1.0), exponent)};
}

}  // namespace errmap::models
