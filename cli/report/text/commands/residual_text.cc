#include "cli/report/text/commands/residual_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "cli/report/number_text.h"
#include "stats/normality/simulated_quantiles.h"
#include "stats/summary.h"

namespace errmap::report {
namespace {

using stats::TestResult;

// Honest where a table of simulated p ends.
std::string SimulatedP(double p) {
  if (p <= stats::kSmallestSimulated) return "<0.001";
  return p >= stats::kLargestSimulated ? ">0.999" : PText(p);
}

// Distances and correlations to five decimals, all else to five digits.
std::string StatisticText(double statistic) {
  return std::abs(statistic) < 1.0 ? fmt::format("{:.5f}", statistic)
                                   : fmt::format("{:.5g}", statistic);
}

std::string InUnit(double value, const data::Unit& unit) {
  if (!std::isfinite(value)) return "n/a";
  return WithSymbol(fmt::format("{:.5g}", value * unit.display_scale),
                    unit.display_symbol);
}

std::string Heading(const char* title,
                    const char* first,
                    const char* second,
                    const char* third) {
  return fmt::format("{:<22}{:>11} {:>9}  {}\n", title, first, second, third);
}

std::string TestLine(const char* name,
                     const TestResult& test,
                     const std::string& symbol,
                     const std::string& assumes,
                     bool from_table = false,
                     double monte_carlo = std::nan("")) {
  if (!test.ok()) return fmt::format("  {:<20} n/a: {}\n", name, test.why_not);
  return fmt::format(
      "  {:<20}{:>11} {:>9}  {}\n",
      name,
      symbol + (symbol.empty() ? "" : " ") + StatisticText(test.statistic),
      from_table ? SimulatedP(test.p) : PText(test.p),
      std::isnan(monte_carlo) ? assumes
                              : "by Monte Carlo " + PText(monte_carlo));
}

std::string CriticalText(double (*critical)(double, Eigen::Index),
                         Eigen::Index n) {
  // Two digits of what is missing to 1, at least four decimals.
  const double strict = critical(0.01, n);
  const int decimals =
      std::max(4, 1 - static_cast<int>(std::floor(std::log10(1.0 - strict))));
  return fmt::format(
      "    5 % and 1 % of normal samples lie below {:.{}f} and {:.{}f}\n",
      critical(0.05, n),
      decimals,
      strict,
      decimals);
}

std::string SerialCells(const TestResult& test, const std::string& shown) {
  if (!test.ok()) return fmt::format("{:>21}", "n/a");
  return fmt::format("{:>11} {:>9}", shown, PText(test.p));
}

std::string SerialLine(const models::ResidualReport& report,
                       const std::string& name,
                       TestResult stats::SerialTests::*member) {
  const auto cells = [&](const stats::SerialTests& tests) {
    const TestResult& test = tests.*member;
    std::string shown = fmt::format("{:.4g}", test.statistic);
    if (member == &stats::SerialTests::runs) {
      shown = fmt::format("{} of {:.0f}", tests.num_runs, tests.expected_runs);
    }
    return SerialCells(test, shown);
  };
  const TestResult& whole = report.whole.*member;
  if (!whole.ok()) {
    return fmt::format("  {:<21} n/a: {}\n", name, whole.why_not);
  }
  return fmt::format("  {:<21}{}{}\n",
                     name,
                     cells(report.whole),
                     report.within ? "    " + cells(*report.within) : "");
}

std::string ShuffledLine(const char* where,
                         const stats::SerialShuffles& shuffles) {
  return fmt::format(
      "  shuffled {} {} times, p: runs {}, lag-1 autocorrelation {},\n    "
      "Durbin-Watson {}, Ljung-Box {}\n",
      where,
      shuffles.draws,
      PText(shuffles.runs),
      PText(shuffles.lag1),
      PText(shuffles.durbin_watson),
      PText(shuffles.ljung_box));
}

std::string BiasLine(const models::NamedBias& named) {
  const TestResult& anova = named.bias.anova;
  const std::string name = "by " + named.column;
  if (!anova.ok()) {
    return fmt::format("  {:<20} n/a: {}\n", name, anova.why_not);
  }
  return fmt::format(
      "  {:<20}{:>11} {:>9}  {:.0f} % explained; normal, one sd\n",
      name,
      fmt::format("F {:.4g}", anova.statistic),
      PText(anova.p),
      100.0 * named.bias.explained);
}

std::string BiasTable(const models::NamedBias& named, const data::Unit& unit) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const stats::LevelBias& level : named.bias.levels) {
    if (level.standard_error > 0.0) {
      smallest = std::min(smallest, level.standard_error);
    }
  }
  const ErrorText error(unit, smallest);
  std::string text = fmt::format("\n{:<14}{:>5} {:>10} {:>10}   {}\n",
                                 named.column,
                                 "n",
                                 "mean",
                                 "+-",
                                 error.symbol());
  for (std::size_t i = 0; i < named.bias.levels.size(); ++i) {
    const stats::LevelBias& level = named.bias.levels[i];
    if (level.n == 0) continue;
    text += fmt::format("{:<14}{:>5} {:>10} {:>10}\n",
                        named.labels[i],
                        level.n,
                        error(level.mean),
                        error(level.standard_error));
  }
  return text;
}

std::string HistogramText(const Eigen::VectorXd& values,
                          const data::Unit& unit,
                          Eigen::Index bins) {
  constexpr double kWidest = 50.0;
  Eigen::VectorXd sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const stats::Histogram histogram = stats::MakeHistogram(sorted, bins);
  const auto most =
      *std::max_element(histogram.counts.begin(), histogram.counts.end());
  const ErrorText error(unit, histogram.width);
  std::string text =
      fmt::format("\nhistogram, {} of width {}\n",
                  Count(static_cast<long long>(histogram.counts.size()), "bin"),
                  error.WithUnit(histogram.width));
  for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
    const double share =
        static_cast<double>(histogram.counts[i]) / static_cast<double>(most);
    text += fmt::format(
        "{:>12} {:>6} {}\n",
        error(histogram.low + histogram.width * static_cast<double>(i)),
        histogram.counts[i],
        std::string(static_cast<std::size_t>(std::lround(kWidest * share)),
                    '#'));
  }
  return text;
}

std::string ProbabilityPlotText(const stats::Normality& normality) {
  if (!normality.tukey_ppcc.ok()) return "";
  std::string text = "\nTukey lambda   r\n";
  for (Eigen::Index i = 0; i < normality.curve.lambda.size(); i += 2) {
    text += fmt::format("{:>12.2f}   {:.6f}\n",
                        normality.curve.lambda[i],
                        normality.curve.r[i]);
  }
  return text;
}

}  // namespace

std::string SampleText(const stats::ErrorMetrics& metrics,
                       const Eigen::VectorXd& values,
                       const stats::ShapeMoments& shape,
                       const data::Unit& unit) {
  Eigen::VectorXd sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto line = [](const char* label, const std::string& text) {
    return fmt::format("  {:<10} {}\n", label, text);
  };
  std::string text;
  text += line(
      "mean",
      fmt::format("{}  +- {} (standard error of independent values)",
                  InUnit(metrics.mean, unit),
                  InUnit(stats::StandardError(metrics.sd, metrics.n), unit)));
  text += line("sd",
               fmt::format("{}  (n - 1);  rmse {}  (n);  mae {}",
                           InUnit(metrics.sd, unit),
                           InUnit(metrics.rmse, unit),
                           InUnit(metrics.mae, unit)));
  text += line("min .. max",
               fmt::format("{} .. {}, range {}",
                           InUnit(metrics.min, unit),
                           InUnit(metrics.max, unit),
                           InUnit(metrics.range, unit)));
  text += line("quartiles",
               fmt::format("{}, {}, {}  (type 7)",
                           InUnit(stats::Quantile(sorted, 0.25), unit),
                           InUnit(stats::Quantile(sorted, 0.5), unit),
                           InUnit(stats::Quantile(sorted, 0.75), unit)));
  if (std::isfinite(shape.skewness)) {
    text += line("skewness",
                 fmt::format("{:.4g}, kurtosis {:.4g}  (m3/m2^1.5, m4/m2^2; "
                             "normal: 0, 3)",
                             shape.skewness,
                             shape.kurtosis));
  }
  return text;
}

std::string NormalityText(const models::ResidualReport& report,
                          Eigen::Index n,
                          const data::Unit& unit) {
  const stats::Normality& tests = report.normality;
  const bool simulated = report.monte_carlo.draws > 0;
  const bool rounded = tests.step > 0.0;
  const stats::MonteCarloP& drawn = report.monte_carlo;
  const double none = std::nan("");
  const auto line = [&](const char* name,
                        const TestResult& test,
                        const char* symbol,
                        const std::string& assumes,
                        double monte_carlo,
                        bool from_table = false) {
    return TestLine(name,
                    test,
                    symbol,
                    rounded ? "normal samples rounded alike" : assumes,
                    from_table && !rounded,
                    simulated ? monte_carlo : none);
  };
  std::string text = Heading("normal?", "statistic", "p", "what p assumes");
  text +=
      TestLine("K-S, Eq. 140", tests.ks, "D", "mean and sd given; asymptotic");
  text += TestLine("K-S, finite n", tests.ks_exact, "D", "the same; exact");
  text += line("Lilliefors",
               tests.lilliefors,
               "D",
               "mean and sd estimated; simulated",
               drawn.lilliefors);
  text += line("Shapiro-Wilk",
               tests.shapiro_wilk,
               "W",
               "the same; Royston's fit",
               drawn.shapiro_wilk);
  text += line("Anderson-Darling",
               tests.anderson_darling,
               "A2",
               "the same; Stephens' fit",
               drawn.anderson_darling);
  text += line("Jarque-Bera",
               tests.jarque_bera,
               "JB",
               "the same; many values",
               drawn.jarque_bera);
  text += line("D'Agostino-Pearson",
               tests.dagostino_pearson,
               "K2",
               "the same; nearly chi-squared",
               drawn.dagostino_pearson);
  text += line("probability plot",
               tests.normal_ppcc,
               "r",
               "the same; simulated",
               drawn.normal_ppcc,
               true);
  const bool has_critical = tests.tukey_ppcc.ok() && !rounded;
  if (has_critical) text += CriticalText(&stats::CriticalNormalPpcc, n);
  text += TestLine("Tukey family's best",
                   tests.tukey_ppcc,
                   "r",
                   tests.tukey_ppcc.ok()
                       ? fmt::format("lambda {:.3f}; at 0.14 r {:.5f}",
                                     tests.curve.best_lambda,
                                     tests.curve.r_at_014)
                       : "",
                   !rounded);
  if (has_critical) text += CriticalText(&stats::CriticalTukeyPpcc, n);
  text +=
      line("one mode (dip)", tests.dip, "", "one mode; simulated", none, true);
  text +=
      "  All p assume independent values. Those of K-S are too large here, "
      "where mean\n  and sd are estimated.\n";
  if (rounded) {
    text +=
        fmt::format("  Steps of {}: p by {} normal samples rounded alike.\n",
                    InUnit(tests.step, unit),
                    stats::kGridDraws);
  }
  if (simulated) {
    text += fmt::format("  Monte Carlo: share of {} normal samples.\n",
                        drawn.draws);
  }
  return text;
}

std::string RandomnessText(const models::ResidualReport& report) {
  const stats::SerialTests& whole = report.whole;
  std::string text =
      fmt::format("{:<23}{:>11} {:>9}", "random?", "in order", "p");
  std::string lags = fmt::format("Ljung-Box, {}", whole.num_lags);
  if (report.within) {
    text += fmt::format("{:>15} {:>9}", "within " + report.group_column, "p");
    lags += fmt::format(" and {}", report.within->num_lags);
  }
  text += "\n";
  text += SerialLine(report, "runs about median", &stats::SerialTests::runs);
  text +=
      SerialLine(report, "lag-1 autocorrelation", &stats::SerialTests::lag1);
  text +=
      SerialLine(report, "Durbin-Watson", &stats::SerialTests::durbin_watson);
  text += SerialLine(report, lags, &stats::SerialTests::ljung_box);
  if (report.whole_shuffles.draws > 0) {
    text += ShuffledLine("in all", report.whole_shuffles);
  }
  if (report.within_shuffles.draws > 0) {
    text += ShuffledLine("within groups", report.within_shuffles);
  }
  text +=
      "  All p assume independent values: normal ones except for runs, many "
      "for\n  Ljung-Box.\n";
  text +=
      TestLine("halves alike (K-S)", report.halves, "D", "any distribution");
  if (report.by_group) text += BiasLine(*report.by_group);
  if (report.by_position) text += BiasLine(*report.by_position);
  if (report.breusch_pagan) {
    text += TestLine("Breusch-Pagan",
                     *report.breusch_pagan,
                     "LM",
                     "spread along " + report.fitted_column);
  }
  return text;
}

std::string DetailsText(const models::ResidualReport& report,
                        const Eigen::VectorXd& values,
                        const data::Unit& unit,
                        Eigen::Index bins) {
  std::string text;
  if (report.by_group) text += BiasTable(*report.by_group, unit);
  if (report.by_position) text += BiasTable(*report.by_position, unit);
  text += HistogramText(values, unit, bins);
  return text + ProbabilityPlotText(report.normality);
}

std::string Report1995Text(const stats::Report1995Statistics& printed,
                           double r_squared,
                           const data::Unit& unit) {
  const auto line = [&](const char* label, double value) {
    return WithSymbol(fmt::format(
                          "  {:<10} {:.6g}", label, value * unit.display_scale),
                      unit.display_symbol) +
           "\n";
  };
  std::string text = fmt::format(
      "as the 1995 program prints it (single precision). Its sums are divided\n"
      "by (n+1)*2 = {}, not n, so mean and sd are too small and D is wrong:\n",
      (printed.n + 1) * 2);
  if (std::isfinite(r_squared)) {
    text += fmt::format("  {:<10} {:.6f}\n", "R-SQ", r_squared);
  }
  text += line("mean", printed.mean) + line("sd", printed.sd) +
          line("min", printed.min) + line("max", printed.max);
  return text + fmt::format("  {:<10} {:.6f}, p {:.6g}\n",
                            "K-S D",
                            printed.ks_d,
                            printed.ks_probability);
}

}  // namespace errmap::report
