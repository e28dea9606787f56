#include <optional>
#include <string>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/json_blocks.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "data/input_error.h"
#include "data/text.h"
#include "data/throwing_as.h"
#include "models/export/export_map.h"
#include "models/export/measured_cost.h"
#include "models/export/program_cost.h"

namespace errmap::cli {
namespace {

struct CostArguments {
  std::string model;
  std::string every;
  bool single = false;
  std::string format = "table";
};

models::MapExport PrepareToMeasure(const CostArguments& arguments) {
  const models::FittedModel fitted =
      LoadForControl(arguments.model, arguments.every, false);
  return data::ThrowingAs<data::InputError>(
      data::PrintablePath(arguments.model) + ": ", [&] {
        return models::PrepareExport({&fitted},
                                     "map",
                                     arguments.single
                                         ? models::Precision::kSingle
                                         : models::Precision::kDouble);
      });
}

Json CostJson(const models::MapExport& map,
              const models::ProgramCost& counted,
              const std::optional<models::MeasuredCost>& measured) {
  const auto known = [&](auto member) {
    return measured ? Json((*measured).*member) : Json(nullptr);
  };
  return {{"schema", "errmap-cost-1"},
          {"model", map.program.model},
          {"precision",
           map.precision == models::Precision::kSingle ? "single" : "double"},
          {"inputs", map.program.size(models::Space::kReading)},
          {"operations",
           {{"additions", counted.additions},
            {"multiplications", counted.multiplications},
            {"divisions", counted.divisions},
            {"exponentials", counted.exponentials},
            {"sines", counted.sines},
            {"comparisons", counted.comparisons},
            {"copies", counted.copies}}},
          {"bytes",
           {{"code", known(&models::MeasuredCost::code_bytes)},
            {"constants", known(&models::MeasuredCost::constant_bytes)},
            {"state", counted.state_bytes}}},
          {"compiler", models::kCostCompiler},
          {"median_ns", known(&models::MeasuredCost::median_ns)},
          {"p999_ns", known(&models::MeasuredCost::high_ns)},
          {"worst_ns", known(&models::MeasuredCost::worst_ns)}};
}

std::string CostText(const models::MapExport& map,
                     const models::ProgramCost& counted,
                     const std::optional<models::MeasuredCost>& measured,
                     const std::string& why) {
  std::string text = fmt::format(
      "{}: one step of the exported C\n"
      "additions        {:>9}\n"
      "multiplications  {:>9}\n"
      "divisions        {:>9}\n"
      "exponentials     {:>9}\n"
      "sines, cosines   {:>9}\n"
      "comparisons      {:>9}\n"
      "copies           {:>9}\n"
      "bytes of state   {:>9}\n",
      data::Printable(map.program.model),
      counted.additions,
      counted.multiplications,
      counted.divisions,
      counted.exponentials,
      counted.sines,
      counted.comparisons,
      counted.copies,
      counted.state_bytes);
  if (!measured) return text + why + "\n";
  return text + fmt::format(
                    "bytes of code    {:>9}\n"
                    "bytes, constants {:>9}\n"
                    "median           {:>9.1f} ns\n"
                    "99.9 % below     {:>9.0f} ns\n"
                    "CPU time of 100000 steps measured here, {}; the slowest, "
                    "{:.0f} ns, includes this system's interrupts\n",
                    measured->code_bytes,
                    measured->constant_bytes,
                    measured->median_ns,
                    measured->high_ns,
                    models::kCostCompiler,
                    measured->worst_ns);
}

int RunCost(const CostArguments& arguments) {
  const models::MapExport map = PrepareToMeasure(arguments);
  const models::ProgramCost counted = models::CostOf(map.program);
  std::string why;
  const std::optional<models::MeasuredCost> measured =
      models::MeasureCost(map, &why);
  if (arguments.format == "json") {
    PrintResult(DumpJson(CostJson(map, counted, measured)));
  } else {
    PrintFitted(CostText(map, counted, measured, why));
  }
  return kDone;
}

}  // namespace

void AddCostCommand(CLI::App* app, Run* run) {
  const Command<CostArguments> command(
      app,
      run,
      "cost",
      "Report a map's operations, memory and time on a controller");
  AddModelArgument(command, &command->model);
  AddFlag(command, "--float", command->single)
      .About("Use single precision except for the state");
  AddEveryOption(command, &command->every);
  AddFormatOption(command, &command->format);
  SetFooter(
      command,
      R"(Operations are counted from the program that errmap export writes; bytes and times are
measured on its C code, compiled here. A polynomial of 10 terms takes about 10 ns, a net with
37 inputs and 10 hidden nodes about 200 ns. Both fit a servo period of 1 ms.
Example: errmap cost map.json)");
  command.Runs(RunCost);
}

}  // namespace errmap::cli
