// What every command shows, in a pipe: no line is wider than 80 columns.

#include <algorithm>
#include <cstdlib>
#include <set>

#include "cli/report/wrap_text.h"
#include "tests/cli/fleet/fleet_fixture.h"

namespace errmap {
namespace {

constexpr std::size_t kColumns = 80;

class EveryScreen : public FleetTest {
 protected:
  void SetUp() override { unsetenv("COLUMNS"); }

  // Runs it and looks at its answer. A word that is wider than a line, such as
  // a path, is none of ours to break.
  void Show(const std::vector<std::string>& words, int status = 0) {
    shown_.insert(words.front());
    const Outcome outcome = Run(words);
    EXPECT_EQ(outcome.status, status) << words.front() << outcome.err;
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

TEST_F(EveryScreen, FitsEightyColumns) {
  ShowMaps();
  WriteFleet();
  Show({"compare", "--config", "fleet.toml", "--dry-run"});
  Show({"compare", "--config", "fleet.toml", "--out", "fleet"});
  Show({"merge", "fleet"});
  Show({"init", "data", "-o", "all.toml"});
  Show({"query", "fleet", "SELECT name, after FROM fleet"});
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
  Show({"certify", "nist"});
  Show({"certify", "agreement"});
  ShowMachine();
  for (const std::string& command : Commands()) {
    Show({"help", command});
    EXPECT_TRUE(shown_.contains(command)) << command << " is not looked at";
  }
}

}  // namespace errmap
