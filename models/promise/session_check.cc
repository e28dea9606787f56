#include "models/promise/session_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "stats/error_metrics.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

using Eigen::Index;
using Eigen::VectorXd;

// A simulated study (tests/benchmarks/session_check.py, seeds 11-40) set these:
// three probes over a session call 90 % of the sessions that are off so, and
// 2.7 % of the others. Half would give 92 and 5.4 %, but call a session off by
// one probe of the promised size: any size is as likely as any other here.
constexpr double kSureOff = 0.65;
constexpr double kSureHolds = 0.25;
constexpr int kDrawsPerUnit = 100;
// Rows of a unit that stand for one time: positions differ among them.
constexpr Index kNearest = 6;
constexpr Index kMostMoreProbes = 12;
constexpr std::uint64_t kSeed = 17;

// Rows of the unit with the elapsed time nearest to `time`, all of them where
// times tell nothing.
std::vector<Index> RowsNear(const HeldOutErrors& errors,
                            const HeldOutErrors::Unit& unit,
                            double time) {
  std::vector<Index> rows(static_cast<std::size_t>(unit.residuals.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<Index>(i);
  if (errors.time_unit != "s") return rows;
  const auto kept = std::min(kNearest, unit.residuals.size());
  std::ranges::nth_element(rows, rows.begin() + (kept - 1), {}, [&](Index row) {
    return std::abs(unit.elapsed[row] - time);
  });
  rows.resize(static_cast<std::size_t>(kept));
  return rows;
}

// RMS of probes of held-out units at these times over the RMSE of the unit,
// ascending.
std::vector<double> RatiosOfProbes(const HeldOutErrors& errors,
                                   const VectorXd& elapsed) {
  stats::Random random(kSeed);
  std::vector<double> ratios;
  for (const HeldOutErrors::Unit& unit : errors.units) {
    if (!(unit.rmse > 0.0)) continue;
    std::vector<std::vector<Index>> near;
    for (const double time : elapsed) {
      near.push_back(RowsNear(errors, unit, time));
    }
    for (int draw = 0; draw < kDrawsPerUnit; ++draw) {
      double squares = 0.0;
      for (const std::vector<Index>& rows : near) {
        const double residual = unit.residuals[rows[static_cast<std::size_t>(
            random.Below(rows.size()))]];
        squares += residual * residual;
      }
      ratios.push_back(
          std::sqrt(squares / static_cast<double>(elapsed.size())) / unit.rmse);
    }
  }
  std::ranges::sort(ratios);
  return ratios;
}

double Quantile(const std::vector<double>& ascending, double share) {
  const auto last = static_cast<double>(ascending.size() - 1);
  return ascending[static_cast<std::size_t>(std::lround(share * last))];
}

// Limits of the RMS of probes at these times.
struct Limits {
  double off_above = 0.0;
  double holds_to = 0.0;
};

Limits LimitsOf(const std::vector<double>& ratios, double promised) {
  return {.off_above = kOffRatio * promised * Quantile(ratios, kSureOff),
          .holds_to = kOffRatio * promised * Quantile(ratios, kSureHolds)};
}

SessionStatus StatusOf(double rms, const Limits& limits) {
  if (rms > limits.off_above) return SessionStatus::kOff;
  return rms <= limits.holds_to ? SessionStatus::kHolds
                                : SessionStatus::kUnknown;
}

std::optional<Index> ProbesToSettle(const HeldOutErrors& errors,
                                    const VectorXd& elapsed,
                                    double rms) {
  for (Index more = 1; more <= kMostMoreProbes; ++more) {
    VectorXd times(elapsed.size() + more);
    for (Index i = 0; i < times.size(); ++i) {
      times[i] = elapsed[i % elapsed.size()];
    }
    const Limits limits = LimitsOf(RatiosOfProbes(errors, times), errors.rmse);
    if (StatusOf(rms, limits) != SessionStatus::kUnknown) return more;
  }
  return std::nullopt;
}

Remedy RemedyOf(const SessionCheck& check) {
  if (check.status != SessionStatus::kOff) return Remedy::kNone;
  if (check.probes < 2) return Remedy::kUnknown;
  return OffsetExplains(check.probe_mean, check.probe_rms, check.promised)
             ? Remedy::kRezero
             : Remedy::kRefit;
}

void RequireProbes(const VectorXd& elapsed, const VectorXd& residuals) {
  if (residuals.size() == 0 || residuals.size() != elapsed.size() ||
      !residuals.allFinite() || !elapsed.allFinite()) {
    throw std::invalid_argument(
        "CheckSession: needs one finite time for each of the finite residuals "
        "of at least one probe");
  }
}

double MedianOf(std::vector<double> values) {
  const auto middle =
      values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace

std::string_view ToString(SessionStatus status) {
  switch (status) {
    case SessionStatus::kHolds:
      return "holds";
    case SessionStatus::kOff:
      return "off";
    case SessionStatus::kUnknown:
      return "unknown";
  }
  return "";
}

std::string_view ToString(Remedy remedy) {
  switch (remedy) {
    case Remedy::kNone:
      return "none";
    case Remedy::kRezero:
      return "re-zero";
    case Remedy::kRefit:
      return "refit";
    case Remedy::kUnknown:
      return "unknown";
  }
  return "";
}

bool OffsetExplains(double mean, double rms, double promised) {
  constexpr double kShare = 0.75;
  return mean * mean >= kShare * (rms * rms - promised * promised);
}

SessionCheck CheckSession(const HeldOutErrors& errors,
                          const VectorXd& elapsed,
                          const VectorXd& residuals,
                          Missing missing) {
  RequireProbes(elapsed, residuals);
  constexpr double kTail = 0.1;  // on each side of 80 %
  SessionCheck check;
  check.missing = missing;
  const bool remembers = missing == Missing::kNothing;
  check.probes = residuals.size();
  check.promised = errors.rmse;
  check.probe_rms = stats::RootMeanSquare(residuals);
  check.probe_mean = residuals.mean();
  check.probe_scatter =
      residuals.size() < 2
          ? kNoFigure
          : std::sqrt((residuals.array() - check.probe_mean).square().sum() /
                      static_cast<double>(residuals.size() - 1));
  const std::vector<double> ratios = RatiosOfProbes(errors, elapsed);
  if (ratios.empty()) {  // held-out errors that are all 0 tell nothing
    check.session_low = check.session_high = kNoFigure;
    check.off_above = check.holds_to = kNoFigure;
    check.off_probability = kNoFigure;
    return check;
  }
  const Limits limits = LimitsOf(ratios, errors.rmse);
  check.off_above = limits.off_above;
  check.holds_to = limits.holds_to;
  if (remembers) check.status = StatusOf(check.probe_rms, limits);
  const double at_limit = check.probe_rms / (kOffRatio * errors.rmse);
  check.off_probability =
      static_cast<double>(std::ranges::lower_bound(ratios, at_limit) -
                          ratios.begin()) /
      static_cast<double>(ratios.size());
  check.session_low = check.probe_rms / Quantile(ratios, 1.0 - kTail);
  check.session_high = check.probe_rms / Quantile(ratios, kTail);
  check.remedy = RemedyOf(check);
  if (check.status == SessionStatus::kUnknown && remembers) {
    check.more_probes = ProbesToSettle(errors, elapsed, check.probe_rms);
  }
  return check;
}

std::vector<ProbeSite> RankProbeSites(const HeldOutErrors& errors) {
  constexpr int kTimes = 4;
  constexpr int kPlaces = 3;
  constexpr std::size_t kFewestProbes = 6;
  const bool timed = errors.time_unit == "s";
  const bool placed = !errors.position.empty();
  double longest = 0.0;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const HeldOutErrors::Unit& unit : errors.units) {
    longest = std::max(longest, unit.elapsed.maxCoeff());
    if (!placed) continue;
    low = std::min(low, unit.position.minCoeff());
    high = std::max(high, unit.position.maxCoeff());
  }
  const auto part = [](double value, double from, double to, int parts) {
    if (!(to > from)) return 0;
    return std::clamp(
        static_cast<int>((value - from) / (to - from) * parts), 0, parts - 1);
  };
  std::map<std::pair<int, int>, std::vector<double>> logs;
  for (const HeldOutErrors::Unit& unit : errors.units) {
    for (Index i = 0; i < unit.residuals.size(); ++i) {
      const int time = timed ? part(unit.elapsed[i], 0.0, longest, kTimes) : 0;
      const int place = placed ? part(unit.position[i], low, high, kPlaces) : 0;
      logs[{time, place}].push_back(
          std::abs(std::log(std::abs(unit.residuals[i]) / unit.rmse)));
    }
  }
  std::vector<ProbeSite> sites;
  for (auto& [cell, values] : logs) {
    if (values.size() < kFewestProbes) continue;
    const auto edge = [](double from, double to, int at, int parts) {
      return from + (to - from) * at / parts;
    };
    const auto& [time, place] = cell;
    sites.push_back(
        {.from = edge(0.0, longest, time, kTimes),
         .until = timed ? edge(0.0, longest, time + 1, kTimes) : longest,
         .position_from = placed ? edge(low, high, place, kPlaces) : kNoFigure,
         .position_until =
             placed ? edge(low, high, place + 1, kPlaces) : kNoFigure,
         .factor = std::exp(MedianOf(std::move(values)))});
  }
  std::ranges::stable_sort(sites, {}, &ProbeSite::factor);
  return sites;
}

}  // namespace errmap::models
