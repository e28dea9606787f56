#include <string>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/json_blocks.h"
#include "cli/report/number_text.h"
#include "cli/report/text/commands/certify_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "models/certification/certification.h"
#include "models/record_json.h"
#include "models/version.h"

namespace errmap::cli {
namespace {

struct CertifyArguments {
  std::string part = "all";
  std::string format = "table";
  bool details = false;

  bool Includes(const char* name) const {
    return part == "all" || part == name;
  }
};

int RunCertify(const CertifyArguments& arguments,
               const std::string& command_line) {
  const models::CertificationFloors floors;
  models::Certification certification;
  if (arguments.Includes("nist")) {
    models::CertifyNonlinear(&certification);
    models::CertifyLinear(&certification);
    models::CertifyUnivariate(&certification);
  }
  if (arguments.Includes("gradients")) {
    models::CertifyGradients(&certification);
  }
  if (arguments.Includes("agreement")) {
    models::CertifyAgreement(&certification);
  }
  models::JudgeFloors(floors, &certification);
  if (arguments.format == "json") {
    Json document = {{"schema", "errmap-certify-1"},
                     {"version", models::Version()},
                     {"passed", certification.passed()}};
    document.update(models::ToJson(certification));
    document["floors"] = models::ToJson(floors);
    document["provenance"] =
        ProvenanceJson(command_line, {{"part", arguments.part}}, {});
    PrintResult(DumpJson(document));
  } else {
    PrintFitted(
        report::CertificationText(certification, floors, arguments.details));
  }
  if (certification.passed()) return kDone;
  const auto missed = std::ssize(certification.missed);
  Warn(fmt::format(
      "certify: {} missed, the first: {}; do not trust this installation",
      report::Count(missed, "floor"),
      certification.missed.front()));
  return kEveryFitFailed;
}

}  // namespace

void AddCertifyCommand(CLI::App* app, Run* run) {
  const Command<CertifyArguments> command(
      app,
      run,
      "certify",
      "Test solvers and statistics on problems with known answers");
  AddOption(command, "PART", command->part)
      .About(
          "nist: NIST's reference data sets; gradients: derivatives against "
          "extrapolated differences; agreement: every solver on one net")
      .OneOf({"nist", "gradients", "agreement", "all"})
      .ShowDefault();
  AddFlag(command, "--details", command->details)
      .About("Print every run of every solver, with its message");
  AddFormatOption(command, &command->format);
  SetFooter(command,
            "Exit status: 0 all are accurate enough, 4 one is not.\n"
            "Example: errmap certify nist --format json");
  command.Runs(RunCertify);
}

}  // namespace errmap::cli
