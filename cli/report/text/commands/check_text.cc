#include "cli/report/text/commands/check_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "data/text.h"

namespace errmap::report {
namespace {

constexpr double kSecondsPerMinute = 60.0;

std::string TimesText(const models::SessionCheck& check,
                      const models::HeldOutErrors& errors,
                      const Eigen::VectorXd& elapsed) {
  if (errors.time_unit != "s") return "";
  const bool is_short = elapsed.maxCoeff() < 2.0 * kSecondsPerMinute;
  const double unit = is_short ? 1.0 : kSecondsPerMinute;
  const std::string first = fmt::format("{:.0f}", elapsed.minCoeff() / unit);
  const std::string last = fmt::format("{:.0f}", elapsed.maxCoeff() / unit);
  return fmt::format(", {}{} {} after {}",
                     first,
                     last == first ? "" : " to " + last,
                     is_short ? "s" : "min",
                     check.missing == models::Missing::kStart
                         ? "its first row"
                         : "the session began");
}

std::string MissingText(models::Missing missing) {
  return missing == models::Missing::kStart
             ? "Not known whether the map holds: it needs the session from its "
               "start, and this log begins later. Give the earlier rows with "
               "--after EARLIER.csv. Say --from-rest if the machine was at "
               "rest before the first row.\n"
             : "Not known whether the map holds: it has a memory and lacks the "
               "readings between the probes. Give them with an empty error, or "
               "earlier ones with --after EARLIER.csv.\n";
}

const char* LeadOf(models::SessionStatus status) {
  switch (status) {
    case models::SessionStatus::kHolds:
      return "The map holds in this session";
    case models::SessionStatus::kOff:
      return "The map does not hold in this session";
    case models::SessionStatus::kHoldsSoFar:
      return "The map holds so far (the rest of the session is not known)";
    case models::SessionStatus::kSensor:
    case models::SessionStatus::kUnknown:
      break;
  }
  return "Not yet known whether the map holds";
}

// `last`: when the last probe was taken, s after the start. What is known from
// then on only is no time to probe again.
std::string ProbeWhenText(const models::SessionCheck& check, double last) {
  const auto minute = [](double seconds) {
    return std::round(seconds / kSecondsPerMinute);
  };
  if (check.next_probe && minute(*check.next_probe) > minute(last)) {
    return fmt::format("Probe again {:.0f} min after the start.\n",
                       minute(*check.next_probe));
  }
  return check.next_probe || check.status == models::SessionStatus::kUnknown
             ? "Take more probes, at other positions and later.\n"
             : "";
}

std::string StatusText(const models::SessionCheck& check,
                       const ErrorText& error) {
  if (check.sensor) {
    return SensorText(*check.sensor) + "The map is not judged until then.\n";
  }
  if (check.missing != models::Missing::kNothing) {
    return MissingText(check.missing);
  }
  if (!std::isfinite(check.session.low)) {
    return "Not known whether the map holds: its file states no error.\n";
  }
  const std::string limit =
      fmt::format("{}, {} times the expected RMSE",
                  error.WithUnit(models::kOffRatio * check.promised),
                  models::kOffRatio);
  if (check.remedy == models::Remedy::kSign ||
      check.remedy == models::Remedy::kGain) {
    return fmt::format("{}: the limit is {}.\n", LeadOf(check.status), limit);
  }
  const bool so_far = check.status == models::SessionStatus::kHoldsSoFar;
  const models::RmseForecast& told = so_far ? check.so_far : check.session;
  // The session beside the probes may err by more or less than these.
  const char* const beside_probes =
      check.probe_rms < told.low    ? " (at the probes it was less)"
      : check.probe_rms > told.high ? " (at the probes it was more)"
                                    : "";
  return fmt::format(
      "{}: its error{} is {}{} to {} RMSE with 80 % confidence{}. The limit is "
      "{}.\n",
      LeadOf(check.status),
      so_far ? " until now" : "",
      *beside_probes != '\0' ? "forecast at " : "",
      error(told.low),
      error.WithUnit(told.high),
      beside_probes,
      limit);
}

std::string RemedyText(const models::SessionCheck& check,
                       const ErrorText& error) {
  switch (check.remedy) {
    case models::Remedy::kNone:
      return "";
    case models::Remedy::kRezero:
      return fmt::format(
          "An offset explains it: re-zero by {} (errmap predict --probes); {} "
          "should be left.\n",
          error.WithUnit(check.probe_mean),
          error.WithUnit(check.left));
    case models::Remedy::kGain:
      return fmt::format(
          "The errors are {:.3g} times those predicted: check the unit and the "
          "scale of this measurement. If they are right, measure this state in "
          "two sessions or more and fit again (errmap update).\n",
          check.gain);
    case models::Remedy::kSign:
      return "The errors are those predicted with the other sign: check the "
             "sign of this measurement (error = actual - nominal).\n";
    case models::Remedy::kRefit:
      return "An offset does not explain it: the shape is wrong. Measure this "
             "state in two sessions or more and fit again (errmap update).\n";
    case models::Remedy::kUnknown:
      return "These probes cannot tell an offset from a wrong shape: take "
             "more, at other positions and later.\n";
  }
  return "";
}

std::string SiteText(const models::HeldOutErrors& errors,
                     const models::ProbeSite& site) {
  std::string text;
  if (errors.time_unit == "s") {
    text += fmt::format("{:.0f} to {:.0f} min after the start",
                        site.from / kSecondsPerMinute,
                        site.until / kSecondsPerMinute);
  }
  if (std::isfinite(site.position_from)) {
    text += fmt::format("{}{} {:.4g} to {:.4g}",
                        text.empty() ? "" : ", ",
                        data::Printable(errors.position),
                        site.position_from,
                        site.position_until);
  }
  return text;
}

// Where the next probe tells most, in what is left of the session.
std::string SitesText(const models::HeldOutErrors& errors,
                      const std::vector<models::ProbeSite>& sites,
                      double last) {
  const bool timed = errors.time_unit == "s";
  const auto next =
      std::ranges::find_if(sites, [&](const models::ProbeSite& site) {
        return std::isfinite(site.factor) && (!timed || site.until > last);
      });
  return sites.size() < 2 || next == sites.end()
             ? ""
             : "Most useful probes: " + SiteText(errors, *next) + ".\n";
}

// When to probe next; where no time is known, where probes tell most.
std::string ProbeText(const models::SessionCheck& check,
                      const models::HeldOutErrors& errors,
                      const std::vector<models::ProbeSite>& sites,
                      double last) {
  if (check.sensor || check.missing != models::Missing::kNothing) return "";
  const bool more = check.remedy == models::Remedy::kUnknown ||
                    check.status == models::SessionStatus::kUnknown;
  return ProbeWhenText(check, last) +
         (more ? SitesText(errors, sites, last) : "");
}

}  // namespace

std::string SensorText(const models::SensorFaultFound& found) {
  const data::ColumnInfo& column = found.columns.front();
  const std::string name = data::Printable(column.name);
  const std::string& unit = column.unit.symbol;
  const std::string lead = "Check " + name + " first: ";
  switch (found.fault) {
    case models::SensorFault::kUnit:
      return fmt::format("{}its readings look like {}, not {}.\n",
                         lead,
                         found.looks_like,
                         unit);
    case models::SensorFault::kDead:
      if (std::isnan(found.value)) return lead + "it gives no reading.\n";
      return fmt::format(
          "{}it reads {:.4g} {} throughout, like a dead or unconnected "
          "sensor.\n",
          lead,
          found.value,
          unit);
    case models::SensorFault::kFrozen:
      return fmt::format("{}it repeats {:.4g} {} while the others change.\n",
                         lead,
                         found.value,
                         unit);
    case models::SensorFault::kSwapped:
      return fmt::format(
          "Check {} and {} first: each reads what the other should, as if they "
          "were swapped.\n",
          name,
          data::Printable(found.columns.back().name));
    case models::SensorFault::kSpike:
      return fmt::format(
          "{}it reads {:.4g} {} in data row {}, far from its other readings. "
          "Delete that row and check again.\n",
          lead,
          found.value,
          unit,
          found.row);
    case models::SensorFault::kOff:
      break;
  }
  return fmt::format("{}it reads {:.3g} {} too {} compared with the others.\n",
                     lead,
                     std::abs(found.value),
                     unit,
                     found.value > 0.0 ? "high" : "low");
}

std::string CheckText(const models::SessionCheck& check,
                      const models::HeldOutErrors& errors,
                      const std::vector<models::ProbeSite>& sites,
                      const Eigen::VectorXd& elapsed,
                      const data::Unit& unit) {
  const ErrorText error(unit, check.promised);
  return fmt::format("{}: RMS {}, mean {}; expected {} RMSE\n{}{}{}",
                     TimesText(check, errors, elapsed),
                     error.WithUnit(check.probe_rms),
                     error.WithUnit(check.probe_mean),
                     error.WithUnit(check.promised),
                     StatusText(check, error),
                     RemedyText(check, error),
                     ProbeText(check, errors, sites, elapsed.maxCoeff()));
}

}  // namespace errmap::report
