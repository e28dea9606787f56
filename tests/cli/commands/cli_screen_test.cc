// What people look at in a terminal: width, length, next steps, suggestions.

#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>

#include "cli/report/wrap_text.h"
#include "tests/cli/both_ways.h"
#include "tests/cli/cli_fixture.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

using report::WidthOf;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class Screens : public Cli {
 protected:
  void SetUp() override { unsetenv("COLUMNS"); }
  void TearDown() override {
    unsetenv("COLUMNS");
    unsetenv("LINES");
  }

  // No line is wider than the terminal, in three of them.
  void ExpectToFit(const std::vector<std::string>& words) {
    for (const char* columns : {"80", "100", "160"}) {
      setenv("COLUMNS", columns, 1);
      const Outcome outcome = Run(words);
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      for (const std::string& line : SplitLines(outcome.out)) {
        EXPECT_LE(report::WidthOf(line), std::stoul(columns)) << line;
      }
    }
  }

  // `sensors` thermometers beside a position, `days` of 30 rows.
  void WriteDays(const std::string& name, int sensors, int days) {
    std::string text = "day,position_mm";
    for (int s = 1; s <= sensors; ++s) {
      text += ",temperature_of_place_" + std::to_string(s) + "_degC";
    }
    text += ",error_mm\n";
    for (int i = 0; i < 30 * days; ++i) {
      const double position = 10.0 * (i % 10);
      text += std::to_string(i / 30) + "," + std::to_string(position);
      double error = 0.0;
      for (int s = 1; s <= sensors; ++s) {
        const double t = 20.0 + 5.0 * std::sin(0.07 * i + s) + 0.1 * (i / 30);
        text += "," + std::to_string(t);
        error += 1e-5 * s * (t - 20.0);
      }
      error += 1e-5 * position + 2e-4 * std::sin(12.9898 * i * i);
      text += "," + std::to_string(error) + "\n";
    }
    Write(name, text);
  }
};

const std::vector<std::string> kQuick = {"--models",
                                         "poly:eq8,poly:full:degree=2,"
                                         "poly:stepwise,poly:ridge:view=auto",
                                         "--quiet"};

std::vector<std::string> With(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(Screens, FitTheShippedSet) {
  ExpectToFit(With({"compare", kDown}, kQuick));
  ExpectToFit(With({"compare", kDown, "--details", "--all"}, kQuick));
}

TEST_F(Screens, FitSeventeenInputs) {
  WriteDays("spindle.csv", 16, 6);
  ExpectToFit(With({"compare", "spindle.csv"}, kQuick));
}

TEST_F(Screens, FitFortyOneInputs) {
  ExpectToFit({"compare",
               SetPath("turning_centre/x_displacement_down.csv"),
               "--models",
               "mean,poly:eq8,poly:stepwise:max_terms=6",
               "--quiet"});
}

TEST_F(Screens, FitSixComponentsInARowEach) {
  std::string study = "models = [\"mean\", \"poly:eq8\"]\n";
  for (int i = 1; i <= 6; ++i) {
    const std::string name = "c" + std::to_string(i) + ".csv";
    WriteDays(name, 1 + i, 6);
    study += "[[component]]\nname = \"a long name of the component number " +
             std::to_string(i) + "\"\ndata = \"" + name + "\"\n";
  }
  Write("study.toml", study);
  const std::vector<std::string> words{
      "compare", "--config", "study.toml", "--quiet"};
  ExpectToFit(words);
  ExpectToFit(With(words, {"--details"}));
  const Outcome outcome = Run(words);
  EXPECT_THAT(outcome.out, StartsWith("6 components"));
  EXPECT_LT(SplitLines(outcome.out).size(), 20U);
}

TEST_F(Screens, FitALongFit) {
  setenv("LINES", "24", 1);
  ExpectToFit({"fit",
               SetPath("turning_centre/x_displacement_down.csv"),
               "--model",
               "poly:full:degree=1",
               "-o",
               "map.json",
               "--no-interval",
               "--quiet"});
  const Outcome outcome = Run({"fit",
                               kDown,
                               "--model",
                               "poly:full:degree=4",
                               "-o",
                               "m.json",
                               "--no-interval",
                               "--quiet"});
  EXPECT_THAT(outcome.out,
              HasSubstr("The equation is long: it is in the "
                        "file"));
  EXPECT_THAT(Run({"fit",
                   kDown,
                   "--model",
                   "poly:full:degree=4",
                   "-o",
                   "m.json",
                   "--no-interval",
                   "--quiet",
                   "--details"})
                  .out,
              HasSubstr("error_mm = "));
}

TEST_F(Screens, FitHelpAndWhatIsSaidOfAMap) {
  ExpectToFit({"--help"});
  for (const char* command :
       {"compare", "fit", "check", "simulate", "export", "watch"}) {
    ExpectToFit({"help", command});
    ExpectToFit({command, "--help"});
  }
  setenv("COLUMNS", "80", 1);
  EXPECT_THAT(Run({"help", "compare"}).out,
              HasSubstr("  --target COL                Column of the error to "
                        "map (default: by its name)\n"));
  const std::string map = "a_map_of_a_long_name_that_fills_half_of_a_line.json";
  ASSERT_EQ(Run({"fit", kDown, "--model", "poly:eq8", "-o", map}).status, 0);
  ExpectToFit({"check", map, kDown, "--quiet"});
  ExpectToFit({"evaluate", map, kDown, "--quiet"});
  ExpectToFit({"residuals", kAppendixB, "--column", "residual_mm"});
  // In pipes help is as wide as on a terminal of 80 columns.
  setenv("COLUMNS", "80", 1);
  const std::string at_80 = Run({"help", "compare"}).out;
  unsetenv("COLUMNS");
  EXPECT_EQ(Run({"help", "compare"}).out, at_80);
}

TEST_F(Screens, HaveTheAnswerInTwelveLinesBeforeTheTable) {
  const std::vector<std::string> lines =
      SplitLines(Run(With({"compare", kDown}, kQuick)).out);
  const auto use = std::ranges::find_if(
      lines, [](const auto& line) { return line.starts_with("Use "); });
  ASSERT_NE(use, lines.end());
  EXPECT_LE(std::find(use, lines.end(), "") - lines.begin(), 14)
      << "what was read, a blank line, the answer";
}

TEST_F(Screens, HaveAtMostTwelveModelsUnlessAllAreAskedFor) {
  const auto rows = [&](const std::vector<std::string>& more) {
    const std::string text =
        Run(With({"compare",
                  kDown,
                  "--models",
                  "poly:eq7,poly:eq8,poly:eq9,poly:full:degree=1,"
                  "poly:full:degree=2,poly:full:degree=3,poly:full:degree=4,"
                  "poly:full:degree=5,poly:full:degree=6,poly:stepwise",
                  "--quiet"},
                 more))
            .out;
    const std::regex row(
        "[*= ] (zero|mean|poly:)[^ ]* +[0-9]+ +[0-9]+\\.[0-9].*");
    std::size_t count = 0;
    for (const std::string& line : SplitLines(text)) {
      if (std::regex_match(line, row)) ++count;
    }
    return std::pair(count, text);
  };
  const auto [few, text] = rows({});
  EXPECT_EQ(few, 12U) << text;
  EXPECT_THAT(OneLine(text), HasSubstr("2 more with --all."));
  const auto [all, whole] = rows({"--all"});
  EXPECT_EQ(all, 14U) << whole;
}

TEST_F(Screens, TellTheNextCommandsWhichWorkAsTheyStand) {
  const Outcome outcome = Run(With({"compare", kDown}, kQuick));
  std::string text = outcome.out;
  for (std::size_t at = 0; (at = text.find(" \\\n", at)) != text.npos;) {
    const std::size_t end = text.find_first_not_of(' ', at + 3);
    text.replace(at, end - at, " ");
  }
  const std::size_t at = text.find("errmap fit ");
  ASSERT_NE(at, std::string::npos) << text;
  std::istringstream line(text.substr(at, text.find('\n', at) - at));
  std::vector<std::string> words;
  for (std::string word; line >> word;) words.push_back(word);
  words.erase(words.begin());
  words.emplace_back("--quiet");
  EXPECT_EQ(Run(words).status, 0) << line.str();
  EXPECT_THAT(OneLine(text),
              AllOf(HasSubstr("errmap check map.json NEW_READINGS.csv"),
                    HasSubstr("; 92 % removed")));
}

TEST_F(Screens, NameTheSensorsAndTheCommandThatTellsWhichWouldDo) {
  WriteDays("days.csv", 3, 6);
  const Outcome outcome = Run({"compare",
                               "days.csv",
                               "--models",
                               "poly:full:degree=1",
                               "--exclude",
                               "temperature_of_place_2_degC",
                               "--quiet"});
  EXPECT_THAT(
      outcome.out,
      AllOf(
          ContainsRegex("its sensors     temperature_of_place_3_degC, *\n? *"
                        "temperature_of_place_1_degC;\n? *--exclude leaves"),
          ContainsRegex("fewer of them   errmap learn days.csv --by sensors")));
  EXPECT_EQ(Run({"learn",
                 "days.csv",
                 "--by",
                 "sensors",
                 "--exclude",
                 "temperature_of_place_2_degC",
                 "--quiet"})
                .status,
            0);
}

// As one line, without the indentation of what goes on.
std::string Squeezed(const std::string& text) {
  return std::regex_replace(OneLine(text), std::regex(" +"), " ");
}

TEST_F(Screens, SayWhyNotTheNet) {
  const Outcome outcome = Run({"compare",
                               kDown,
                               "--models",
                               "poly:full:degree=3,net:scg:iterations=20",
                               "--out",
                               "study",
                               "--quiet"});
  const Json component =
      Json::parse(Read("study/results.json"))["components"][0];
  const auto rmse = [&](const std::string& model) {
    return Model(component, model)["results"]["groups:5"]["test"]["rmse"]
        .get<double>();
  };
  const double net = kUmPerMm * rmse("net:scg:iterations=20");
  const double more = net - kUmPerMm * rmse("poly:full:degree=3");
  ASSERT_GT(more, 0.0);
  std::smatch found;
  const std::string text = Squeezed(outcome.out);
  ASSERT_TRUE(std::regex_search(
      text,
      found,
      std::regex("why no net +the best, net:scg:iterations=20, has "
                 "([0-9.]+) um, ([0-9.]+) um more \\(95 % ")))
      << outcome.out;
  constexpr double kLastDigit = 6e-4;
  EXPECT_NEAR(std::stod(found[1]), net, kLastDigit);
  EXPECT_NEAR(std::stod(found[2]), more, kLastDigit);
  EXPECT_THAT(
      Read("study/report.html"),
      HasSubstr("<li>Why no net: the best, net:scg:iterations=20, has "));
  EXPECT_THAT(Run({"compare", kDown, "--models", "poly:eq8", "--quiet"}).out,
              Not(HasSubstr("why no net")));
}

TEST_F(Screens, NameASmallerMapThatErrsAtMostTwiceAsMuch) {
  const auto screen = [&](const std::string& models) {
    return Squeezed(Run({"compare", kDown, "--models", models, "--quiet"}).out);
  };
  EXPECT_THAT(
      screen("poly:full:degree=3,blend"),
      ContainsRegex("a smaller map +poly:full:degree=3: [0-9]+ operations "));
  // The baselines have three times its error.
  EXPECT_THAT(screen("blend"), Not(HasSubstr("a smaller map")));
}

TEST_F(Screens, TellHowManyRowsWereExtrapolated) {
  const std::vector<std::string> words{
      "compare", kDown, "--models", "poly:full:degree=3", "--quiet"};
  EXPECT_THAT(Squeezed(Run(words).out),
              ContainsRegex("extrapolated +[0-9]+ % of the test readings were "
                            "beyond all training data"));
  Run(With(words, {"--out", "study"}));
  const Json component =
      Json::parse(Read("study/results.json"))["components"][0];
  double rows = 0.0;
  double outside = 0.0;
  for (const auto& row : Records(Read("study/residuals.csv"))) {
    if (row.at("holdout") != "groups:5") continue;
    rows += 1.0;
    if (row.at("inside") == "0") outside += 1.0;
  }
  EXPECT_DOUBLE_EQ(
      outside / rows,
      component["recommendation"]["extrapolated_share"].get<double>());
  // The first and the last cycles, whose like no other fold saw. What is asked
  // for lies beyond all rows of the file, and no cycle counts below the first.
  EXPECT_GT(outside, 0.0);
  const Json& beyond = component["recommendation"]["beyond"][0];
  EXPECT_EQ(beyond["column"], "elapsed_cycles");
  EXPECT_TRUE(beyond["below"].is_null());
  EXPECT_EQ(beyond["above"], 34.0);
}

TEST_F(Screens, SayWhatTwoDaysHeldOutWholeTell) {
  WriteDays("days.csv", 1, 2);
  const Outcome outcome =
      Run({"compare", "days.csv", "--models", "poly:full:degree=1", "--quiet"});
  const std::string text = Squeezed(outcome.out);
  EXPECT_THAT(text, HasSubstr("another day "));
  EXPECT_THAT(text, Not(HasSubstr("another day is not known")));
  EXPECT_THAT(text, ContainsRegex("measure next +6 days or more"));
}

// Each of two days is beyond the other: "below 26" and "above 23.5" say
// nothing.
TEST_F(Screens, AskForNoStateThatLiesBelowOneBoundAndAboveAnother) {
  std::string days = "day,cycle,position_mm,t1_degC,error_um\n";
  for (int i = 0; i < 72; ++i) {
    const int day = i / 36;
    const int cycle = i / 6 % 6;
    const double t = 20.0 + 6.0 * day + 0.7 * cycle;
    days += std::to_string(day) + "," + std::to_string(6 * day + cycle) + "," +
            std::to_string(50 * (i % 6)) + "," + std::to_string(t) + "," +
            std::to_string(1.5 * t + 0.1 * (i * 7 % 11)) + "\n";
  }
  Write("two.csv", days);
  const std::string text = Squeezed(
      Run({"compare", "two.csv", "--models", "poly:full:degree=1", "--quiet"})
          .out);
  EXPECT_THAT(text, ContainsRegex("extrapolated +100 % of"));
  EXPECT_THAT(text, ContainsRegex("measure next +6 days or more"));
  EXPECT_THAT(text, Not(HasSubstr("t1_degC below")));
}

TEST_F(Screens, NameTheMapThatWasWritten) {
  const Outcome outcome =
      Run(With({"compare", kDown, "--out", "study"}, kQuick));
  EXPECT_THAT(outcome.out, ContainsRegex("the page +study/report.html\n"));
  const std::size_t at = outcome.out.find("study/models/");
  ASSERT_NE(at, std::string::npos) << outcome.out;
  const std::string map =
      outcome.out.substr(at, outcome.out.find_first_of("\n ", at) - at);
  EXPECT_EQ(Run({"predict", map, kDown}).status, 0) << map;
  const Json results = Json::parse(Read("study/results.json"));
  const Json component = results["components"][0];
  EXPECT_EQ(
      "study/" + Model(component, component["recommendation"]["model"])["file"]
                     .get<std::string>(),
      map);
}

TEST_F(Screens, WriteThePageAlone) {
  const Outcome outcome =
      Run(With({"compare", kDown, "-o", "page.html"}, kQuick));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_THAT(outcome.out, ContainsRegex("the page +page.html\n"));
  EXPECT_THAT(Read("page.html"), HasSubstr("</html>"));
  EXPECT_THAT(Run({"compare", kDown, "-o", "study"}).err,
              HasSubstr("study.html; --out study writes a folder"));
  EXPECT_EQ(Run(With({"compare", kDown, "-o", kDown}, kQuick)).status,
            kWrongCommandLine);
}

TEST_F(Screens, HaveNoColourInPipes) {
  EXPECT_THAT(Run(With({"compare", kDown}, kQuick)).out,
              Not(HasSubstr("\033")));
}

TEST_F(Screens, ExplainCommandsAndModels) {
  EXPECT_EQ(Run({"help", "compare"}).out, Run({"compare", "--help"}).out);
  EXPECT_EQ(Run({"help"}).out, Run({"--help"}).out);
  EXPECT_THAT(Run({"help", "compare"}).out,
              AllOf(HasSubstr("net:scg"), HasSubstr("groups:K")));
  EXPECT_THAT(Run({"models"}).out, ContainsRegex("poly:eq8 +Eq. 8 of 1995"));
  EXPECT_THAT(
      Run({"models", "net:scg"}).out,
      AllOf(ContainsRegex("hidden +20 +hidden nodes: cv or a whole "
                          "number from 1 to 10000"),
            ContainsRegex("wfactor +1e-05 +.*: cv or a number from 0"),
            ContainsRegex("evaluations +.*: a whole number from 1 on"),
            ContainsRegex("rows +.*: all or a whole number from\n +100"),
            ContainsRegex("history +.*: auto, none\n +or time")));
  EXPECT_THAT(Run({"models", "poly:stepwise"}).out,
              ContainsRegex("max_terms +rows/5 +.*: none or a whole number"));
  EXPECT_EQ(Run({"models", "net:sgc"}).status, kWrongCommandLine);
}

TEST_F(Screens, GuessWhatWasMeant) {
  const auto err = [&](const std::vector<std::string>& words) {
    const Outcome outcome = Run(words);
    EXPECT_EQ(outcome.status, kWrongCommandLine) << outcome.err;
    EXPECT_EQ(SplitLines(outcome.err).size(), 1U) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(err({"comprae", kDown}), HasSubstr("did you mean 'compare'?"));
  EXPECT_THAT(err({"version"}), HasSubstr("did you mean '--version'?"));
  EXPECT_THAT(err({"--hlep"}),
              HasSubstr("no option '--hlep'; did you mean '--help'?"));
  EXPECT_THAT(err({"compare", kDown, "-m", "mean"}),
              HasSubstr("no option '-m'; see errmap compare --help"));
  EXPECT_THAT(
      RefusalOf(Run({"evaluate", kDown, "map.json"}), kUnusable),
      HasSubstr("is not a map (JSON written by errmap); name the map first"));
  EXPECT_THAT(err({"help", "comprae"}), HasSubstr("did you mean 'compare'?"));
  EXPECT_THAT(err({"compare", kDown, "--modles", "mean"}),
              HasSubstr("no option '--modles'; did you mean '--models'?"));
  EXPECT_THAT(err({"fit", kDown, "--modle", "mean"}),
              HasSubstr("no option '--modle'; did you mean '--model'?"));
  EXPECT_THAT(err({"fit", kDown}), HasSubstr("--model is required"));
  EXPECT_THAT(err({"fit", "--model", "mean", "-o", "-x"}),
              HasSubstr("DATA is required"));
  EXPECT_THAT(err({"fit", kDown, "--", "--modle"}),
              HasSubstr("--model is required"));
  EXPECT_THAT(err({"when"}), HasSubstr("errmap: when: MODEL is required"));
  EXPECT_THAT(err({"when", "a", "b", "c"}),
              HasSubstr("when: not expected: b c; see errmap when --help"));
  EXPECT_THAT(err({"compare", kDown, "--goal"}),
              HasSubstr("compare: --goal: its value X is missing"));
  EXPECT_THAT(err({"compare", kDown, "--jobs", "x"}),
              HasSubstr("compare: --jobs must be 1 to 1024, found 'x'"));
  EXPECT_THAT(err({"compare", kDown, "--models", "poly:eq88"}),
              HasSubstr("did you mean 'poly:eq8'?"));
  EXPECT_THAT(err({"compare", kDown, "--models", "ridge"}),
              HasSubstr("did you mean 'poly:ridge'?"));
  EXPECT_THAT(err({"compare", kDown, "--models", "mean,", "poly:eq8"}),
              HasSubstr("names stand between commas, without blanks"));
  EXPECT_THAT(err({"compare", kDown, "--models", "net:scg:hiden=3"}),
              HasSubstr("did you mean 'hidden'?"));
  EXPECT_THAT(err({"compare", kDown, "--holdout", "evry:3"}),
              HasSubstr("did you mean every?"));
  EXPECT_THAT(err({"compare", kDown, "--format", "tabel"}),
              HasSubstr("did you mean 'table'?"));
}

// A figure that stands in several places is written alike in all of them: no
// length is another one rounded. The goal is not a figure of the study.
TEST_F(Screens, SayEachFigureInOneWay) {
  const Outcome outcome = Run(
      With({"compare", kDown, "--details", "--goal", "7um", "--out", "study"},
           kQuick));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::string text = OneLine(outcome.out) + " " + Read("study/report.md") + " ";
  bool in_tag = false;
  for (const char c : Read("study/report.html")) {
    if (c == '<' || c == '>') in_tag = c == '<';
    text += in_tag || c == '>' ? ' ' : c;
  }
  const std::regex length("([0-9]+(\\.[0-9]+)?)(?: |\u00a0)(um|\u00b5m)");
  std::set<std::string> figures;
  for (std::sregex_iterator it(text.begin(), text.end(), length), end;
       it != end;
       ++it) {
    figures.insert((*it)[1]);
  }
  EXPECT_GT(figures.size(), 15U);
  figures.erase("7");
  const auto decimals = [](const std::string& figure) {
    const std::size_t point = figure.find('.');
    return point == figure.npos ? 0 : figure.size() - point - 1;
  };
  for (const std::string& coarse : figures) {
    for (const std::string& fine : figures) {
      if (decimals(coarse) >= decimals(fine)) continue;
      const double step =
          std::pow(10.0, -static_cast<double>(decimals(coarse)));
      EXPECT_GT(std::abs(std::stod(coarse) - std::stod(fine)), 0.5 * step)
          << coarse << " and " << fine;
    }
  }
}

TEST_F(Screens, TakeAGoalWithItsUnit) {
  const auto compare = [&](const std::string& goal) {
    return Run({"compare", kDown, "--models", "poly:eq8", "--goal", goal});
  };
  EXPECT_THAT(OneLine(compare("2um").out),
              ContainsRegex("goal +2 um: not reached"));
  for (const char* same : {"0.002", "0.002 mm", "2 \u00b5m", "2e-3mm"}) {
    EXPECT_EQ(compare(same).out, compare("2um").out) << same;
  }
  EXPECT_EQ(compare("2um").err, compare("0.002").err);
  EXPECT_THAT(RefusalOf(compare(""), kWrongCommandLine),
              HasSubstr("--goal must be a finite number such as 0.002"));
  EXPECT_THAT(OneLine(compare("20").err),
              HasSubstr("goal 20 is in mm, the unit of error_mm: 20000 um, "
                        "more than the error itself; write 20um if that was "
                        "meant"));
  EXPECT_THAT(RefusalOf(compare("2 arcsec"), kUnusable),
              HasSubstr("goal is 2 arcsec, but the target is in mm"));
  EXPECT_THAT(Run({"compare",
                   kDown,
                   "--models",
                   "mean",
                   "--indifference",
                   "20um",
                   "--format",
                   "json",
                   "--quiet"})
                  .out,
              HasSubstr("\"indifference\": 0.02"));
}

TEST_F(Screens, SayOnceHowTheFileOfBothWaysWasRead) {
  Write("ways.csv", RowsOfBothWays());
  const std::string screen =
      Run({"compare", "ways.csv", "--models", "mean,poly:full:degree=1"}).out;
  EXPECT_THAT(screen,
              AllOf(StartsWith("Read: 160 rows in 4 sessions (by day)"),
                    HasSubstr("both ways"),
                    HasSubstr("\n\n2 components.")));
}

TEST_F(Screens, CarryTheAnswerInCsvAndMarkdown) {
  const auto rows =
      Records(Run(With({"compare", kDown, "--format", "csv"}, kQuick)).out);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("unit"), "mm");
    // None where neighbouring cycles err alike.
    EXPECT_EQ(row.at("test_ci95_low").empty(),
              row.at("test_ci95_high").empty());
    if (!row.at("test_ci95_low").empty()) {
      EXPECT_LE(std::stod(row.at("test_ci95_low")),
                std::stod(row.at("test_rmse")));
      EXPECT_GE(std::stod(row.at("test_ci95_high")),
                std::stod(row.at("test_rmse")));
    }
    for (const char* key :
         {"interchangeable", "gap", "sensors", "goal", "established"}) {
      EXPECT_TRUE(row.contains(key)) << key;
    }
  }
  EXPECT_THAT(Run(With({"compare", kDown, "--format", "md"}, kQuick)).out,
              AllOf(HasSubstr("interchangeable"), HasSubstr("| um |")));
}

}  // namespace
}  // namespace errmap
