#include "models/trained_range.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"

namespace errmap::models {
namespace {

TrainedInput Trained(const char* name, double min, double max) {
  return {.column = {name, data::UnitOfColumn(name)},
          .min = min,
          .max = max,
          .mean = 0.5 * (min + max),
          .sd = 1.0};
}

// Noise at a bound, up to kRangeTolerance of the range, is not outside.
TEST(InputsOutside, IsEmptyWithinTheTrainedRangeAndALittleBeyond) {
  EXPECT_FALSE(
      IsInside({Trained("t1_degC", 20.0, 25.0)}, Eigen::MatrixXd{{25.2}}, 0));
  EXPECT_FALSE(
      IsInside({Trained("t1_degC", 20.0, 25.0)}, Eigen::MatrixXd{{19.8}}, 0));
  const Eigen::MatrixXd values{{19.91}, {25.09}};
  EXPECT_THAT(InputsOutside({Trained("t1_degC", 20.0, 25.0)}, values),
              ::testing::IsEmpty());
  EXPECT_TRUE(IsInside({Trained("t1_degC", 20.0, 25.0)}, values, 1));
}

TEST(InputsOutside, CountsRowsAndGivesTheRangeFound) {
  const Eigen::MatrixXd values{{1.0, 19.0}, {2.0, 22.0}, {3.0, 23.0}};
  const auto outside = InputsOutside(
      {Trained("position_mm", 0.0, 9.0), Trained("t1_degC", 20.0, 25.0)},
      values);
  ASSERT_EQ(outside.size(), 1U);
  EXPECT_EQ(outside[0].input, 1);
  EXPECT_EQ(outside[0].num_rows, 1);
  EXPECT_EQ(outside[0].min, 19.0);
  EXPECT_EQ(outside[0].max, 23.0);
  EXPECT_EQ(outside[0].looks_like, "");
}

TEST(InputsOutside, RecognisesTheUnitThatWasMeant) {
  const auto looks_like = [](const TrainedInput& input, double value) {
    const auto outside =
        InputsOutside({input}, Eigen::MatrixXd{{value}, {value + 1.0}});
    return outside.empty() ? "inside" : outside[0].looks_like;
  };
  EXPECT_EQ(looks_like(Trained("t1_degC", 20.0, 25.0), 294.0), "K");
  EXPECT_EQ(looks_like(Trained("t1_degC", 20.0, 25.0), 71.0), "degF");
  EXPECT_EQ(looks_like(Trained("t1 [K]", 293.0, 298.0), 21.0), "degC");
  EXPECT_EQ(looks_like(Trained("t1_degC", 20.0, 25.0), 5000.0), "");
  EXPECT_EQ(looks_like(Trained("speed_rpm", 0.0, 10.0), 70.0), "");
  // A hotter day, and a longer way along the axis, are in the same unit.
  EXPECT_EQ(looks_like(Trained("t1_degC", 16.0, 38.0), 40.0), "");
  EXPECT_EQ(looks_like(Trained("x_mm", 0.0, 800.0), 1200.0), "");
  EXPECT_EQ(looks_like(Trained("x_mm", 0.0, 800.0), 2400.0), "");
  // Inches lie near the millimetres of an axis, but travel less.
  EXPECT_EQ(InputsOutside({Trained("x_mm", -215.9, -12.7)},
                          Eigen::MatrixXd{{-8.5}, {-4.5}, {-0.5}})
                .front()
                .looks_like,
            "in");
}

TEST(InputsOutside, RecognisesTheUnitOfAnAxisByItsTravel) {
  const Eigen::MatrixXd um = Eigen::VectorXd::LinSpaced(9, 0.0, 8e5);
  const auto outside = InputsOutside({Trained("x_mm", 0.0, 800.0)}, um);
  ASSERT_EQ(outside.size(), 1U);
  EXPECT_EQ(outside[0].looks_like, "um");
}

TEST(FindSpikes, FindsSingleReadingsThatNoMachineGives) {
  const std::vector<TrainedInput> trained = {Trained("x_mm", 0.0, 10.0),
                                             Trained("t1_degC", 20.0, 25.0)};
  Eigen::MatrixXd readings(6, 2);
  readings.col(0) << 0.0, 2.0, 4.0, 6.0, 8.0, 900.0;
  readings.col(1) << 31.0, 32.0, -127.0, 33.0, 35.0, 36.0;
  const std::vector<Spike> spikes = FindSpikes(trained, readings);
  ASSERT_EQ(spikes.size(), 1U);
  EXPECT_EQ(spikes[0].input, 1);
  EXPECT_EQ(spikes[0].row, 2);
  EXPECT_EQ(spikes[0].value, -127.0);
  EXPECT_EQ(FindSpikes(trained, readings.topRows(3)).size(), 1U);
  // Of two readings neither is single, and two of six are more than a fifth.
  EXPECT_THAT(FindSpikes(trained, readings.middleRows(1, 2)),
              ::testing::IsEmpty());
  readings(4, 1) = -127.0;
  EXPECT_THAT(FindSpikes(trained, readings), ::testing::IsEmpty());
}

TEST(FindSpikes, LeavesAMachineAloneThatWarmsOrCools) {
  const std::vector<TrainedInput> trained = {Trained("t1_degC", 20.0, 20.5)};
  Eigen::MatrixXd hard(100, 1);
  for (Eigen::Index row = 0; row < hard.rows(); ++row) {
    hard(row, 0) =
        20.0 + 20.0 * (1.0 - std::exp(-0.1 * static_cast<double>(row)));
  }
  EXPECT_THAT(FindSpikes(trained, hard), ::testing::IsEmpty());
  // The next day begins cold, and a door is opened.
  Eigen::MatrixXd days(220, 1);
  days << hard, Eigen::MatrixXd::Constant(20, 1, 39.0), hard;
  days(150, 0) -= 2.0;
  EXPECT_THAT(FindSpikes(trained, days), ::testing::IsEmpty());
  days(50, 0) = 85.0;
  EXPECT_EQ(FindSpikes(trained, days).size(), 1U);
}

TEST(InputsOutside, TakesAnEmptyCellForNoReading) {
  const double empty = std::nan("");
  const std::vector<TrainedInput> trained = {Trained("t1_degC", 20.0, 25.0)};
  EXPECT_THAT(InputsOutside(trained, Eigen::MatrixXd{{empty}, {empty}, {22.0}}),
              ::testing::IsEmpty());
  EXPECT_THAT(InputsOutside(trained, Eigen::MatrixXd{{empty}}),
              ::testing::IsEmpty());
  const auto outside = InputsOutside(
      trained, Eigen::MatrixXd{{empty}, {empty}, {71.0}, {72.0}, {22.0}});
  ASSERT_EQ(outside.size(), 1U);
  EXPECT_EQ(outside[0].num_rows, 2);
  EXPECT_EQ(outside[0].min, 22.0);
  EXPECT_EQ(outside[0].max, 72.0);
  // Most readings, not most rows.
  EXPECT_EQ(
      InputsOutside(trained, Eigen::MatrixXd{{empty}, {71.0}, {72.0}, {70.0}})
          .front()
          .looks_like,
      "degF");
}

}  // namespace
}  // namespace errmap::models
