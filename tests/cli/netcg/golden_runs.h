#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/netcg/run_file.h"
#include "data/csv.h"
#include "data/formats/pattern_file.h"
#include "tests/cli/cli_runner.h"
#include "tests/places.h"

namespace errmap::testing {

/// A file of tests/golden/netcg/runs.
inline std::string RunPath(const std::string& name) {
  return tests::TestDir() + "/golden/netcg/runs/" + name;
}

inline nlohmann::json Figures() {
  return nlohmann::json::parse(Process::TextOf(RunPath("figures.json")));
}

/// The pattern file of cases a (train.csv) or e (held_out.csv), with the dead
/// thermocouples that these leave out.
inline data::PatternTable StackedPatterns(const std::string& csv) {
  const data::CsvTable table =
      data::ReadCsv(tests::TestDir() + "/golden/" + csv);
  const auto rows = static_cast<Eigen::Index>(table.num_rows);
  data::PatternTable patterns;
  patterns.inputs = {"position_mm"};
  patterns.targets = {"error_mm"};
  patterns.input_values = Eigen::MatrixXd::Zero(rows, 41);
  const auto column = [&](const std::string& name) -> Eigen::VectorXd {
    const auto found = table.Find(name);
    if (found < 0) return Eigen::VectorXd::Zero(rows);
    return Eigen::Map<const Eigen::VectorXd>(
        std::vector<double>(
            table.columns[static_cast<std::size_t>(found)].values)
            .data(),
        rows);
  };
  patterns.input_values.col(0) = column("position_mm");
  patterns.target_values = column("error_mm");
  for (int i = 0; i < 40; ++i) {
    const std::string number = (i < 10 ? "0" : "") + std::to_string(i);
    patterns.inputs.push_back("t" + number + "_degC");
    patterns.input_values.col(i + 1) = column("tc" + number);
  }
  constexpr double kStop = -12.7;  // mm between positions
  for (const double position : patterns.input_values.col(0)) {
    patterns.index.push_back(std::lround(position / kStop));
  }
  return patterns;
}

}  // namespace errmap::testing
