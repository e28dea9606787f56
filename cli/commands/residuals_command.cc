#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/json_blocks.h"
#include "cli/report/number_text.h"
#include "cli/report/text/commands/residual_text.h"
#include "cli/report/text/commands/residual_words.h"
#include "cli/report/wrap_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "cli/study_setup/provenance.h"
#include "data/column_header.h"
#include "data/columns.h"
#include "data/csv.h"
#include "data/files/shown_path.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/dataset.h"
#include "data/text.h"
#include "models/record_json.h"
#include "models/study/record/builders/parts.h"
#include "stats/error_metrics.h"
#include "stats/not_a_number.h"
#include "stats/report_1995.h"
#include "stats/summary.h"

namespace errmap::cli {
namespace {

using Rows = std::vector<Index>;

struct ResidualsArguments {
  std::string file;
  std::string column;
  std::string order;
  std::string group;
  std::string position;
  std::string fitted;
  data::MissingPolicy missing = data::MissingPolicy::kError;
  std::string format = "table";
  long long monte_carlo = 0;
  std::uint64_t seed = 1;
  long long bins = 0;
  bool details = false;
  bool as_printed_1995 = false;
};

// A numeric column.
struct Column {
  std::string name;  // "": none
  VectorXd values;   // of every data row; NaN if there is none
};

Column ReadColumn(const data::CsvTable& table,
                  const std::string& name,
                  const ResidualsArguments& arguments) {
  Rows rows;
  const VectorXd found =
      data::NumericColumn(table, name, arguments.missing, &rows);
  Column column{.name = name,
                .values = VectorXd::Constant(static_cast<Index>(table.num_rows),
                                             stats::kNaN)};
  column.values(rows) = found;
  return column;
}

// The column that an option names, or the first whose name starts with
// `prefix`; that one must be fit for use, else it is passed over.
Column FindColumn(const data::CsvTable& table,
                  const std::string& named,
                  const char* option,
                  const std::string& prefix,
                  const ResidualsArguments& arguments) {
  if (!named.empty()) {
    data::RequireColumn(table, named, option);
    return ReadColumn(table, named, arguments);
  }
  if (prefix.empty()) return {};
  for (const data::CsvColumn& column : table.columns) {
    if (!data::StartsWithIgnoringCase(column.name, prefix) ||
        column.name == arguments.column) {
      continue;
    }
    try {
      return ReadColumn(table, column.name, arguments);
    } catch (const data::InputError& error) {
      Warn(fmt::format("{}: left out: {}", column.name, error.what()));
    }
    return {};
  }
  return {};
}

// Rows that every column in use has values in, ascending.
Rows CommonRows(const data::CsvTable& table,
                const std::vector<const Column*>& columns) {
  Rows rows = data::AllRows(table.num_rows);
  for (const Column* column : columns) {
    if (column->name.empty()) continue;
    std::erase_if(
        rows, [&](Index row) { return !std::isfinite(column->values[row]); });
  }
  return rows;
}

models::ResidualInputs ReadInputs(const ResidualsArguments& arguments) {
  const data::CsvTable table = data::ReadCsv(arguments.file);
  SayUnless(false, table.remarks);
  data::RequireKnownUnit(
      table,
      {data::RequireColumn(table, arguments.column, "--column"),
       data::ColumnUse::kOther});
  const Column residuals = ReadColumn(table, arguments.column, arguments);
  const Column order =
      FindColumn(table, arguments.order, "--order", "", arguments);
  const Column position = FindColumn(
      table, arguments.position, "--position", "position", arguments);
  const Column fitted =
      FindColumn(table, arguments.fitted, "--fitted", "predicted", arguments);
  Rows rows = CommonRows(table, {&residuals, &order, &position, &fitted});
  if (rows.empty()) {
    throw data::InputError(fmt::format(
        "{}: no row has values in every column in use", arguments.file));
  }
  models::ResidualInputs inputs;
  if (!order.name.empty()) {
    std::ranges::stable_sort(
        rows, {}, [&](Index row) { return order.values[row]; });
    inputs.order = "order of " + order.name;
  }
  inputs.values = residuals.values(rows);
  if (!position.name.empty()) {
    inputs.position_column = position.name;
    inputs.positions = position.values(rows);
  }
  if (!fitted.name.empty()) {
    inputs.fitted_column = fitted.name;
    inputs.fitted = fitted.values(rows);
  }
  std::string group = arguments.group;
  if (!group.empty()) {
    data::RequireColumn(table, group, "--group");
  } else if (const std::ptrdiff_t cycle = data::CycleColumn(table);
             cycle >= 0 && arguments.column != table.At(cycle).name) {
    group = table.At(cycle).name;
  }
  if (!group.empty()) {
    data::Grouping grouping = data::GroupByColumn(table, group, rows);
    inputs.group_column = group;
    inputs.group_codes = std::move(grouping.codes);
    inputs.group_labels = std::move(grouping.labels);
  }
  return inputs;
}

Json Report1995Json(const stats::Report1995Statistics& printed,
                    double r_squared) {
  return {{"r_squared", r_squared},
          {"mean", printed.mean},
          {"sd", printed.sd},
          {"min", printed.min},
          {"max", printed.max},
          {"ks", {{"d", printed.ks_d}, {"p_given", printed.ks_probability}}}};
}

Json SummaryJson(const stats::ErrorMetrics& metrics,
                 const VectorXd& values,
                 const stats::ShapeMoments& shape) {
  VectorXd sorted = values;
  std::sort(sorted.begin(), sorted.end());
  Json summary = models::ToJson(metrics);
  summary["standard_error"] = stats::StandardError(metrics.sd, metrics.n);
  summary["skewness"] = shape.skewness;
  summary["kurtosis"] = shape.kurtosis;
  summary["q25"] = stats::Quantile(sorted, 0.25);
  summary["median"] = stats::Quantile(sorted, 0.5);
  summary["q75"] = stats::Quantile(sorted, 0.75);
  return summary;
}

// Figures for plots: standardised residuals in measured order (Eq. 137), the
// Tukey-lambda curve, the normal probability plot and the histogram (`bins` 0:
// Freedman-Diaconis) of `values`.
Json PlotsJson(const models::ResidualReport& report,
               const VectorXd& values,
               Index bins) {
  VectorXd sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto array = [](const VectorXd& numbers) {
    return Json(std::vector<double>(numbers.begin(), numbers.end()));
  };
  const stats::Histogram histogram = stats::MakeHistogram(sorted, bins);
  Json json = {{"histogram",
                {{"low", histogram.low},
                 {"width", histogram.width},
                 {"counts", histogram.counts}}}};
  if (report.normality.tukey_ppcc.ok()) {
    json["standardised"] = array(stats::Standardise(values));
    json["tukey_ppcc"] = {{"lambda", array(report.normality.curve.lambda)},
                          {"r", array(report.normality.curve.r)}};
    json["normal_probability_plot"] = {
        {"quantile", array(stats::NormalMedians(sorted.size()))},
        {"value", array(sorted)}};
  }
  return json;
}

// The columns and choices that took effect.
Json ConfigurationJson(const ResidualsArguments& arguments,
                       const models::ResidualInputs& inputs) {
  const auto named = [](const std::string& name) {
    return name.empty() ? Json() : Json(name);
  };
  return {{"column", arguments.column},
          {"order", named(arguments.order)},
          {"group", named(inputs.group_column)},
          {"position", named(inputs.position_column)},
          {"fitted", named(inputs.fitted_column)},
          {"missing", ToString(arguments.missing)},
          {"monte_carlo", arguments.monte_carlo},
          {"seed", arguments.seed},
          {"bins", arguments.bins}};
}

int RunResiduals(const ResidualsArguments& arguments,
                 const std::string& command_line) {
  const models::ResidualInputs inputs = ReadInputs(arguments);
  const VectorXd& values = inputs.values;
  const data::Unit unit = data::UnitOfColumn(arguments.column);
  // A residual is what is left of a target, so R2 has no meaning here.
  stats::ErrorMetrics metrics =
      stats::ComputeErrorMetrics(values, values, values);
  metrics.r2 = stats::kNaN;
  const models::ResidualReport report = models::AssessResiduals(
      inputs, static_cast<Index>(arguments.monte_carlo), arguments.seed);
  const stats::Report1995Statistics printed =
      stats::ComputeAsPrinted1995(values);
  const double r_squared_1995 =
      inputs.fitted_column.empty()
          ? stats::kNaN
          : stats::RSquaredAsPrinted1995(inputs.fitted + values, inputs.fitted);
  const std::string sentences =
      report::ResidualSentences(report, metrics, printed, unit);
  if (arguments.format == "json") {
    Json document = {
        {"schema", "errmap-residuals-1"},
        {"file", data::ShownPath(arguments.file)},
        {"column", arguments.column},
        {"unit", unit.symbol},
        {"summary", SummaryJson(metrics, values, report.normality.shape)},
        {"normality",
         models::ToJson(
             models::MakeRecord(report.normality, report.monte_carlo))},
        {"randomness", models::ToJson(models::MakeRecord(report))},
        {"plots",
         PlotsJson(report, values, static_cast<Index>(arguments.bins))},
        {"words", sentences}};
    if (arguments.as_printed_1995) {
      document["as_printed_1995"] = Report1995Json(printed, r_squared_1995);
    }
    document["provenance"] =
        ProvenanceJson(command_line,
                       ConfigurationJson(arguments, inputs),
                       {study_setup::HashInput(arguments.file)});
    PrintResult(DumpJson(document));
    return kDone;
  }
  constexpr std::size_t kWidth = 80;
  PrintFitted(fmt::format(
      "{}, column {}: {} in {}{}\n",
      arguments.file,
      arguments.column,
      report::Count(values.size(), "value"),
      inputs.order,
      inputs.group_column.empty() ? "" : ", groups " + inputs.group_column));
  if (arguments.as_printed_1995) {
    PrintFitted(report::Report1995Text(printed, r_squared_1995, unit) +
                "\ncorrect:\n");
  }
  PrintFitted(fmt::format(
      "{}\n{}\n{}\n{}\n",
      report::SampleText(metrics, values, report.normality.shape, unit),
      report::NormalityText(report, values.size(), unit),
      report::RandomnessText(report),
      report::WrapText(sentences, kWidth)));
  if (arguments.details) {
    PrintFitted(report::DetailsText(
        report, values, unit, static_cast<Index>(arguments.bins)));
  }
  return kDone;
}

void AddColumnOptions(CLI::App* command, ResidualsArguments* arguments) {
  AddOption(command, "--column COL", arguments->column)
      .About("The column")
      .Required();
  AddOption(command, "--order COL", arguments->order)
      .About(
          "Column with the order of measurement (default: the order of the "
          "rows)");
  AddOption(command, "--group COL", arguments->group)
      .About("Warm-up cycles, days or segments (default: cycle)");
  AddOption(command, "--position COL", arguments->position)
      .About("Look for bias along this column (default: the first position*)");
  AddOption(command, "--fitted COL", arguments->fitted)
      .About(
          "Test whether the spread changes with this column (default: the "
          "first predicted*)");
}

}  // namespace

void AddResidualsCommand(CLI::App* app, Run* run) {
  const Command<ResidualsArguments> command(
      app,
      run,
      "residuals",
      "Statistics of a column of residuals, or of any numbers");
  AddOption(command, "FILE FILE.csv", command->file)
      .About("CSV file")
      .Required();
  AddColumnOptions(command, &*command);
  AddOption(command, "--monte-carlo N", command->monte_carlo)
      .About("Simulate p with this many normal samples; 0 for none")
      .Range(0LL, 10'000'000LL)
      .ShowDefault();
  AddSeedOption(command, &command->seed, "Seed of the simulation");
  AddOption(command, "--bins N", command->bins)
      .About("Bins of the histogram (0: by Freedman and Diaconis)")
      .Range(0LL, 10'000LL)
      .ShowDefault();
  AddChoice(
      command,
      "--missing",
      "What to do about empty, NA and NaN cells: error or drop-rows",
      std::vector{data::MissingPolicy::kError, data::MissingPolicy::kDropRows},
      &command->missing);
  AddFlag(command, "--details", command->details)
      .About("Also print bias per group and position, histogram, PPCC curve")
      .Under(kOutputOptions);
  AddFlag(command, "--as-printed-1995", command->as_printed_1995)
      .About("Also the statistics that the program of NISTIR 5367 prints")
      .Under(kOutputOptions);
  AddFormatOption(command, &command->format);
  SetFooter(command,
            "Example: errmap residuals "
            "data/sets/nistir5367_appendix_b.csv --column residual_mm");
  command.Runs(RunResiduals);
}

}  // namespace errmap::cli
