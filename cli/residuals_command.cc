#include <limits>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/command.h"
#include "cli/data_arguments.h"
#include "cli/json_blocks.h"
#include "cli/summary_text.h"
#include "data/csv.h"
#include "data/dataset.h"
#include "stats/error_metrics.h"
#include "stats/kolmogorov_smirnov.h"
#include "stats/report_1995.h"

namespace errmap::cli {
namespace {

struct ResidualsArguments {
  std::string file;
  std::string column;
  std::string missing = "error";
  std::string format = "table";
  bool as_printed_1995 = false;
};

Json Report1995Json(const stats::Report1995Statistics& printed) {
  return {{"mean", printed.mean},
          {"sd", printed.sd},
          {"min", printed.min},
          {"max", printed.max},
          {"ks", {{"d", printed.ks_d}, {"p_given", printed.ks_probability}}}};
}

std::string Report1995Text(const stats::Report1995Statistics& printed,
                           const data::Unit& unit) {
  const auto line = [&](const char* label, double value) {
    return fmt::format(
        "  {:<10} {:.6g}{}\n",
        label,
        value * unit.display_scale,
        unit.display_symbol.empty() ? "" : " " + unit.display_symbol);
  };
  return fmt::format(
      "as the 1995 program prints it (single precision; its sums are divided "
      "by\n(n+1)*2 = {} in place of n, so mean and sd are too small and D is "
      "wrong):\n{}{}{}{}  {:<10} {:.6f}, p {:.6g}\n",
      (printed.n + 1) * 2,
      line("mean", printed.mean),
      line("sd", printed.sd),
      line("min", printed.min),
      line("max", printed.max),
      "K-S D",
      printed.ks_d,
      printed.ks_probability);
}

int RunResiduals(const ResidualsArguments& arguments) {
  const data::CsvTable table = data::ReadCsv(arguments.file);
  const Eigen::VectorXd values = data::NumericColumn(
      table,
      arguments.column,
      arguments.missing == "error" ? data::MissingPolicy::kError
                                   : data::MissingPolicy::kDropRows,
      nullptr);
  const data::Unit unit = data::UnitOfColumn(arguments.column);
  // A residual is what is left of a target, so R2 has no meaning here.
  stats::ErrorMetrics metrics =
      stats::ComputeErrorMetrics(values, values, values);
  metrics.r2 = std::numeric_limits<double>::quiet_NaN();
  const double ks_d = stats::KsDistanceFromNormal(
      values, metrics.residuals.mean, metrics.residuals.sd);
  const double ks_p = stats::KsProbabilityMeanSdGiven(ks_d, values.size());
  if (arguments.format == "json") {
    Json document = {{"schema", "errmap-residuals-1"},
                     {"file", arguments.file},
                     {"column", arguments.column},
                     {"unit", unit.symbol},
                     {"summary", MetricsJson(metrics)},
                     {"normality", NormalityJson(ks_d, ks_p)}};
    if (arguments.as_printed_1995) {
      document["as_printed_1995"] =
          Report1995Json(stats::ComputeAsPrinted1995(values));
    }
    fmt::print("{}", DumpJson(document));
    return kDone;
  }
  fmt::print("{}, column {}\n", arguments.file, arguments.column);
  if (arguments.as_printed_1995) {
    fmt::print("{}\ncorrect:\n",
               Report1995Text(stats::ComputeAsPrinted1995(values), unit));
  }
  fmt::print("{}", SummaryText(metrics, unit, ks_d, ks_p));
  return kDone;
}

}  // namespace

void AddResidualsCommand(CLI::App* app, Run* run) {
  auto arguments = std::make_shared<ResidualsArguments>();
  CLI::App* command = app->add_subcommand(
      "residuals", "Statistics of a column of residuals (or of anything)");
  command->add_option("FILE", arguments->file, "CSV file")
      ->required()
      ->type_name("FILE.csv");
  command->add_option("--column", arguments->column, "The column")
      ->required()
      ->type_name("COL");
  command
      ->add_option("--missing",
                   arguments->missing,
                   "What empty, NA and NaN cells do: error or drop-rows")
      ->check(CLI::IsMember({"error", "drop-rows"}))
      ->type_name("error|drop-rows")
      ->capture_default_str();
  command->add_flag("--as-printed-1995",
                    arguments->as_printed_1995,
                    "Also what the program of NISTIR 5367 prints for them");
  command->add_option("--format", arguments->format, "table or json")
      ->check(CLI::IsMember({"table", "json"}))
      ->type_name("table|json")
      ->capture_default_str();
  command->callback(
      [arguments, run] { run->status = RunResiduals(*arguments); });
}

}  // namespace errmap::cli
