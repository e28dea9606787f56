#include "data/formats/fortran_format.h"

#include <limits>

#include <gtest/gtest.h>

namespace errmap::data {
namespace {

// All texts as gfortran 12 writes them.
TEST(FortranFormat, GeneralIsFixedInRangeAndScientificOutside) {
  EXPECT_EQ(EditG(0.9231175687, 15, 7), "  0.9231176    ");
  EXPECT_EQ(EditG(3.7788296e-3, 15, 7), "  0.3778830E-02");
  EXPECT_EQ(EditG(-0.47982166, 15, 7), " -0.4798217    ");
  EXPECT_EQ(EditG(4.985, 12, 4), "   4.985    ");
  EXPECT_EQ(EditG(0.0, 12, 3), "    0.00    ");
  EXPECT_EQ(EditG(1.0, 12, 3), "    1.00    ");
  EXPECT_EQ(EditG(1e-3, 12, 3), "   0.100E-02");
  EXPECT_EQ(EditG(std::numeric_limits<double>::quiet_NaN(), 12, 4),
            "         NaN");
}

TEST(FortranFormat, GeneralDecidesByTheRoundedValue) {
  EXPECT_EQ(EditG(0.09999996, 12, 4), "  0.1000    ");
  EXPECT_EQ(EditG(9999.7, 12, 4), "  0.1000E+05");
}

TEST(FortranFormat, ScientificHasADigitBeforeThePointOnlyWithP) {
  EXPECT_EQ(EditE(1.45119, 14, 6), "  0.145119E+01");
  EXPECT_EQ(EditE(-0.258032, 14, 6), " -0.258032E+00");
  EXPECT_EQ(EditE(0.0, 14, 6), "  0.000000E+00");
  EXPECT_EQ(EditE(1e-120, 14, 6), "  0.100000-119");
  EXPECT_EQ(Edit1PE(1.3e-3, 12, 3), "   1.300E-03");
  EXPECT_EQ(Edit1PE(3.745387e-5, 9, 3), "3.745E-05");
}

TEST(FortranFormat, ListDirectedShowsAllDigitsOfItsPrecision) {
  EXPECT_EQ(ListDirected(0.33121023553067724), "  0.33121023553067724     ");
  EXPECT_EQ(ListDirected(9.8869840267804862e-2), "   9.8869840267804862E-002");
  EXPECT_EQ(ListDirected(1.0697260122505279), "   1.0697260122505279     ");
  EXPECT_EQ(ListDirected(0.331210256F), "  0.331210256    ");
  EXPECT_EQ(ListDirected(9.88597795e-2F), "   9.88597795E-02");
  EXPECT_EQ(ListDirected(60LL), "          60");
}

TEST(FortranFormat, TakesMoreColumnsRatherThanStars) {
  EXPECT_EQ(EditI(100, 2), "100");
  EXPECT_EQ(EditF(123456.789, 6, 3), "123456.789");
}

}  // namespace
}  // namespace errmap::data
