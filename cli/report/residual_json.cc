#include "cli/report/residual_json.h"

#include <algorithm>

#include "stats/summary.h"

namespace errmap::cli {
namespace {

using stats::TestResult;

Json TestJson(const char* statistic,
              const TestResult& test,
              const char* p = "p") {
  Json json = {{statistic, test.statistic}, {p, test.p}};
  if (!test.ok()) json["why"] = test.why_not;
  return json;
}

Json PpccJson(const stats::Normality& normality) {
  const TestResult& normal = normality.normal_ppcc;
  const TestResult& tukey = normality.tukey_ppcc;
  if (!tukey.ok()) {
    return {{"lambda", nullptr},
            {"r_max", nullptr},
            {"r_normal", nullptr},
            {"why", tukey.why_not}};
  }
  return {{"lambda", normality.curve.best_lambda},
          {"r_max", tukey.statistic},
          {"p_max", tukey.p},
          {"r_014", normality.curve.r_at_014},
          {"r_normal", normal.statistic},
          {"p_normal", normal.p}};
}

Json SerialJson(const stats::SerialTests& tests,
                const stats::SerialShuffles& shuffles) {
  Json runs = TestJson("z", tests.runs);
  Json lag1 = TestJson("r", tests.lag1);
  Json ljung_box = TestJson("q", tests.ljung_box);
  if (tests.runs.ok()) {
    runs["runs"] = tests.num_runs;
    runs["expected"] = tests.expected_runs;
  }
  if (tests.lag1.ok()) lag1["expected"] = tests.expected_lag1;
  if (tests.ljung_box.ok()) ljung_box["lags"] = tests.num_lags;
  Json json = {{"runs", std::move(runs)},
               {"lag1", std::move(lag1)},
               {"durbin_watson", TestJson("d", tests.durbin_watson)},
               {"ljung_box", std::move(ljung_box)}};
  if (shuffles.draws > 0) {
    json["shuffled"] = {{"draws", shuffles.draws},
                        {"runs", shuffles.runs},
                        {"lag1", shuffles.lag1},
                        {"durbin_watson", shuffles.durbin_watson},
                        {"ljung_box", shuffles.ljung_box}};
  }
  return json;
}

Json BiasJson(const NamedBias& named) {
  Json levels = Json::array();
  for (std::size_t i = 0; i < named.bias.levels.size(); ++i) {
    const stats::LevelBias& level = named.bias.levels[i];
    if (level.n == 0) continue;
    levels.push_back({{"level", named.labels[i]},
                      {"n", level.n},
                      {"mean", level.mean},
                      {"standard_error", level.standard_error}});
  }
  Json json = TestJson("f", named.bias.anova);
  json["column"] = named.column;
  json["explained"] = named.bias.explained;
  json["levels"] = std::move(levels);
  return json;
}

}  // namespace

Json NormalityJson(const stats::Normality& normality,
                   const stats::MonteCarloP& monte_carlo) {
  Json ks = TestJson("d", normality.ks, "p_given");
  ks["p_given_exact"] = normality.ks_exact.p;
  Json json = {
      {"ks", std::move(ks)},
      {"lilliefors", TestJson("d", normality.lilliefors)},
      {"shapiro_wilk", TestJson("w", normality.shapiro_wilk)},
      {"anderson_darling", TestJson("a2", normality.anderson_darling)},
      {"jarque_bera", TestJson("jb", normality.jarque_bera)},
      {"dagostino_pearson", TestJson("k2", normality.dagostino_pearson)},
      {"ppcc", PpccJson(normality)},
      {"dip", TestJson("dip", normality.dip)},
      {"skewness", normality.shape.skewness},
      {"kurtosis", normality.shape.kurtosis}};
  if (monte_carlo.draws > 0) {
    json["monte_carlo"] = {{"draws", monte_carlo.draws},
                           {"lilliefors", monte_carlo.lilliefors},
                           {"shapiro_wilk", monte_carlo.shapiro_wilk},
                           {"anderson_darling", monte_carlo.anderson_darling},
                           {"jarque_bera", monte_carlo.jarque_bera},
                           {"dagostino_pearson", monte_carlo.dagostino_pearson},
                           {"normal_ppcc", monte_carlo.normal_ppcc}};
  }
  return json;
}

Json RandomnessJson(const ResidualReport& report) {
  Json breusch_pagan;
  if (report.breusch_pagan) {
    breusch_pagan = TestJson("lm", *report.breusch_pagan);
    breusch_pagan["column"] = report.fitted_column;
  }
  return {{"order", report.order},
          {"in_order", SerialJson(report.whole, report.whole_shuffles)},
          {"within_groups",
           report.within ? SerialJson(*report.within, report.within_shuffles)
                         : Json()},
          {"halves", TestJson("d", report.halves)},
          {"by_group", report.by_group ? BiasJson(*report.by_group) : Json()},
          {"by_position",
           report.by_position ? BiasJson(*report.by_position) : Json()},
          {"breusch_pagan", std::move(breusch_pagan)}};
}

Json PlotsJson(const ResidualReport& report,
               const Eigen::VectorXd& values,
               Eigen::Index bins) {
  Eigen::VectorXd sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto array = [](const Eigen::VectorXd& numbers) {
    return Json(std::vector<double>(numbers.begin(), numbers.end()));
  };
  const stats::Histogram histogram = stats::MakeHistogram(sorted, bins);
  Json json = {{"histogram",
                {{"low", histogram.low},
                 {"width", histogram.width},
                 {"counts", histogram.counts}}}};
  if (report.normality.tukey_ppcc.ok()) {
    json["standardised"] = array(stats::Standardise(values));
    json["tukey_ppcc"] = {{"lambda", array(report.normality.curve.lambda)},
                          {"r", array(report.normality.curve.r)}};
    json["normal_probability_plot"] = {
        {"quantile", array(stats::NormalMedians(sorted.size()))},
        {"value", array(sorted)}};
  }
  return json;
}

}  // namespace errmap::cli
