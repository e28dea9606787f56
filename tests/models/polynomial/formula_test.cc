#include "models/polynomial/formula.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::models {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<std::string> kNames = {"position_mm", "t1_degC", "bed: top"};

std::vector<TermPowers> Read(const std::string& text) {
  return ResolveTerms(ParseTerms(text, "formula"), kNames, "formula");
}

std::string RefusalOfInFormula(const std::string& text) {
  try {
    Read(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Formula, ReadsSumsOfProductsOfPowers) {
  EXPECT_THAT(
      Read("position_mm + position_mm^2 + t1_degC*position_mm^2"),
      ElementsAre(
          TermPowers{1, 0, 0}, TermPowers{2, 0, 0}, TermPowers{2, 1, 0}));
  EXPECT_THAT(Read("\"bed: top\"*t1_degC"), ElementsAre(TermPowers{0, 1, 1}));
  EXPECT_THAT(Read("t1_degC*t1_degC^2"), ElementsAre(TermPowers{0, 3, 0}));
}

TEST(Formula, SaysWhereItCannotBeRead) {
  EXPECT_THAT(RefusalOfInFormula("position_mm+"),
              HasSubstr("position 13: ends where a name should be"));
  EXPECT_THAT(RefusalOfInFormula("position_mm++t1_degC"),
              HasSubstr("position 13: '+' where a name should be"));
  EXPECT_THAT(RefusalOfInFormula("position_mm t1_degC"),
              HasSubstr("position 13: 't' where + or the end should be"));
  EXPECT_THAT(RefusalOfInFormula("t1_degC^0"),
              HasSubstr("position 9: a power must be a whole number from 1"));
  EXPECT_THAT(RefusalOfInFormula("t1_degC^x"), HasSubstr("found 'x'"));
  EXPECT_THAT(RefusalOfInFormula("3*t1_degC"), HasSubstr("the number '3'"));
  EXPECT_THAT(RefusalOfInFormula("\"bed"), HasSubstr("never closed"));
  EXPECT_THAT(RefusalOfInFormula("t1_degC+(position_mm)"),
              HasSubstr("position 9: '('"));
}

TEST(Formula, NamesWhatIsNoInputAndWhatStandsTwice) {
  EXPECT_THAT(RefusalOfInFormula("t1_degC+t2_degC"),
              HasSubstr("position 9: 't2_degC' is not an input; there are "
                        "position_mm, t1_degC"));
  EXPECT_THAT(RefusalOfInFormula("positon_mm"),
              HasSubstr("did you mean 'position_mm'?"));
  EXPECT_THAT(RefusalOfInFormula("t1_degC*position_mm+position_mm*t1_degC"),
              HasSubstr("position 21: position_mm*t1_degC stands twice"));
}

}  // namespace
}  // namespace errmap::models
