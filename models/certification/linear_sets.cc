#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/text.h"
#include "models/certification/certification.h"
#include "models/certification/strd_functions.h"
#include "models/recipe_catalog.h"
#include "models/regression_record.h"
#include "stats/extended_summary.h"
#include "stats/lre.h"
#include "stats/summary.h"

namespace errmap::models {
namespace {

using fitting::ExtendedVector;

double Lre(double value, const std::string& certified) {
  return stats::LogRelativeError(
      value, stats::ParseDoubleDouble(certified).hi, stats::kLreCapLinear);
}

// The problem's data as the CSV file that a user would have of them.
std::string CsvText(const data::StrdProblem& problem) {
  std::string text = data::JoinWords(problem.columns, ",") + "\n";
  for (const std::vector<std::string>& row : problem.rows) {
    text += data::JoinWords(row, ",") + "\n";
  }
  return text;
}

// The model as a user would ask for it; --target is the first column.
std::string FormulaSpec(const data::StrdProblem& problem) {
  std::vector<std::string> terms;
  bool intercept = true;
  if (problem.design == data::StrdDesign::kPowers) {
    intercept = problem.low_power == 0;
    for (int k = std::max(1, problem.low_power); k <= problem.high_power; ++k) {
      terms.push_back(fmt::format("{}^{}", problem.columns[1], k));
    }
  } else {
    terms.assign(problem.columns.begin() + 1, problem.columns.end());
  }
  return fmt::format("poly:formula={}:centred=no{}",
                     data::JoinWords(terms, "+"),
                     intercept ? "" : ":intercept=no");
}

// What `errmap fit` makes of the problem, from its text on.
LinearCertificate Certify(const data::StrdProblem& problem) {
  LinearCertificate row{.problem = problem.name, .model = FormulaSpec(problem)};
  // By name, or a column that only counts would be left out.
  const data::PreparedDataset prepared = data::MakeDataset(
      data::ParseCsv(CsvText(problem), problem.name + ".csv"),
      {.target = problem.columns[0],
       .inputs = {problem.columns.begin() + 1, problem.columns.end()}});
  const FittedModel fitted =
      MakeRecipe(row.model)->Fit(prepared.dataset, {.explain = true});
  for (const CoefficientRecord& line : fitted.regression->coefficients) {
    row.estimates.push_back({line.term, line.estimate, line.standard_error});
  }
  const auto count = std::ssize(row.estimates);
  VectorXd coefficients(count);
  VectorXd deviations(count);
  for (Index j = 0; j < count; ++j) {
    const CertifiedEstimate& found = row.estimates[static_cast<std::size_t>(j)];
    coefficients[j] = found.estimate;
    deviations[j] = found.standard_deviation;
  }
  const LeastSquaresRecord& fit = *fitted.regression->least_squares.value;
  row.rss = fit.anova.residual_ss;
  row.lre_coefficients = stats::SmallestLogRelativeError(
      coefficients, CertifiedParameters(problem), stats::kLreCapLinear);
  row.lre_sd = stats::SmallestLogRelativeError(
      deviations, CertifiedDeviations(problem), stats::kLreCapLinear);
  row.lre_rss = Lre(row.rss, problem.residual_sum_of_squares);
  row.condition = fit.condition;
  row.bits = static_cast<int>(fit.bits);
  return row;
}

}  // namespace

void CertifyLinear(Certification* certification) {
  for (const data::StrdProblem& problem : data::StrdProblems()) {
    if (problem.kind != data::StrdKind::kLinear) continue;
    certification->linear.push_back(Certify(problem));
  }
}

void CertifyUnivariate(Certification* certification) {
  // Double data give this much of the 13 digits wanted, and a digit in hand.
  constexpr double kWanted = 1e-14;
  for (const data::StrdProblem& problem : data::StrdProblems()) {
    if (problem.kind != data::StrdKind::kUnivariate) continue;
    const ExtendedVector sample = StrdColumn(problem, 0);
    const VectorXd doubles = sample.cast<double>();
    const stats::SampleSummary plain = stats::Summarize(doubles);
    const stats::ExtendedSummary extended = stats::SummarizeExtended(sample);
    UnivariateCertificate row{.problem = problem.name};
    row.condition = extended.condition;
    const double lag_one = stats::LagOneAutocorrelation(doubles);
    row.lre_mean_double = Lre(plain.mean, problem.mean);
    row.lre_sd_double = Lre(plain.sd, problem.standard_deviation);
    row.lre_autocorrelation_double = Lre(lag_one, problem.autocorrelation);
    const bool by_doubles =
        row.condition * std::ldexp(1.0, -stats::kDoubleBits) <= kWanted;
    row.bits = by_doubles ? stats::kDoubleBits : stats::kDoubleDoubleBits;
    row.mean = by_doubles ? plain.mean : extended.mean.hi;
    row.sd = by_doubles ? plain.sd : extended.sd.hi;
    row.autocorrelation = by_doubles ? lag_one : extended.autocorrelation.hi;
    row.lre_mean = Lre(row.mean, problem.mean);
    row.lre_sd = Lre(row.sd, problem.standard_deviation);
    row.lre_autocorrelation = Lre(row.autocorrelation, problem.autocorrelation);
    certification->univariate.push_back(row);
  }
}

}  // namespace errmap::models
