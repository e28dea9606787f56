#include "data/units.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace errmap::data {
namespace {

TEST(UnitOfColumn, ReadsLengthsFromTheSuffixAndShowsThemInMicrometres) {
  const Unit mm = UnitOfColumn("error_mm");
  EXPECT_EQ(mm.symbol, "mm");
  EXPECT_EQ(mm.quantity, Quantity::kLength);
  EXPECT_EQ(mm.display_scale, 1000.0);
  EXPECT_EQ(mm.display_symbol, "um");
  EXPECT_EQ(UnitOfColumn("disp_ch1_um").display_scale, 1.0);
  EXPECT_EQ(UnitOfColumn("gap_nm").display_scale, 1e-3);
  EXPECT_EQ(UnitOfColumn("travel_m").display_scale, 1e6);
}

TEST(UnitOfColumn, ShowsAllOtherQuantitiesAsTheyStand) {
  for (const std::string symbol : {"arcsec", "urad", "mrad", "rad", "deg"}) {
    const Unit unit = UnitOfColumn("yaw_" + symbol);
    EXPECT_EQ(unit.symbol, symbol);
    EXPECT_EQ(unit.quantity, Quantity::kAngle);
    EXPECT_EQ(unit.display_scale, 1.0);
    EXPECT_EQ(unit.display_symbol, symbol);
  }
  for (const std::string symbol : {"degC", "K", "degF"}) {
    EXPECT_EQ(UnitOfColumn("bed_" + symbol).symbol, symbol);
    EXPECT_EQ(UnitOfColumn("bed_" + symbol).quantity, Quantity::kTemperature);
  }
  for (const std::string symbol :
       {"s", "min", "h", "rpm", "N", "V", "A", "W", "bar", "pct", "percent"}) {
    EXPECT_EQ(UnitOfColumn("x_" + symbol).symbol, symbol);
    EXPECT_EQ(UnitOfColumn("x_" + symbol).quantity, Quantity::kOther);
  }
}

TEST(UnitOfColumn, TakesBothMicroSignsForMicrometres) {
  EXPECT_EQ(UnitOfColumn("error_\u00b5m"), UnitOfSymbol("um"));
  EXPECT_EQ(UnitOfColumn("error_\u03bcm"), UnitOfSymbol("um"));
}

TEST(UnitOfColumn, FallsBackToMillimetresForPositionsAndErrors) {
  EXPECT_EQ(UnitOfColumn("position").symbol, "mm");
  EXPECT_EQ(UnitOfColumn("position_x").symbol, "mm");
  EXPECT_EQ(UnitOfColumn("Error").symbol, "mm");
  EXPECT_EQ(UnitOfColumn("error_yaw_arcsec").symbol, "arcsec");
}

TEST(UnitOfColumn, FallsBackToDegreesForUsualNamesOfTemperatures) {
  for (const char* name : {"t12",
                           "T1",
                           "tc03",
                           "TC3",
                           "temp",
                           "temp4",
                           "temp_bed",
                           "temperature",
                           "Temperature_1"}) {
    EXPECT_EQ(UnitOfColumn(name).symbol, "degC") << name;
  }
  for (const char* name :
       {"t", "tc", "tool", "t12b", "tempo", "template", "humidity"}) {
    EXPECT_EQ(UnitOfColumn(name), Unit{}) << name;
  }
}

TEST(UnitOfColumn, HasNoUnitForUnknownSuffixesAndOtherCase) {
  EXPECT_EQ(UnitOfColumn("pressure_foo"), Unit{});
  EXPECT_EQ(UnitOfColumn("x_MM"), Unit{});
  EXPECT_EQ(UnitOfColumn("mm"), Unit{});
  EXPECT_EQ(UnitOfColumn("x_"), Unit{});
  EXPECT_EQ(UnitOfColumn(""), Unit{});
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
  for (const char* name : {"error_mm", "t1_degC", "yaw_urad", "n_rpm"}) {
    const Unit unit = UnitOfColumn(name);
    EXPECT_EQ(UnitOfSymbol(unit.symbol), unit) << name;
  }
}

TEST(StemOfColumn, StripsUnitThenDigitsThenUnderscore) {
  EXPECT_EQ(StemOfColumn("disp_ch1_um"), "disp_ch");
  EXPECT_EQ(StemOfColumn("disp_ch12_um"), "disp_ch");
  EXPECT_EQ(StemOfColumn("disp_1_um"), "disp");
  EXPECT_EQ(StemOfColumn("disp_1"), "disp");
  EXPECT_EQ(StemOfColumn("error_mm"), "error");
  EXPECT_EQ(StemOfColumn("error"), "error");
  EXPECT_EQ(StemOfColumn("error_x"), "error_x");
}

TEST(StemOfColumn, KeepsNamesThatAreAllNumberAndUnit) {
  EXPECT_EQ(StemOfColumn("12"), "12");
  EXPECT_EQ(StemOfColumn("12_mm"), "12_mm");
  EXPECT_EQ(StemOfColumn("_mm"), "_mm");
  EXPECT_EQ(StemOfColumn(""), "");
}

}  // namespace
}  // namespace errmap::data
