#include "models/export/program/safe_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::models {
namespace {

using ::testing::ElementsAre;

TEST(SafeIdentifier, KeepsLettersDigitsAndSingleUnderscores) {
  EXPECT_EQ(SafeIdentifier("t12_degC", 40), "t12_degC");
  EXPECT_EQ(SafeIdentifier("x displacement,  down", 40), "x_displacement_down");
  EXPECT_EQ(SafeIdentifier("a__b_", 40), "a_b");
  EXPECT_EQ(SafeIdentifier("7 spindles", 40), "m_7_spindles");
  EXPECT_EQ(SafeIdentifier("\xc2\xb5m", 40), "m");
  EXPECT_EQ(SafeIdentifier("*/ system(\"rm\"); /*", 40), "system_rm");
  EXPECT_EQ(SafeIdentifier("", 40), "m");
  EXPECT_EQ(SafeIdentifier("abcdefgh_ijk", 9), "abcdefgh");
}

TEST(SafeIdentifiers, TellsApartWhatCasesAndCutsMakeEqual) {
  EXPECT_THAT(
      SafeIdentifiers({"T 1", "t_1", "T.1", "abcdefghijk", "abcdefghXX"}, 8),
      ElementsAre("T_1", "t_1_2", "T_1_3", "abcdefgh", "abcdef_2"));
}

TEST(CommentText, EndsNoCommentOfAnyLanguage) {
  EXPECT_EQ(CommentText("a*/b(*c*)d\\\n\"\"\"e?\?/"), "a_/b(_c_)d_____e__/");
  EXPECT_EQ(CommentText(std::string(200, 'a')).size(), 80);
}

TEST(RealText, HasAPointAndReadsBack) {
  EXPECT_EQ(RealText(5.0), "5.0");
  EXPECT_EQ(RealText(1e-5), "1.0e-05");
  EXPECT_EQ(RealText(0.1), "0.1");
  EXPECT_EQ(RealText(-2.5e300), "-2.5e+300");
  EXPECT_EQ(RealText(0.1, true), "0.1");
  EXPECT_EQ(std::stod(RealText(1.0 / 3.0)), 1.0 / 3.0);
}

}  // namespace
}  // namespace errmap::models
