#include "cli/report/words/commands/certify_text.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>

namespace errmap::report {
namespace {

using models::Certification;
using models::CertificationFloors;

// "gradient 40, no_descent 14": how the runs of a solver ended.
std::string Stops(const Certification& certification,
                  const std::string& solver) {
  std::map<std::string, int> counts;
  for (const auto& row : certification.nonlinear) {
    if (row.solver == solver) ++counts[row.stop];
  }
  std::string text;
  for (const auto& [stop, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", stop, count);
  }
  return text;
}

std::size_t NumProblems(const Certification& certification) {
  std::set<std::string> names;
  for (const auto& row : certification.nonlinear) names.insert(row.problem);
  return names.size();
}

// What claims of a minimum are worth.
std::string ClaimsText(const Certification& certification,
                       const CertificationFloors& floors) {
  int claims = 0;
  std::map<std::string, int> others;  // by the reason
  for (const auto& row : certification.nonlinear) {
    if (!row.claims_minimum) continue;
    ++claims;
    if (row.lre_rss < floors.claimed_lre_rss && !row.other_minimum.empty()) {
      ++others[row.other_minimum];
    }
  }
  std::string text = fmt::format(
      "{} runs claim a minimum: with {:.0f} digits of the sum of squares or "
      "more, but for\n",
      claims,
      floors.claimed_lre_rss);
  for (const auto& [reason, count] : others) {
    text += fmt::format("{:>4} on problems of which {}\n", count, reason);
  }
  return text;
}

std::string SolversText(const Certification& certification,
                        const CertificationFloors& floors,
                        bool details) {
  std::string text = fmt::format(
      "NIST StRD, nonlinear: {} problems from both starts; digits (LRE, at "
      "most 11)\n",
      NumProblems(certification));
  text += fmt::format("{:<30}{:>7}{:>7}{:>7}{:>7}{:>7}{:>7}{}\n",
                      "solver",
                      "solved",
                      "floor",
                      "mean",
                      "floor",
                      "least",
                      "sd",
                      details ? "  runs ended with" : "");
  for (const auto& row : certification.nonlinear_summary) {
    text += fmt::format("{:<30}{:>7}{:>7}{:>7.2f}{:>7.2f}{:>7.2f}{:>7.2f}{}\n",
                        row.solver,
                        fmt::format("{}/{}", row.solved, row.runs),
                        row.floor_solved,
                        row.mean_lre_parameters,
                        row.floor_mean_lre_parameters,
                        row.least_lre_parameters,
                        row.mean_lre_sd,
                        details ? "  " + Stops(certification, row.solver) : "");
  }
  return text +
         fmt::format(
             "Floors of every run of {}: parameters {:.1f}, sd {:.1f}, sum of "
             "squares {:.1f}\n",
             models::kDefaultSolver,
             floors.nonlinear_lre_parameters,
             floors.nonlinear_lre_sd,
             floors.nonlinear_lre_rss) +
         ClaimsText(certification, floors) +
         fmt::format(
             "{} is the library's (fitting/nonlinear/nonlinear_regression.h); "
             "no command\nfits formulas by it. The commands fit nets, by the "
             "solvers below it: net:lm,\nnet:scg, net:cg, net:ceres, "
             "net:nlopt.\n",
             models::kDefaultSolver);
}

// The default solver's runs; with `details` everybody's.
std::string RunsText(const Certification& certification, bool details) {
  const int widest = details ? 30 : 6;
  std::string text =
      fmt::format("\n{:<10}{:>5} {:<{}}{:>8}{:>7}{:>7}{:>7}  {}\n",
                  "problem",
                  "start",
                  "solver",
                  widest,
                  "param.",
                  "sd",
                  "RSS",
                  "steps",
                  "stop");
  for (const auto& row : certification.nonlinear) {
    if (!details && row.solver != models::kDefaultSolver) continue;
    text += fmt::format("{:<10}{:>5} {:<{}}{:>8.2f}{:>7.2f}{:>7.2f}{:>7}  {}\n",
                        row.problem,
                        row.start,
                        row.solver,
                        widest,
                        row.lre_parameters,
                        row.lre_sd,
                        row.lre_rss,
                        row.iterations,
                        details ? row.stop + ": " + row.message : row.stop);
  }
  return text;
}

std::string LinearText(const Certification& certification,
                       const CertificationFloors& floors) {
  std::string text = fmt::format(
      "\nNIST StRD, linear, as errmap fit --model "
      "poly:formula=...:centred=no fits\nthe data's CSV; digits (LRE, at most "
      "15; floors {:.0f})\n"
      "{:<10}{:>8}{:>7}{:>7}{:>12}{:>6}\n",
      floors.linear_lre_coefficients,
      "problem",
      "coeff.",
      "sd",
      "RSS",
      "condition",
      "bits");
  for (const auto& row : certification.linear) {
    text += fmt::format("{:<10}{:>8.2f}{:>7.2f}{:>7.2f}{:>12.2g}{:>6}\n",
                        row.problem,
                        row.lre_coefficients,
                        row.lre_sd,
                        row.lre_rss,
                        row.condition,
                        row.bits);
  }
  return text;
}

std::string UnivariateText(const Certification& certification,
                           const CertificationFloors& floors) {
  std::string text = fmt::format(
      "\nNIST StRD, univariate; digits (LRE, at most 15; floors {:.0f}, from "
      "double data {:.0f})\n"
      "{:<10}{:>7}{:>7}{:>9}{:>6}{:>12}   {}\n",
      floors.univariate_lre,
      floors.univariate_double_lre,
      "problem",
      "mean",
      "sd",
      "autocor.",
      "bits",
      "condition",
      "from double data");
  for (const auto& row : certification.univariate) {
    text += fmt::format(
        "{:<10}{:>7.2f}{:>7.2f}{:>9.2f}{:>6}{:>12.2g}   {:.2f} {:.2f} {:.2f}\n",
        row.problem,
        row.lre_mean,
        row.lre_sd,
        row.lre_autocorrelation,
        row.bits,
        row.condition,
        row.lre_mean_double,
        row.lre_sd_double,
        row.lre_autocorrelation_double);
  }
  return text;
}

std::string GradientsText(const Certification& certification,
                          const CertificationFloors& floors,
                          bool details) {
  constexpr std::size_t kShown = 10;
  auto rows = certification.gradients;
  // NaN first: it is the worst.
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    const double x = a.worst_relative_error;
    const double y = b.worst_relative_error;
    return x != x ? y == y : x > y;
  });
  const std::size_t shown =
      details ? rows.size() : std::min(kShown, rows.size());
  std::string text = fmt::format(
      "\nGradients and Jacobians against Ridders extrapolation: {} checks,\n"
      "relative error at most {:.0e}\n",
      rows.size(),
      floors.gradient_relative_error);
  for (std::size_t i = 0; i < shown; ++i) {
    text += fmt::format(
        "{:<46}{:>9.1e}\n", rows[i].objective, rows[i].worst_relative_error);
  }
  if (shown < rows.size()) {
    text += fmt::format("... {} better ones (--details shows all)\n",
                        rows.size() - shown);
  }
  return text;
}

std::string AgreementText(const Certification& certification) {
  const auto lowest = std::ranges::min_element(
      certification.agreement, {}, &models::AgreementCertificate::objective);
  std::string text = fmt::format(
      "\nAgreement on one well-damped net from one start: how far the "
      "objective "
      "ends\nabove the lowest ({:.8g}), how far predictions are apart as a "
      "share "
      "of the\ntarget range, each beside its floor\n"
      "{:<29}{:>7}{:>6}{:>7}{:>6}{:>6} {}\n",
      lowest->objective,
      "solver",
      "above",
      "floor",
      "apart",
      "floor",
      "steps",
      "stop");
  for (const auto& row : certification.agreement) {
    text += fmt::format("{:<29}{:>7.0e}{:>6.0e}{:>7.0e}{:>6.0e}{:>6} {}\n",
                        row.solver,
                        row.difference,
                        row.most_difference,
                        row.prediction_difference,
                        row.most_prediction_difference,
                        row.iterations,
                        row.stop);
  }
  return text;
}

}  // namespace

std::string CertificationText(const Certification& certification,
                              const CertificationFloors& floors,
                              bool details) {
  std::string text;
  if (!certification.nonlinear.empty()) {
    text += SolversText(certification, floors, details);
    text += RunsText(certification, details);
  }
  if (!certification.linear.empty()) text += LinearText(certification, floors);
  if (!certification.univariate.empty()) {
    text += UnivariateText(certification, floors);
  }
  if (!certification.gradients.empty()) {
    text += GradientsText(certification, floors, details);
  }
  if (!certification.agreement.empty()) {
    text += AgreementText(certification);
  }
  if (text.starts_with('\n')) text.erase(0, 1);
  text += certification.passed() ? "\nPassed: every floor is reached.\n"
                                 : "\nNot passed:\n";
  for (const std::string& line : certification.missed) {
    text += "  " + line + "\n";
  }
  return text;
}

}  // namespace errmap::report
