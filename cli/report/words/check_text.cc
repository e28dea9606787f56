#include "cli/report/words/check_text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "data/text.h"

namespace errmap::report {
namespace {

constexpr double kSecondsPerMinute = 60.0;

std::string TimesText(const models::HeldOutErrors& errors,
                      const Eigen::VectorXd& elapsed) {
  if (errors.time_unit != "s") return "";
  return fmt::format(", {:.0f} to {:.0f} min after the session began",
                     elapsed.minCoeff() / kSecondsPerMinute,
                     elapsed.maxCoeff() / kSecondsPerMinute);
}

// Some probes leave nothing certain.
std::string ProbabilityText(double probability) {
  constexpr double kLittle = 0.01;
  if (probability < kLittle) return "less than 1 %";
  if (probability > 1.0 - kLittle) return "more than 99 %";
  return fmt::format("{:.0f} %", kPercent * probability);
}

std::string StatusText(const models::SessionCheck& check,
                       const ErrorText& error) {
  if (check.missing != models::Missing::kNothing) {
    return fmt::format(
        "Not known whether the map holds: it has a memory, and {} are missing. "
        "Give all rows since its start, those without a probe with an empty "
        "error, or the earlier ones with --after.\n",
        check.missing == models::Missing::kStart
            ? "the first rows of the session"
            : "the readings between the probes of the session");
  }
  const char* const lead = check.status == models::SessionStatus::kHolds
                               ? "The map holds in this session"
                           : check.status == models::SessionStatus::kOff
                               ? "The map does not hold in this session"
                               : "Not yet known whether the map holds";
  std::string text = fmt::format(
      "{}: its error is {} to {} RMSE with 80 % confidence, above {} ({} times "
      "the promise) with a probability of {}.",
      lead,
      error(check.session_low),
      error.WithUnit(check.session_high),
      error.WithUnit(models::kOffRatio * check.promised),
      models::kOffRatio,
      ProbabilityText(check.off_probability));
  if (check.status == models::SessionStatus::kUnknown) {
    text += check.more_probes
                ? fmt::format(" {} like these would settle it.",
                              Count(*check.more_probes, "more probe"))
                : " More probes like these would not settle it; take them "
                  "later or elsewhere.";
  }
  return text + "\n";
}

std::string RemedyText(const models::SessionCheck& check,
                       const ErrorText& error) {
  switch (check.remedy) {
    case models::Remedy::kNone:
      return "";
    case models::Remedy::kRezero:
      return fmt::format(
          "An offset explains it: re-zero by {} (errmap predict --probes); {} "
          "of scatter is left.\n",
          error.WithUnit(check.probe_mean),
          error.WithUnit(check.probe_scatter));
    case models::Remedy::kRefit:
      return "An offset does not explain it: the shape is wrong; measure this "
             "state in two sessions or more and fit again (errmap update).\n";
    case models::Remedy::kUnknown:
      return "One probe cannot tell an offset from a wrong shape: take a "
             "second one elsewhere.\n";
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
    text +=
        fmt::format("{}{} {:.4g} to {:.4g}",
                    text.empty() ? "" : ", ",
                    data::Printable(errors.position, errors.position.size()),
                    site.position_from,
                    site.position_until);
  }
  return text;
}

std::string SitesText(const models::HeldOutErrors& errors,
                      const std::vector<models::ProbeSite>& sites) {
  if (sites.size() < 2 || !std::isfinite(sites.front().factor)) return "";
  return fmt::format(
      "Probes tell most at {}: half of them are within a factor of {:.2g} of "
      "the session's error.\n",
      SiteText(errors, sites.front()),
      sites.front().factor);
}

}  // namespace

std::string CheckText(const models::SessionCheck& check,
                      const models::HeldOutErrors& errors,
                      const std::vector<models::ProbeSite>& sites,
                      const Eigen::VectorXd& elapsed,
                      const data::Unit& unit) {
  const ErrorText error(unit, check.promised);
  return fmt::format("{}: RMS {}, mean {}; promised {} RMSE\n{}{}{}",
                     TimesText(errors, elapsed),
                     error.WithUnit(check.probe_rms),
                     error.WithUnit(check.probe_mean),
                     error.WithUnit(check.promised),
                     StatusText(check, error),
                     RemedyText(check, error),
                     SitesText(errors, sites));
}

}  // namespace errmap::report
