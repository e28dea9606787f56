#include "data/column_header.h"

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

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
  EXPECT_EQ(UnitOfColumn("travel_cm").display_scale, 1e4);
  EXPECT_EQ(UnitOfColumn("travel [m]").display_scale, 1e6);
}

TEST(UnitOfColumn, ShowsAllOtherQuantitiesAsTheyStand) {
  for (const std::string symbol : {"arcsec", "urad", "mrad", "rad", "deg"}) {
    const Unit unit = UnitOfColumn("yaw_" + symbol);
    EXPECT_EQ(unit.symbol, symbol);
    EXPECT_EQ(unit.quantity, Quantity::kAngle);
    EXPECT_EQ(unit.display_scale, 1.0);
    EXPECT_EQ(unit.display_symbol, symbol);
  }
  for (const std::string symbol : {"degC", "degF"}) {
    EXPECT_EQ(UnitOfColumn("bed_" + symbol).symbol, symbol);
    EXPECT_EQ(UnitOfColumn("bed_" + symbol).quantity, Quantity::kTemperature);
  }
  for (const std::string symbol :
       {"s", "min", "h", "rpm", "N", "V", "A", "W", "bar", "pct", "percent"}) {
    EXPECT_EQ(UnitOfColumn("x_" + symbol).symbol, symbol);
    EXPECT_EQ(UnitOfColumn("x_" + symbol).display_scale, 1.0);
    EXPECT_NE(UnitOfColumn("x_" + symbol).quantity, Quantity::kLength);
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
                           "Temperature_1",
                           "28-0316a2794bff"}) {
    EXPECT_EQ(UnitOfColumn(name).symbol, "degC") << name;
  }
  for (const char* name : {"t",
                           "tc",
                           "tool",
                           "t12b",
                           "tempo",
                           "template",
                           "humidity",
                           "28-03-2024-0000"}) {
    EXPECT_EQ(UnitOfColumn(name), Unit{}) << name;
  }
}

TEST(UnitOfColumn, HasNoUnitForUnknownSuffixes) {
  EXPECT_EQ(UnitOfColumn("pressure_foo"), Unit{});
  EXPECT_EQ(UnitOfColumn("mm"), Unit{});
  EXPECT_EQ(UnitOfColumn("x_"), Unit{});
  EXPECT_EQ(UnitOfColumn(""), Unit{});
}

TEST(ReadHeader, ReadsUnitsHoweverPeopleWriteThem) {
  for (const char* name : {"error [\u00b5m]",
                           "error [\u03bcm]",
                           "error (um)",
                           "error um",
                           "error_UM",
                           "error_Um",
                           "error_microns",
                           "error (micron)",
                           "error [ um ]",
                           "error-um",
                           "error, um",
                           "error / um",
                           "error (in um)",
                           "error..um."}) {
    const Header header = ReadHeader(name);
    EXPECT_EQ(header.unit, UnitOfSymbol("um")) << name;
    EXPECT_EQ(header.source, UnitSource::kStated) << name;
    EXPECT_THAT(header.base, ::testing::StartsWith("error")) << name;
  }
  EXPECT_EQ(ReadHeader("disp_ch1 [um]").base, "disp_ch1");
}

TEST(ReadHeader, KnowsTheUnitsOfTheField) {
  const std::vector<std::pair<const char*, const char*>> names = {
      {"error_inch", "in"},
      {"error [in]", "in"},
      {"error_mil", "mil"},
      {"error_thou", "mil"},
      {"error [nm]", "nm"},
      {"error_CM", "cm"},
      {"error (m)", "m"},
      {"error [arcsec]", "arcsec"},
      {"error [Bogensekunden]", "arcsec"},
      {"error [Zoll]", "in"},
      {"force [VDC]", "V"},
      {"error [\"]", "arcsec"},
      {"error_\u00b5rad", "urad"},
      {"error_mrad", "mrad"},
      {"error_rad", "rad"},
      {"tilt_deg", "deg"},
      {"T1 [\u00b0C]", "degC"},
      {"T1 [\u2103]", "degC"},
      {"T1 (C)", "degC"},
      {"T1_deg C", "degC"},
      {"T1 [K]", "K"},
      {"t1_K", "K"},
      {"temp_K", "K"},
      {"T1 [\u00b0F]", "degF"},
      {"T1 (F)", "degF"},
      {"strain_ppm", "ppm"},
      {"strain_um/m", "um/m"},
      {"speed [U/min]", "rpm"},
      {"flow [l/min]", "l/min"},
      {"NOx_mg_per_m3", "mg/m3"},
      {"torque_Nm", "Nm"}};
  for (const auto& [name, symbol] : names) {
    EXPECT_EQ(ReadHeader(name).unit.symbol, symbol) << name;
  }
}

TEST(ReadHeader, TakesBareLettersForNames) {
  for (const char* name : {"T_in", "pos_c", "x_v", "axis_n"}) {
    EXPECT_EQ(ReadHeader(name).source, UnitSource::kNone) << name;
    EXPECT_EQ(ReadHeader(name).unit, Unit{}) << name;
  }
  EXPECT_EQ(ReadHeader("error_C").unit.symbol, "mm");
  EXPECT_EQ(ReadHeader("temp_in").unit.symbol, "degC");
}

TEST(ReadHeader, TakesDegreesOfAThermometerForNoAngle) {
  EXPECT_EQ(UnitOfColumn("Temp. [\u00b0]").symbol, "degC");
  EXPECT_EQ(UnitOfColumn("T2 (deg)").symbol, "degC");
  EXPECT_EQ(UnitOfColumn("C [\u00b0]").symbol, "deg");
  EXPECT_EQ(UnitOfColumn("angle [deg]").symbol, "deg");
}

TEST(ReadHeader, TakesBareDegreesBehindTheNameOfATemperature) {
  for (const char* name : {"temp_C", "T1_C", "tc03 C", "T_bed_C"}) {
    EXPECT_EQ(ReadHeader(name).unit.symbol, "degC") << name;
    EXPECT_EQ(ReadHeader(name).source, UnitSource::kStated) << name;
  }
  EXPECT_EQ(ReadHeader("Temp_F").unit.symbol, "degF");
  EXPECT_EQ(ReadHeader("t1_c").unit.symbol, "");
  EXPECT_EQ(ReadHeader("valve_C").unit.symbol, "");
}

TEST(ReadHeader, LeavesWhatMayBeAUnitWithoutOne) {
  for (const char* name : {"travel_m",
                           "error_m",
                           "error_in",
                           "position_m",
                           "position_in",
                           "x_in",
                           "pos_ft",
                           "error_furlong",
                           "error_mm2",
                           "flow_m\u00b3"}) {
    EXPECT_EQ(ReadHeader(name).source, UnitSource::kUnread) << name;
    EXPECT_EQ(ReadHeader(name).unit, Unit{}) << name;
  }
  EXPECT_EQ(ReadHeader("error [furlong]").source, UnitSource::kUnknown);
  EXPECT_EQ(ReadHeader("position (left)").source, UnitSource::kUnknown);
}

// Mutation: reading the last word alone leaves all of these in mm.
TEST(ReadHeader, FindsTheOneUnitOfErrorsAnywhereInAName) {
  const std::vector<std::pair<const char*, const char*>> names = {
      {"error_um_mean", "um"},
      {"error {um}", "um"},
      {"error <um>", "um"},
      {"error [um] mean", "um"},
      {"Error in um (mean)", "um"},
      {"error_mm_x", "mm"},
      {"tilt_arcsec_avg", "arcsec"}};
  for (const auto& [name, symbol] : names) {
    EXPECT_EQ(ReadHeader(name).unit.symbol, symbol) << name;
    EXPECT_EQ(ReadHeader(name).source, UnitSource::kStated) << name;
  }
  EXPECT_EQ(ReadHeader("error_um_mean").base, "error_mean");
  EXPECT_EQ(ReadHeader("temp_min_left").unit.symbol, "degC");
  EXPECT_EQ(ReadHeader("spindle_rad_x").source, UnitSource::kNone);
}

TEST(ReadHeader, DoubtsSeveralUnitsAndThoseWithANumber) {
  for (const char* name : {"error_10um", "error_um_mm", "error_mm_um_x"}) {
    EXPECT_EQ(ReadHeader(name).source, UnitSource::kDoubtful) << name;
    EXPECT_EQ(ReadHeader(name).unit, Unit{}) << name;
  }
  EXPECT_EQ(ReadHeader("probe_10mm_um").unit.symbol, "um");
  EXPECT_EQ(ReadHeader("error_um_per_mm").source, UnitSource::kStated);
}

TEST(ReadHeader, TakesAFactorBesideTheUnitWithIt) {
  for (const char* name :
       {"Error 1/1000 mm", "Abw. 10^-3 mm", "Error x10^-3 mm"}) {
    EXPECT_EQ(ReadHeader(name).unit.symbol, "um") << name;
  }
  for (const char* name : {"Error mm x1000", "Error hundredths of mm"}) {
    EXPECT_EQ(ReadHeader(name).source, UnitSource::kUnknown) << name;
  }
  EXPECT_EQ(ReadHeader("Error 1 mm").base, "Error 1");
}

TEST(ReadHeader, SaysWhatItOnlyAssumes) {
  EXPECT_EQ(ReadHeader("error").source, UnitSource::kAssumed);
  EXPECT_EQ(ReadHeader("error_x").unit.symbol, "mm");
  EXPECT_EQ(ReadHeader("t12").source, UnitSource::kAssumed);
  EXPECT_EQ(ReadHeader("error [-]").source, UnitSource::kStated);
  EXPECT_EQ(ReadHeader("error [-]").unit, Unit{});
}

TEST(ReadHeader, NeverTakesAnotherQuantityForALength) {
  for (const char* name : {"error_NOx_mg_per_m3",
                           "error [mg/m3]",
                           "error_pct",
                           "error [bar]",
                           "error_degC",
                           "error_V",
                           "error_mg"}) {
    EXPECT_NE(ReadHeader(name).unit.quantity, Quantity::kLength) << name;
    EXPECT_EQ(ReadHeader(name).unit.display_scale, 1.0) << name;
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

TEST(NamesPosition, TakesALengthOrAnAngleThatIsCalledSo) {
  for (const char* name : {"position_mm",
                           "Position",
                           "Sollposition [mm]",
                           "x_pos_mm",
                           "Pos. [mm]",
                           "axis position (deg)"}) {
    EXPECT_TRUE(NamesPosition(name)) << name;
  }
  // A thermometer at a position, and words that end alike.
  for (const char* name : {"T pos 3 [degC]",
                           "t_position_3_degC",
                           "pos",
                           "Sollposition",
                           "composite_mm",
                           "error_mm"}) {
    EXPECT_FALSE(NamesPosition(name)) << name;
  }
}

// Known or not, stated or assumed; a remark in brackets is none.
TEST(HasUnit, TakesWhatStandsInBracketsForOne) {
  for (const char* name : {"angle [arcsec]",
                           "Energy [kWh]",
                           "Charge [Ah]",
                           "t1_degC",
                           "position"}) {
    EXPECT_TRUE(HasUnit(name)) << name;
  }
  for (const char* name : {"t (MATLAB)", "Sample (No.)", "index [-]", "flow"}) {
    EXPECT_FALSE(HasUnit(name)) << name;
  }
}

}  // namespace
}  // namespace errmap::data
