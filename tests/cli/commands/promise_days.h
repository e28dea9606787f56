#pragma once

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "data/csv.h"
#include "tests/cli/cli_fixture.h"

namespace errmap {

inline constexpr int kCliPromiseRowsPerDay = 40;

// DaysInCliPromise of three thermometers that warm together, each day in its
// own way, and an error that is theirs and the position's and a little more;
// `offset` (um) moves the errors, `raise` (degC) the second thermometer.
inline std::string DaysInCliPromise(int first,
                                    int last,
                                    double offset = 0.0,
                                    double raise = 0.0,
                                    int step = 1) {
  std::string text =
      "day,time_s,position_mm,t1_degC,t2_degC,t3_degC,error_um\n";
  for (int day = first; day <= last; ++day) {
    const double pace = 8.0 + 3.0 * std::sin(2.3 * day);
    for (int row = 0; row < kCliPromiseRowsPerDay; row += step) {
      const double warm = 1.0 - std::exp(-row / pace);
      const double slow = 1.0 - std::exp(-row / (3.0 * pace));
      const double air = 20.0 + std::sin(1.7 * day);
      const double x = 40.0 * (row % 5);
      const double t1 = air + 8.0 * warm + 0.05 * std::sin(7.1 * row + day);
      const double t2 = air + 5.0 * warm + 0.05 * std::sin(5.3 * row + day);
      const double t3 = air + 4.0 * slow + 0.05 * std::sin(3.7 * row + day);
      const double rest =
          0.5 * std::sin(0.8 * day) + 0.3 * std::sin(12.7 * row + 3.1 * day);
      const double error = 2.0 * (t1 - 20.0) + 0.02 * x * (t3 - 20.0) + rest;
      text += std::to_string(day) + "," + std::to_string(60 * row);
      for (const double value : {x, t1, t2 + raise, t3, error + offset}) {
        text += "," + data::CsvNumber(value);
      }
      text += "\n";
    }
  }
  return text;
}

class CliPromise : public Cli {
 protected:
  void SetUp() override {
    Write("train.csv", DaysInCliPromise(1, 10));
    const Outcome outcome = Run({"fit",
                                 "train.csv",
                                 "--model",
                                 "poly:ridge:degree=2",
                                 "-o",
                                 "map.json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }

  // A map without a memory, plane.json.
  void FitPlane(const std::string& days) {
    const Outcome outcome =
        Run({"fit", days, "--model", "poly:full:degree=1", "-o", "plane.json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  }
};

}  // namespace errmap
