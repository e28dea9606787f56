#include "models/fault_effect.h"

#include <cmath>

#include <gtest/gtest.h>

#include "data/column_header.h"
#include "tests/models/model_test_data.h"

namespace errmap::models {
namespace {

using Eigen::Index;

// Twenty rows of an exact plane.
data::Dataset::Parts Plane() {
  data::Dataset::Parts parts;
  parts.source = "plane";
  for (const char* name : {"position_mm", "t1_degC"}) {
    parts.inputs.push_back({name, data::UnitOfColumn(name)});
  }
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  parts.input_values.resize(20, 2);
  parts.target_values.resize(20);
  for (Index i = 0; i < 20; ++i) {
    const double x = static_cast<double>(i % 5);
    const double t = 20.0 + 0.1 * static_cast<double>(i);
    parts.input_values.row(i) << x, t;
    parts.target_values[i] = 1e-3 * x + 2e-3 * t;
  }
  return parts;
}

TEST(EffectOfRows, HoldsBothFitsAgainstTheSoundRows) {
  data::Dataset::Parts parts = Plane();
  parts.target_values[7] = 20.0;
  const FaultEffect effect = EffectOfRows(data::Dataset(parts), {7});
  EXPECT_GT(effect.rmse_with, 0.5);
  EXPECT_LT(effect.rmse_without, 1e-12);
}

TEST(EffectOfInput, LeavesTheColumnOut) {
  const FaultEffect effect = EffectOfInput(data::Dataset(Plane()), 1);
  EXPECT_LT(effect.rmse_with, 1e-12);
  EXPECT_GT(effect.rmse_without, 2e-3 * 0.1 * 5.0);
}

// Fitted to its own rows a plane never errs more for another input.
TEST(EffectOfInput, IsThatOnRowsHeldOut) {
  data::Dataset::Parts parts = Plane();
  parts.groups = {
      .column = "cycle", .labels = {"1", "2", "3", "4"}, .codes = {}};
  for (Index i = 0; i < 20; ++i) {
    const Index cycle = i / 5;
    parts.groups.codes.push_back(cycle);
    parts.input_values(i, 1) = 20.0 + static_cast<double>(cycle);
    parts.target_values[i] = 1e-3 * parts.input_values(i, 0) +
                             (cycle == 0 || cycle == 3 ? 1e-3 : 0.0);
  }
  const FaultEffect effect = EffectOfInput(data::Dataset(parts), 1);
  EXPECT_GT(effect.rmse_with, 1.2 * effect.rmse_without);
}

TEST(EffectOfRows, IsNotANumberWhereNothingCanBeFitted) {
  const data::Dataset all(Plane());
  std::vector<Index> rows;
  for (Index i = 0; i < 19; ++i) rows.push_back(i);
  EXPECT_TRUE(std::isnan(EffectOfRows(all, rows).rmse_without));
}

}  // namespace
}  // namespace errmap::models
