#include "cli/shell/man_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/recipe_catalog.h"
#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

cli::ProgramReference OneCommand() {
  return {.description = "About\n\nA second paragraph",
          .footer = "Example: errmap fit d.csv",
          .commands = {
              {.name = "fit",
               .description = "Fit a map",
               .footer = "First line\nsecond line\nExample: errmap fit -o m",
               .positionals = {{.names = {"DATA"},
                                .value = "FILE.csv",
                                .choices = {},
                                .description = ".dot first, back\\slash",
                                .fallback = "",
                                .required = true,
                                .repeatable = false}},
               .options = {{.names = {"-o", "--output"},
                            .value = "FILE",
                            .choices = {},
                            .description = "File to write",
                            .fallback = "m.json",
                            .required = true,
                            .repeatable = false}}}}};
}

TEST(ManPage, GivesACommandItsSynopsisArgumentsAndExample) {
  const std::string page = cli::ManPage(OneCommand());
  EXPECT_THAT(page,
              HasSubstr(".SS \\fBfit\\fR \\fIFILE.csv\\fR \\fB\\-o\\fR "
                        "\\fIFILE\\fR [options]\nFit a map.\n"));
  EXPECT_THAT(page,
              HasSubstr(".TP\n\\fB\\-o\\fR, \\fB\\-\\-output\\fR "
                        "\\fIFILE\\fR\nFile to write (default: m.json)\n"));
  EXPECT_THAT(page, HasSubstr(".PP\nFirst line\nsecond line\n.PP\nExample:\n"));
  EXPECT_THAT(page, HasSubstr("\nerrmap fit \\-o m\n"));
}

TEST(ManPage, LeavesNothingToBeTakenForARequest) {
  EXPECT_THAT(cli::ManPage(OneCommand()),
              HasSubstr("\n\\&.dot first, back\\eslash\n"));
}

TEST(ManPage, NamesEveryModelWithItsOptionsAndEveryExitStatus) {
  const std::string page = cli::ManPage(OneCommand());
  for (const std::string& type : models::ModelTypes()) {
    EXPECT_THAT(page, HasSubstr("\\fB" + type + "\\fR\n")) << type;
  }
  EXPECT_THAT(page, HasSubstr(": position, T, clip\n"));
  EXPECT_THAT(page, HasSubstr("hidden=20"));
  for (const char* status : {"0", "1", "2", "3", "4", "130"}) {
    EXPECT_THAT(page, HasSubstr(std::string("\\fB") + status + "\\fR\n"));
  }
}

class ProgramManPage : public Cli {};

TEST_F(ProgramManPage, HasEveryCommandAndNoHiddenOne) {
  const std::string page = Run({"__man"}).out;
  for (const std::string& line : SplitLines(Run({"__complete", ""}).out)) {
    EXPECT_THAT(page, HasSubstr(".SS \\fB" + line.substr(0, line.find('\t'))));
  }
  EXPECT_THAT(page, Not(HasSubstr("__")));
}

}  // namespace
}  // namespace errmap
