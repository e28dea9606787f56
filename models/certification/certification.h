#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fitting/minimisers/objective.h"
#include "stats/eigen.h"

namespace errmap::models {

/// The value found, and the number of digits it shares with the certified
/// value.
struct CertifiedEstimate {
  std::string name;
  double estimate = 0.0;
  double standard_deviation = 0.0;
};

/// One run of one solver on a nonlinear NIST problem.
struct NonlinearCertificate {
  std::string problem;
  int start = 1;
  std::string solver;
  double lre_parameters = 0.0;  // the smallest over the parameters
  double lre_sd = 0.0;
  double lre_rss = 0.0;
  std::int64_t iterations = 0;
  std::string stop = {};  // fitting::ToString of the termination
  bool claims_minimum = false;
  std::string message = {};  // the solver's message or its exception's text
  /// The reason, if a claimed minimum may differ from the certified one; else
  /// empty.
  std::string other_minimum = {};
  std::vector<CertifiedEstimate> estimates = {};
  double rss = 0.0;
};

/// All runs of one solver, with its floors. A problem is solved if
/// lre_parameters is above 4.
struct SolverCertificate {
  std::string solver;
  /// Models that this solver fits, such as "net:scg" for "scg:moller"; empty
  /// for the default solver.
  std::optional<std::string> fits = {};
  int runs = 0;
  int solved = 0;
  double mean_lre_parameters = 0.0;
  double mean_lre_sd = 0.0;
  double least_lre_parameters = 0.0;
  int floor_solved = 0;
  double floor_mean_lre_parameters = 0.0;
};

/// A linear NIST problem, solved like `errmap fit --model SPEC` from CSV data.
struct LinearCertificate {
  std::string problem;
  std::string model = {};  // the SPEC
  double lre_coefficients = 0.0;
  double lre_sd = 0.0;
  double lre_rss = 0.0;
  double condition = 0.0;  // of the design with columns of unit length
  int bits = 0;            // of the arithmetic chosen by its condition
  std::vector<CertifiedEstimate> estimates = {};  // intercept first, if any
  double rss = 0.0;
};

struct UnivariateCertificate {
  std::string problem;
  double lre_mean = 0.0;
  double lre_sd = 0.0;
  double lre_autocorrelation = 0.0;
  double mean = 0.0;
  double sd = 0.0;
  double autocorrelation = 0.0;  // at lag 1
  double condition = 0.0;        // sqrt(1 + (mean / sd)^2)
  /// Precision of the values above: 53 if doubles suffice, 106 if the condition
  /// requires the decimal text.
  int bits = 0;
  /// The same from double data, whatever the condition: compare uses these.
  double lre_mean_double = 0.0;
  double lre_sd_double = 0.0;
  double lre_autocorrelation_double = 0.0;
};

struct GradientCertificate {
  std::string objective;
  double worst_relative_error = 0.0;
};

struct AgreementCertificate {
  std::string solver;
  double objective = 0.0;
  double difference = 0.0;  // relative, of the objective to the lowest
  double prediction_difference = 0.0;  // largest, as share of target range
  double most_difference = 0.0;        // the floors of this solver
  double most_prediction_difference = 0.0;
  std::int64_t iterations = 0;
  std::string stop = {};
};

/// The default solver's name: Levenberg-Marquardt with its fallbacks and polish
/// (fitting::FitNonlinearRegression). Only the library uses it: the commands
/// fit nets with the other solvers.
inline constexpr const char* kDefaultSolver = "lm";

/// The floors for an installation: LRE are minima, errors are maxima. Floors of
/// a single solver are in its row.
struct CertificationFloors {
  std::string nonlinear_solver = kDefaultSolver;  // of the next four
  double nonlinear_lre_parameters = 10.0;
  double nonlinear_mean_lre_parameters = 10.6;
  double nonlinear_lre_sd = 10.0;
  double nonlinear_lre_rss = 10.0;
  /// LRE of the sum of squares that any solver needs to claim a minimum.
  double claimed_lre_rss = 4.0;
  double linear_lre_coefficients = 13.0;
  double linear_lre_sd = 13.0;
  double linear_lre_rss = 13.0;
  double univariate_lre = 13.0;
  /// A double keeps 8 digits of 0.1 added to 10000000.
  double univariate_lre_sd_numacc4 = 8.0;
  /// Floors for plain double data: the mean; sd and autocorrelation.
  double univariate_double_lre_mean = 13.0;
  double univariate_double_lre = 8.0;
  double gradient_relative_error = 1e-6;
};

/// All results; the member names of these structs are their keys in JSON.
struct Certification {
  /// One sentence for each floor that was missed.
  std::vector<std::string> missed;
  std::vector<NonlinearCertificate> nonlinear;
  std::vector<SolverCertificate> nonlinear_summary;
  std::vector<LinearCertificate> linear;
  std::vector<UnivariateCertificate> univariate;
  std::vector<GradientCertificate> gradients;
  std::vector<AgreementCertificate> agreement;

  bool passed() const { return missed.empty(); }
};

/// Runs every solver on every problem from both starts, in parallel. The
/// results do not depend on the number of threads.
void CertifyNonlinear(Certification* certification);
void CertifyLinear(Certification* certification);
void CertifyUnivariate(Certification* certification);
/// Checks gradients of nets of several shapes and of the NIST problems, at
/// random points and at the minimum.
void CertifyGradients(Certification* certification);
/// Runs every solver on one well-damped net from one start.
void CertifyAgreement(Certification* certification);

/// Adds a row: the gradient of `f` at x (n) against Ridders extrapolation.
/// Checks the Jacobian of its residuals, if any, along random combinations.
/// Components are multiplied by their parameter's size. Errors are relative to
/// each component, or to 1e-3 of the largest if that is more. `gradient_size`:
/// the largest component at a typical point, for use at a minimum, where the
/// gradient vanishes; 0: the largest at x.
void CertifyGradient(const std::string& name,
                     const fitting::Objective& f,
                     const VectorXd& x,
                     double gradient_size,
                     Certification* certification);

/// Fills `missed` from the parts that have run.
void JudgeFloors(const CertificationFloors& floors,
                 Certification* certification);

}  // namespace errmap::models
