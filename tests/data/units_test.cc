#include "data/units.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"

namespace errmap::data {
namespace {

double ConvertedBy(double value, const char* from, const char* to) {
  return Converted(value, UnitOfSymbol(from), UnitOfSymbol(to));
}

TEST(Converted, KnowsEveryPairOfAQuantity) {
  EXPECT_EQ(ConvertedBy(2.0, "m", "mm"), 2000.0);
  EXPECT_EQ(ConvertedBy(2.5, "um", "mm"), 0.0025);
  EXPECT_EQ(ConvertedBy(1.0, "in", "mm"), 25.4);
  EXPECT_DOUBLE_EQ(ConvertedBy(1.0, "mil", "um"), 25.4);
  EXPECT_DOUBLE_EQ(ConvertedBy(20.0, "degC", "K"), 293.15);
  EXPECT_DOUBLE_EQ(ConvertedBy(293.15, "K", "degC"), 20.0);
  EXPECT_NEAR(ConvertedBy(68.0, "degF", "degC"), 20.0, 1e-12);
  EXPECT_NEAR(ConvertedBy(-40.0, "degC", "degF"), -40.0, 1e-12);
  EXPECT_NEAR(ConvertedBy(1.0, "arcsec", "urad"), 4.84813681109536, 1e-14);
  EXPECT_DOUBLE_EQ(ConvertedBy(5.0, "mdeg", "arcsec"), 18.0);
  EXPECT_DOUBLE_EQ(ConvertedBy(180.0, "deg", "rad"), 3.14159265358979323846);
  EXPECT_EQ(ConvertedBy(3.0, "um/m", "ppm"), 3.0);
  EXPECT_EQ(ConvertedBy(2.0, "min", "s"), 120.0);
  for (const Quantity quantity : {Quantity::kLength,
                                  Quantity::kAngle,
                                  Quantity::kTemperature,
                                  Quantity::kTime,
                                  Quantity::kRatio}) {
    for (const Unit& a : UnitsOf(quantity)) {
      for (const Unit& b : UnitsOf(quantity)) {
        ASSERT_TRUE(AreConvertible(a, b)) << a.symbol << b.symbol;
        EXPECT_NEAR(Converted(Converted(1.5, a, b), b, a), 1.5, 1e-12)
            << a.symbol << " " << b.symbol;
      }
    }
  }
}

TEST(Converted, RefusesAnotherQuantity) {
  EXPECT_FALSE(AreConvertible(UnitOfSymbol("mm"), UnitOfSymbol("degC")));
  EXPECT_FALSE(AreConvertible(UnitOfSymbol("V"), UnitOfSymbol("A")));
  EXPECT_FALSE(AreConvertible(UnitOfSymbol("mm"), UnitOfSymbol("")));
  EXPECT_TRUE(AreConvertible(UnitOfSymbol("V"), UnitOfSymbol("V")));
  EXPECT_THROW(ConvertedBy(1.0, "mm", "V"), std::invalid_argument);
}

TEST(UnitOfSymbol, KeepsTheTextOfUnknownSymbols) {
  const Unit unit = UnitOfSymbol("furlong");
  EXPECT_EQ(unit.symbol, "furlong");
  EXPECT_EQ(unit.display_symbol, "furlong");
  EXPECT_EQ(unit.quantity, Quantity::kOther);
  EXPECT_EQ(unit.display_scale, 1.0);
  EXPECT_EQ(UnitOfSymbol(""), Unit{});
}

TEST(UnitOfSymbol, FindsWhatUnitOfColumnFound) {
  for (const char* name :
       {"error_mm", "t1_degC", "yaw_urad", "n_rpm", "a [mg/m3]", "b_%"}) {
    const Unit unit = UnitOfColumn(name);
    EXPECT_EQ(UnitOfSymbol(unit.symbol), unit) << name;
  }
}

}  // namespace
}  // namespace errmap::data
