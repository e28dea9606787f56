#include "models/study/journal/fit_label.h"

#include <array>
#include <dlfcn.h>
#include <optional>
#include <variant>

#include <fmt/format.h>

#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/sha256.h"
#include "models/version.h"

namespace errmap::models {
namespace {

using data::Dataset;
using data::Sha256Stream;
// A text with its length before it, so that no two lists of texts look alike.
void AddText(std::string_view text, Sha256Stream* stream) {
  stream->Add(fmt::format("{}:", text.size()));
  stream->Add(text);
}

void AddColumn(const data::ColumnInfo& column, Sha256Stream* stream) {
  AddText(column.name, stream);
  AddText(column.unit.symbol, stream);
}

// Digests of the columns and of each row of a data set, from which those of
// any selection of rows follow. The file's name plays no part.
class RowDigests {
 public:
  explicit RowDigests(const Dataset& dataset) : dataset_(dataset) {
    Sha256Stream stream;
    AddColumn(dataset.target(), &stream);
    AddText(data::ToString(dataset.align()), &stream);
    for (const data::ColumnInfo& input : dataset.inputs()) {
      AddColumn(input, &stream);
    }
    AddText(dataset.groups().column, &stream);
    for (const std::string& label : dataset.groups().labels) {
      AddText(label, &stream);
    }
    if (dataset.log() != nullptr) AddLog(*dataset.log(), &stream);
    columns_ = stream.Finish();
    for (Index row = 0; row < dataset.num_rows(); ++row) AddRow(row, &stream);
  }

  void AddAll(Sha256Stream* stream) const {
    stream->Add(columns_);
    stream->Add(rows_);
  }

  void AddRows(const std::vector<Index>& rows, Sha256Stream* stream) const {
    stream->Add(columns_);
    for (const Index row : rows) {
      stream->Add(std::string_view(rows_).substr(
          static_cast<std::size_t>(row) * kDigestBytes, kDigestBytes));
    }
  }

 private:
  static constexpr std::size_t kDigestBytes = 32;

  template <typename T>
  static void AddBytes(const T& numbers, Sha256Stream* stream) {
    stream->Add(
        {reinterpret_cast<const char*>(numbers.data()),
         static_cast<std::size_t>(numbers.size()) * sizeof(*numbers.data())});
  }

  // Filters run through all of it, so it counts for every row.
  static void AddLog(const data::SessionLog& log, Sha256Stream* stream) {
    AddText(log.sessions.column, stream);
    for (const std::string& label : log.sessions.labels) {
      AddText(label, stream);
    }
    AddText(log.time_unit, stream);
    AddText(log.time_column, stream);
    AddBytes(log.sessions.codes, stream);
    AddBytes(log.first_rows, stream);
    AddBytes(log.time, stream);
    AddBytes(log.input_values, stream);
  }

  void AddRow(Index row, Sha256Stream* stream) {
    const auto at = static_cast<std::size_t>(row);
    numbers_.clear();
    for (Index i = 0; i < dataset_.num_inputs(); ++i) {
      numbers_.push_back(dataset_.input_values()(row, i));
    }
    numbers_.push_back(dataset_.target_values()[row]);
    if (dataset_.weights().size() != 0) {
      numbers_.push_back(dataset_.weights()[row]);
    }
    // Messages name rows of the file, so a row's place in it counts too.
    const std::array<Index, 3> places = {
        dataset_.rows()[at],
        dataset_.has_groups() ? dataset_.groups().codes[at] : -1,
        dataset_.log() != nullptr ? dataset_.log_rows()[at] : -1};
    AddBytes(numbers_, stream);
    AddBytes(places, stream);
    rows_ += stream->Finish();
  }

  const Dataset& dataset_;
  std::string columns_;
  std::string rows_;  // one digest after another
  std::vector<double> numbers_;
};

// Training and test rows of every fold.
std::vector<std::string> FoldDigests(const RowDigests& digests,
                                     const Holdout& holdout) {
  Sha256Stream stream;
  std::optional<RowDigests> of_file;
  if (holdout.test_data != nullptr) of_file.emplace(*holdout.test_data);
  std::vector<std::string> folds;
  for (const stats::Fold& fold : holdout.folds) {
    digests.AddRows(fold.train, &stream);
    const std::string training = stream.Finish();
    (of_file ? *of_file : digests).AddRows(fold.test, &stream);
    folds.push_back(data::Sha256(training + stream.Finish()));
  }
  return folds;
}

std::string OptionsText(const std::vector<EffectiveOption>& options) {
  std::string text;
  for (const EffectiveOption& option : options) {
    if (!text.empty()) text += " ";
    text += std::visit(
        [&](const auto& value) {
          return fmt::format("{}={}", option.key, value);
        },
        option.value);
  }
  return text;
}

// What of the context changes a figure: all but `threads` and `shared`.
// Every member is named, so that a new one has to be thought of here.
std::string ContextText(const FitContext& context) {
  const auto& [seed,
               explain,
               default_bootstraps,
               threads,
               most_design_values,
               keep_trace,
               inner_holdout,
               indifference,
               shared] = context;
  std::ignore = threads;
  std::ignore = shared;
  std::string text = fmt::format("seed={}", seed);
  if (explain) text += " explained";
  if (explain && !default_bootstraps) text += " without bootstraps";
  if (keep_trace) text += " traced";
  // The fit to all rows and those of whole groups never share their rows.
  if (inner_holdout != InnerHoldout::kDecisive &&
      inner_holdout != InnerHoldout::kWholeGroups) {
    text += fmt::format(" inner={}", ToString(inner_holdout));
  }
  if (indifference != 0.0) {
    text += fmt::format(" indifference={}", indifference);
  }
  if (most_design_values != FitContext().most_design_values) {
    text += fmt::format(" design={}", most_design_values);
  }
  return text;
}

}  // namespace

const std::string& ProgramIdentity() {
  static const std::string identity = [] {
    constexpr std::size_t kDigits = 12;
    std::string text = std::string("errmap ") + Version();
    try {
      // In a shared library (a module of Python) it is that.
      Dl_info own{};
      const bool is_known =
          dladdr(reinterpret_cast<const void*>(&ProgramIdentity), &own) != 0;
      const std::string_view object = is_known ? own.dli_fname : "";
      const std::string program = data::ReadFile(
          object.find(".so") == object.npos ? "/proc/self/exe"
                                            : std::string(object));
      text += " (build " + data::Sha256(program).substr(0, kDigits) + ")";
    } catch (const data::InputError&) {
      // Some systems do not show a process its own program.
    }
    return text;
  }();
  return identity;
}

FitLabels::FitLabels(std::string component,
                     const Dataset& dataset,
                     const std::vector<Holdout>& holdouts,
                     const std::vector<std::unique_ptr<ModelRecipe>>& recipes,
                     const StudyOptions& options,
                     std::string program)
    : component_(std::move(component)),
      holdouts_(holdouts),
      options_(options),
      program_(std::move(program)),
      tasks_(StudyTasks(holdouts, recipes)) {
  for (const auto& recipe : recipes) {
    models_.push_back({recipe->name(), OptionsText(recipe->options())});
  }
  const RowDigests digests(dataset);
  Sha256Stream stream;
  digests.AddAll(&stream);
  all_rows_ = data::Hexadecimal(stream.Finish());
  for (const Holdout& holdout : holdouts) {
    rows_.push_back(FoldDigests(digests, holdout));
  }
}

std::string FitLabels::KeyOf(const StudyTask& task) const {
  const Model& model = models_.at(task.model);
  const std::string context =
      ContextText(ContextOfTask(task, holdouts_, options_));
  const std::string& rows =
      task.holdout < 0
          ? all_rows_
          : rows_.at(static_cast<std::size_t>(task.holdout)).at(task.fold);
  Sha256Stream stream;
  for (const std::string* text :
       {&model.name, &program_, &model.options, &context, &rows}) {
    AddText(*text, &stream);
  }
  return data::Hexadecimal(stream.Finish());
}

std::vector<std::string> FitLabels::Keys() const {
  std::vector<std::string> keys;
  for (const StudyTask& task : tasks_) keys.push_back(KeyOf(task));
  return keys;
}

}  // namespace errmap::models
