#include "models/certification/certification_json.h"

#include "models/version.h"

namespace errmap::models {
namespace {

using Json = nlohmann::ordered_json;

Json FloorsJson(const CertificationFloors& floors) {
  return {{"nonlinear_solver", kDefaultSolver},
          {"nonlinear_solved", floors.nonlinear_solved},
          {"nonlinear_lre_parameters", floors.nonlinear_parameters},
          {"nonlinear_mean_lre_parameters", floors.nonlinear_mean_parameters},
          {"nonlinear_lre_sd", floors.nonlinear_sd},
          {"nonlinear_lre_rss", floors.nonlinear_rss},
          {"linear_lre_coefficients", floors.linear_coefficients},
          {"linear_lre_sd", floors.linear_sd},
          {"linear_lre_rss", floors.linear_rss},
          {"univariate_lre", floors.univariate},
          {"univariate_lre_sd_numacc4", floors.univariate_numacc4_sd},
          {"univariate_double_lre_mean", floors.univariate_double_mean},
          {"univariate_double_lre", floors.univariate_double},
          {"gradient_relative_error", floors.gradient_relative_error},
          {"agreement_difference", floors.agreement_objective},
          {"agreement_prediction_difference", floors.agreement_predictions}};
}

Json EstimatesJson(const std::vector<CertifiedEstimate>& estimates) {
  Json rows = Json::array();
  for (const CertifiedEstimate& row : estimates) {
    rows.push_back({{"name", row.name},
                    {"estimate", row.estimate},
                    {"standard_deviation", row.standard_deviation}});
  }
  return rows;
}

Json NonlinearJson(const Certification& certification) {
  Json rows = Json::array();
  for (const auto& row : certification.nonlinear) {
    rows.push_back({{"problem", row.problem},
                    {"start", row.start},
                    {"solver", row.solver},
                    {"lre_parameters", row.lre_parameters},
                    {"lre_sd", row.lre_sd},
                    {"lre_rss", row.lre_rss},
                    {"iterations", row.iterations},
                    {"stop", row.stop},
                    {"message", row.message},
                    {"estimates", EstimatesJson(row.estimates)},
                    {"rss", row.residual_sum_of_squares}});
  }
  return rows;
}

Json SummaryJson(const Certification& certification) {
  Json rows = Json::array();
  for (const auto& row : certification.nonlinear_summary) {
    const std::string fits = ModelsFittedBy(row.solver);
    rows.push_back({{"solver", row.solver},
                    {"fits", fits.empty() ? Json() : Json(fits)},
                    {"runs", row.runs},
                    {"solved", row.solved},
                    {"mean_lre_parameters", row.mean_lre_parameters},
                    {"mean_lre_sd", row.mean_lre_sd},
                    {"least_lre_parameters", row.least_lre_parameters}});
  }
  return rows;
}

Json LinearJson(const Certification& certification) {
  Json rows = Json::array();
  for (const auto& row : certification.linear) {
    rows.push_back({{"problem", row.problem},
                    {"model", row.model},
                    {"lre_coefficients", row.lre_coefficients},
                    {"lre_sd", row.lre_sd},
                    {"lre_rss", row.lre_rss},
                    {"condition", row.condition},
                    {"bits", row.bits},
                    {"estimates", EstimatesJson(row.estimates)},
                    {"rss", row.residual_sum_of_squares}});
  }
  return rows;
}

Json UnivariateJson(const Certification& certification) {
  Json rows = Json::array();
  for (const auto& row : certification.univariate) {
    rows.push_back(
        {{"problem", row.problem},
         {"lre_mean", row.lre_mean},
         {"lre_sd", row.lre_sd},
         {"lre_autocorrelation", row.lre_autocorrelation},
         {"mean", row.mean},
         {"sd", row.sd},
         {"autocorrelation", row.autocorrelation},
         {"condition", row.condition},
         {"bits", row.bits},
         {"lre_mean_double", row.lre_mean_double},
         {"lre_sd_double", row.lre_sd_double},
         {"lre_autocorrelation_double", row.lre_autocorrelation_double}});
  }
  return rows;
}

}  // namespace

Json CertificationJson(const Certification& certification,
                       const CertificationFloors& floors) {
  Json gradients = Json::array();
  for (const auto& row : certification.gradients) {
    gradients.push_back({{"objective", row.objective},
                         {"worst_relative_error", row.worst_relative_error}});
  }
  Json agreement = Json::array();
  for (const auto& row : certification.agreement) {
    agreement.push_back({{"solver", row.solver},
                         {"objective", row.objective},
                         {"difference", row.difference},
                         {"prediction_difference", row.prediction_difference},
                         {"iterations", row.iterations},
                         {"stop", row.stop},
                         {"judged", row.judged}});
  }
  return {{"schema", "errmap-certify-1"},
          {"version", Version()},
          {"passed", certification.passed()},
          {"missed", certification.missed},
          {"nonlinear", NonlinearJson(certification)},
          {"nonlinear_summary", SummaryJson(certification)},
          {"linear", LinearJson(certification)},
          {"univariate", UnivariateJson(certification)},
          {"gradients", gradients},
          {"agreement", agreement},
          {"floors", FloorsJson(floors)}};
}

}  // namespace errmap::models
