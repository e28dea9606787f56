#include <fmt/format.h>

#include "models/certification/certification.h"

namespace errmap::models {
namespace {

// Collects what is missed; written so that a NaN misses.
class Judge {
 public:
  explicit Judge(std::vector<std::string>* missed) : missed_(missed) {}

  void AtLeast(const std::string& what, double found, double floor) {
    if (found >= floor) return;
    missed_->push_back(fmt::format(
        "{}: {:.2f}, at least {:.2f} is needed", what, found, floor));
  }
  void AtMost(const std::string& what, double found, double limit) {
    if (found <= limit) return;
    missed_->push_back(fmt::format(
        "{}: {:.1e}, at most {:.0e} is allowed", what, found, limit));
  }

 private:
  std::vector<std::string>* missed_;
};

}  // namespace

void JudgeFloors(const CertificationFloors& floors,
                 Certification* certification) {
  certification->missed.clear();
  Judge judge(&certification->missed);
  for (const NonlinearCertificate& row : certification->nonlinear) {
    const std::string run =
        fmt::format("{} from start {}, ", row.problem, row.start);
    if (row.claims_minimum && row.other_minimum.empty()) {
      judge.AtLeast(run + row.solver + " claims a minimum; sum of squares",
                    row.lre_rss,
                    floors.claimed_lre_rss);
    }
    if (row.solver != kDefaultSolver) continue;
    judge.AtLeast(run + "parameters",
                  row.lre_parameters,
                  floors.nonlinear_lre_parameters);
    judge.AtLeast(
        run + "standard deviations", row.lre_sd, floors.nonlinear_lre_sd);
    judge.AtLeast(
        run + "residual sum of squares", row.lre_rss, floors.nonlinear_lre_rss);
  }
  for (const SolverCertificate& row : certification->nonlinear_summary) {
    judge.AtLeast(
        row.solver + ", problems solved", row.solved, row.floor_solved);
    judge.AtLeast(row.solver + ", mean of parameters",
                  row.mean_lre_parameters,
                  row.floor_mean_lre_parameters);
  }
  for (const LinearCertificate& row : certification->linear) {
    judge.AtLeast(row.problem + ", coefficients",
                  row.lre_coefficients,
                  floors.linear_lre_coefficients);
    judge.AtLeast(row.problem + ", standard deviations",
                  row.lre_sd,
                  floors.linear_lre_sd);
    judge.AtLeast(row.problem + ", residual sum of squares",
                  row.lre_rss,
                  floors.linear_lre_rss);
  }
  for (const UnivariateCertificate& row : certification->univariate) {
    judge.AtLeast(row.problem + ", mean", row.lre_mean, floors.univariate_lre);
    judge.AtLeast(row.problem + ", sd",
                  row.lre_sd,
                  row.problem == "NumAcc4" ? floors.univariate_lre_sd_numacc4
                                           : floors.univariate_lre);
    judge.AtLeast(row.problem + ", autocorrelation",
                  row.lre_autocorrelation,
                  floors.univariate_lre);
    judge.AtLeast(row.problem + ", mean in double",
                  row.lre_mean_double,
                  floors.univariate_double_lre_mean);
    judge.AtLeast(row.problem + ", sd in double",
                  row.lre_sd_double,
                  floors.univariate_double_lre);
    judge.AtLeast(row.problem + ", autocorrelation in double",
                  row.lre_autocorrelation_double,
                  floors.univariate_double_lre);
  }
  for (const GradientCertificate& row : certification->gradients) {
    judge.AtMost("gradient of " + row.objective,
                 row.worst_relative_error,
                 floors.gradient_relative_error);
  }
  for (const AgreementCertificate& row : certification->agreement) {
    judge.AtMost(row.solver + ", objective above the lowest",
                 row.difference,
                 row.most_difference);
    judge.AtMost(row.solver + ", predictions",
                 row.prediction_difference,
                 row.most_prediction_difference);
  }
}

}  // namespace errmap::models
