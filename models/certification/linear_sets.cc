#include <cmath>

#include "fitting/least_squares/extended_least_squares.h"
#include "models/certification/certification.h"
#include "models/certification/strd_functions.h"
#include "stats/extended_summary.h"
#include "stats/lre.h"
#include "stats/summary.h"

namespace errmap::models {
namespace {

using fitting::ExtendedMatrix;
using fitting::ExtendedVector;

double Number(const std::string& text) {
  return stats::ParseDoubleDouble(text).hi;
}

ExtendedMatrix Design(const data::StrdProblem& problem) {
  if (problem.design == data::StrdDesign::kPowers) {
    return fitting::PowersDesign(
        StrdColumn(problem, 1), problem.low_power, problem.high_power);
  }
  ExtendedMatrix design(static_cast<Eigen::Index>(problem.rows.size()),
                        static_cast<Eigen::Index>(problem.columns.size()));
  design.col(0).setOnes();
  for (std::size_t j = 1; j < problem.columns.size(); ++j) {
    design.col(static_cast<Eigen::Index>(j)) = StrdColumn(problem, j);
  }
  return design;
}

double Lre(const stats::DoubleDouble& value, const std::string& certified) {
  return stats::LogRelativeError(
      value.hi, Number(certified), stats::kLreCapLinear);
}

}  // namespace

void CertifyLinear(Certification* certification) {
  for (const data::StrdProblem& problem : data::StrdProblems()) {
    if (problem.kind != data::StrdKind::kLinear) continue;
    const fitting::ExtendedLeastSquaresFit fit =
        fitting::SolveExtendedLeastSquares(Design(problem),
                                           StrdColumn(problem, 0));
    certification->linear.push_back(
        {.problem = problem.name,
         .lre_coefficients =
             stats::SmallestLogRelativeError(fit.coefficients.cast<double>(),
                                             CertifiedParameters(problem),
                                             stats::kLreCapLinear),
         .lre_sd = stats::SmallestLogRelativeError(
             fit.standard_deviations.cast<double>(),
             CertifiedDeviations(problem),
             stats::kLreCapLinear),
         .lre_rss =
             Lre(fit.residual_sum_of_squares, problem.residual_sum_of_squares),
         .condition = fit.condition,
         .bits = fit.bits});
  }
}

void CertifyUnivariate(Certification* certification) {
  // Double data give this much of the 13 digits wanted, and a digit in hand.
  constexpr double kWanted = 1e-14;
  for (const data::StrdProblem& problem : data::StrdProblems()) {
    if (problem.kind != data::StrdKind::kUnivariate) continue;
    const ExtendedVector sample = StrdColumn(problem, 0);
    const Eigen::VectorXd doubles = sample.cast<double>();
    const stats::SampleSummary plain = stats::Summarize(doubles);
    const stats::ExtendedSummary extended = stats::SummarizeExtended(sample);
    UnivariateCertificate row{.problem = problem.name};
    row.condition = extended.condition;
    row.lre_mean_double = Lre(plain.mean, problem.mean);
    row.lre_sd_double = Lre(plain.sd, problem.standard_deviation);
    row.lre_autocorrelation_double =
        Lre(stats::LagOneAutocorrelation(doubles), problem.autocorrelation);
    if (row.condition * std::ldexp(1.0, -stats::kDoubleBits) <= kWanted) {
      row.bits = stats::kDoubleBits;
      row.lre_mean = row.lre_mean_double;
      row.lre_sd = row.lre_sd_double;
      row.lre_autocorrelation = row.lre_autocorrelation_double;
    } else {
      row.bits = stats::kDoubleDoubleBits;
      row.lre_mean = Lre(extended.mean, problem.mean);
      row.lre_sd = Lre(extended.sd, problem.standard_deviation);
      row.lre_autocorrelation =
          Lre(extended.autocorrelation, problem.autocorrelation);
    }
    certification->univariate.push_back(row);
  }
}

}  // namespace errmap::models
