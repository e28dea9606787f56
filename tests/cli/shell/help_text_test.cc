#include "cli/shell/help_text.h"

#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/wrap_text.h"
#include "tests/cli/cli_fixture.h"

namespace errmap {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

cli::OptionReference Option(std::vector<std::string> names,
                            const std::string& value,
                            const std::string& description) {
  cli::OptionReference option;
  option.names = std::move(names);
  option.value = value;
  option.description = description;
  return option;
}

cli::CommandReference Weigh() {
  cli::CommandReference command;
  command.name = "weigh";
  command.purpose = "Kitchen";
  command.description = "Weigh things";
  command.footer = "A sentence\nthat goes on.\nExample: errmap weigh apple";
  command.positionals = {Option({"THING"}, "FILE", "What to weigh")};
  command.positionals.front().required = true;
  command.options = {Option({"-o", "--output"}, "FILE", "Where to"),
                     Option({"--unit"}, "g|kg", "Of weight\nThe whole story")};
  command.options.front().required = true;
  command.options.push_back(Option({"--rare"}, "", "For a few"));
  command.options.back().seldom = true;
  return command;
}

TEST(CommandHelp, LeavesWhatIsSeldomNeededToAll) {
  const std::string usual =
      cli::CommandHelp(Weigh(), cli::HelpOptions::kUsual, 80);
  EXPECT_THAT(usual,
              AllOf(HasSubstr("Usage: errmap weigh FILE -o FILE [options]\n"),
                    HasSubstr("  --unit g|kg                 Of weight\n"),
                    Not(HasSubstr("--rare")),
                    Not(HasSubstr("whole story")),
                    HasSubstr("1 more option: errmap help weigh --all\n")));
  const std::string all = cli::CommandHelp(Weigh(), cli::HelpOptions::kAll, 80);
  EXPECT_THAT(all,
              AllOf(HasSubstr("  --rare                      For a few\n"),
                    HasSubstr("Of weight. The whole story\n"),
                    Not(HasSubstr("more option"))));
}

TEST(CommandHelp, JoinsTheLinesOfASentenceAndKeepsAnExampleApart) {
  EXPECT_THAT(cli::CommandHelp(Weigh(), cli::HelpOptions::kAll, 80),
              HasSubstr("\nA sentence that goes on.\nExample: errmap weigh "
                        "apple\n"));
}

TEST(CommandHelp, ContinuesALongExampleAsAShellReadsIt) {
  cli::CommandReference command = Weigh();
  command.footer = "Example: errmap weigh apple.csv pear.csv -o weights.csv";
  EXPECT_THAT(cli::CommandHelp(command, cli::HelpOptions::kAll, 40),
              HasSubstr("\nExample:\n  errmap weigh apple.csv pear.csv \\\n"
                        "      -o weights.csv\n"));
}

TEST(CommandHelp, PutsManyOptionsUnderHeadingsAndTheOutputLast) {
  cli::CommandReference command = Weigh();
  for (cli::OptionReference& option : command.options) {
    option.heading = option.names[0] == "-o" ? "Output" : "Scales";
  }
  EXPECT_THAT(cli::CommandHelp(command, cli::HelpOptions::kAll, 80),
              Not(HasSubstr("Output:")));
  while (command.options.size() < 11) {
    command.options.push_back(command.options.back());
  }
  const std::string help =
      cli::CommandHelp(command, cli::HelpOptions::kAll, 80);
  EXPECT_THAT(help,
              HasSubstr("  THING FILE                  What to weigh\n"
                        "Scales:\n  --unit g|kg"));
  EXPECT_THAT(help, HasSubstr("Output:\n  -o,--output FILE            Where"));
  EXPECT_LT(help.find("Scales:"), help.find("Output:"));
}

TEST(ProgramHelp, PutsCommandsUnderWhatTheyServe) {
  cli::ProgramReference program;
  program.description = "About";
  program.footer = "At last";
  program.commands = {Weigh(), Weigh(), Weigh()};
  program.commands[2].purpose = "Cellar";
  EXPECT_EQ(cli::ProgramHelp(program, 80),
            "About\nUsage: errmap COMMAND [options]\n\nKitchen\n"
            "  weigh        Weigh things\n  weigh        Weigh things\n\n"
            "Cellar\n  weigh        Weigh things\n\nAt last\n");
}

class ProgramsHelp : public Cli {
 protected:
  std::vector<std::string> Commands() {
    std::vector<std::string> names;
    for (const std::string& line : SplitLines(Run({"__complete", ""}).out)) {
      names.push_back(line.substr(0, line.find('\t')));
    }
    return names;
  }
};

void ExpectAtMost(const std::string& text,
                  std::size_t most_lines,
                  std::size_t most_columns) {
  const std::vector<std::string> lines = SplitLines(text);
  EXPECT_LE(lines.size(), most_lines);
  for (const std::string& line : lines) {
    EXPECT_LE(report::WidthOf(line), most_columns) << line;
  }
}

// Mark an option seldom (MarkSeldom), or put what is not needed every day
// behind a line feed of its description, where this fails.
TEST_F(ProgramsHelp, OfEachCommandFits40LinesOf80Columns) {
  for (const std::string& command : Commands()) {
    SCOPED_TRACE(command);
    ExpectAtMost(Run({"help", command}).out, 40, 80);
    ExpectAtMost(Run({"help", command, "--all"}).out, 150, 80);
  }
}

TEST_F(ProgramsHelp, NamesEachCommandInOneLine) {
  const std::string help = Run({"--help"}).out;
  ExpectAtMost(help, 60, 80);
  for (const std::string& command : Commands()) {
    int lines = 0;
    for (const std::string& line : SplitLines(help)) {
      if (line.starts_with("  " + command + " ")) ++lines;
    }
    EXPECT_EQ(lines, 1) << command;
  }
  for (const std::string& line : SplitLines(help)) {
    EXPECT_FALSE(line.starts_with("   ")) << "goes on: " << line;
  }
}

TEST_F(ProgramsHelp, NamesEveryOptionWithAll) {
  for (const std::string& command : Commands()) {
    const std::string all = Run({"help", command, "--all"}).out;
    for (const std::string& line :
         SplitLines(Run({"__complete", command, "--"}).out)) {
      const std::string option = line.substr(0, line.find('\t'));
      if (option == "--help") continue;
      EXPECT_THAT(all, HasSubstr(option)) << command;
    }
  }
}

TEST_F(ProgramsHelp, BeginsWithThreeCommandsWhereNothingIsAsked) {
  const Outcome nothing = Run({});
  EXPECT_EQ(nothing.status, kWrongCommandLine);
  ExpectAtMost(nothing.out, 15, 80);
  int commands = 0;
  for (const std::string& line : SplitLines(nothing.out)) {
    if (line.starts_with("  errmap ")) ++commands;
  }
  EXPECT_EQ(commands, 3);
}

TEST_F(ProgramsHelp, ExplainsTopicsToo) {
  EXPECT_THAT(Run({"help", "words"}).out,
              AllOf(HasSubstr("Hold-out"), HasSubstr("Session")));
  EXPECT_THAT(Run({"help", "wrods"}).err, HasSubstr("did you mean 'words'?"));
  EXPECT_THAT(SplitLines(Run({"__complete", "help", "tut"}).out),
              ::testing::Contains(StartsWith("tutorial\t")));
  for (const std::string& line :
       SplitLines(Run({"__complete", "help", ""}).out)) {
    if (line.starts_with("-")) continue;
    const std::string word = line.substr(0, line.find('\t'));
    const Outcome help = Run({"help", word});
    EXPECT_EQ(help.status, 0) << word;
    for (const std::string& text : SplitLines(help.out)) {
      EXPECT_LE(report::WidthOf(text), 80U) << word << ": " << text;
    }
  }
}

// "--name VALUE" of a line of help, "" where there is none.
std::string ValueOf(const std::string& line, const std::string& name) {
  const std::string words = line.substr(0, line.find("  ", 2));
  const std::size_t at = words.find(name);
  if (!line.starts_with("  -") || at == words.npos) return "";
  const std::size_t end = at + name.size();
  if (end < words.size() && words[end] != ' ') return "";
  return words.substr(at);
}

// What an option is called does not depend on the command.
TEST_F(ProgramsHelp, CallsTheSameThingByTheSameOption) {
  const std::map<std::string, std::set<std::string>> meant = {
      {"--target", {"--target COL"}},
      {"--group", {"--group COL"}},
      {"--session", {"--session COL"}},
      {"--time", {"--time COL"}},
      {"--inputs", {"--inputs A,B,..."}},
      {"--exclude", {"--exclude A,B,..."}},
      {"--models", {"--models LIST"}},
      // deploy takes a map, the others the SPEC of one.
      {"--model", {"--model SPEC", "--model FILE.json"}},
      {"--goal", {"--goal X"}},
      {"--seed", {"--seed N"}},
      {"--jobs", {"--jobs N"}},
      {"--out", {"--out DIR"}},
      {"--after", {"--after EARLIER.csv"}},
      // report prints the page itself.
      {"--format",
       {"--format table|json",
        "--format table|json|csv|md",
        "--format html|md"}},
      {"--quiet", {"--quiet"}},
      {"--force", {"--force"}},
      {"--resume", {"--resume"}}};
  std::map<std::string, int> seen;
  for (const std::string& command : Commands()) {
    for (const std::string& line :
         SplitLines(Run({"help", command, "--all"}).out)) {
      if (line.starts_with("  -o")) {
        EXPECT_THAT(line, StartsWith("  -o,--output ")) << command;
      }
      for (const auto& [name, forms] : meant) {
        const std::string form = ValueOf(line, name);
        if (form.empty()) continue;
        ++seen[name];
        EXPECT_TRUE(forms.contains(form)) << command << ": " << line;
      }
    }
  }
  for (const auto& [name, forms] : meant) EXPECT_GT(seen[name], 1) << name;
}

// What reads a table of measurements and fits, can be told all about it; what
// runs a map through a table, its times and sessions.
TEST_F(ProgramsHelp, OffersTheSameOptionsWhereTheSameIsRead) {
  const std::map<std::string, std::vector<std::string>> needed = {
      {"compare", {"target", "group", "session", "time", "models", "out"}},
      {"learn", {"target", "group", "session", "time", "models", "out"}},
      {"fit", {"target", "group", "session", "time", "model", "output"}},
      {"update", {"session", "time", "output"}},
      {"predict", {"session", "time", "output", "after"}},
      {"evaluate", {"session", "time", "after"}},
      {"check", {"session", "time", "after"}},
      {"volumetric", {"session", "time", "output", "after"}}};
  const std::set<std::string> prints_a_table = {"predict", "volumetric"};
  for (const auto& [command, options] : needed) {
    const std::string help = Run({"help", command, "--all"}).out;
    for (const std::string& option : options) {
      EXPECT_THAT(help, HasSubstr("--" + option + " ")) << command;
    }
    EXPECT_THAT(help, HasSubstr("  --quiet ")) << command;
    EXPECT_EQ(help.find("  --format ") == help.npos,
              prints_a_table.contains(command))
        << command;
  }
}

}  // namespace
}  // namespace errmap
