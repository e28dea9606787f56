#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/commands/data_arguments.h"
#include "cli/commands/studies/compare_arguments.h"
#include "cli/machine/machine_study.h"
#include "cli/shell/command_options.h"
#include "cli/slice.h"

namespace errmap::cli {

void AddIso230Command(CLI::App* app, Run* run);
void AddVolumetricCommand(CLI::App* app, Run* run);

namespace {

// --machine machine.toml DIR: its maps, compared together.
class CompareMachine : public CompareMode {
 public:
  void AddOptions(std::string_view flag, CLI::App* command) override {
    if (flag != "--predictions") return;
    AddOption(command, "--machine machine.toml", machine_)
        .About(
            "Compare the maps STEM.json of this machine on STEM.csv in the "
            "folder DATA, and judge them together at the poses of its "
            "tool_tip.csv");
    AddOption(command, "--later N", later_)
        .About(
            "With --machine: number of last sessions kept from all fits, to "
            "judge them")
        .Range(1, 1000)
        .ShowDefault();
    MarkSeldom(command, {"--machine", "--later"});
  }

  std::optional<int> Begin(const CompareArguments& arguments) override {
    if (machine_.empty()) {
      if (arguments.given.contains("--later")) {
        throw UsageError("--later needs --machine");
      }
      return std::nullopt;
    }
    std::vector<std::string> of_one =
        GivenOfFewer(arguments, study_setup::Reach::kAlike);
    for (const char* flag : {"--rezero", "--config"}) {
      if (arguments.given.contains(flag)) of_one.insert(of_one.begin(), flag);
    }
    for (const std::string& flag : of_one) {
      throw UsageError(fmt::format(
          "{} is for one component, and --machine has several", flag));
    }
    if (!arguments.given.contains("DATA")) {
      throw UsageError(
          "--machine needs the folder of its components' data: errmap compare "
          "--machine machine.toml DIR");
    }
    if (arguments.data.files.size() != 1) {
      throw UsageError("--machine needs one folder as DATA");
    }
    study_ = machine::ReadMachineStudy(machine_,
                                       arguments.data.files.front(),
                                       later_,
                                       arguments.data.selection.session);
    return std::nullopt;
  }

  std::optional<study_setup::StudyPlan> Plan(
      const CompareArguments& arguments,
      const study_setup::MakeOwnRecipes& /*own*/) override {
    if (!study_) return std::nullopt;
    return machine::PlanOfMachine(
        *study_, ConfigOf(arguments), Sayer(arguments.data.quiet));
  }

  bool Judges() const override { return study_.has_value(); }
  void Judge(const study_setup::StudyRun& run,
             models::StudyRecord* record) const override {
    machine::AddMachine(machine::JudgeMachine(*study_, run), record);
  }

 private:
  std::string machine_;
  int later_ = 1;  // sessions that judge it
  std::optional<machine::MachineStudy> study_;
};

}  // namespace
}  // namespace errmap::cli

namespace errmap::machine {

cli::Slice AsSlice() {
  constexpr const char* kPurpose = "Hand over to the control";
  return {.commands = {{cli::AddIso230Command, kPurpose},
                       {cli::AddVolumetricCommand, kPurpose}},
          .compare = []() -> std::unique_ptr<cli::CompareMode> {
            return std::make_unique<cli::CompareMachine>();
          }};
}

}  // namespace errmap::machine
