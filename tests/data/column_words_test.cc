#include "data/column_words.h"

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "data/way_words.h"

namespace errmap::data {
namespace {

TEST(ErrorSign, TurnsWithEveryWordForACorrection) {
  for (const char* name : {"correction_um",
                           "abw_korr [um]",
                           "Abw. Komp. [um]",
                           "x comp [um]",
                           "-error_um",
                           "nominal - actual [um]"}) {
    EXPECT_EQ(ErrorSign(name), -1) << name;
  }
  EXPECT_EQ(ErrorSign("Abweichung [um]"), 1);
  EXPECT_EQ(ErrorSign("-correction_um"), 1);
  EXPECT_EQ(ErrorSign("E_xx [um]"), 1);
  EXPECT_EQ(ErrorSign("E_AX"), 1);
  EXPECT_EQ(ErrorSign("E_ax1"), 0);
  EXPECT_EQ(ErrorSign("company"), 0);
}

TEST(IsCalled, TakesNoToolForADay) {
  EXPECT_FALSE(IsCalled("gun", Word::kSession));
  EXPECT_TRUE(IsCalled("Messtag", Word::kSession));
}

TEST(IsCalledPosition, IsInNoUnitOfErrors) {
  EXPECT_TRUE(IsCalledPosition("X [mm]"));
  EXPECT_TRUE(IsCalledPosition("Sollposition [mm]"));
  for (const char* unit : {"um", "0.1um", "0.0001in", "nm", "arcsec"}) {
    EXPECT_FALSE(IsCalledPosition("pos dev [" + std::string(unit) + "]"));
    EXPECT_FALSE(IsCalledPosition("X [" + std::string(unit) + "]"));
  }
}

TEST(WayWords, TakeASignWithItsAxis) {
  EXPECT_EQ(FirstIsUp("+x", "-x"), true);
  EXPECT_EQ(FirstIsUp("-Z", "+Z"), false);
  EXPECT_EQ(IsUpwards("-x"), false);
  EXPECT_EQ(IsUpwards("+k"), std::nullopt);
  EXPECT_TRUE(IsCalled("Anfahrt", Word::kDirection));
}

}  // namespace
}  // namespace errmap::data
