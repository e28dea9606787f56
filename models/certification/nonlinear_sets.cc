#include <algorithm>

#include "fitting/parallel_for.h"
#include "models/certification/certification.h"
#include "models/certification/solvers.h"
#include "models/certification/strd_functions.h"
#include "stats/lre.h"

namespace errmap::models {
namespace {

using fitting::RegressionStatistics;

// Enough for the slowest that converges at all (scg on Bennett5 does not).
constexpr fitting::StoppingRules kStopping{.iterations = 5000,
                                           .evaluations = 20000};

// Why a run may end at a minimum other than the certified one, as far as its
// gradient or its cost can tell; empty: it may not.
std::string OtherMinimum(const std::string& problem,
                         const std::string& solver) {
  if (problem == "Lanczos1") {
    return "the sum of squares, 1.4e-25, is the rounding of the data";
  }
  const bool is_ours =
      !solver.starts_with("ceres:") && !solver.starts_with("nlopt:");
  if (is_ours && problem != "BoxBOD") return "";
  static const std::vector<std::string> kTwoExponentials{"Lanczos2",
                                                         "Lanczos3"};
  if (std::ranges::count(kTwoExponentials, problem) > 0) {
    return "two exponentials fit nearly as well as three";
  }
  static const std::vector<std::string> kLevelOff{"BoxBOD",
                                                  "DanWood",
                                                  "Eckerle4",
                                                  "Hahn1",
                                                  "Kirby2",
                                                  "MGH09",
                                                  "MGH10",
                                                  "MGH17",
                                                  "Misra1a",
                                                  "Misra1b",
                                                  "Misra1d",
                                                  "Rat42",
                                                  "Rat43",
                                                  "Thurber"};
  if (std::ranges::count(kLevelOff, problem) > 0) {
    return "the sum of squares levels off far from its minimum";
  }
  return "";
}

struct Case {
  const data::StrdProblem* problem;
  int start;
  const CertifiedSolver* solver;  // null: the default
};

void JudgeRow(const data::StrdProblem& problem,
              const RegressionStatistics& statistics,
              NonlinearCertificate* row) {
  constexpr double kCap = stats::kLreCapNonlinear;
  row->lre_parameters = stats::SmallestLogRelativeError(
      statistics.parameters, CertifiedParameters(problem), kCap);
  row->lre_sd = stats::SmallestLogRelativeError(
      statistics.standard_deviations, CertifiedDeviations(problem), kCap);
  row->rss = statistics.residual_sum_of_squares;
  for (std::size_t j = 0; j < problem.parameters.size(); ++j) {
    const auto at = static_cast<Index>(j);
    row->estimates.push_back({problem.parameters[j].name,
                              statistics.parameters[at],
                              statistics.standard_deviations[at]});
  }
  row->lre_rss = stats::LogRelativeError(
      statistics.residual_sum_of_squares,
      stats::ParseDoubleDouble(problem.residual_sum_of_squares).hi,
      kCap);
}

NonlinearCertificate RunCase(const Case& run) {
  const data::StrdProblem& problem = *run.problem;
  NonlinearCertificate row{
      .problem = problem.name,
      .start = run.start,
      .solver = run.solver == nullptr ? kDefaultSolver : run.solver->name,
      .stop = std::string(ToString(fitting::Termination::kFailed)),
      .message = "",
      .other_minimum = OtherMinimum(
          problem.name,
          run.solver == nullptr ? kDefaultSolver : run.solver->name)};
  const auto function = MakeStrdFunction(problem);
  const VectorXd start = StrdStart(problem, run.start);
  try {
    fitting::FitSummary summary;
    RegressionStatistics statistics;
    if (run.solver == nullptr) {
      fitting::RegressionFit fit =
          fitting::FitNonlinearRegression(*function, start, kStopping);
      summary = std::move(fit.summary);
      statistics = std::move(fit.statistics);
    } else {
      const fitting::RegressionObjective objective(*function);
      fitting::Minimum minimum =
          run.solver->make(kStopping)->Minimize(objective, start);
      summary = std::move(minimum.summary);
      statistics = fitting::AssessRegression(
          *function, minimum.x.cast<stats::DoubleDouble>());
    }
    JudgeRow(problem, statistics, &row);
    row.iterations = summary.iterations;
    row.stop = std::string(ToString(summary.termination));
    row.claims_minimum = summary.converged();
    row.message = summary.message;
  } catch (const std::exception& error) {
    row.message = error.what();
  }
  return row;
}

SolverCertificate Summarise(const CertifiedSolver* certified,
                            const std::vector<NonlinearCertificate>& rows) {
  constexpr double kSolved = 4.0;
  const std::string solver =
      certified == nullptr ? kDefaultSolver : certified->name;
  SolverCertificate summary{.solver = solver,
                            .least_lre_parameters = stats::kLreCapNonlinear};
  if (certified != nullptr) {
    summary.fits = "net:" + solver.substr(0, solver.find(':'));
    summary.floor_solved = certified->floors.solved;
    summary.floor_mean_lre_parameters = certified->floors.mean_lre_parameters;
  }
  for (const NonlinearCertificate& row : rows) {
    if (row.solver != solver) continue;
    ++summary.runs;
    if (row.lre_parameters > kSolved) ++summary.solved;
    summary.mean_lre_parameters += row.lre_parameters;
    summary.mean_lre_sd += row.lre_sd;
    summary.least_lre_parameters =
        std::min(summary.least_lre_parameters, row.lre_parameters);
  }
  if (certified == nullptr) {
    summary.floor_solved = summary.runs;
    summary.floor_mean_lre_parameters =
        CertificationFloors().nonlinear_mean_lre_parameters;
  }
  const double runs = std::max(1, summary.runs);
  summary.mean_lre_parameters /= runs;
  summary.mean_lre_sd /= runs;
  return summary;
}

}  // namespace

void CertifyNonlinear(Certification* certification) {
  std::vector<const CertifiedSolver*> solvers{nullptr};
  for (const CertifiedSolver& solver : CertifiedSolvers()) {
    if (solver.fits_formulas) solvers.push_back(&solver);
  }
  std::vector<Case> cases;
  for (const CertifiedSolver* solver : solvers) {
    for (const data::StrdProblem& problem : data::StrdProblems()) {
      if (problem.kind != data::StrdKind::kNonlinear) continue;
      cases.push_back({&problem, 1, solver});
      cases.push_back({&problem, 2, solver});
    }
  }
  certification->nonlinear.resize(cases.size());
  fitting::ParallelFor(0, cases.size(), [&](std::size_t i) {
    certification->nonlinear[i] = RunCase(cases[i]);
  });
  for (const CertifiedSolver* solver : solvers) {
    certification->nonlinear_summary.push_back(
        Summarise(solver, certification->nonlinear));
  }
}

}  // namespace errmap::models
