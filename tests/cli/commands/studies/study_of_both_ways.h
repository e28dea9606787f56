#pragma once

// A file of both ways along the axis, and a study of a component for each.

#include <string>
#include <vector>

#include "tests/cli/cli_fixture.h"

namespace errmap {

class StudyOfBothWays : public Cli {
 protected:
  /// Ten cycles of six positions, up and down, with hysteresis.
  static std::string BothWays(const std::string& position = "position_mm") {
    std::string text = "cycle,direction," + position + ",error_mm\n";
    for (int cycle = 1; cycle <= 10; ++cycle) {
      for (int i = 0; i < 12; ++i) {
        const bool up = i % 2 == 1;
        const int x = 10 * (i / 2);
        const double error =
            1e-4 * x + 1e-5 * ((7 * i + 3 * cycle) % 11) + (up ? 0.002 : 0.0);
        text += std::to_string(cycle) + (up ? ",up," : ",down,") +
                std::to_string(x) + "," + std::to_string(error) + "\n";
      }
    }
    return text;
  }

  void WriteStudy() const {
    Write("both.csv", BothWays());
    Write("study.toml",
          "seed = 3\n"
          "holdouts = [\"every:3\"]\n"
          "models = [\"mean\"]\n"
          "[[component]]\n"
          "name = \"x, down\"\n"
          "data = \"both.csv\"\n"
          "where = { direction = \"down\" }\n"
          "goal = 0.001\n"
          "[[component]]\n"
          "name = \"x, up\"\n"
          "data = \"both.csv\"\n"
          "where = { direction = \"up\" }\n"
          "[[model]]\n"
          "use = \"poly:full\"\n"
          "degree = 2\n");
  }

  Json RunStudy(std::vector<std::string> more) const {
    more.insert(more.begin(),
                {"compare", "--config", "study.toml", "--format", "json"});
    return RunJson(more);
  }

  std::string Refusal(const std::string& text, int status = kUnusable) const {
    Write("study.toml", text);
    return RefusalOf(Run({"compare", "--config", "study.toml"}), status);
  }
};

}  // namespace errmap
