#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "cli/netcg/run_file.h"
#include "fitting/minimisers/optimizer.h"
#include "models/scaling.h"
#include "stats/eigen.h"

namespace errmap::netcg {

enum class NetcgPrecision { kSingle, kDouble };
/// "single", "double".
std::string_view ToString(NetcgPrecision precision);

/// The data of a run: the chosen columns of its patterns.
struct NetcgData {
  MatrixXd inputs;     // (P x I)
  MatrixXd targets;    // (P x J) as in the file
  double scale = 1.0;  // the file's scale factor
  /// For a testing run: scaling of targets in the training run, if known.
  std::optional<models::TargetScaling> training_scaling;
  /// (N) read from a file; (0) if the seed draws them.
  VectorXd initial_weights;
};

/// Errors after a run: error = desired - predicted.
struct NetcgFigures {
  MatrixXd desired;    // (P x J)
  MatrixXd predicted;  // (P x J)
  MatrixXd errors;     // (P x J)
  double mean = 0.0;
  double sd = 0.0;
  double min = 0.0;
  double max = 0.0;
  double r2 = 0.0;
  double ks_d = 0.0;  // of the first output
  double ks_p = 0.0;
};

/// Scaling of targets for the corrected figures.
enum class NetcgScaling {
  kTraining,  // as those of the training run, as they should be
  kTestFile,  // by the test file's own range, since no other is known
};

struct NetcgResult {
  VectorXd weights;               // (N)
  models::TargetScaling scaling;  // of the run's own targets
  /// Statistics as the program computes them, including its errors
  /// (stats/report_1995.h). In a testing run, desired and predicted are scaled
  /// by the range of the test file.
  NetcgFigures printed;
  /// Corrected figures: divisors P J and P J - 1, R-SQ = 1 - SSE/SST, the scale
  /// factor applied, the training run's scaling if known. ks_d uses the first
  /// output's own mean and sd, and ks_p is by Lilliefors (NaN below 4
  /// patterns).
  NetcgFigures corrected;
  NetcgScaling corrected_scaling = NetcgScaling::kTraining;

  // As the program ends.
  int ierr = 0;  // 0 error goal, 1 iterations, 2 gradient, 3 slow or stuck
  std::int64_t iterations = 0;
  std::int64_t function_calls = 0;
  double error = 0.0;           // E, regularised
  double gradient_ratio = 0.0;  // |g| / |w|
  double weight_change = 0.0;   // rms
  /// Line k is sqrt(2 E) before iteration k, as in the program's graphics file.
  std::vector<double> error_curve;
  fitting::FitSummary summary;
};

/// Runs a specification on its data in this precision: weights, scaling,
/// training (or none), results, in the program's order of operations. Unlike
/// the program, it stops at once if the start already meets a goal. Throws
/// std::invalid_argument if sizes do not agree, the targets do not vary, or the
/// error is not finite at the start.
NetcgResult RunNetcg(const NetcgSpecification& specification,
                     const NetcgData& data,
                     NetcgPrecision precision);

/// Random generator of the report (function UNI of Appendix A, of J. Blue, D.
/// Kahaner and G. Marsaglia): uniform on [0, 1) in single precision, from
/// integers of 32 bits.
class Uni {
 public:
  /// Seeds by z = uni(seed). That call is itself a draw, the first of Next().
  explicit Uni(std::int64_t seed);
  float Next();

 private:
  std::array<std::int64_t, 17> m_ = {};
  std::size_t i_ = 4;
  std::size_t j_ = 16;
};

/// Initial weights (N) of a net in NetcgObjective's order, drawn as in
/// subroutine SETWTS. One draw is discarded. The others lie within +-0.5, row
/// by row (to outer, from inner).
Eigen::VectorXf RandomWeights(Index inputs,
                              Index hidden,
                              Index outputs,
                              std::int64_t seed);

}  // namespace errmap::netcg
