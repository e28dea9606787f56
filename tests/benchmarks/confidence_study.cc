// How often what is false, and what is true, is called established, and what
// the 95 % interval of an RMSE covers: a study of the statistics, run by hand.
// Prints Markdown tables; some minutes with the default repetitions.
//
//   confidence_study [REPETITIONS [differences|baselines|intervals|turns]]

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "tests/models/study/confidence_simulation.h"

namespace errmap {
namespace {

using testing::EstablishedDifferent;
using testing::EstablishedWithin;
using testing::Simulation;
using testing::Tails;
using testing::World;

constexpr double kMemories[] = {0.0, 0.3, 0.5, 0.9};

const char* Name(Tails tails) {
  switch (tails) {
    case Tails::kNormal:
      return "normal";
    case Tails::kT3:
      return "t3";
    case Tails::kT5:
      return "t5";
  }
  return "";
}

const char* Name(World::Kind kind) {
  switch (kind) {
    case World::Kind::kLosses:
      return "losses";
    case World::Kind::kBiases:
      return "biases";
    case World::Kind::kScales:
      return "scales";
  }
  return "";
}

// One row per kind, tails and number of units; one column per memory.
template <typename Share>
void PrintRows(World world, const Share& share) {
  std::printf("| %s | %s | %d | %d |",
              Name(world.kind),
              Name(world.tails),
              static_cast<int>(world.units),
              static_cast<int>(world.models));
  for (const double memory : kMemories) {
    world.memory = memory;
    std::printf(" %.1f |", share(world));
    std::fflush(stdout);
  }
  std::printf("\n");
}

void PrintHead(const char* title) {
  std::printf(
      "\n%s, %%\n\n"
      "| drawn | tails | units | models | memory 0 | 0.3 | 0.5 | 0.9 |\n"
      "|---|---|---|---|---|---|---|---|\n",
      title);
}

void StudyDifferences(int repetitions) {
  PrintHead(
      "Equal models called different (units are separate sessions below 12)");
  for (const World::Kind kind :
       {World::Kind::kLosses, World::Kind::kBiases, World::Kind::kScales}) {
    for (const Tails tails : {Tails::kNormal, Tails::kT3}) {
      for (const Eigen::Index models : {2, 6}) {
        for (const Eigen::Index units : {6, 10, 12, 20, 35}) {
          PrintRows({.kind = kind,
                     .units = units,
                     .models = models,
                     .tails = tails,
                     .separate_sessions = units < 12},
                    [&](const World& world) {
                      return EstablishedDifferent(world, repetitions);
                    });
        }
      }
    }
  }
  PrintHead("A difference of one standard deviation called one");
  for (const Tails tails : {Tails::kNormal, Tails::kT3}) {
    for (const Eigen::Index units : {12, 20, 35}) {
      PrintRows({.units = units, .tails = tails, .worse = 1.0},
                [&](const World& world) {
                  return EstablishedDifferent(world, repetitions);
                });
    }
  }
}

// A map against a baseline before all else, units that are sessions.
void StudyTurns(int repetitions) {
  for (const double worse : {0.0, 0.5, 0.67, 1.0, 2.0}) {
    char title[100];
    std::snprintf(title,
                  sizeof(title),
                  "A gain of %.2f standard deviations called one",
                  worse);
    PrintHead(title);
    for (const Tails tails : {Tails::kNormal, Tails::kT3}) {
      for (const Eigen::Index units : {6, 8, 10, 12}) {
        PrintRows({.units = units,
                   .tails = tails,
                   .separate_sessions = true,
                   .worse = worse,
                   .in_turn = true},
                  [&](const World& world) {
                    return EstablishedDifferent(world, repetitions);
                  });
      }
    }
  }
}

void StudyBaselines(int repetitions) {
  for (const double worse : {0.1, 0.0, -0.1}) {
    char title[100];
    std::snprintf(title,
                  sizeof(title),
                  "A baseline of %.2f times a map's RMSE called no worse",
                  1.0 + worse);
    PrintHead(title);
    for (const Tails tails : {Tails::kNormal, Tails::kT3}) {
      for (const Eigen::Index units : {6, 12, 35}) {
        PrintRows({.kind = World::Kind::kBiases,
                   .units = units,
                   .tails = tails,
                   .separate_sessions = true,
                   .worse = worse},
                  [&](const World& world) {
                    return EstablishedWithin(world, repetitions);
                  });
      }
    }
  }
}

void StudyIntervals(int repetitions) {
  PrintHead("Truth within the 95 % interval of an RMSE");
  for (const Tails tails : {Tails::kNormal, Tails::kT5, Tails::kT3}) {
    for (const Eigen::Index units : {6, 12, 35}) {
      PrintRows({.kind = World::Kind::kBiases,
                 .units = units,
                 .models = 1,
                 .tails = tails},
                [&](const World& world) {
                  Simulation simulation(world, 2026);
                  int covered = 0;
                  for (int i = 0; i < repetitions; ++i) {
                    const stats::Bounds95 bounds =
                        simulation.Compare(i).rmse_bounds[0];
                    covered += bounds.lower <= 1.0 && 1.0 <= bounds.upper;
                  }
                  return 100.0 * covered / repetitions;
                });
    }
  }
}

}  // namespace
}  // namespace errmap

int main(int count, char** words) {
  const int repetitions = count > 1 ? std::atoi(words[1]) : 10000;
  const std::string_view part = count > 2 ? words[2] : "all";
  if (repetitions < 1) {
    std::fprintf(stderr, "confidence_study: REPETITIONS must be at least 1\n");
    return 2;
  }
  std::printf("%d repetitions\n", repetitions);
  const auto wanted = [&](std::string_view name) {
    return part == "all" || part == name;
  };
  if (wanted("differences")) errmap::StudyDifferences(repetitions);
  if (wanted("turns")) errmap::StudyTurns(repetitions);
  if (wanted("baselines")) errmap::StudyBaselines(repetitions);
  if (wanted("intervals")) errmap::StudyIntervals(repetitions);
}
