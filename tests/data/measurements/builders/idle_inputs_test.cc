// Dead and repeated inputs: data/measurements/builders/idle_inputs.h by
// MakeDataset.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/data/measurements/as_measured.h"
#include "tests/data/measurements/make_dataset_test_data.h"

namespace errmap::data {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace as_measured;

TEST(IdleInputs, LeavesOutDeadInputsWithARemark) {
  std::string text = "zero,constant,stuck,live,error_um\n";
  for (int i = 0; i < 10; ++i) {
    text += i == 4 ? "0,21.5,7," : "0,21.5,8,";
    text.append(std::to_string(i)).append(",");
    text.append(std::to_string(i)).append("\n");
  }
  const PreparedDataset prepared = Make(text);
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("stuck", "live"));
  EXPECT_THAT(Column(prepared.dataset, 1),
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_THAT(
      prepared.remarks,
      ElementsAre("input zero is dead (0 in all 10 rows) and is left out; "
                  "keep_dead keeps it",
                  "input constant is dead (21.5 in all 10 rows) and is left "
                  "out; keep_dead keeps it",
                  "input stuck is 8 in 9 of 10 rows and is kept: its effect "
                  "depends on the others",
                  "input live repeats the target error_um value for value; "
                  "exclude = live leaves it out"));
  EXPECT_THAT(DroppedNames(prepared), ElementsAre("zero", "constant"));
  EXPECT_EQ(prepared.dropped[0].why, "is dead (0 in all 10 rows)");
}

TEST(IdleInputs, AreToldInOneLineWhereTheSameIsSaid) {
  EXPECT_THAT(Make("a,b,c,d,error_um\n1,0,0,5,1\n2,0,0,5,3\n").remarks,
              ElementsAre("inputs b, c: each is dead (0 in all 2 rows) and is "
                          "left out; keep_dead keeps it",
                          "input d is dead (5 in all 2 rows) and is left out; "
                          "keep_dead keeps it"));
}

TEST(IdleInputs, KeepsDeadInputsWhereAskedAndSaysSo) {
  const PreparedDataset prepared =
      Make("zero,nought,a,error_um\n0,0,1,1\n0,0,2,3\n", {.keep_dead = true});
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("zero", "nought", "a"));
  EXPECT_THAT(
      prepared.remarks,
      ElementsAre("input zero is dead (0 in all 2 rows) and is kept",
                  "input nought is dead (0 in all 2 rows) and is kept"));
  EXPECT_THAT(prepared.dropped, IsEmpty());
}

TEST(IdleInputs, SaysWhatBecameOfOneThatWasNamedWithTheAnswer) {
  const std::string text = "a,b,error_um\n1,5,1\n2,5,3\n4,5,4\n";
  EXPECT_THAT(Make(text).doubts, IsEmpty());
  EXPECT_THAT(
      Make(text, {.inputs = {"a", "b"}}).doubts,
      ElementsAre("The input b, asked for by inputs, is dead (5 in all 3 rows) "
                  "and is left out; keep_dead keeps it."));
}

TEST(IdleInputs, KeepsInputsWithLessThanNineTenthsOfOneValue) {
  std::string text = "a,error_um\n";
  for (int i = 0; i < 19; ++i) {  // 17 of 19 is 89.5 %
    text += (i < 2 ? "1," : "0,") + std::to_string(i) + "\n";
  }
  EXPECT_THAT(Make(text).remarks, IsEmpty());
}

TEST(IdleInputs, JudgesDeadInputsByTheRowsKept) {
  const PreparedDataset prepared = Make("a,b,error\n5,1,1\n5,2,2\n6,,3\n",
                                        {.missing = MissingPolicy::kDropRows});
  EXPECT_THAT(DroppedNames(prepared), ElementsAre("a"));
}

TEST(IdleInputs, LeavesOutWhatRepeatsAnotherUnlessItIsNamed) {
  const std::string text = "t3,t4,t5,t6,error_um\n1,0,1.0,-0,1\n2,2,2,2,3\n";
  const PreparedDataset prepared = Make(text);
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("t3", "t4"));
  EXPECT_THAT(DroppedNames(prepared), ElementsAre("t5", "t6"));
  EXPECT_THAT(prepared.remarks,
              ElementsAre("input t5 repeats t3 value for value and is left "
                          "out; name it in inputs to use it",
                          "input t6 repeats t4 value for value and is left "
                          "out; name it in inputs to use it"));
  const PreparedDataset named = Make(text, {.inputs = {"t3", "t5"}});
  EXPECT_EQ(named.dataset.num_inputs(), 2);
  EXPECT_THAT(
      named.remarks,
      ElementsAre("input t5 repeats t3 value for value; both are kept"));
}

// What counts the cycles on through the days is a state that never returns.
TEST(MessyFiles, ACounterThatNeverReturnsIsNoInput) {
  const auto counted = [](const std::string& name, int cycles) {
    return Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
      const int cycle = i == 0 ? 0 : (static_cast<int>(i) - 1) / kPositions;
      cells->insert(cells->end() - 1,
                    i == 0 ? name : std::to_string(cycle % cycles));
    }));
  };
  constexpr int kAll = kDays * kCycles;
  const PreparedDataset made = Make(counted("elapsed_cycles", kAll));
  EXPECT_THAT(DroppedNames(made), ElementsAre("elapsed_cycles"));
  EXPECT_THAT(made.remarks,
              Contains(HasSubstr("elapsed_cycles counts on from session to "
                                 "session and is left out")));
  EXPECT_THAT(DroppedNames(Make(counted("age", kAll))), ElementsAre("age"));
  const auto of_jobs = [](int step) {  // a job runs for a cycle or two
    return Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
      const int cycle = i == 0 ? 0 : (static_cast<int>(i) - 1) / kPositions;
      cells->insert(cells->end() - 1,
                    i == 0 ? "k" : std::to_string(500 + step * cycle));
    }));
  };
  EXPECT_THAT(DroppedNames(Make(of_jobs(3))), ElementsAre("k"));
  EXPECT_THAT(DroppedNames(Make(of_jobs(-7))), ElementsAre("k"));
  // Where it begins anew with each day it tells how warm the machine is; what
  // was asked for may be meant.
  EXPECT_THAT(Make(counted("elapsed_cycles", kCycles)).dropped, IsEmpty());
  EXPECT_THAT(Make(counted("elapsed_cycles", kAll),
                   {.inputs = {"position_mm", "elapsed_cycles"}})
                  .dropped,
              IsEmpty());
}

}  // namespace
}  // namespace errmap::data
