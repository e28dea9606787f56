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

/// Weights of a net as subroutines SETWTS and PUTWTS of NISTIR 5367, Appendix
/// A, read and write them.
struct NetcgWeights {
  Index inputs = 0;
  Index hidden = 0;
  Index outputs = 0;
  VectorXd w;  // (N) in NetcgObjective's order
  /// How the training run scaled its targets; the program's own files do not
  /// say.
  std::optional<models::TargetScaling> scaling;
};

enum class WeightDigits {
  kReport,  // 5E14.6: six digits
  kFull,    // all digits, and the scaling on a last line that SETWTS ignores
};

/// Throws InputError naming `name`, line, what was expected and found.
NetcgWeights ParseWeights(std::string_view text, const std::string& name);

/// Nodes, then the weights into each node from a new line on.
std::string WeightsText(const NetcgWeights& weights, WeightDigits digits);

/// The graphics file of the weights into the hidden nodes: a row per input, a
/// column per hidden node.
std::string FirstLayerGraph(const NetcgWeights& weights);
/// That of the weights into the first output.
std::string SecondLayerGraph(const NetcgWeights& weights);

/// Which figures a report shows.
enum class NetcgStatistics {
  kAsPrinted,  // as the program printed them; a line points to the errata
  kCorrected,  // right ones, in the same places; lines say what they are
};

/// The run report in the layout of NISTIR 5367, Appendix B.
std::string RunReport(const NetcgSpecification& specification,
                      const NetcgResult& result,
                      NetcgStatistics statistics);

/// "achieved error goal", "iteration limit", ...: how the report ends.
std::string EndingOf(int ierr);

/// The graphics file of the error curve; of reals in that precision.
std::string ErrorCurveGraph(const NetcgResult& result,
                            NetcgPrecision precision);

/// The graphics file of the residuals of the first output.
std::string ResidualGraph(const NetcgFigures& figures);

/// What the 1995 program and its report have wrong, a line each.
std::string NetcgErrata();

struct NetcgOptions {
  NetcgPrecision precision = NetcgPrecision::kSingle;  // the program's
  NetcgStatistics statistics = NetcgStatistics::kAsPrinted;
  WeightDigits weight_digits = WeightDigits::kReport;
  /// Pattern file of the training run, for the scaling of testing runs whose
  /// weights come from elsewhere; "": none.
  std::string training_file = {};
  /// Folder that is written to in place of the run file's; "": none.
  std::string out = {};
};

struct NetcgOutputFile {
  std::string path;
  std::string content;
};

/// A run that is done.
struct NetcgRecord {
  NetcgSpecification specification;
  NetcgResult result;
  std::vector<NetcgOutputFile> files;  // to be written
};

/// Told of each run before it begins: its number from 0, and how many.
using NetcgProgress = std::function<void(
    const NetcgSpecification& run, std::size_t number, std::size_t count)>;

/// Runs a run file. Names of files are relative to its folder, those of outputs
/// to options.out where that is given (absolute ones and ones with ".." keep
/// their last part there). All input is read and checked before the first run;
/// a run may read weights that an earlier one writes. Writes nothing.
/// Throws InputError naming file and line.
std::vector<NetcgRecord> RunNetcgFile(const std::string& path,
                                      const NetcgOptions& options,
                                      const NetcgProgress& progress = {});

/// The patterns that a run works on: of `table` its first rows and the columns
/// that are chosen.
NetcgData DataOf(const NetcgSpecification& run,
                 const data::PatternTable& table);

/// The files of a run, from its result.
std::vector<NetcgOutputFile> NetcgOutputs(const NetcgSpecification& run,
                                          const NetcgResult& result,
                                          const NetcgOptions& options,
                                          const std::string& folder);

/// What was done, for people: how each run ended, its statistics as printed
/// and right, and the files.
std::string NetcgText(const std::vector<NetcgRecord>& records,
                      const NetcgOptions& options);

}  // namespace errmap::netcg
