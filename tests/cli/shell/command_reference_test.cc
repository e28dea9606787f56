#include "cli/shell/command_reference.h"

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class CommandReferenceTest : public ::testing::Test {
 protected:
  CommandReferenceTest() {
    app_.footer("Said by all");
    CLI::App* command = app_.add_subcommand("fit", "Fit one map");
    command->add_option("DATA", file_, "A table")
        ->required()
        ->type_name("FILE.csv");
    command->add_option("-o,--output", out_, "File to write")
        ->required()
        ->type_name("FILE.json");
    command->add_option("--format", format_, "How to say it")
        ->check(CLI::IsMember({"table", "json"}))
        ->type_name("table|json")
        ->capture_default_str();
    command->add_option("--model", models_, "A model")->type_name("SPEC");
    command->add_flag("--quiet", quiet_, "Say nothing");
    command->add_flag("--secret", secret_, "Not for people")->group("");
    app_.add_subcommand("cost", "Cost of a map")->footer("Its own");
    app_.add_subcommand("hidden", "Not for people")->group("");
  }

  CLI::App app_{"About", "program"};
  std::string file_;
  std::string out_;
  std::string format_ = "table";
  std::vector<std::string> models_;
  bool quiet_ = false;
  bool secret_ = false;
};

TEST_F(CommandReferenceTest, NamesCommandsButForHiddenOnes) {
  const ProgramReference program = DescribeProgram(app_);
  EXPECT_EQ(program.description, "About");
  ASSERT_EQ(program.commands.size(), 2U);
  EXPECT_EQ(program.commands[0].name, "fit");
  EXPECT_EQ(program.commands[0].description, "Fit one map");
  EXPECT_EQ(program.commands[1].name, "cost");
}

TEST_F(CommandReferenceTest, KeepsAFooterThatIsACommandsOwn) {
  const ProgramReference program = DescribeProgram(app_);
  EXPECT_EQ(program.footer, "Said by all");
  EXPECT_EQ(program.commands[0].footer, "");
  EXPECT_EQ(program.commands[1].footer, "Its own");
}

TEST_F(CommandReferenceTest, TellsPositionalsOptionsAndFlagsApart) {
  const CommandReference fit = DescribeProgram(app_).commands[0];
  ASSERT_EQ(fit.positionals.size(), 1U);
  EXPECT_THAT(fit.positionals[0].names, ElementsAre("DATA"));
  EXPECT_EQ(fit.positionals[0].value, "FILE.csv");
  EXPECT_TRUE(fit.positionals[0].required);
  ASSERT_EQ(fit.options.size(), 4U);  // neither --help nor --secret
  EXPECT_THAT(fit.options[0].names, ElementsAre("-o", "--output"));
  EXPECT_TRUE(fit.options[0].required);
  EXPECT_THAT(fit.options[0].choices, IsEmpty());
  EXPECT_EQ(fit.options[1].value, "table|json");
  EXPECT_THAT(fit.options[1].choices, ElementsAre("table", "json"));
  EXPECT_EQ(fit.options[1].fallback, "table");
  EXPECT_FALSE(fit.options[1].repeatable);
  EXPECT_TRUE(fit.options[2].repeatable);
  EXPECT_EQ(fit.options[3].value, "");
  EXPECT_EQ(fit.options[3].description, "Say nothing");
}

}  // namespace
}  // namespace errmap::cli
