#pragma once

#include <string>
#include <vector>

#include "cli/turning_centre/simulation.h"
#include "cli/turning_centre/simulation_files.h"
#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::testing {

/// X displacement of a simulated turning centre, `cycles` cycles a day.
inline data::Dataset SimulatedDays(std::uint64_t seed, int days, int cycles) {
  const std::string name = "x_displacement_down.csv";
  return data::MakeDataset(
             data::ParseCsv(
                 turning_centre::SimulationFile(
                     turning_centre::Simulate({.seed = seed,
                                               .days = days,
                                               .cycles = cycles,
                                               .dead = {3, 4, 16, 19}}),
                     {},
                     name),
                 name),
             {.session = "day"})
      .dataset;
}

/// The rows whose session is, or is not, among the first `count`.
inline data::Dataset FirstSessions(const data::Dataset& dataset,
                                   Eigen::Index count,
                                   bool first = true) {
  std::vector<Eigen::Index> rows;
  const std::vector<Eigen::Index> sessions = dataset.session_codes();
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    if ((sessions[i] < count) == first) {
      rows.push_back(static_cast<Eigen::Index>(i));
    }
  }
  return dataset.SelectRows(rows);
}

}  // namespace errmap::testing
