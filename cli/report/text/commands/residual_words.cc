#include "cli/report/text/commands/residual_words.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "cli/report/number_text.h"

namespace errmap::report {
namespace {

using Eigen::Index;
using stats::TestResult;

// The usual levels: what a reader takes for a hint and for evidence.
constexpr double kHint = 0.05;
constexpr double kEvidence = 0.01;

// How many of the tests that estimate mean and sd reject at a level.
struct Rejections {
  int tests = 0;
  int at_hint = 0;
  int at_evidence = 0;
  std::string names;  // of those that reject at kHint
};

Rejections CountRejections(const stats::Normality& normality) {
  const std::pair<const char*, const TestResult*> tests[] = {
      {"Lilliefors", &normality.lilliefors},
      {"Shapiro-Wilk", &normality.shapiro_wilk},
      {"Anderson-Darling", &normality.anderson_darling},
      {"Jarque-Bera", &normality.jarque_bera},
      {"D'Agostino-Pearson", &normality.dagostino_pearson},
      {"probability plot", &normality.normal_ppcc}};
  Rejections count;
  for (const auto& [name, test] : tests) {
    if (!test->ok()) continue;
    ++count.tests;
    if (test->p > kHint) continue;
    ++count.at_hint;
    count.names += (count.names.empty() ? "" : ", ") + std::string(name);
    if (test->p <= kEvidence) ++count.at_evidence;
  }
  return count;
}

bool Shows(const TestResult& test) { return test.ok() && test.p <= kEvidence; }

std::string ShapeSentence(const stats::Normality& normality, Index values) {
  const Rejections count = CountRejections(normality);
  if (values < stats::kFewestForShape) {
    return Count(values, "value") + (values == 1 ? " is" : " are") +
           " too few for any test of shape.";
  }
  if (count.tests == 0) {
    return "Nothing can be said of the shape: " + normality.lilliefors.why_not +
           ".";
  }
  const std::string tests =
      Count(count.tests, "test") + " for an estimated mean and sd";
  const auto reject = [](int number) {
    return fmt::format("{} {}", number, number == 1 ? "rejects" : "reject");
  };
  if (count.at_hint == 0) {
    return fmt::format(
        "The shape is consistent with a normal distribution: of {}, none "
        "rejects at 5 %.",
        tests);
  }
  if (count.at_evidence == 0) {
    return fmt::format(
        "The shape is close to normal: of {}, {} at 5 % ({}), none at 1 %.",
        tests,
        reject(count.at_hint),
        count.names);
  }
  return fmt::format(
      "The shape is {}: of {}, {} at 1 %.",
      2 * count.at_evidence > count.tests ? "not normal" : "doubtful",
      tests,
      reject(count.at_evidence));
}

std::string StepSentence(const stats::Normality& normality,
                         const data::Unit& unit) {
  if (!(normality.step > 0.0)) return "";
  return fmt::format(
      "The values come in steps of {}. Each test of shape compares them with "
      "normal samples rounded the same way.",
      ErrorText(unit, normality.step).WithUnit(normality.step));
}

std::string ModesSentence(const stats::Normality& normality) {
  if (!Shows(normality.dip)) return "";
  return "It has more than one mode (dip).";
}

std::string Report1995Sentence(const stats::Normality& normality,
                               const stats::ErrorMetrics& summary,
                               const stats::Report1995Statistics& printed) {
  if (!normality.ks.ok() || !normality.lilliefors.ok() || !(printed.sd > 0.0)) {
    return "";
  }
  const bool said_normal = printed.ks_probability > kHint;
  const bool is_normal = normality.lilliefors.p > kHint;
  const std::string figures = fmt::format(
      "sd {:.3f} and mean {:.3f} of the true ones, K-S D {:.4f}, not {:.4f}, p "
      "{:.2g}",
      printed.sd / summary.sd,
      summary.mean == 0.0 ? 1.0 : printed.mean / summary.mean,
      printed.ks_d,
      normality.ks.statistic,
      printed.ks_probability);
  const std::string said = fmt::format(
      "The 1995 program divides by 2(n + 1), not n: {}. So it calls them {}",
      figures,
      said_normal ? "normal" : "not normal");
  if (said_normal == is_normal) return said + ". Lilliefors' test agrees.";
  // What its own test says with the right divisors tells what they are to
  // blame for.
  if ((normality.ks.p > kHint) == said_normal) {
    return said + fmt::format(
                      ", as it would with the right divisors (p {:.2g}): it "
                      "takes mean and sd as given. Lilliefors' test allows for "
                      "their estimate: p {:.2g}.",
                      normality.ks.p,
                      normality.lilliefors.p);
  }
  return said +
         fmt::format(
             ". With the right divisors, p is {:.2g} by Lilliefors' test{}.",
             normality.lilliefors.p,
             CountRejections(normality).at_evidence > 0
                 ? ", but other tests reject at 1 %"
                 : ": the wrong divisors changed the verdict");
}

// The tests of order that show memory, by name.
std::string TestsThatShowMemory(const stats::SerialTests& tests) {
  const std::pair<const char*, const TestResult*> all[] = {
      {"runs", &tests.runs},
      {"lag-1 autocorrelation", &tests.lag1},
      {"Durbin-Watson", &tests.durbin_watson},
      {"Ljung-Box", &tests.ljung_box}};
  std::string names;
  for (const auto& [name, test] : all) {
    if (!Shows(*test)) continue;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return names;
}

std::string MemorySentence(const models::ResidualReport& report,
                           const stats::ErrorMetrics& summary) {
  const stats::SerialTests& whole = report.whole;
  if (!whole.lag1.ok()) return "";
  const std::string shown_by = TestsThatShowMemory(whole);
  const std::string runs = whole.runs.ok()
                               ? fmt::format(
                                     ", {} runs about the median where {:.0f} "
                                     "are expected",
                                     whole.num_runs,
                                     whole.expected_runs)
                               : "";
  const std::string figures =
      fmt::format("lag-1 autocorrelation {:.2f}{}", whole.lag1.statistic, runs);
  if (shown_by.empty()) {
    return fmt::format("The order shows no autocorrelation ({}).", figures);
  }
  std::string text =
      fmt::format("They are not independent: {}. Tests that reject at 1 %: {}.",
                  figures,
                  shown_by);
  const double r = whole.lag1.statistic;
  if (r > 0.0 && r < 1.0) {
    text += fmt::format(
        " For the mean they count as about {:.0f} independent values, not {} "
        "(first-order autoregression). Any p that assumes independence is only "
        "a guide.",
        static_cast<double>(summary.n) * (1.0 - r) / (1.0 + r),
        summary.n);
  }
  return text;
}

std::string BiasSentence(const models::NamedBias& named,
                         const std::string& noun,
                         const data::Unit& unit,
                         double sd) {
  if (!Shows(named.bias.anova)) return "";
  const auto& levels = named.bias.levels;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    if (levels[i].n == 0) continue;
    if (levels[worst].n == 0 ||
        std::abs(levels[i].mean) > std::abs(levels[worst].mean)) {
      worst = i;
    }
  }
  const ErrorText error(unit, sd);
  return fmt::format(
      "Their mean depends on {}, which explains {:.0f} % of the sum of "
      "squares. The largest mean, {} at {} {}, is {:.1f} standard errors.",
      noun,
      100.0 * named.bias.explained,
      error.WithUnit(levels[worst].mean),
      noun,
      named.labels[worst],
      std::abs(levels[worst].mean) / levels[worst].standard_error);
}

std::string WithinSentence(const models::ResidualReport& report) {
  if (!report.within || !report.within->lag1.ok()) return "";
  const stats::SerialTests& within = *report.within;
  const bool memory = !TestsThatShowMemory(within).empty();
  return fmt::format(
      "Within a {}, about its mean, {} ({:.2f} at lag 1, expected {:.2f}).",
      report.group_column,
      memory ? "some autocorrelation is left" : "no autocorrelation is left",
      within.lag1.statistic,
      within.expected_lag1);
}

std::string SpreadSentence(const models::ResidualReport& report) {
  if (!report.breusch_pagan || !Shows(*report.breusch_pagan)) return "";
  return "Their spread changes with " + report.fitted_column + ".";
}

}  // namespace

std::string ResidualSentences(const models::ResidualReport& report,
                              const stats::ErrorMetrics& summary,
                              const stats::Report1995Statistics& printed,
                              const data::Unit& unit) {
  std::vector<std::string> sentences = {
      ShapeSentence(report.normality, summary.n),
      StepSentence(report.normality, unit),
      ModesSentence(report.normality),
      Report1995Sentence(report.normality, summary, printed),
      MemorySentence(report, summary)};
  if (report.by_group) {
    sentences.push_back(BiasSentence(
        *report.by_group, report.by_group->column, unit, summary.sd));
  }
  if (report.by_position) {
    sentences.push_back(BiasSentence(
        *report.by_position, report.by_position->column, unit, summary.sd));
  }
  sentences.push_back(WithinSentence(report));
  sentences.push_back(SpreadSentence(report));
  std::string text;
  for (const std::string& sentence : sentences) {
    if (sentence.empty()) continue;
    text += (text.empty() ? "" : " ") + sentence;
  }
  return text;
}

}  // namespace errmap::report
