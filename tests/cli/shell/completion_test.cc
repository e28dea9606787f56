#include "cli/shell/completion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/recipe_catalog.h"
#include "stats/holdout.h"
#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using cli::CommandReference;
using cli::Completion;
using cli::OptionReference;
using cli::ProgramReference;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::Gt;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

OptionReference Option(const std::string& name,
                       const std::string& value,
                       const std::vector<std::string>& choices = {}) {
  return {.names = {name},
          .value = value,
          .choices = choices,
          .description = "What " + name + " does",
          .fallback = "",
          .required = false,
          .repeatable = name == "--holdout"};
}

ProgramReference SmallProgram() {
  CommandReference compare{
      .name = "compare",
      .description = "Compare maps\nby error",
      .footer = "",
      .positionals = {Option("DATA", "FILE.csv")},
      .options = {Option("--target", "COL"),
                  Option("--inputs", "A,B,..."),
                  Option("--holdout", "SPEC"),
                  Option("--models", "LIST"),
                  Option("--model", "SPEC"),
                  Option("--out", "DIR"),
                  Option("--split", "FILE"),
                  Option("--predictions", "NAME=FILE"),
                  Option("--config", "study.toml"),
                  Option("--seed", "N"),
                  Option("--format", "table|json", {"table", "json"}),
                  Option("--quiet", "")}};
  CommandReference cost = compare;
  cost.name = "cost";
  cost.positionals = {Option("MODEL", "FILE.json"), Option("DATA", "FILE.csv")};
  cost.options = {Option("--quiet", "")};
  return {.description = "", .footer = "", .commands = {compare, cost}};
}

std::vector<std::string> Words(const Completion& completion) {
  std::vector<std::string> words;
  for (const cli::Candidate& candidate : completion.candidates) {
    words.push_back(candidate.word);
  }
  return words;
}

Completion Complete(const std::vector<std::string>& words) {
  return cli::Complete(SmallProgram(), words);
}

TEST(Completion, OffersCommandsThatGoOnFromTheWord) {
  EXPECT_THAT(Words(Complete({})), ElementsAre("compare", "cost"));
  EXPECT_THAT(Words(Complete({"co"})), ElementsAre("compare", "cost"));
  EXPECT_THAT(Words(Complete({"cos"})), ElementsAre("cost"));
  EXPECT_THAT(Words(Complete({"x"})), IsEmpty());
  EXPECT_THAT(Words(Complete({"--v"})), ElementsAre("--version"));
  EXPECT_THAT(Words(Complete({"nonsense", ""})), IsEmpty());
}

TEST(Completion, OffersOptionsOnceButThoseThatMayBeRepeated) {
  EXPECT_THAT(Words(Complete({"compare", "--mod"})),
              ElementsAre("--models", "--model"));
  EXPECT_THAT(Words(Complete({"compare", "--quiet", "--q"})), IsEmpty());
  EXPECT_THAT(Words(Complete({"compare", "--holdout", "every:3", "--hold"})),
              ElementsAre("--holdout"));
  EXPECT_THAT(Words(Complete({"compare", "--help", "--he"})),
              ElementsAre("--help"));
}

TEST(Completion, OffersFilesOfThePositionalThatIsNext) {
  const Completion data = Complete({"compare", "--quiet", ""});
  EXPECT_TRUE(data.files);
  EXPECT_EQ(data.extension, "csv");
  EXPECT_EQ(Complete({"cost", ""}).extension, "json");
  EXPECT_EQ(Complete({"cost", "m.json", ""}).extension, "csv");
  // None is left: options.
  EXPECT_THAT(Words(Complete({"cost", "m.json", "d.csv", ""})),
              ElementsAre("--quiet", "--help"));
}

TEST(Completion, OffersTheWordsThatAnOptionIsLimitedTo) {
  EXPECT_THAT(Words(Complete({"compare", "--format", ""})),
              ElementsAre("table", "json"));
  EXPECT_THAT(Words(Complete({"compare", "--format", "j"})),
              ElementsAre("json"));
  EXPECT_THAT(Words(Complete({"compare", "--format=j"})),
              ElementsAre("--format=json"));
  EXPECT_THAT(Words(Complete({"compare", "--seed", ""})), IsEmpty());
}

TEST(Completion, OffersFilesAndFoldersWhereAnOptionTakesThem) {
  EXPECT_TRUE(Complete({"compare", "--out", ""}).folders);
  EXPECT_TRUE(Complete({"compare", "--split", ""}).files);
  EXPECT_EQ(Complete({"compare", "--split", ""}).extension, "");
  EXPECT_TRUE(Complete({"compare", "--predictions", "mine="}).files);
  EXPECT_EQ(Complete({"compare", "--config", ""}).extension, "toml");
  EXPECT_FALSE(Complete({"compare", "--seed", ""}).files);
}

TEST(Completion, OffersEveryModelAndThenItsOptions) {
  EXPECT_THAT(Words(Complete({"compare", "--model", ""})),
              AllOf(SizeIs(models::ModelTypes().size() + 1),
                    Contains("net:scg"),
                    Contains("poly:formula=")));
  EXPECT_THAT(Words(Complete({"compare", "--model", "net:scg:hid"})),
              ElementsAre("net:scg:hidden="));
  EXPECT_THAT(Words(Complete({"compare", "--model", "net:scg:hidden=9:w"})),
              ElementsAre("net:scg:hidden=9:wfactor="));
  EXPECT_THAT(Words(Complete({"compare", "--model", "net:scg:hidden=9:hid"})),
              IsEmpty());
  EXPECT_THAT(Words(Complete({"compare", "--model", "poly:stepwise:"})),
              AllOf(Contains("poly:stepwise:heredity="),
                    Not(Contains("poly:stepwise:hidden="))));
}

TEST(Completion, GoesOnInListsAfterTheLastComma) {
  EXPECT_THAT(Words(Complete({"compare", "--models", "mean,net:n"})),
              ElementsAre("mean,net:nlopt"));
  EXPECT_THAT(Words(Complete({"compare", "--models=mean,net:n"})),
              ElementsAre("--models=mean,net:nlopt"));
}

TEST(Completion, OffersHoldoutsThatCanBeUsedAsTheyStand) {
  EXPECT_THAT(Words(Complete({"compare", "--holdout", ""})),
              ElementsAreArray(cli::HoldoutExamples()));
  for (const std::string& example : cli::HoldoutExamples()) {
    if (example == "file:") continue;  // A name is to follow.
    EXPECT_NO_THROW(stats::ParseHoldout(example)) << example;
  }
  const Completion file = Complete({"compare", "--holdout", "file:o"});
  EXPECT_TRUE(file.files);
  EXPECT_EQ(file.extension, "csv");
}

class CompletionOfColumns : public CliTest {};

TEST_F(CompletionOfColumns, ReadsThemFromTheDataFileNamedBefore) {
  Write("d.csv", "position_mm,t1_degC,error_mm\n1,2,3\n4,5,6\n");
  const std::string path = (scratch_ / "d.csv").string();
  EXPECT_THAT(Words(Complete({"compare", path, "--target", ""})),
              ElementsAre("position_mm", "t1_degC", "error_mm"));
  EXPECT_THAT(Words(Complete({"compare", path, "--inputs", "t1_degC,pos"})),
              ElementsAre("t1_degC,position_mm"));
  EXPECT_THAT(Words(Complete({"compare", "gone.csv", "--target", ""})),
              IsEmpty());
  Write("bad.csv", "no line end");
  EXPECT_THAT(
      Words(Complete(
          {"compare", (scratch_ / "bad.csv").string(), "--target", ""})),
      IsEmpty());
}

TEST(CompletionText, HasALinePerCandidateAndOneForFiles) {
  Completion completion;
  completion.candidates = {{"a", "What a is\nin two lines"},
                           {"b", ""},
                           {"two\nlines", "not to be told"}};
  completion.files = true;
  EXPECT_EQ(cli::CompletionText(completion), "a\tWhat a is\nb\n:files\n");
  completion.extension = "csv";
  EXPECT_EQ(cli::CompletionText(completion), "a\tWhat a is\nb\n:files csv\n");
  EXPECT_EQ(
      cli::CompletionText(
          {.candidates = {}, .files = false, .extension = "", .folders = true}),
      ":folders\n");
}

// The program as it is, whatever commands it has.
class ProgramCompletion : public Cli {};

TEST_F(ProgramCompletion, KnowsEveryCommandOfTheHelpAndEveryOptionOfEach) {
  const std::vector<std::string> lines =
      SplitLines(Run({"__complete", ""}).out);
  ASSERT_THAT(lines, SizeIs(Gt(6U)));
  for (const std::string& line : lines) {
    const std::string command = line.substr(0, line.find('\t'));
    EXPECT_THAT(Run({"--help"}).out, ::testing::HasSubstr("  " + command));
    const std::string help = Run({"help", command, "--all"}).out;
    const std::string offered = Run({"__complete", command, "-"}).out;
    int options = 0;
    for (const std::string& help_line : SplitLines(help)) {
      if (!help_line.starts_with("  -")) continue;
      std::string name = help_line.substr(0, help_line.find(' ', 2)).substr(2);
      name = name.substr(name.rfind(',') + 1);
      EXPECT_THAT(offered, ::testing::HasSubstr(name)) << command;
      ++options;
    }
    // --help, which all have, is not in the list; models has nothing else.
    EXPECT_GT(options, command == "models" ? -1 : 0) << command;
  }
}

}  // namespace
}  // namespace errmap
