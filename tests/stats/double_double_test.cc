#include "stats/double_double.h"

#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::stats {
namespace {

// A few units of 2^-104 for one operation, some dozens for a series.
constexpr double kOperation = 0x1p-102;
constexpr double kFunction = 0x1p-97;

double RelativeError(const DoubleDouble& value, const DoubleDouble& expected) {
  return std::abs(((value - expected) / expected).hi);
}

DoubleDouble Number(const char* text) { return ParseDoubleDouble(text); }

TEST(DoubleDouble, KeepsWhatADoubleWouldRoundAway) {
  const DoubleDouble sum = DoubleDouble(1e16) + 1.0 + 1e-10;
  // The low part is 1 + 1e-10, to a double's digits.
  EXPECT_NEAR((sum - 1e16 - 1.0).hi, 1e-10, 1e-16);
}

TEST(DoubleDouble, DividesAndMultipliesBack) {
  for (const double a : {1.0, -7.0, 1e-30, 3e200}) {
    for (const double b : {3.0, -0.1, 1e40}) {
      EXPECT_LT(RelativeError(DoubleDouble(a) / b * b, a), kOperation);
    }
  }
}

// Digits from Python's decimal module at 50 digits.
TEST(DoubleDouble, KnowsTheDecimalThatADoubleWasReadFrom) {
  for (const char* text : {"0.1", "-6.860120914", "1e-30", "273.15", "3"}) {
    const DoubleDouble meant = Number(text);
    const DoubleDouble found = DecimalOf(meant.hi);
    EXPECT_EQ(found.hi, meant.hi) << text;
    EXPECT_EQ(found.lo, meant.lo) << text;
  }
  // Few decimals, as most data have, go a shorter way to the same bits.
  for (int whole = -99999; whole < 1'000'000; whole += 137) {
    for (const int decimals : {0, 1, 3, 5, 6, 7, 9}) {
      const std::string text =
          std::to_string(whole) + "e-" + std::to_string(decimals);
      const DoubleDouble meant = ParseDoubleDouble(text);
      EXPECT_EQ(DecimalOf(meant.hi).lo, meant.lo) << text;
    }
  }
  EXPECT_NE(DecimalOf(0.1).lo, 0.0);
  EXPECT_TRUE(std::isnan(DecimalOf(std::nan("")).hi));
}

TEST(DoubleDouble, ParsesDecimalsToThirtyDigits) {
  EXPECT_LT(RelativeError(Number("0.1") * 10.0, 1.0), kOperation);
  EXPECT_LT(RelativeError(Number("-2.5134E+03"), -2513.4), 1e-16);
  EXPECT_LT(RelativeError(Number("123456789.987654321e-4") * 1e13,
                          DoubleDouble(123456789987654321.0 - 1.0) + 1.0 + 0.0),
            1e-15);
  EXPECT_EQ(Number("10000000.2").hi, 10000000.2);
  EXPECT_NE(Number("10000000.2").lo, 0.0);
  EXPECT_EQ(Number("+5.").hi, 5.0);
}

TEST(DoubleDouble, KnowsTheSmallestNumbers) {
  for (const char* text :
       {"1e-310", "5e-324", "1.2345678901234567e-295", "-2.5e-301"}) {
    const double meant = std::strtod(text, nullptr);
    EXPECT_EQ(Number(text).hi, meant) << text;
    EXPECT_EQ(DecimalOf(meant).hi, meant) << text;
  }
  EXPECT_EQ(Number("1e-400").hi, 0.0);
}

TEST(DoubleDouble, RefusesWhatIsNoDecimal) {
  for (const char* text : {"",
                           "-",
                           ".",
                           "1.2.3",
                           "1e",
                           "1e+",
                           "0x10",
                           "1,5",
                           "nan",
                           "1 ",
                           "1e99999"}) {
    EXPECT_THROW(ParseDoubleDouble(text), std::invalid_argument) << text;
  }
}

TEST(DoubleDouble, FunctionsHaveThirtyDigits) {
  const DoubleDouble e = Number("2.71828182845904523536028747135266249776");
  const DoubleDouble ln10 = Number("2.30258509299404568401799145468436420760");
  const DoubleDouble root2 = Number("1.41421356237309504880168872420969807857");
  const DoubleDouble sin1 = Number("0.84147098480789650665250232163029899962");
  const DoubleDouble cos1 = Number("0.54030230586813971740093660744297660373");
  const DoubleDouble pi = Number("3.14159265358979323846264338327950288420");
  EXPECT_LT(RelativeError(exp(DoubleDouble(1.0)), e), kFunction);
  EXPECT_LT(RelativeError(exp(DoubleDouble(-1.0)) * e, 1.0), kFunction);
  EXPECT_LT(RelativeError(log(DoubleDouble(10.0)), ln10), kFunction);
  EXPECT_LT(RelativeError(sqrt(DoubleDouble(2.0)), root2), kOperation);
  EXPECT_LT(RelativeError(sin(DoubleDouble(1.0)), sin1), kFunction);
  EXPECT_LT(RelativeError(cos(DoubleDouble(1.0)), cos1), kFunction);
  EXPECT_LT(RelativeError(atan(DoubleDouble(1.0)) * 4.0, pi), kFunction);
  EXPECT_LT(RelativeError(pow(DoubleDouble(10.0), DoubleDouble(0.5)),
                          sqrt(DoubleDouble(10.0))),
            kFunction);
}

TEST(DoubleDouble, IdentitiesHoldOverTheRange) {
  for (double x = -30.0; x <= 30.0; x += 0.37) {
    const DoubleDouble t = x;
    const DoubleDouble one = sin(t) * sin(t) + cos(t) * cos(t);
    EXPECT_LT(RelativeError(one, 1.0), kFunction) << x;
    EXPECT_LT(RelativeError(exp(t) * exp(-t), 1.0), kFunction) << x;
    EXPECT_LT(RelativeError(log(exp(t)), t), kFunction) << x;
    EXPECT_LT(RelativeError(sin(atan(t)) / cos(atan(t)), t), kFunction) << x;
  }
}

TEST(DoubleDouble, BehavesAsDoubleOutsideARange) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exp(DoubleDouble(1000.0)).hi, infinity);
  EXPECT_EQ(exp(DoubleDouble(-1000.0)).hi, 0.0);
  EXPECT_TRUE(std::isnan(log(DoubleDouble(-1.0)).hi));
  EXPECT_TRUE(std::isnan(sqrt(DoubleDouble(-1.0)).hi));
  EXPECT_TRUE(std::isnan(sin(DoubleDouble(infinity)).hi));
  EXPECT_EQ((DoubleDouble(infinity) + 1.0).hi, infinity);
  EXPECT_EQ((DoubleDouble(1.0) / 0.0).hi, infinity);
  EXPECT_FALSE(isfinite(DoubleDouble(1e308) * 10.0));
}

}  // namespace
}  // namespace errmap::stats
