#include "models/fleet/watch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "data/text.h"
#include "stats/distributions.h"
#include "stats/error_metrics.h"

namespace errmap::models {
namespace {

// What the spread common to all sensors counts in that of one, in sessions.
constexpr double kPriorSessions = 1.0;
// Odd days are more frequent than t has them: by so much wider, of 252 healthy
// days of simulated machines 1 instead of 3 has a corrected p below 0.0025.
constexpr double kSensorWidening = 1.25;

// Length of the travel over all units, which have positions.
double TravelOf(const HeldOutErrors& errors) {
  const auto [low, high] = errors.travel();
  return high - low;
}

// For each of m rows the nearest of a unit's, in time as shares of the longest
// unit and in place as shares of all places.
class Neighbours {
 public:
  Neighbours(const HeldOutErrors& errors,
             const VectorXd& elapsed,
             const VectorXd& position)
      : elapsed_(elapsed), position_(position) {
    if (elapsed.size() > 0) {
      const double longest = errors.longest();
      if (longest > 0.0) per_time_ = 1.0 / longest;
    }
    if (position.size() > 0) {
      const double travel = TravelOf(errors);
      if (travel > 0.0) per_place_ = 1.0 / travel;
    }
  }

  Eigen::ArrayXd Residuals(const HeldOutErrors::Unit& unit,
                           Index num_rows) const {
    Eigen::ArrayXd found(num_rows);
    for (Index row = 0; row < num_rows; ++row) {
      Eigen::ArrayXd far = Eigen::ArrayXd::Zero(unit.residuals.size());
      if (per_time_ > 0.0) {
        far += (per_time_ * (unit.elapsed.array() - elapsed_[row])).square();
      }
      if (per_place_ > 0.0) {
        far += (per_place_ * (unit.position.array() - position_[row])).square();
      }
      Index nearest = 0;
      far.minCoeff(&nearest);
      found[row] = unit.residuals[nearest];
    }
    return found;
  }

 private:
  const VectorXd& elapsed_;
  const VectorXd& position_;
  double per_time_ = 0.0;
  double per_place_ = 0.0;
};

// Of the newest `count` sessions, of each of which something is expected.
MapJudgement JudgeNewest(const HeldOutErrors& held_out,
                         const std::vector<WatchedSession>& sessions,
                         std::size_t count) {
  const auto n = static_cast<double>(held_out.units.size());
  const auto k = static_cast<double>(count);
  double offset = 0.0;  // in the spread of the held-out ones
  double logarithm = 0.0;
  double square = 0.0;
  double expected = 0.0;
  for (std::size_t i = sessions.size() - count; i < sessions.size(); ++i) {
    const WatchedSession& session = sessions[i];
    offset += session.offset / session.expected.offset / k;
    logarithm += (std::log(session.mean_square) - session.expected.log_square) /
                 session.expected.log_spread / k;
    square += session.mean_square / k;
    expected += session.expected.square / k;
  }
  MapJudgement found;
  found.promised = std::max(held_out.rmse, std::sqrt(expected));
  found.found = std::sqrt(square);
  for (std::size_t i = sessions.size() - count; i < sessions.size(); ++i) {
    found.offset += sessions[i].offset / k;
  }
  found.p_offset = stats::StudentTwoSided(offset * std::sqrt(k), n);
  // Mean squares differ by factors from day to day. How widely is known from n
  // days only: F with degrees of freedom estimated from them takes it as given,
  // and accused healthy days that were odd by a factor of 6 at p = 1e-6.
  const double t_rms = logarithm / std::sqrt(1.0 / k + 1.0 / n);
  const double both = stats::StudentTwoSided(t_rms, n - 1.0);
  found.p_rms = t_rms > 0.0 ? 0.5 * both : 1.0 - 0.5 * both;
  found.p = std::min(1.0, 2.0 * std::min(found.p_offset, found.p_rms));
  return found;
}

}  // namespace

bool AreTooFew(const HeldOutErrors& errors,
               Index rows,
               const VectorXd& position) {
  constexpr double kLeastTravel = 0.5;
  if (rows < kFewestRows) return true;
  return position.size() > 0 && position.maxCoeff() - position.minCoeff() <
                                    kLeastTravel * TravelOf(errors);
}

ExpectedErrors ExpectedOf(const HeldOutErrors& errors,
                          const VectorXd& elapsed,
                          const VectorXd& position) {
  ExpectedErrors expected;
  const auto num_units = std::ssize(errors.units);
  if (num_units < kFewestSessions) return expected;
  const Neighbours neighbours(errors, elapsed, position);
  const Index num_rows = std::max<Index>(
      {elapsed.size(), position.size(), Index{elapsed.size() == 0}});
  Eigen::ArrayXd means(num_units);
  Eigen::ArrayXd squares(num_units);
  for (Index u = 0; u < num_units; ++u) {
    const HeldOutErrors::Unit& unit = errors.units[static_cast<std::size_t>(u)];
    const bool anywhere = elapsed.size() == 0 && position.size() == 0;
    const Eigen::ArrayXd residuals = anywhere
                                         ? unit.residuals.array()
                                         : neighbours.Residuals(unit, num_rows);
    means[u] = residuals.mean();
    squares[u] = residuals.square().mean();
  }
  if (!(squares.minCoeff() > 0.0)) return expected;
  // Few days may be alike by chance; those of simulated machines differ by this
  // sd, which counts as so many sessions.
  constexpr double kUsualSpread = 0.6;
  constexpr double kPriorUnits = 2.0;
  const Eigen::ArrayXd logs = squares.log();
  const auto n = static_cast<double>(num_units);
  expected.offset = std::sqrt(means.square().mean());
  expected.square = squares.mean();
  expected.log_square = logs.mean();
  expected.log_spread = std::sqrt(((logs - logs.mean()).square().sum() +
                                   kPriorUnits * kUsualSpread * kUsualSpread) /
                                  (n - 1.0 + kPriorUnits));
  return expected;
}

void JudgeSensors(const SensorRelations& relations,
                  const SensorShifts& shifts,
                  WatchedSession* session) {
  const VectorXd squares = relations.spread.cwiseAbs2();
  constexpr double kLeast = 1e-12;
  const double common = stats::GeometricMean(squares.cwiseMax(kLeast));
  const auto n = static_cast<double>(relations.sessions);
  const Eigen::ArrayXd widening =
      relations.Widening(shifts.distance.transpose()).transpose();
  const double missing =
      relations.rows > 0
          ? std::max(0.0,
                     1.0 - static_cast<double>(session->rows) /
                               static_cast<double>(relations.rows))
          : 0.0;
  Index worst = 0;
  double largest = 0.0;
  for (Index i = 0; i < squares.size(); ++i) {
    const double within = missing > 0.0 ? missing * relations.within[i] : 0.0;
    const double variance =
        widening[i] *
        ((n * squares[i] + kPriorSessions * common) / (n + kPriorSessions) +
         within);
    const double t =
        std::abs(shifts.shift[i]) / (kSensorWidening * std::sqrt(variance));
    if (t <= largest) continue;
    largest = t;
    worst = i;
  }
  session->sensor = relations.columns[std::size_t(worst)].name;
  session->sensor_shift = shifts.shift[worst];
  session->p_sensor =
      std::min(1.0,
               static_cast<double>(squares.size()) *
                   stats::StudentTwoSided(largest, n + kPriorSessions - 1.0));
}

std::optional<MapJudgement> JudgeSessions(
    const HeldOutErrors& held_out,
    const std::vector<WatchedSession>& sessions) {
  if (sessions.empty() || !sessions.back().expected.known()) {
    return std::nullopt;
  }
  MapJudgement best = JudgeNewest(held_out, sessions, 1);
  if (sessions.size() == 1 || !sessions[sessions.size() - 2].expected.known()) {
    return best;
  }
  const MapJudgement two = JudgeNewest(held_out, sessions, 2);
  if (two.p < best.p) best = two;
  best.p = std::min(1.0, 2.0 * best.p);
  return best;
}

namespace {

bool IsAbove(const MapJudgement& judgement, double indifference) {
  return judgement.found > judgement.promised + indifference &&
         std::max(judgement.found,
                  std::hypot(judgement.promised, judgement.offset)) >
             (1.0 + kLeastWorse) * judgement.promised;
}

}  // namespace

bool IsWorse(const MapJudgement& judgement, double indifference) {
  return judgement.p < kSurelyChanged && IsAbove(judgement, indifference);
}

bool IsDoubtful(const MapJudgement& judgement, double indifference) {
  constexpr double kFarAbove = 2.0;
  return !IsWorse(judgement, indifference) &&
         IsAbove(judgement, indifference) &&
         (judgement.p < kDoubtful ||
          judgement.found > kFarAbove * judgement.promised);
}

namespace {

constexpr std::array<std::string_view, 7> kStatusNames = {"as promised",
                                                          "worse",
                                                          "sensor changed",
                                                          "outside",
                                                          "too few rows",
                                                          "not judged",
                                                          "doubtful"};

}  // namespace

std::string_view ToString(WatchStatus status) {
  return data::NameOf(kStatusNames, status);
}

WatchStatus WatchStatusNamed(std::string_view name) {
  const auto found = std::ranges::find(kStatusNames, name);
  return found == kStatusNames.end()
             ? WatchStatus::kNotJudged
             : WatchStatus(found - kStatusNames.begin());
}

}  // namespace errmap::models
