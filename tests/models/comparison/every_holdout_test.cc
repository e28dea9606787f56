// Every kind of hold-out on every shape of data: figures, or a refusal.

#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/files/atomic_file.h"
#include "models/comparison/compare.h"
#include "models/study/judgement/units_of_analysis.h"

namespace errmap::models {
namespace {

using Eigen::Index;

// Columns that say which rows belong together.
struct Shape {
  std::string name;
  std::vector<int> cycles_of_days = {};  // none: no day
  int cycles = 0;                        // where there is no day
  bool has_cycles = true;
  bool cycles_count_on = false;  // from day to day, else each begins with 1
  bool first_days_come_last = false;
};

std::vector<Shape> Shapes() {
  return {{.name = "one session", .cycles_of_days = {12}},
          {.name = "two sessions", .cycles_of_days = {6, 6}},
          {.name = "unequal", .cycles_of_days = {1, 7, 2, 9, 3, 1}},
          {.name = "later days first",
           .cycles_of_days = {4, 4, 4, 4, 4, 4},
           .first_days_come_last = true},
          {.name = "cycles across days",
           .cycles_of_days = {3, 3, 3, 3},
           .cycles_count_on = true},
          {.name = "neither", .cycles = 12, .has_cycles = false}};
}

std::string TextOf(const Shape& shape) {
  std::vector<std::pair<std::string, int>> cycles;  // day and number
  for (std::size_t day = 0; day < shape.cycles_of_days.size(); ++day) {
    const std::size_t place = shape.first_days_come_last
                                  ? (day + shape.cycles_of_days.size() / 2) %
                                        shape.cycles_of_days.size()
                                  : day;
    for (int i = 0; i < shape.cycles_of_days[day]; ++i) {
      const int number = shape.cycles_count_on
                             ? static_cast<int>(cycles.size()) * 2 / 3
                             : i + 1;
      cycles.emplace_back(fmt::format("2026-03-{:02}", place + 1), number);
    }
  }
  for (int i = 0; i < shape.cycles; ++i) cycles.emplace_back("", i + 1);
  const bool has_days = !shape.cycles_of_days.empty();
  std::string text = has_days ? "day," : "";
  text += shape.has_cycles ? "cycle," : "";
  text += "position_mm,t1_degC,error_um\n";
  int row = 0;
  for (const auto& [day, number] : cycles) {
    for (int x = 0; x < 4; ++x, ++row) {
      if (has_days) text += day + ",";
      if (shape.has_cycles) text += std::to_string(number) + ",";
      const double t = 20.0 + 0.3 * std::sqrt(row) + 0.1 * ((row * 7) % 5);
      text += fmt::format("{},{:.2f},{:.3f}\n",
                          100 * x,
                          t,
                          x + 0.7 * (t - 20.0) + 0.2 * ((row * 11) % 7));
    }
  }
  return text;
}

const std::vector<std::string>& Specs() {
  static const std::vector<std::string> specs = {"every:3",
                                                 "groups:2",
                                                 "groups:2:repeats=3",
                                                 "sessions:2",
                                                 "sessions:2:repeats=3",
                                                 "blocks:5",
                                                 "leave-one-group-out",
                                                 "kfold:5",
                                                 "forward:1",
                                                 "forward:3",
                                                 "forward:3:gap=1",
                                                 "random:0.1",
                                                 "random:0.6",
                                                 "file:"};
  return specs;
}

// What every later step takes for granted of the units of held-out rows.
void ExpectUnitsInOrder(const data::Dataset& dataset, const Holdout& holdout) {
  UnitsOfAnalysis units;
  const HeldOutRows held = GatherHeldOut(dataset, holdout);
  const std::vector<Index> codes = AssignUnits(holdout, held, &units);
  ASSERT_EQ(codes.size(), held.rows.size());
  const std::set<Index> present(codes.begin(), codes.end());
  ASSERT_EQ(present.size(), units.labels.size());
  EXPECT_EQ(*present.begin(), 0);
  EXPECT_EQ(*present.rbegin(), std::ssize(units.labels) - 1);
  if (units.name == kBlockOfRows) return;
  const data::Dataset& source = *held.source;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const auto row = static_cast<std::size_t>(held.rows[i]);
    const std::string& label =
        units.are_sessions
            ? source.log()->sessions.labels[static_cast<std::size_t>(
                  source.session_codes()[row])]
            : source.groups()
                  .labels[static_cast<std::size_t>(source.groups().codes[row])];
    EXPECT_EQ(units.labels[static_cast<std::size_t>(codes[i])], label);
  }
}

class EveryHoldoutTest : public ::testing::Test {
 protected:
  EveryHoldoutTest() { std::filesystem::create_directories(folder_); }
  ~EveryHoldoutTest() override { std::filesystem::remove_all(folder_); }

  std::string Write(const Shape& shape) const {
    const std::string path = (folder_ / (shape.name + ".csv")).string();
    data::WriteFileAtomically(path, TextOf(shape));
    return path;
  }

  // Whether it was possible.
  bool Compare(const std::string& file, const std::string& spec) const {
    ComparisonOptions options{.models = {"mean", "poly:eq9"}};
    options.holdouts = {spec};
    try {
      const ComponentStudy study = CompareMaps(file, {}, options);
      EXPECT_TRUE(study.judgement.recommendation);
      for (const Holdout& holdout : study.holdouts) {
        ExpectUnitsInOrder(study.data.dataset, holdout);
      }
      return true;
    } catch (const std::invalid_argument&) {
      return false;
    }
  }

  std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / "every_holdout";
};

TEST_F(EveryHoldoutTest, GivesFiguresOrRefusesOnEveryShapeOfData) {
  std::map<std::string, std::set<std::string>> impossible;  // by shape
  const std::string later = Write({.name = "later", .cycles_of_days = {5, 5}});
  const std::string rows =
      Write({.name = "later rows", .cycles = 5, .has_cycles = false});
  for (const Shape& shape : Shapes()) {
    const std::string file = Write(shape);
    for (const std::string& spec : Specs()) {
      const std::string whole =
          spec != "file:" ? spec : spec + (shape.has_cycles ? later : rows);
      SCOPED_TRACE(shape.name + ", " + whole);
      if (!Compare(file, whole)) impossible[shape.name].insert(spec);
    }
  }
  const std::set<std::string> of_sessions = {"sessions:2",
                                             "sessions:2:repeats=3"};
  const std::map<std::string, std::set<std::string>> expected = {
      {"one session", of_sessions},
      {"cycles across days", {"forward:3:gap=1"}},  // four days, and one lost
      // Its cycles are found by the positions.
      {"neither", of_sessions}};
  EXPECT_EQ(impossible, expected);
}

}  // namespace
}  // namespace errmap::models
