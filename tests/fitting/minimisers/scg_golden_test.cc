// netcg against the report's own program (tests/golden/netcg/README.md).

#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fitting/minimisers/scaled_conjugate_gradient.h"
#include "models/net/net_objective.h"
#include "tests/models/golden_netcg.h"

namespace errmap::fitting {
namespace {

using errmap::testing::GoldenCase;
using errmap::testing::GoldenPath;
using errmap::testing::ReadGoldenCase;
using models::NetArithmetic;

// How far a comparison of trajectories means anything: rounding is amplified
// by the iteration (tests/golden/netcg/README.md).
constexpr double kSameDigits = 1e-9;
constexpr double kLateDigits = 1e-6;
constexpr double kSingleDigits = 1e-3;

struct GoldenRun {
  Minimum minimum;
  std::vector<ScgPass> passes;
};

template <typename Scalar = double>
GoldenRun RunCase(const GoldenCase& golden) {
  const auto& run = golden.json["run"];
  GoldenRun result;
  ScaledConjugateGradientOptions options;
  options.variant = ScgVariant::kNetcg;
  options.stopping = {.iterations = run["niter"],
                      .cost_goal = run["egoal"],
                      .gradient_goal = run["gwgoal"],
                      .slow_ratio = run["errdel"],
                      .progress_interval = run["nfreq"]};
  options.observer = [&](const ScgPass& pass) {
    result.passes.push_back(pass);
  };
  const models::BasicNetObjective<Scalar> objective(golden.shape,
                                                    golden.inputs,
                                                    golden.scaled_targets,
                                                    golden.wfactor,
                                                    {},
                                                    NetArithmetic::kPlain);
  result.minimum = BasicScaledConjugateGradient<Scalar>(options).Minimize(
      objective, golden.initial_weights.template cast<Scalar>());
  return result;
}

bool Has(const std::string& events, const std::string& event) {
  const std::string marked = "|" + events + "|";
  return marked.find("|" + event + "|") != std::string::npos;
}

// Compares E_rms pass by pass up to `iterations`, and every event with it.
void ExpectSameTrajectory(const GoldenCase& golden,
                          const GoldenRun& run,
                          std::int64_t iterations,
                          double tolerance) {
  const auto& rows = golden.json["trajectory"];
  std::size_t compared = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto& row = rows[i];
    if (row[1].get<std::int64_t>() > iterations) break;
    ASSERT_LT(i - 1, run.passes.size());
    const ScgPass& pass = run.passes[i - 1];
    const double expected = row[3];
    const std::string events = row[7];
    SCOPED_TRACE("pass " + std::to_string(i) + ", events " + events);
    EXPECT_NEAR(std::sqrt(2.0 * pass.cost), expected, tolerance * expected);
    EXPECT_EQ(pass.iteration, row[1].get<std::int64_t>());
    EXPECT_EQ(pass.accepted, !Has(events, "fail"));
    EXPECT_EQ(pass.made_definite, Has(events, "deltak<=0"));
    EXPECT_EQ(pass.restarted, Has(events, "restart"));
    EXPECT_EQ(pass.gave_up_direction, Has(events, "fail_restart"));
    ++compared;
  }
  EXPECT_GE(compared, static_cast<std::size_t>(iterations));
}

TEST(ScgGolden, FollowsTheReportsProgramOnRawInputs) {
  const GoldenCase golden = ReadGoldenCase("case_a");
  ExpectSameTrajectory(golden, RunCase(golden), 30, kSameDigits);
}

TEST(ScgGolden, FollowsTheReportsProgramOnScaledInputs) {
  const GoldenCase golden = ReadGoldenCase("case_b");
  ExpectSameTrajectory(golden, RunCase(golden), 30, kSameDigits);
}

TEST(ScgGolden, FollowsTheReportsProgramToTheEndOfASmallRun) {
  const GoldenCase golden = ReadGoldenCase("case_c");
  const GoldenRun run = RunCase(golden);
  ExpectSameTrajectory(golden, run, 60, kSameDigits);
  EXPECT_EQ(run.minimum.summary.termination, Termination::kIterationLimit);
  EXPECT_FALSE(run.minimum.summary.converged());
  const Eigen::VectorXd expected =
      errmap::testing::ToVector(golden.json["weights_final"]);
  EXPECT_LT((run.minimum.x - expected).norm(), 1e-8 * expected.norm());
}

TEST(ScgGolden, RepairsFailsAndRestartsInTheSamePasses) {
  const GoldenCase golden = ReadGoldenCase("case_d1");
  const GoldenRun run = RunCase(golden);
  ExpectSameTrajectory(golden, run, 100, kSameDigits);
  ExpectSameTrajectory(golden, run, 120, kLateDigits);
}

TEST(ScgGolden, MultipliesLambdaBySixteenAfterAPoorSuccess) {
  const GoldenCase golden = ReadGoldenCase("case_d2");
  ExpectSameTrajectory(golden, RunCase(golden), 120, kLateDigits);
}

TEST(ScgGolden, FollowsTheReportsProgramInSinglePrecision) {
  nlohmann::json single;
  std::ifstream(GoldenPath("single.json")) >> single;
  const auto expect = [&](const std::string& name, std::int64_t iterations) {
    SCOPED_TRACE(name);
    GoldenCase golden = ReadGoldenCase(name);
    golden.json["trajectory"] = single[name];
    ExpectSameTrajectory(
        golden, RunCase<float>(golden), iterations, kSingleDigits);
  };
  expect("case_a", 5);
  expect("case_b", 5);
  expect("case_c", 5);
  expect("case_d1", 3);
}

void ExpectSameEnd(const std::string& name, Termination termination) {
  const GoldenCase golden = ReadGoldenCase(name);
  const GoldenRun run = RunCase(golden);
  EXPECT_EQ(run.minimum.summary.termination, termination) << name;
  EXPECT_EQ(run.minimum.summary.iterations,
            golden.json["result"]["k"].get<std::int64_t>())
      << name;
}

TEST(ScgGolden, StopsWhereTheReportsProgramStops) {
  ExpectSameEnd("case_c_stop_egoal", Termination::kCostGoal);
  ExpectSameEnd("case_c_stop_gwgoal", Termination::kGradient);
  ExpectSameEnd("case_c_stop_slow", Termination::kSlowProgress);
}

}  // namespace
}  // namespace errmap::fitting
