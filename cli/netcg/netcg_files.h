#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/netcg/netcg_run.h"
#include "data/formats/pattern_file.h"
#include "models/scaling.h"
#include "stats/eigen.h"

namespace errmap::netcg {

/// Weights of a net, as subroutines SETWTS and PUTWTS of NISTIR 5367, Appendix
/// A, read and write them.
struct NetcgWeights {
  Index inputs = 0;
  Index hidden = 0;
  Index outputs = 0;
  VectorXd w = {};  // (N) in NetcgObjective's order
  /// Scaling of targets in the training run, which the program's own files
  /// lack.
  std::optional<models::TargetScaling> scaling = {};
};

enum class WeightDigits {
  kReport,  // 5E14.6: six digits
  kFull,    // all digits, and the scaling on a last line that SETWTS ignores
};

/// Throws InputError naming `name`, the line, and what was expected and found.
NetcgWeights ParseWeights(std::string_view text, const std::string& name);

/// Returns the numbers of nodes, then the weights into each node, beginning on
/// a new line.
std::string WeightsText(const NetcgWeights& weights, WeightDigits digits);

/// Returns the graphics file of the weights into the hidden nodes: a row per
/// input, a column per hidden node.
std::string FirstLayerGraph(const NetcgWeights& weights);
/// Returns the graphics file of the weights into the first output.
std::string SecondLayerGraph(const NetcgWeights& weights);

/// Options of a report's figures.
enum class NetcgStatistics {
  kAsPrinted,  // as the program printed them; a line points to the errata
  kCorrected,  // right ones, in the same places; lines say what they are
};

/// Returns the run report in the layout of NISTIR 5367, Appendix B.
std::string RunReport(const NetcgSpecification& specification,
                      const NetcgResult& result,
                      NetcgStatistics statistics);

/// Returns "achieved error goal", "iteration limit", ...: the end of the
/// report.
std::string EndingOf(int ierr);

/// Returns the graphics file of the error curve, with reals of that precision.
std::string ErrorCurveGraph(const NetcgResult& result,
                            NetcgPrecision precision);

/// Returns the graphics file of the residuals of the first output.
std::string ResidualGraph(const NetcgFigures& figures);

/// Returns the errors of the 1995 program and its report, a line for each.
std::string NetcgErrata();

struct NetcgOptions {
  NetcgPrecision precision = NetcgPrecision::kSingle;  // the program's
  NetcgStatistics statistics = NetcgStatistics::kAsPrinted;
  WeightDigits weight_digits = WeightDigits::kReport;
  /// Pattern file of the training run, which gives the scaling of testing runs
  /// whose weights come from elsewhere; "": none.
  std::string training_file = {};
  /// Folder to write to, in place of the run file's; "": none.
  std::string out = {};
};

struct NetcgOutputFile {
  std::string path;
  std::string content;
};

/// A finished run.
struct NetcgRecord {
  NetcgSpecification specification;
  NetcgResult result = {};
  std::vector<NetcgOutputFile> files = {};  // to be written
};

/// Called before each run with its number, from 0, and the number of runs.
using NetcgProgress = std::function<void(
    const NetcgSpecification& run, std::size_t number, std::size_t count)>;

/// Runs a run file. File names are relative to its folder. Outputs go to
/// options.out if that is given; absolute names and those with ".." then keep
/// only their last part. All input is read and checked before the first run,
/// but a run may read weights that an earlier one writes. Writes nothing.
/// Throws InputError naming file and line.
std::vector<NetcgRecord> RunNetcgFile(const std::string& path,
                                      const NetcgOptions& options,
                                      const NetcgProgress& progress = {});

/// Returns the patterns for a run: the first rows and the chosen columns of
/// `table`.
NetcgData DataOf(const NetcgSpecification& run,
                 const data::PatternTable& table);

/// Returns the files of a run, from its result.
std::vector<NetcgOutputFile> NetcgOutputs(const NetcgSpecification& run,
                                          const NetcgResult& result,
                                          const NetcgOptions& options,
                                          const std::string& folder);

/// Returns a text on how each run ended, its statistics as printed and
/// corrected, and the files.
std::string NetcgText(const std::vector<NetcgRecord>& records,
                      const NetcgOptions& options);

}  // namespace errmap::netcg
