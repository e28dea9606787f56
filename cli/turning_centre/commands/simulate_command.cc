#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/number_text.h"
#include "cli/shell/command_options.h"
#include "cli/slice.h"
#include "cli/turning_centre/simulation.h"
#include "cli/turning_centre/simulation_files.h"
#include "data/throwing_as.h"

namespace errmap::cli {
namespace {

using turning_centre::FileOptions;
using turning_centre::Simulate;
using turning_centre::Simulation;
using turning_centre::SimulationOptions;

struct SimulateArguments {
  std::string machine;
  std::string folder;
  SimulationOptions simulation;
  FileOptions files;
  bool force = false;
  bool quiet = false;
};

int RunSimulate(const SimulateArguments& arguments) {
  const SimulationOptions& options = arguments.simulation;
  data::ThrowingAs<UsageError>("", [&] { options.Validate(); });
  const std::vector<std::string> names = turning_centre::SimulationFileNames();
  // Before the work, not after it.
  ClaimedFolder folder(arguments.folder, names, {}, arguments.force);
  const Simulation simulation = Simulate(options);
  for (const std::string& name : names) {
    folder.Write(
        name,
        turning_centre::SimulationFile(simulation, arguments.files, name));
  }
  folder.Finish();
  if (!arguments.quiet) {
    Warn(fmt::format("{} of {}, {} in {}; README.md there says what they are",
                     report::Count(options.days, "day"),
                     report::Count(options.cycles, "cycle"),
                     report::Count(std::ssize(names), "file"),
                     arguments.folder));
  }
  return kDone;
}

}  // namespace

void AddSimulateCommand(CLI::App* app, Run* run) {
  const Command<SimulateArguments> command(
      app,
      run,
      "simulate",
      "Simulate measurements of a machine with known errors");
  SimulationOptions& options = command->simulation;
  AddOption(command, "MACHINE", command->machine)
      .About("turning-centre: two slides, a spindle, 40 thermocouples")
      .Required()
      .OneOf({"turning-centre"})
      .Value("NAME");
  AddOption(command, "-o,--output DIR", command->folder)
      .About("Folder to write")
      .Required()
      .Under(kOutputOptions);
  AddSeedOption(command, &options.seed, "Seed of all random draws");
  const auto add = [&](const char* flag, auto& value, const char* what) {
    AddOption(command, flag, value).About(what).ShowDefault();
  };
  add("--days",
      options.days,
      "Days; the first follows the report of 1995, the others are random");
  add("--cycles", options.cycles, "Warm-up cycles per day");
  add("--duty", options.workload.duty, "Factor for all feed duties");
  add("--speed", options.workload.speed, "Factor for all spindle speeds");
  add("--warm",
      options.warm_hours,
      "Hours of unmeasured work, and a break, before the first cycle of each "
      "day but the first");
  add("--air",
      options.air_factor,
      "Factor for all heat conductances to the air");
  add("--noise",
      options.noise_um,
      "Standard deviation of a reading of length, um");
  add("--angle-noise",
      options.noise_urad,
      "Standard deviation of a reading of an angle, urad");
  add("--sensor-noise",
      options.sensor_noise,
      "Standard deviation of a thermocouple's reading, degC");
  const auto add_fault =
      [&](const char* flag, std::vector<int>* list, const char* what) {
        AddOption(command, flag, *list)
            .About(what)
            .SeparatedBy(',')
            .Value("N,N,...");
      };
  add_fault("--dead", &options.dead, "Thermocouples (0 to 39) that read 0");
  add_fault("--stuck", &options.stuck, "... that stop on the first day");
  add_fault("--drifting", &options.drifting, "... that gain 0.04 degC an hour");
  add_fault("--noisy", &options.noisy, "... with 25 times the noise");
  add("--from-day",
      options.from_day,
      "Day on which these faults and --shift-um begin");
  add("--shift-um",
      options.shift_um,
      "From then on, add this to the displacements of both slides, as if the "
      "machine had changed");
  add("--points",
      options.points_per_day,
      "Random poses per day in tool_tip.csv");
  AddFlag(command, "--truth", command->files.truth)
      .About("Add the error without reading noise: truth_mm, truth_urad");
  AddForceFlag(command, &command->force);
  AddQuietFlag(command, &command->quiet);
  MarkSeldom(command,
             {"--duty",
              "--speed",
              "--warm",
              "--air",
              "--angle-noise",
              "--sensor-noise",
              "--points"});
  SetFooter(command,
            "The same options give the same files, byte for byte.\nExample: "
            "errmap simulate turning-centre -o simulated --dead 3,4,16,19");
  command.Runs(RunSimulate);
}

}  // namespace errmap::cli

namespace errmap::turning_centre {

cli::Slice AsSlice() {
  return {
      .commands = {
          {cli::AddSimulateCommand, "Laboratory", cli::AddResidualsCommand}}};
}

}  // namespace errmap::turning_centre
