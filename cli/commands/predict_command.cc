#include <cstdio>
#include <memory>
#include <numeric>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/shell/number_text.h"
#include "cli/study_file/data_arguments.h"
#include "data/atomic_file.h"
#include "data/csv.h"
#include "data/dataset.h"
#include "models/model_file.h"

namespace errmap::cli {
namespace {

struct PredictArguments {
  std::string model;
  std::string file;
  std::string out;
  bool quiet = false;
};

// The model's inputs out of a table, every row; the target need not be there.
Eigen::MatrixXd InputsOf(const models::FittedModel& fitted,
                         const data::CsvTable& table) {
  Eigen::MatrixXd inputs(static_cast<Eigen::Index>(table.num_rows),
                         static_cast<Eigen::Index>(fitted.inputs.size()));
  Eigen::Index column = 0;
  for (const models::TrainedInput& input : fitted.inputs) {
    if (table.Find(input.column.name) < 0) {
      throw data::InputError(
          fmt::format("{}: no column '{}', which the map reads; add it or fit "
                      "a map without it",
                      table.file,
                      input.column.name));
    }
    inputs.col(column++) = data::NumericColumn(
        table, input.column.name, data::MissingPolicy::kError, nullptr);
  }
  return inputs;
}

bool IsInside(const models::FittedModel& fitted,
              const Eigen::MatrixXd& inputs,
              Eigen::Index row) {
  for (std::size_t i = 0; i < fitted.inputs.size(); ++i) {
    const double value = inputs(row, static_cast<Eigen::Index>(i));
    if (value < fitted.inputs[i].min || value > fitted.inputs[i].max) {
      return false;
    }
  }
  return true;
}

int RunPredict(const PredictArguments& arguments) {
  const models::FittedModel fitted = models::LoadModel(arguments.model);
  const data::CsvTable table = data::ReadCsv(arguments.file);
  const Eigen::MatrixXd inputs = InputsOf(fitted, table);
  const Eigen::VectorXd predicted = fitted.model->Predict(inputs);

  // The columns that tell a row apart, where the file has them.
  std::vector<const data::CsvColumn*> ids;
  std::string text;
  for (const char* name : {"record", "cycle"}) {
    const std::ptrdiff_t index = table.Find(name);
    if (index < 0) continue;
    ids.push_back(&table.columns[static_cast<std::size_t>(index)]);
    text += data::CsvField(name) + ",";
  }
  text += "predicted,lower_90,upper_90,lower_95,upper_95,inside\n";
  Eigen::Index outside = 0;
  for (Eigen::Index row = 0; row < predicted.size(); ++row) {
    for (const data::CsvColumn* id : ids) {
      text +=
          data::CsvField(table.CellText(*id, static_cast<std::size_t>(row))) +
          ",";
    }
    const bool inside = IsInside(fitted, inputs, row);
    outside += inside ? 0 : 1;
    text += fmt::format(
        "{},,,,,{}\n", data::CsvNumber(predicted[row]), inside ? 1 : 0);
  }
  if (arguments.out.empty()) {
    fmt::print("{}", text);
  } else {
    data::WriteFileAtomically(arguments.out, text);
  }
  if (!arguments.quiet) {
    const std::string& unit = fitted.target.unit.symbol;
    Say(fmt::format("{} predicted as {}{}; compensate by minus that",
                    Count(predicted.size(), "row"),
                    fitted.target.name,
                    unit.empty() ? "" : " in " + unit));
    if (outside > 0) {
      Say(fmt::format(
          "warning: {} outside the trained range of the inputs (inside = 0): "
          "there the map extrapolates",
          Count(outside, "row")));
    }
  }
  return kDone;
}

}  // namespace

void AddPredictCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<PredictArguments>();
  CLI::App* command = app->add_subcommand(
      "predict", "Predict the error of every row with a fitted map");
  command->add_option("MODEL", arguments->model, "Model file")
      ->required()
      ->type_name("FILE.json");
  command->add_option("DATA", arguments->file, "CSV file with its inputs")
      ->required()
      ->type_name("FILE.csv");
  command
      ->add_option(
          "-o,--output", arguments->out, "File to write (default: stdout)")
      ->type_name("FILE.csv");
  command->add_flag("--quiet", arguments->quiet, "No remarks on stderr");
  command->footer(
      "Columns: record and cycle where the data have them, predicted (in the "
      "target's unit),\nlower_90 ... upper_95 (empty without an interval), "
      "inside (1 within the trained range).");
  command->callback([arguments, run] { run->status = RunPredict(*arguments); });
}

}  // namespace errmap::cli
