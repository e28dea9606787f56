#include "data/measurements/dataset.h"

#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"

namespace errmap::data {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> ColumnInDataset(const Dataset& dataset,
                                    Eigen::Index input) {
  const Eigen::VectorXd values = dataset.input_values().col(input);
  return {values.begin(), values.end()};
}

Dataset::Parts SmallParts() {
  return {.source = "memory",
          .inputs = {{"position_mm", UnitOfColumn("position_mm")},
                     {"t1_degC", UnitOfColumn("t1_degC")}},
          .input_values = Eigen::MatrixXd{{1, 4}, {2, 5}, {3, 6}},
          .target = {"error_um", UnitOfColumn("error_um")},
          .target_values = Eigen::Vector3d(7, 8, 9),
          .groups = {"cycle", {"1", "2"}, {0, 1, 1}},
          .weights = Eigen::Vector3d(1, 2, 3),
          .rows = {10, 20, 30}};
}

// ---- Dataset.

TEST(Dataset, KeepsItsParts) {
  const Dataset dataset(SmallParts());
  EXPECT_EQ(dataset.num_rows(), 3);
  EXPECT_EQ(dataset.num_inputs(), 2);
  EXPECT_EQ(dataset.FindInput("t1_degC"), 1);
  EXPECT_EQ(dataset.FindInput("error_um"), -1);
  EXPECT_TRUE(dataset.has_groups());
  EXPECT_THAT(dataset.rows(), ElementsAre(10, 20, 30));
}

TEST(Dataset, NumbersTheRowsWhereNoneAreGiven) {
  Dataset::Parts parts = SmallParts();
  parts.rows.clear();
  EXPECT_THAT(Dataset(parts).rows(), ElementsAre(0, 1, 2));
}

TEST(Dataset, MayHaveNoInputsGroupsAndWeights) {
  Dataset::Parts parts = SmallParts();
  parts.inputs.clear();
  parts.input_values.resize(0, 0);
  parts.groups = {};
  parts.weights.resize(0);
  const Dataset dataset(parts);
  EXPECT_EQ(dataset.num_inputs(), 0);
  EXPECT_EQ(dataset.input_values().rows(), 3);
  EXPECT_FALSE(dataset.has_groups());
}

TEST(Dataset, SelectsRowsInTheOrderAsked) {
  const Dataset selected = Dataset(SmallParts()).SelectRows({2, 0, 2});
  EXPECT_THAT(selected.rows(), ElementsAre(30, 10, 30));
  EXPECT_EQ(selected.target_values(), Eigen::Vector3d(9, 7, 9));
  EXPECT_THAT(ColumnInDataset(selected, 1), ElementsAre(6, 4, 6));
  EXPECT_EQ(selected.weights(), Eigen::Vector3d(3, 1, 3));
  EXPECT_THAT(selected.groups().codes, ElementsAre(1, 0, 1));
  EXPECT_THAT(selected.groups().labels, ElementsAre("1", "2"));
}

Dataset::Parts PartsWithLog() {
  Dataset::Parts parts = SmallParts();
  auto log = std::make_shared<SessionLog>();
  log->sessions = {"day", {"a", "b"}, {0, 0, 1, 1}};
  log->first_rows = {0, 2};
  log->time = Eigen::Vector4d(0, 1, 10, 11);
  log->time_unit = "s";
  log->input_values = Eigen::MatrixXd{{1, 4}, {kNan, kNan}, {2, 5}, {3, 6}};
  parts.log = log;
  parts.log_rows = {0, 2, 3};
  return parts;
}

TEST(Dataset, SelectsRowsWithTheirSessions) {
  const Dataset dataset(PartsWithLog());
  EXPECT_THAT(dataset.session_codes(), ElementsAre(0, 1, 1));
  EXPECT_EQ(dataset.num_sessions(), 2);
  EXPECT_TRUE(dataset.has_sessions());
  const Dataset later = dataset.SelectRows({2, 1});
  EXPECT_EQ(later.log(), dataset.log());
  EXPECT_THAT(later.log_rows(), ElementsAre(3, 2));
  EXPECT_EQ(later.num_sessions(), 1);
  EXPECT_FALSE(later.has_sessions());
  EXPECT_EQ(Dataset(SmallParts()).num_sessions(), 0);
}

// A million rows of 41 inputs are not kept twice.
TEST(Dataset, ReadsTheInputsOfALogThatHasNoOtherRows) {
  Dataset::Parts parts = SmallParts();
  auto log = std::make_shared<SessionLog>();
  log->sessions = {"day", {"a"}, {0, 0, 0}};
  log->first_rows = {0};
  log->time = Eigen::Vector3d(0, 1, 2);
  log->time_unit = "s";
  log->input_values = std::move(parts.input_values);
  parts.input_values.resize(0, 0);
  parts.log = log;
  parts.log_rows = {0, 1, 2};
  const Dataset dataset(parts);
  EXPECT_EQ(&dataset.input_values(), &log->input_values);
  EXPECT_EQ(dataset.SelectRows({2}).input_values(),
            (Eigen::MatrixXd{{3.0, 6.0}}));
  EXPECT_EQ(dataset.SelectRows({}).input_values().rows(), 0);
  auto other = std::make_shared<SessionLog>(*log);
  other->input_values.setZero();
  EXPECT_EQ(dataset.WithLog(other, {0, 1, 2}).input_values(),
            log->input_values);
  parts.log_rows = {0, 2, 1};
  EXPECT_THAT([&] { Dataset{parts}; },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("log_rows: found 2 at 1")));
}

TEST(Dataset, RefusesALogThatDoesNotAgree) {
  const auto refused = [](const auto& change, const char* what) {
    Dataset::Parts parts = PartsWithLog();
    auto log = std::make_shared<SessionLog>(*parts.log);
    change(&parts, log.get());
    if (parts.log != nullptr) parts.log = log;
    EXPECT_THAT([&] { Dataset{parts}; },
                ThrowsMessage<std::invalid_argument>(HasSubstr(what)));
  };
  using Parts = Dataset::Parts;
  refused(
      [](Parts* parts, SessionLog*) {
        parts->log_rows = {0, 2};
      },
      "log_rows: found 2, expected 3");
  refused(
      [](Parts* parts, SessionLog*) {
        parts->log_rows = {0, 2, 4};
      },
      "log_rows: 4 is outside 0..3");
  refused([](Parts* parts, SessionLog*) { parts->log = nullptr; },
          "log_rows without a log");
  refused([](Parts*, SessionLog* log) { log->sessions.codes[0] = 2; },
          "log.sessions.codes: 2 is outside 0..1");
  refused([](Parts*, SessionLog* log) { log->first_rows = {0}; },
          "log.first_rows: found 1, expected 2");
  refused([](Parts*, SessionLog* log) { log->time[1] = kNan; },
          "log.time has a value that is not finite");
  refused([](Parts*, SessionLog* log) { log->input_values.resize(4, 1); },
          "columns of log.input_values: found 1, expected 2");
}

TEST(Dataset, SelectsNoRows) {
  const Dataset none = Dataset(SmallParts()).SelectRows({});
  EXPECT_EQ(none.num_rows(), 0);
  EXPECT_EQ(none.num_inputs(), 2);
}

TEST(Dataset, RefusesRowsItDoesNotHave) {
  const Dataset dataset(SmallParts());
  EXPECT_THAT(
      [&] {
        dataset.SelectRows({0, 3});
      },
      ThrowsMessage<std::invalid_argument>(
          "errmap::data::Dataset::SelectRows: index 3 is outside the "
          "rows 0..2"));
  EXPECT_THROW(dataset.SelectRows({-1}), std::invalid_argument);
}

TEST(Dataset, RefusesShapesThatDoNotAgree) {
  Dataset::Parts parts = SmallParts();
  parts.inputs.pop_back();
  EXPECT_THAT([&] { Dataset{parts}; },
              ThrowsMessage<std::invalid_argument>(
                  "errmap::data::Dataset: columns of input_values: found 2, "
                  "expected 1"));
  parts = SmallParts();
  parts.target_values = Eigen::Vector2d(1, 2);
  EXPECT_THAT([&] { Dataset{parts}; },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("rows of input_values: found 3, expected 2")));
  parts = SmallParts();
  parts.weights = Eigen::Vector2d(1, 2);
  EXPECT_THAT([&] { Dataset{parts}; },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("weights: found 2, expected 3")));
  parts = SmallParts();
  parts.rows = {1};
  EXPECT_THAT([&] { Dataset{parts}; },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("rows: found 1, expected 3")));
}

TEST(Dataset, RefusesValuesThatAreNotFinite) {
  Dataset::Parts parts = SmallParts();
  parts.target_values(1) = kNan;
  EXPECT_THAT(
      [&] { Dataset{parts}; },
      ThrowsMessage<std::invalid_argument>(HasSubstr("target_values has")));
  parts = SmallParts();
  parts.input_values(2, 1) = std::numeric_limits<double>::infinity();
  EXPECT_THAT(
      [&] { Dataset{parts}; },
      ThrowsMessage<std::invalid_argument>(HasSubstr("input_values has")));
}

TEST(Dataset, RefusesWeightsThatAreNotPositive) {
  for (const double weight : {0.0, -1.0, kNan}) {
    Dataset::Parts parts = SmallParts();
    parts.weights(0) = weight;
    EXPECT_THAT([&] { Dataset{parts}; },
                ThrowsMessage<std::invalid_argument>(HasSubstr("weights has")));
  }
}

TEST(Dataset, RefusesGroupsThatDoNotFit) {
  Dataset::Parts parts = SmallParts();
  parts.groups.codes = {0, 1, 2};
  EXPECT_THAT([&] { Dataset{parts}; },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("group code 2 is outside the labels 0..1")));
  parts.groups.codes = {0, 1};
  EXPECT_THAT([&] { Dataset{parts}; },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("group codes: found 2, expected 3")));
  parts.groups = {"", {}, {0, 0, 0}};
  EXPECT_THAT([&] { Dataset{parts}; },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("without a group column")));
}

// ---- Groups and single columns.

TEST(GroupByColumn, SortsNumbersNumericallyWithTheirShortestText) {
  const CsvTable table = ParseCsv("g\n10\n2.0\n1e1\n-0\n2\n0\n", "f.csv");
  const Grouping groups = GroupByColumn(table, "g", {0, 1, 2, 3, 4, 5});
  EXPECT_EQ(groups.column, "g");
  EXPECT_THAT(groups.labels, ElementsAre("0", "2", "10"));
  EXPECT_THAT(groups.codes, ElementsAre(2, 1, 2, 0, 1, 0));
}

TEST(GroupByColumn, GroupsHaveAWord) {
  EXPECT_EQ(WordFor({.column = "", .labels = {"1", "2"}, .codes = {}}),
            "session");
  EXPECT_EQ(WordFor({.column = "cycle", .labels = {"1", "2"}, .codes = {}}),
            "cycle");
  EXPECT_EQ(WordFor({.column = "Zyklus", .labels = {"1", "2"}, .codes = {}}),
            "cycle");
  EXPECT_EQ(WordFor({.column = "Datum",
                     .labels = {"02.03.2026", "03.03.2026"},
                     .codes = {}}),
            "day");
  EXPECT_EQ(WordFor({.column = "start",
                     .labels = {"2026-03-02 07:00", "2026-03-03 07:00"},
                     .codes = {}}),
            "start");
  EXPECT_EQ(
      WordFor({.column = "position_mm", .labels = {"1", "2"}, .codes = {}}),
      "group");
}

TEST(GroupByColumn, KeepsTextsInOrderOfAppearance) {
  const CsvTable table = ParseCsv("g\nwarm\n3\ncold\n3.0\nwarm\n", "f.csv");
  const Grouping groups = GroupByColumn(table, "g", {0, 1, 2, 3, 4});
  EXPECT_THAT(groups.labels, ElementsAre("warm", "3", "cold"));
  EXPECT_THAT(groups.codes, ElementsAre(0, 1, 2, 1, 0));
}

TEST(GroupByColumn, LooksAtTheGivenRowsOnly) {
  const CsvTable table = ParseCsv("g,x\n3,1\nwarm,1\n,1\n2,1\n", "f.csv");
  const Grouping groups = GroupByColumn(table, "g", {3, 0});
  EXPECT_THAT(groups.labels, ElementsAre("2", "3"));
  EXPECT_THAT(groups.codes, ElementsAre(0, 1));
}

TEST(GroupByColumn, RefusesMissingCellsAndUnknownRows) {
  const CsvTable table = ParseCsv("g,x\n3,1\n,1\n", "f.csv");
  EXPECT_THAT(
      [&] {
        GroupByColumn(table, "g", {0, 1});
      },
      ThrowsMessage<InputError>(
          StartsWith("f.csv: line 3 (data row 1), column 'g': empty cell")));
  EXPECT_THAT([&] { GroupByColumn(table, "h", {0}); },
              ThrowsMessage<InputError>(HasSubstr("no column 'h' (group)")));
  EXPECT_THROW(GroupByColumn(table, "g", {2}), std::invalid_argument);
  EXPECT_THROW(GroupByColumn(table, "g", {-1}), std::invalid_argument);
}

TEST(NumericColumn, GivesValuesAndRows) {
  const CsvTable table = ParseCsv("a,b\n1,x\nNA,y\n3,z\n", "f.csv");
  std::vector<Eigen::Index> rows;
  EXPECT_EQ(NumericColumn(table, "a", MissingPolicy::kDropRows, &rows),
            Eigen::Vector2d(1, 3));
  EXPECT_THAT(rows, ElementsAre(0, 2));
  EXPECT_EQ(NumericColumn(table, "a", MissingPolicy::kDropRows, nullptr).size(),
            2);
}

TEST(NumericColumn, RefusesWhatMakeDatasetRefuses) {
  const CsvTable table = ParseCsv("a;b;c;d\n1;x;1,5;\nNA;y;1.5;NA\n", "f.csv");
  const auto error_of = [&](const std::string& column, MissingPolicy missing) {
    try {
      NumericColumn(table, column, missing, nullptr);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_of("a", MissingPolicy::kError),
              HasSubstr("line 3 (data row 1), column 'a': 'NA' is a missing"));
  EXPECT_THAT(error_of("b", MissingPolicy::kError),
              HasSubstr("'b' holds no numbers"));
  EXPECT_THAT(error_of("c", MissingPolicy::kError), HasSubstr("decimal comma"));
  EXPECT_THAT(error_of("d", MissingPolicy::kDropRows),
              HasSubstr("'d' holds no numbers"));
  EXPECT_THAT(error_of("e", MissingPolicy::kError), HasSubstr("no column 'e'"));
}

}  // namespace
}  // namespace errmap::data
