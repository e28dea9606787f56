#include "cli/commands/residual_json.h"

#include <algorithm>

#include "stats/summary.h"

namespace errmap::cli {

Json PlotsJson(const models::ResidualReport& report,
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
