#include "models/session/session_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "data/text.h"
#include "stats/error_metrics.h"
#include "stats/not_a_number.h"
#include "stats/order_statistic.h"

namespace errmap::models {
namespace {

// How sure is sure enough (tests/benchmarks/mornings.py).
constexpr double kSureOff = 0.9;
constexpr double kSureHolds = 0.06;
constexpr double kWorse = 0.03;  // the most that an order may make worse
constexpr double kMuchWorse = 1.1;
// Of a session's held-out errors those up to the last probe, for a word on all.
constexpr double kLeastSeen = 0.5;
// So many probes may miss another shape of the errors.
constexpr Index kFewProbes = 3;

double Quantile(std::vector<double> values, double share) {
  const auto last = static_cast<double>(values.size() - 1);
  const auto rank = static_cast<std::size_t>(std::lround(share * last));
  return stats::OrderStatistic(std::move(values), rank);
}

double ShareAbove(const std::vector<double>& values, double limit) {
  const auto above = std::ranges::count_if(
      values, [limit](double value) { return value > limit; });
  return static_cast<double>(above) / static_cast<double>(values.size());
}

// The RMSE of each draw at these sites.
std::vector<double> RmseOfDraws(const MatrixXd& errors,
                                const std::vector<Index>& sites) {
  std::vector<double> rmse;
  for (Index draw = 0; draw < errors.rows(); ++draw) {
    rmse.push_back(stats::RootMeanSquare(errors(draw, sites).transpose()));
  }
  return rmse;
}

RmseForecast ForecastOf(const std::vector<double>& rmse, double promised) {
  constexpr double kTail = 0.1;  // on each side of 80 %
  return {.low = Quantile(rmse, kTail),
          .high = Quantile(rmse, 1.0 - kTail),
          .off_probability = ShareAbove(rmse, kOffRatio * promised)};
}

double SpreadOf(const VectorXd& values) {
  return stats::RootMeanSquare(values.array() - values.mean());
}

// Errors over predictions, by least squares; NaN where the predictions at the
// probes hardly differ, which tells no gain from an offset.
double GainOf(const SessionProbes& probes, const SessionForecast& forecast) {
  constexpr double kLeastSpread = 0.8;  // of that in whole sessions
  const double spread = SpreadOf(probes.predicted);
  if (!(spread > 0.0) || spread < kLeastSpread * SpreadOf(forecast.predicted)) {
    return stats::kNaN;
  }
  return 1.0 + probes.residuals.dot(probes.predicted) /
                   probes.predicted.squaredNorm();
}

// Another sign is a gain of about -1.
bool IsSign(double gain) {
  constexpr double kAboutOne = 0.35;
  return std::abs(gain + 1.0) < kAboutOne;
}

// Another sign or scale, which no state of a machine is.
bool IsOfNoMachine(double gain) {
  constexpr double kScale = 3.0;
  return IsSign(gain) || gain > kScale || std::abs(gain) < 1.0 / kScale;
}

// Errors over predictions where that alone brings the probes within the limit,
// whose noise grows alike, and explains three quarters of their mean square;
// else NaN. Some factor fits three probes of many a wrong shape, another sign
// hardly does.
double ExplainingGain(const SessionProbes& probes, double limit) {
  const VectorXd measured = probes.residuals + probes.predicted;
  const double gain =
      measured.dot(probes.predicted) / probes.predicted.squaredNorm();
  const double left = stats::RootMeanSquare(measured - gain * probes.predicted);
  const bool explains = (probes.residuals.size() > 3 || IsSign(gain)) &&
                        left <= limit * std::max(1.0, std::abs(gain)) &&
                        left <= 0.5 * stats::RootMeanSquare(probes.residuals);
  return explains ? gain : stats::kNaN;
}

// What an order leaves of the draws, by the sites that come after it.
struct Order {
  Remedy remedy = Remedy::kNone;
  std::vector<double> left;  // RMSE of each draw
};

std::vector<double> LeftByGain(const SessionForecast& forecast,
                               const std::vector<Index>& after,
                               double gain) {
  return RmseOfDraws(
      forecast.errors.rowwise() - (gain - 1.0) * forecast.predicted.transpose(),
      after);
}

std::vector<Order> OrdersFor(const SessionForecast& forecast,
                             const std::vector<Index>& after,
                             const SessionCheck& check) {
  std::vector<Order> orders;
  orders.push_back(
      {Remedy::kRezero,
       RmseOfDraws(forecast.errors.array() - check.probe_mean, after)});
  if (!std::isfinite(check.gain)) return orders;
  orders.push_back({Remedy::kGain, LeftByGain(forecast, after, check.gain)});
  orders.push_back({Remedy::kSign, LeftByGain(forecast, after, -1.0)});
  return orders;
}

bool DoesNoHarm(const std::vector<double>& left,
                const std::vector<double>& as_it_is) {
  std::vector<double> ratios;
  for (std::size_t draw = 0; draw < as_it_is.size(); ++draw) {
    ratios.push_back(left[draw] / as_it_is[draw]);
  }
  return ShareAbove(ratios, kMuchWorse) <= kWorse;
}

// The order that leaves least, if it helps and leaves no more than the limit.
void ChooseRemedy(const SessionProbes& probes,
                  const SessionForecast& forecast,
                  SessionCheck* check) {
  constexpr Index kFew = 5;  // probes, which some factor fits by chance
  const std::vector<Index>& after =
      forecast.later.empty() ? forecast.so_far : forecast.later;
  const std::vector<double> as_it_is = RmseOfDraws(forecast.errors, after);
  const double limit = kOffRatio * check->promised;
  const Order* best = nullptr;
  const std::vector<Order> orders = OrdersFor(forecast, after, *check);
  const auto typical = [](const Order& order) {
    return Quantile(order.left, 0.5);
  };
  for (const Order& order : orders) {
    if (best == nullptr || typical(order) < typical(*best)) best = &order;
  }
  check->left = typical(*best);
  if (DoesNoHarm(best->left, as_it_is) && check->left <= limit &&
      check->probes > 1) {
    check->remedy = best->remedy;
  } else if (ShareAbove(best->left, limit) > kSureOff && check->probes > 2) {
    // A wrong sign or unit is looked for before days are measured anew.
    const double gain = ExplainingGain(probes, limit);
    if (std::isnan(gain)) {
      check->remedy = Remedy::kRefit;
    } else {
      check->gain = gain;
      const bool is_told =
          IsOfNoMachine(gain) ||
          (check->probes > kFew &&
           DoesNoHarm(LeftByGain(forecast, after, gain), as_it_is));
      check->remedy = is_told ? Remedy::kGain : Remedy::kUnknown;
    }
  } else {
    check->remedy = Remedy::kUnknown;
  }
  if (check->remedy == Remedy::kGain && IsSign(check->gain)) {
    check->remedy = Remedy::kSign;
  }
  if (check->remedy != Remedy::kGain && check->remedy != Remedy::kSign) {
    check->gain = 1.0;
  }
}

// The first part of the rest of the session of which it is not known.
std::optional<double> NextProbe(const SessionForecast& forecast,
                                double promised) {
  constexpr std::size_t kParts = 6;
  const std::vector<Index>& later = forecast.later;
  const std::size_t parts = std::min(kParts, later.size());
  for (std::size_t k = 0; k < parts; ++k) {
    const std::vector<Index> part(
        later.begin() + static_cast<std::ptrdiff_t>(later.size() * k / parts),
        later.begin() +
            static_cast<std::ptrdiff_t>(later.size() * (k + 1) / parts));
    const std::vector<double> rmse = RmseOfDraws(forecast.errors, part);
    if (ShareAbove(rmse, kOffRatio * promised) > 2.0 * kSureHolds) {
      return forecast.elapsed[part.front()];
    }
  }
  return std::nullopt;
}

void RequireProbes(const SessionProbes& probes) {
  const Index count = probes.residuals.size();
  const auto is_whole = [count](const VectorXd& values) {
    return values.size() == count && values.allFinite();
  };
  if (count == 0 || !is_whole(probes.residuals) || !is_whole(probes.elapsed) ||
      !is_whole(probes.predicted) ||
      (probes.position.size() > 0 && !is_whole(probes.position))) {
    throw std::invalid_argument(
        "CheckSession: needs a finite time, prediction and residual of each of "
        "at least one probe, and of each or none a finite position");
  }
}

}  // namespace

std::string_view ToString(SessionStatus status) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"holds", "off", "unknown", "holds so far", "sensor"});
  return data::NameOf(kNames, status);
}

std::string_view ToString(Remedy remedy) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"none", "re-zero", "refit", "unknown", "gain", "sign"});
  return data::NameOf(kNames, remedy);
}

bool OffsetExplains(double mean, double rms, double promised) {
  constexpr double kShare = 0.75;
  return mean * mean >= kShare * (rms * rms - promised * promised);
}

SessionCheck CheckSession(const HeldOutErrors& errors,
                          const SessionProbes& probes,
                          Missing missing,
                          std::optional<SensorFaultFound> sensor) {
  RequireProbes(probes);
  const VectorXd& residuals = probes.residuals;
  SessionCheck check;
  check.missing = missing;
  check.sensor = std::move(sensor);
  check.probes = residuals.size();
  check.promised = errors.rmse;
  check.probe_rms = stats::RootMeanSquare(residuals);
  check.probe_mean = residuals.mean();
  check.probe_scatter =
      residuals.size() < 2
          ? stats::kNaN
          : std::sqrt((residuals.array() - check.probe_mean).square().sum() /
                      static_cast<double>(residuals.size() - 1));
  constexpr RmseForecast kNothing{stats::kNaN, stats::kNaN, stats::kNaN};
  check.so_far = check.session = kNothing;
  check.left = stats::kNaN;
  if (check.sensor) {
    check.status = SessionStatus::kSensor;
    return check;
  }
  // Held-out errors that are all 0 tell nothing.
  if (missing != Missing::kNothing || !(errors.rmse > 0.0)) return check;
  const SessionForecast forecast = ForecastSession(errors, probes);
  const auto forecast_of = [&](const std::vector<Index>& sites) {
    return ForecastOf(RmseOfDraws(forecast.errors, sites), errors.rmse);
  };
  std::vector<Index> all = forecast.so_far;
  all.insert(all.end(), forecast.later.begin(), forecast.later.end());
  check.session = forecast_of(all);
  check.so_far =
      forecast.so_far.empty() ? check.session : forecast_of(forecast.so_far);
  if (!forecast.later.empty()) check.later = forecast_of(forecast.later);
  const bool seen = static_cast<double>(forecast.so_far.size()) >=
                    kLeastSeen * static_cast<double>(all.size());
  const bool holds_so_far = check.so_far.off_probability <= kSureHolds;
  if (check.session.off_probability >= kSureOff) {
    check.status = SessionStatus::kOff;
    check.gain = GainOf(probes, forecast);
    ChooseRemedy(probes, forecast, &check);
  } else if (seen && holds_so_far && check.probes > kFewProbes &&
             check.session.off_probability <= kSureHolds &&
             (!check.later || check.later->off_probability <= kSureHolds)) {
    check.status = SessionStatus::kHolds;
  } else if (holds_so_far && check.later) {
    check.status = SessionStatus::kHoldsSoFar;
  }
  if (check.status != SessionStatus::kOff) {
    check.next_probe = NextProbe(forecast, errors.rmse);
    if (!check.next_probe && check.status == SessionStatus::kHoldsSoFar &&
        !forecast.later.empty()) {
      check.next_probe =
          forecast.elapsed[forecast.later[forecast.later.size() / 2]];
    }
  }
  return check;
}

std::vector<ProbeSite> RankProbeSites(const HeldOutErrors& errors) {
  constexpr int kTimes = 4;
  constexpr int kPlaces = 3;
  constexpr std::size_t kFewestProbes = 6;
  const bool timed = errors.time_unit == "s";
  const bool placed = !errors.position.empty();
  const double longest = errors.longest();
  const auto [low, high] = placed ? errors.travel() : std::pair(0.0, 0.0);
  const auto part = [](double value, double from, double to, int parts) {
    if (!(to > from)) return 0;
    return std::clamp(
        static_cast<int>((value - from) / (to - from) * parts), 0, parts - 1);
  };
  std::map<std::pair<int, int>, std::vector<double>> logs;
  for (const HeldOutErrors::Unit& unit : errors.units) {
    // Errors that are all 0 have no size to be told.
    if (!(unit.rmse > 0.0)) continue;
    for (Index i = 0; i < unit.residuals.size(); ++i) {
      const int time = timed ? part(unit.elapsed[i], 0.0, longest, kTimes) : 0;
      const int place = placed ? part(unit.position[i], low, high, kPlaces) : 0;
      // An error of 0 is infinitely far from the unit's RMSE.
      logs[{time, place}].push_back(
          std::abs(std::log(std::abs(unit.residuals[i]) / unit.rmse)));
    }
  }
  std::vector<ProbeSite> sites;
  for (auto& [cell, values] : logs) {
    if (values.size() < kFewestProbes) continue;
    const double factor = std::exp(stats::UpperMedian(std::move(values)));
    if (!std::isfinite(factor)) continue;
    const auto edge = [](double from, double to, int at, int parts) {
      return from + (to - from) * at / parts;
    };
    const auto& [time, place] = cell;
    sites.push_back(
        {.from = edge(0.0, longest, time, kTimes),
         .until = timed ? edge(0.0, longest, time + 1, kTimes) : longest,
         .position_from =
             placed ? edge(low, high, place, kPlaces) : stats::kNaN,
         .position_until =
             placed ? edge(low, high, place + 1, kPlaces) : stats::kNaN,
         .factor = factor});
  }
  std::ranges::stable_sort(sites, {}, &ProbeSite::factor);
  return sites;
}

}  // namespace errmap::models
