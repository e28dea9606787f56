#include "cli/netcg/netcg_files.h"

#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/argument_name.h"
#include "data/files/atomic_file.h"
#include "data/files/sheet_path.h"
#include "data/input_error.h"
#include "data/text.h"

namespace errmap::netcg {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTitleLimit = 80;

// The files that a run writes.
std::vector<NetcgFile> OutputsOf(const NetcgSpecification& run) {
  std::vector<NetcgFile> outputs = {
      NetcgFile::kReport, NetcgFile::kErrorCurve, NetcgFile::kResiduals};
  if (run.is_training()) {
    outputs.insert(outputs.end(),
                   {NetcgFile::kFinalWeights,
                    NetcgFile::kFirstLayer,
                    NetcgFile::kSecondLayer});
  }
  return outputs;
}

std::string InputPath(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).lexically_normal().string();
}

bool IsDevice(const std::string& name) { return name.starts_with("/dev/"); }

std::string OutputPath(const std::string& folder,
                       const std::string& out,
                       const std::string& name) {
  if (out.empty() || IsDevice(name)) return InputPath(folder, name);
  const fs::path path = fs::path(name).lexically_normal();
  const bool stays_inside = path.is_relative() && *path.begin() != "..";
  return (fs::path(out) / (stays_inside ? path : path.filename()))
      .lexically_normal()
      .string();
}

std::vector<Index> ColumnsOf(const NetcgSpecification& run,
                             const data::PatternTable& table) {
  std::vector<Index> columns;
  for (Index i = 0; i < table.input_values.cols(); ++i) {
    const auto flag = static_cast<std::size_t>(i);
    if (flag >= run.uses_column.size() || run.uses_column[flag]) {
      columns.push_back(i);
    }
  }
  return columns;
}

// One run file with all that it reads.
class Runner {
 public:
  Runner(std::string path, const NetcgOptions& options)
      : path_(std::move(path)),
        folder_(fs::path(path_).parent_path().string()),
        options_(options),
        runs_(ParseRunFile(data::ReadFile(path_, data::kMostTextOfPrograms),
                           path_)) {
    inputs_read_.insert(InputPath("", path_));
    if (!options.training_file.empty()) {
      inputs_read_.insert(InputPath("", options.training_file));
      training_scaling_ = TrainingScaling(options.training_file);
    }
    for (const NetcgSpecification& run : runs_) {
      data_.push_back(ReadData(run));
      if (run.is_training()) {
        will_write_.insert(OutputPath(
            folder_, options.out, run.file(NetcgFile::kFinalWeights)));
      }
    }
    for (const NetcgSpecification& run : runs_) CheckOutputs(run);
  }

  std::vector<NetcgRecord> Run(const NetcgProgress& progress) {
    std::vector<NetcgRecord> records;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (progress) progress(runs_[i], i, runs_.size());
      records.push_back(RunOne(runs_[i], &data_[i]));
    }
    return records;
  }

 private:
  [[noreturn]] void Refuse(std::size_t line, const std::string& why) const {
    throw data::InputError(data::PrintablePath(path_) + ": line " +
                           std::to_string(line) + ": " + why);
  }

  // The text of a file that the run names.
  std::string ReadNamed(const NetcgSpecification& run,
                        NetcgFile which,
                        const std::string& path) const {
    try {
      return data::ReadFile(path);
    } catch (const data::InputError& error) {
      Refuse(run.line_of(which),
             "the " + std::string(NameOf(which)) + ": " + error.what());
    }
  }

  static models::TargetScaling TrainingScaling(const std::string& file) {
    const data::PatternTable table = data::ReadPatterns(file);
    try {
      return models::SigmoidTargetScaling(table.target_values);
    } catch (const std::invalid_argument&) {
      throw data::InputError(data::PrintablePath(file) +
                             ": line 1: its targets do not vary, so no run "
                             "can have been trained on them");
    }
  }

  NetcgData ReadData(const NetcgSpecification& run) {
    const std::string path = InputPath(folder_, run.file(NetcgFile::kPatterns));
    const data::PatternTable table =
        data::ParsePatterns(ReadNamed(run, NetcgFile::kPatterns, path), path);
    inputs_read_.insert(path);
    CheckCounts(run, table, path);
    NetcgData data = DataOf(run, table);
    if (data.targets.maxCoeff() == data.targets.minCoeff()) {
      Refuse(run.line_of(NetcgFile::kPatterns),
             "the targets of the " + std::to_string(run.patterns) +
                 " patterns of " + data::PrintablePath(path) +
                 " do not vary, so they cannot be scaled");
    }
    const std::string weights =
        InputPath(folder_, run.file(NetcgFile::kInitialWeights));
    const bool is_made_before = will_write_.contains(OutputPath(
        folder_, options_.out, run.file(NetcgFile::kInitialWeights)));
    if (!run.draws_weights() && !is_made_before) {
      inputs_read_.insert(weights);
      TakeWeights(
          run,
          ParseWeights(ReadNamed(run, NetcgFile::kInitialWeights, weights),
                       weights),
          &data);
    }
    return data;
  }

  void CheckCounts(const NetcgSpecification& run,
                   const data::PatternTable& table,
                   const std::string& path) const {
    const std::string file = data::PrintablePath(path);
    if (run.patterns > table.input_values.rows()) {
      Refuse(run.network_line,
             std::to_string(run.patterns) + " patterns are asked for, and " +
                 file + " has " + std::to_string(table.input_values.rows()));
    }
    if (run.outputs != table.target_values.cols()) {
      Refuse(run.network_line,
             std::to_string(run.outputs) + " outputs are asked for, and " +
                 file + " has " + std::to_string(table.target_values.cols()));
    }
    const Index chosen = std::ssize(ColumnsOf(run, table));
    if (chosen != run.inputs) {
      Refuse(run.flags_line,
             "the column flags choose " + std::to_string(chosen) + " of the " +
                 std::to_string(table.input_values.cols()) + " inputs of " +
                 file + ", and line " + std::to_string(run.network_line) +
                 " says " + std::to_string(run.inputs));
    }
  }

  void TakeWeights(const NetcgSpecification& run,
                   const NetcgWeights& weights,
                   NetcgData* data) const {
    if (weights.inputs != run.inputs || weights.hidden != run.hidden ||
        weights.outputs != run.outputs) {
      const auto nodes = [](Index i, Index h, Index o) {
        return std::to_string(i) + "-" + std::to_string(h) + "-" +
               std::to_string(o);
      };
      Refuse(run.network_line,
             "the net has " + nodes(run.inputs, run.hidden, run.outputs) +
                 " nodes, and the weights in " +
                 data::QuotedText(run.file(NetcgFile::kInitialWeights)) +
                 " are those of " +
                 nodes(weights.inputs, weights.hidden, weights.outputs));
    }
    data->initial_weights = weights.w;
    data->training_scaling =
        training_scaling_ ? training_scaling_ : weights.scaling;
  }

  // A wrong name must not cost a measurement, nor the work of a long run.
  void CheckOutputs(const NetcgSpecification& run) const {
    std::set<std::string> own;
    for (const NetcgFile which : OutputsOf(run)) {
      const std::string path =
          OutputPath(folder_, options_.out, run.file(which));
      const std::string what =
          "the " + std::string(NameOf(which)) + " " + data::PrintablePath(path);
      const std::size_t line = run.line_of(which);
      std::error_code ignored;
      if (fs::is_directory(path, ignored)) Refuse(line, what + " is a folder");
      if (options_.out.empty() &&
          !fs::is_directory(fs::path(path).parent_path() / ".", ignored) &&
          fs::path(path).has_parent_path()) {
        Refuse(line, what + " is in a folder that does not exist");
      }
      for (const std::string& input : inputs_read_) {
        if (path != input && !data::IsSameFile(path, input)) continue;
        Refuse(line, what + " would overwrite what is read");
      }
      if (!own.insert(path).second && !IsDevice(path)) {
        Refuse(line, what + " is named twice in this run");
      }
    }
  }

  NetcgRecord RunOne(const NetcgSpecification& run, NetcgData* data) {
    const std::string from =
        OutputPath(folder_, options_.out, run.file(NetcgFile::kInitialWeights));
    if (!run.draws_weights() && data->initial_weights.size() == 0) {
      TakeWeights(run, written_.at(from), data);
    }
    NetcgRecord record{.specification = run, .result = {}, .files = {}};
    try {
      record.result = RunNetcg(run, *data, options_.precision);
    } catch (const std::invalid_argument& error) {
      Refuse(run.network_line, error.what());
    }
    record.files = NetcgOutputs(run, record.result, options_, folder_);
    if (run.is_training()) {
      const std::string path =
          OutputPath(folder_, options_.out, run.file(NetcgFile::kFinalWeights));
      for (const NetcgOutputFile& file : record.files) {
        if (file.path != path) continue;
        NetcgWeights weights = ParseWeights(file.content, path);
        weights.scaling = record.result.scaling;
        written_[path] = weights;
      }
    }
    return record;
  }

  std::string path_;
  std::string folder_;
  const NetcgOptions& options_;
  std::vector<NetcgSpecification> runs_;
  std::vector<NetcgData> data_;
  std::optional<models::TargetScaling> training_scaling_;
  std::set<std::string> inputs_read_;
  std::set<std::string> will_write_;             // final weights so far
  std::map<std::string, NetcgWeights> written_;  // by path
};

}  // namespace

std::vector<NetcgRecord> RunNetcgFile(const std::string& path,
                                      const NetcgOptions& options,
                                      const NetcgProgress& progress) {
  return Runner(path, options).Run(progress);
}

NetcgData DataOf(const NetcgSpecification& run,
                 const data::PatternTable& table) {
  NetcgData data;
  data.scale = table.scale;
  data.targets = table.target_values.topRows(run.patterns);
  data.inputs = table.input_values.topRows(run.patterns)(Eigen::all,
                                                         ColumnsOf(run, table));
  return data;
}

std::vector<NetcgOutputFile> NetcgOutputs(const NetcgSpecification& run,
                                          const NetcgResult& result,
                                          const NetcgOptions& options,
                                          const std::string& folder) {
  const NetcgFigures& figures =
      options.statistics == NetcgStatistics::kCorrected ? result.corrected
                                                        : result.printed;
  const NetcgWeights weights{.inputs = run.inputs,
                             .hidden = run.hidden,
                             .outputs = run.outputs,
                             .w = result.weights,
                             .scaling = result.scaling};
  std::vector<NetcgOutputFile> files;
  const auto add = [&](NetcgFile which, std::string content) {
    files.push_back(
        {OutputPath(folder, options.out, run.file(which)), std::move(content)});
  };
  add(NetcgFile::kReport, RunReport(run, result, options.statistics));
  add(NetcgFile::kErrorCurve, ErrorCurveGraph(result, options.precision));
  add(NetcgFile::kResiduals, ResidualGraph(figures));
  if (run.is_training()) {
    add(NetcgFile::kFinalWeights, WeightsText(weights, options.weight_digits));
    add(NetcgFile::kFirstLayer, FirstLayerGraph(weights));
    add(NetcgFile::kSecondLayer, SecondLayerGraph(weights));
  }
  return files;
}

std::string NetcgText(const std::vector<NetcgRecord>& records,
                      const NetcgOptions& options) {
  std::string text;
  std::size_t number = 0;
  for (const NetcgRecord& record : records) {
    const NetcgSpecification& run = record.specification;
    const NetcgResult& result = record.result;
    if (number > 0) text += "\n";
    text += fmt::format(
        "run {} of {}: {}\n  {} on {}: {} patterns, {}-{}-{} nodes, {} "
        "weights, {} precision\n",
        ++number,
        records.size(),
        data::Printable(run.title, kTitleLimit),
        run.is_training() ? "training" : "testing",
        data::PrintablePath(run.file(NetcgFile::kPatterns)),
        run.patterns,
        run.inputs,
        run.hidden,
        run.outputs,
        run.num_weights(),
        ToString(options.precision));
    if (run.is_training()) {
      text += fmt::format(
          "  ended after {} iterations: ierr {}, {}; E {:.6g}, |g|/|w| "
          "{:.3e}\n",
          result.iterations,
          result.ierr,
          EndingOf(result.ierr),
          result.error,
          result.gradient_ratio);
    }
    text += "  errors              as printed          right\n";
    const auto line = [&](const char* name, double printed, double right) {
      text += fmt::format(
          "    {:12}  {:>13.6g}  {:>13.6g}\n", name, printed, right);
    };
    const NetcgFigures& printed = result.printed;
    const NetcgFigures& right = result.corrected;
    line("mean", printed.mean, right.mean);
    line("sd", printed.sd, right.sd);
    line("minimum", printed.min, right.min);
    line("maximum", printed.max, right.max);
    line("R-SQ", printed.r2, right.r2);
    line("K-S D", printed.ks_d, right.ks_d);
    line("K-S p", printed.ks_p, right.ks_p);
    text += "    right: divisors n and n - 1, 1 - SSE/SST, Lilliefors' p";
    text += result.corrected_scaling == NetcgScaling::kTraining
                ? ", training scaling\n"
                : ";\n    but scaled by the test file's range: the training "
                  "run's is not known\n    (" +
                      data::ArgumentName("training") +
                      " names its pattern file)\n";
    text += "  wrote";
    for (const NetcgOutputFile& file : record.files) {
      text += " " + data::PrintablePath(file.path);
    }
    text += "\n";
  }
  return text;
}

}  // namespace errmap::netcg
