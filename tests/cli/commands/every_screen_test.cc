// What every command shows, in a pipe: no line is wider than 80 columns, no
// sentence longer than 25 words; and what one result is said to be, wherever it
// is told.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include "cli/report/wrap_text.h"
#include "tests/cli/fleet/fleet_fixture.h"
#include "tests/cli/one_line.h"

namespace errmap {
namespace {

constexpr std::size_t kColumns = 80;
constexpr std::ptrdiff_t kMostWords = 25;  // of a sentence

// The column in which the text of a line begins, behind a label or an option.
std::size_t TextColumn(const std::string& line) {
  const std::size_t first = line.find_first_not_of(' ');
  const std::size_t gap = line.find("  ", first);
  return gap == line.npos ? first : line.find_first_not_of(' ', gap);
}

// Lines that were broken because the next word had no room, put together again.
std::vector<std::string> Paragraphs(const std::string& text) {
  std::vector<std::string> paragraphs;
  std::string before;
  for (const std::string& line : SplitLines(text)) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == line.npos) {
      before.clear();
      continue;
    }
    const std::string word = line.substr(first, line.find(' ', first) - first);
    const bool goes_on =
        !before.empty() && first == TextColumn(before) &&
        report::WidthOf(before) + 1 + report::WidthOf(word) > kColumns;
    if (goes_on) {
      paragraphs.back() += " " + line.substr(first);
    } else {
      paragraphs.push_back(line.substr(TextColumn(line)));
    }
    before = line;
  }
  return paragraphs;
}

// A row of a table is not a sentence, and a list of names is one word.
void ExpectShortSentences(const std::string& command, const std::string& text) {
  static const std::regex list("([^ ,]+, ){3,}[^ ,]*[^ ,.]");
  static const std::regex end("[.?!]\\)?( |$)");
  static const std::regex word("[^ ]*[[:alnum:]][^ ]*");
  for (const std::string& paragraph : Paragraphs(text)) {
    if (paragraph.find("  ") != paragraph.npos) continue;
    const std::string prose = std::regex_replace(paragraph, list, "list");
    for (std::sregex_token_iterator part(prose.begin(), prose.end(), end, -1);
         part != std::sregex_token_iterator();
         ++part) {
      const std::string sentence = *part;
      EXPECT_LE(std::distance(std::sregex_iterator(
                                  sentence.begin(), sentence.end(), word),
                              std::sregex_iterator()),
                kMostWords)
          << command << ": " << sentence;
    }
  }
}

class EveryScreen : public FleetTest {
 protected:
  void SetUp() override { unsetenv("COLUMNS"); }

  // Runs it and looks at its answer. A word that is wider than a line, such as
  // a path, is none of ours to break.
  void Show(const std::vector<std::string>& words, int status = 0) {
    shown_.insert(words.front());
    const Outcome outcome = Run(words);
    EXPECT_EQ(outcome.status, status) << words.front() << outcome.err;
    ExpectShortSentences(words.front(), outcome.out);
    for (const std::string& line : SplitLines(outcome.err)) {
      ExpectShortSentences(words.front(), line);
    }
    for (const std::string& line : SplitLines(outcome.out)) {
      if (line.find(' ') == line.npos) continue;
      EXPECT_LE(report::WidthOf(line), kColumns)
          << words.front() << ": " << line;
    }
  }

  // Those that the help names.
  std::set<std::string> Commands() const {
    std::set<std::string> commands;
    for (const std::string& line : SplitLines(Run({"--help"}).out)) {
      const std::size_t end = line.find(' ', 2);
      if (line.starts_with("  ") && line.size() > 2 && line[2] != ' ' &&
          end != line.npos) {
        commands.insert(line.substr(2, end - 2));
      }
    }
    return commands;
  }

  std::set<std::string> shown_;

  // Days and cycles of several numbers, with all that can be asked of them.
  void ShowStudies() {
    WriteComponent("two_days.csv", 4, 2);
    WriteComponent("one_day.csv", 5, 1);
    const std::string files[] = {"days.csv", "two_days.csv", "one_day.csv"};
    for (const std::string& file : files) {
      for (const char* option : {"--goal=0.5um",
                                 "--goal=100um",
                                 "--rezero=probe",
                                 "--choose=best",
                                 "--holdout=every:3"}) {
        Show({"compare",
              file,
              option,
              "--models=mean,poly:eq8,poly:ridge:view=auto,net:scg,blend",
              "--details"});
      }
    }
  }

  void ShowMistakes() {
    Show({"compare", "nothing.csv"}, kUnusable);
    Show({"compare", "days.csv", "--target", "t"}, kUnusable);
    Show({"compare", "days.csv", "--models", "poly"}, kWrongCommandLine);
    Show({"compare", "days.csv", "--holdout", "days"}, kWrongCommandLine);
    Show({"compare", "days.csv", "--detail"}, kWrongCommandLine);
    Show({"fit", "days.csv"}, kWrongCommandLine);
    Show({"learn", "days.csv"}, kWrongCommandLine);
    Show({"predict", "map.json", "clock.csv"}, kUnusable);
    Show({"update", "map.json", "one_day.csv", "-o", "u.json"}, kUnusable);
    Show({"report", "nothing"}, kUnusable);
    Show({"compares"}, kWrongCommandLine);
  }

  void ShowMaps() {
    WriteComponent("days.csv", 3, 6);
    WriteComponent("new.csv", 5, 8);
    Show({"compare",
          "days.csv",
          "--models",
          "mean,poly:eq8",
          "--out",
          "s",
          "--details",
          "--all"});
    Show({"compare", "days.csv", "--dry-run"});
    Show({"report", "s"});
    Show({"fit", "days.csv", "--model", "poly:eq8", "-o", "map.json"});
    Show({"fit",
          "days.csv",
          "--model",
          "net:scg:iterations=20",
          "-o",
          "net.json",
          "--details"});
    Show({"evaluate", "map.json", "new.csv"});
    Show({"check", "map.json", "new.csv"});
    Show({"predict", "map.json", "new.csv", "-o", "out.csv"});
    Show({"update", "map.json", "new.csv", "-o", "better.json"});
    Show({"learn", "days.csv", "--by", "sessions", "--models", "poly:eq8"});
    Show({"learn", "days.csv", "--by", "sensors"});
    Show({"residuals", "s/residuals.csv", "--column", "mean", "--details"});
    Show({"cost", "map.json"});
    Show({"export", "map.json", "--c", "-o", "control"});
    Show({"convert", "days.csv", "days.md"});
    Show({"init", "days.csv", "-o", "study.toml"});
    Show({"models"});
    Show({"models", "net:scg"});
  }

  // An error that grows by 1 um an hour.
  void ShowWhen() {
    std::string days = "day,time_s,position_mm,error_um\n";
    for (int i = 0; i < 300; ++i) {
      const int time = 600 * (i % 60);
      const int position = 100 * (i % 3);
      days += std::to_string(i / 60) + "," + std::to_string(time) + "," +
              std::to_string(position) + "," +
              std::to_string(0.01 * position + time / 3600.0) + "\n";
    }
    Write("clock.csv", days);
    Show({"fit", "clock.csv", "--model", "poly:position", "-o", "clock.json"});
    Show({"when", "clock.json", "--goal", "2um"});
  }

  void ShowMachine() {
    Write("machine.toml",
          "name = \"m\"\nlength = \"mm\"\nangle = \"rad\"\n[[link]]\n"
          "name = \"X\"\nbranch = \"tool\"\njoint = \"linear\"\n"
          "axis = [1, 0, 0]\ncoordinate = \"x_mm\"\n"
          "errors = { EXX = 0.001 }\n");
    Write("points.csv", "x_mm\n1\n2\n");
    Show({"volumetric", "machine.toml", "--at", "points.csv", "-o", "v.csv"});
    std::string test = "run,position_mm,direction,error_um\n";
    for (int i = 0; i < 20; ++i) {
      test += std::to_string(i / 10 + 1) + "," + std::to_string(50 * (i % 5)) +
              (i % 10 < 5 ? ",up," : ",down,") + std::to_string(i % 7) + "\n";
    }
    Write("test.csv", test);
    Show({"iso230", "test.csv"});
    for (const char* name : {"case_c.in", "tiny.tab"}) {
      Write(name,
            Process::TextOf(tests::TestDir() + "/golden/netcg/runs/" + name));
    }
    Show({"netcg", "case_c.in"});
  }
};

}  // namespace

TEST_F(EveryScreen, FitsEightyColumnsAndSaysItInShortSentences) {
  ShowMaps();
  ShowStudies();
  WriteFleet();
  Show({"compare", "--config", "fleet.toml", "--dry-run"});
  Show({"compare", "--config", "fleet.toml", "--out", "fleet"});
  Show({"merge", "fleet"});
  Show({"init", "data", "-o", "all.toml"});
  Show({"deploy", "fleet", "--all"});
  WriteComponent("new/m01/x_down.csv", 9);
  Show({"watch", "fleet", "data", "new"});
  Show({"submit",
        "slurm",
        "--config",
        "fleet.toml",
        "--out",
        "cluster",
        "--tasks",
        "2"});
  Show({"simulate",
        "turning-centre",
        "-o",
        "demo",
        "--days",
        "2",
        "--cycles",
        "2"});
  Show({"fit",
        "demo/x_displacement_down.csv",
        "--model",
        "poly:eq8",
        "-o",
        "demo.json"});
  Show({"when", "demo.json", "--goal", "5um"});
  Show({"read", "demo/x_displacement_down.csv"});
  Show({"certify", "nist"});
  Show({"certify", "agreement"});
  ShowMachine();
  ShowWhen();
  ShowMistakes();
  for (const std::string& command : Commands()) {
    Show({"help", command});
    Show({"help", command, "--all"});
    EXPECT_TRUE(shown_.contains(command)) << command << " is not looked at";
  }
}

namespace {

using ::testing::HasSubstr;

class OneResult : public EveryScreen {
 protected:
  static inline const std::vector<std::string> kMaps = {
      "--models", "mean,poly:eq8,poly:full:degree=1,blend", "--quiet"};

  // "0.512" of "... 0.512 um RMSE ...", the first.
  static std::string FigureIn(const std::string& text) {
    std::smatch found;
    return std::regex_search(text, found, std::regex("[: ]([0-9.]+) um RMSE"))
               ? found[1].str()
               : "";
  }

  // Screen, page, Markdown, map and results.json of one file say the same of
  // the recommended map: what is promised, where, and whether the goal is met.
  Json Agree(const std::string& file) {
    std::vector<std::string> words{
        "compare", file, "--goal", "0.5um", "--out", file + ".d"};
    words.insert(words.end(), kMaps.begin(), kMaps.end());
    const Outcome screen = Run(words);
    EXPECT_EQ(screen.status, 0) << screen.err;
    const std::string text = OneLine(screen.out);
    const std::string folder = file + ".d/";
    const Json component =
        Json::parse(Read(folder + "results.json"))["components"][0];
    const Json& advice = component["recommendation"];
    const std::string figure = FigureIn(text);
    const std::string holdout = advice["holdout"];
    const std::string standing = advice["goal_standing"];
    EXPECT_NEAR(std::stod(figure),
                kUmPerMm * advice["rmse"].get<double>(),
                5e-3 * std::stod(figure));
    // The sentence of every document is that of the record.
    EXPECT_EQ(FigureIn(advice["sentence"]), figure);
    const std::string use = advice["sentence"];
    EXPECT_THAT(text, HasSubstr(use.substr(0, use.find(". ") + 1)));
    EXPECT_THAT(text, HasSubstr("(" + holdout + ")"));
    const bool reached = standing.starts_with("met");
    const std::string said = reached                    ? "reached"
                             : standing == "not judged" ? "not judged on"
                                                        : "not reached";
    EXPECT_THAT(text, HasSubstr("0.5 um: " + said));
    const std::string page = Read(folder + "report.html");
    EXPECT_THAT(page, HasSubstr("class=\"number\">" + figure + " µm"));
    EXPECT_EQ(page.find("µm: reached") != page.npos, reached);
    EXPECT_THAT(Read(folder + "report.md"),
                HasSubstr(": " + figure + " um RMSE"));
    for (const Json& model : component["models"]) {
      if (model["name"] != advice["model"]) continue;
      EXPECT_NEAR(model["results"][holdout]["test"]["rmse"].get<double>(),
                  advice["rmse"].get<double>(),
                  1e-15);
      const Json map = Json::parse(Read(folder + std::string(model["file"])));
      if (map["interval"].is_null()) continue;
      // The same map fitted alone promises the same.
      EXPECT_EQ(Run({"fit",
                     file,
                     "--model",
                     advice["model"],
                     "-o",
                     file + ".json",
                     "--quiet"})
                    .status,
                0);
      EXPECT_EQ(Json::parse(Read(file + ".json"))["interval"], map["interval"]);
      EXPECT_EQ(map["interval"]["holdout"], holdout);
      for (const Json& held : component["holdouts"]) {
        if (held["name"] != holdout) continue;
        EXPECT_EQ(map["interval"]["unit"], held["unit_of_analysis"]);
      }
    }
    return advice;
  }
};

TEST_F(OneResult, IsTheSameOnEveryScreen) {
  WriteComponent("two.csv", 3, 2);
  WriteComponent("six.csv", 4, 6);
  WriteComponent("run.csv", 5, 1);
  // Days of as many cycles each: groups:5 cuts as sessions:5 does.
  WriteComponent("five.csv", 6, 5);
  EXPECT_EQ(Agree("two.csv")["holdout"], "sessions:2");
  const Json six = Agree("six.csv");
  EXPECT_EQ(six["holdout"], "sessions:5");
  // A folder with a file of each of these days.
  const std::vector<std::string> lines = SplitLines(Read("six.csv"));
  std::map<std::string, std::string> days;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::string& day = days[lines[i].substr(0, lines[i].find(','))];
    day += (day.empty() ? lines[0] + "\n" : "") + lines[i] + "\n";
  }
  ASSERT_EQ(days.size(), 6U);
  std::filesystem::create_directories(scratch_ / "days");
  for (const auto& [day, rows] : days) Write("days/" + day + ".csv", rows);
  const Json folder = Agree("days");
  for (const char* said : {"rmse", "holdout", "goal_standing", "sentence"}) {
    EXPECT_EQ(folder[said], six[said]);
  }
  EXPECT_EQ(Agree("five.csv")["holdout"], "sessions:5");
  EXPECT_THAT(Agree("run.csv")["holdout"].get<std::string>(),
              HasSubstr("groups:"));
  std::string rows = "position_mm,t1_degC,error_mm\n";
  for (int i = 0; i < 60; ++i) {
    rows += std::to_string(10 * (i % 12)) + "," +
            std::to_string(20.0 + 0.1 * i) + "," +
            std::to_string(1e-4 * i + 1e-5 * (i * 7 % 11)) + "\n";
  }
  Write("rows.csv", rows);
  // Passes along the axis are cycles.
  EXPECT_EQ(Agree("rows.csv")["holdout"], "groups:5");
}

TEST_F(OneResult, IsTheSameInAFleet) {
  WriteComponent("data/m01/x_down.csv", 3, 2);
  WriteComponent("data/m01/x_up.csv", 4, 6);
  Write("fleet.toml",
        "models = [\"mean\", \"poly:eq8\", \"poly:full:degree=1\", "
        "\"blend\"]\n[[component]]\nname = \"{machine}/{component}\"\n"
        "data = \"data/{machine}/{component}_{direction}.csv\"\n");
  const Json fleet = RunJson({"compare",
                              "--config",
                              "fleet.toml",
                              "--out",
                              "fleet",
                              "--format",
                              "json",
                              "--quiet"})["components"];
  ASSERT_EQ(fleet.size(), 2U);
  const Json alone[] = {Agree("data/m01/x_down.csv"),
                        Agree("data/m01/x_up.csv")};
  for (const Json& advice : alone) {
    const auto same = std::ranges::find_if(fleet, [&](const Json& component) {
      return component["recommendation"]["holdout"] == advice["holdout"];
    });
    ASSERT_NE(same, fleet.end()) << advice["holdout"];
    const Json& found = (*same)["recommendation"];
    EXPECT_EQ(found["model"], advice["model"]);
    EXPECT_EQ(found["rmse"], advice["rmse"]);
    EXPECT_EQ(found["goal"], "no goal");  // the fleet's study has none
    EXPECT_EQ(found["sentence"], advice["sentence"]);
    const Json rows =
        Rows("fleet",
             "SELECT after, goal_standing FROM fleet WHERE abs(after - " +
                 std::to_string(kUmPerMm * advice["rmse"].get<double>()) +
                 ") < 1e-5");
    ASSERT_EQ(rows.size(), 1U) << rows;
    EXPECT_EQ(rows[0][1], "no goal");
  }
}

}  // namespace

}  // namespace errmap
