#include "cli/report/text/commands/certify_text.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/report/table.h"

namespace errmap::report {
namespace {

using models::Certification;
using models::CertificationFloors;

// Columns of figures stand close; those of words behind them have a gap.
Table::Column Figures(const char* name, std::size_t width) {
  return {.name = name, .width = width, .gap = 0};
}
Table::Column Words(const char* name, std::size_t width, std::size_t gap = 2) {
  return {.name = name, .is_number = false, .width = width, .gap = gap};
}

// Digits, or another number of two decimals.
Fixed Digits(double value) { return {value, 2}; }

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
  Table table{.nothing = "nan"};
  for (const auto& row : certification.nonlinear_summary) {
    std::vector<Table::Named> cells = {
        {Words("solver", 30), row.solver},
        {Figures("solved", 7), fmt::format("{}/{}", row.solved, row.runs)},
        {Figures("floor", 7), std::int64_t{row.floor_solved}},
        {Figures("mean", 7), Digits(row.mean_lre_parameters)},
        {Figures("floor", 7), Digits(row.floor_mean_lre_parameters)},
        {Figures("least", 7), Digits(row.least_lre_parameters)},
        {Figures("sd", 7), Digits(row.mean_lre_sd)}};
    if (details) {
      cells.push_back(
          {Words("runs ended with", 0), Stops(certification, row.solver)});
    }
    table.Add(std::move(cells));
  }
  return text + TerminalTable(table) +
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
  const std::size_t widest = details ? 30 : 6;
  Table table{.nothing = "nan"};
  for (const auto& row : certification.nonlinear) {
    if (!details && row.solver != models::kDefaultSolver) continue;
    table.Add({{Words("problem", 10), row.problem},
               {Figures("start", 5), std::int64_t{row.start}},
               {Words("solver", widest, 1), row.solver},
               {Figures("param.", 8), Digits(row.lre_parameters)},
               {Figures("sd", 7), Digits(row.lre_sd)},
               {Figures("RSS", 7), Digits(row.lre_rss)},
               {Figures("steps", 7), row.iterations},
               {Words("stop", 0),
                details ? row.stop + ": " + row.message : row.stop}});
  }
  return "\n" + TerminalTable(table);
}

std::string LinearText(const Certification& certification,
                       const CertificationFloors& floors) {
  Table table{.nothing = "nan"};
  for (const auto& row : certification.linear) {
    table.Add({{Words("problem", 10), row.problem},
               {Figures("coeff.", 8), Digits(row.lre_coefficients)},
               {Figures("sd", 7), Digits(row.lre_sd)},
               {Figures("RSS", 7), Digits(row.lre_rss)},
               {Figures("condition", 12), Number{row.condition, 2}},
               {Figures("bits", 6), std::int64_t{row.bits}}});
  }
  return fmt::format(
             "\nNIST StRD, linear, as errmap fit --model "
             "poly:formula=...:centred=no fits\nthe data's CSV; digits (LRE, "
             "at most 15; floors {:.0f})\n",
             floors.linear_lre_coefficients) +
         TerminalTable(table);
}

std::string UnivariateText(const Certification& certification,
                           const CertificationFloors& floors) {
  Table table{.nothing = "nan"};
  for (const auto& row : certification.univariate) {
    table.Add({{Words("problem", 10), row.problem},
               {Figures("mean", 7), Digits(row.lre_mean)},
               {Figures("sd", 7), Digits(row.lre_sd)},
               {Figures("autocor.", 9), Digits(row.lre_autocorrelation)},
               {Figures("bits", 6), std::int64_t{row.bits}},
               {Figures("condition", 12), Number{row.condition, 2}},
               {Words("from double data", 0, 3),
                fmt::format("{:.2f} {:.2f} {:.2f}",
                            row.lre_mean_double,
                            row.lre_sd_double,
                            row.lre_autocorrelation_double)}});
  }
  return fmt::format(
             "\nNIST StRD, univariate; digits (LRE, at most 15; floors "
             "{:.0f}, from double data {:.0f})\n",
             floors.univariate_lre,
             floors.univariate_double_lre) +
         TerminalTable(table);
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
  const auto rounded = [](double share) {
    return fmt::format("{:.0e}", share);
  };
  Table table;
  for (const auto& row : certification.agreement) {
    table.Add({{Words("solver", 29), row.solver},
               {Figures("above", 7), rounded(row.difference)},
               {Figures("floor", 6), rounded(row.most_difference)},
               {Figures("apart", 7), rounded(row.prediction_difference)},
               {Figures("floor", 6), rounded(row.most_prediction_difference)},
               {Figures("steps", 6), row.iterations},
               {Words("stop", 0, 1), row.stop}});
  }
  return fmt::format(
             "\nAgreement on one well-damped net from one start. Beside their "
             "floors: objective\nabove the lowest ({:.8g}), and predictions "
             "apart, as a share of the target range.\n",
             lowest->objective) +
         TerminalTable(table);
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
