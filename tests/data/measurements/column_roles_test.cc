// Which column is what: data/measurements/column_roles.h by MakeDataset.

#include "data/measurements/column_roles.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/column_header.h"
#include "tests/data/measurements/make_dataset_test_data.h"

namespace errmap::data {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::string_view kTypical =
    "record,cycle,position_mm,time_s,t1_degC,truth_um,note,error_um\n"
    "1,2,10,0,20.5,1,cold,1.5\n"
    "2,2,20,60,20.75,2,,2.5\n"
    "3,1,30,120,21,3,warm,3.5\n";

TEST(ColumnRoles, TakesTargetGroupAndInputsByDefault) {
  const PreparedDataset prepared = Make(kTypical);
  const Dataset& dataset = prepared.dataset;
  EXPECT_EQ(dataset.source(), "f.csv");
  EXPECT_EQ(dataset.target().name, "error_um");
  EXPECT_EQ(dataset.target().unit.symbol, "um");
  EXPECT_EQ(dataset.target_values(), Eigen::Vector3d(1.5, 2.5, 3.5));
  EXPECT_THAT(InputNames(dataset), ElementsAre("position_mm", "t1_degC"));
  EXPECT_THAT(Column(dataset, 1), ElementsAre(20.5, 20.75, 21));
  EXPECT_EQ(dataset.groups().column, "cycle");
  EXPECT_THAT(dataset.groups().labels, ElementsAre("1", "2"));
  EXPECT_THAT(dataset.groups().codes, ElementsAre(1, 1, 0));
  EXPECT_EQ(dataset.weights().size(), 0);
  EXPECT_THAT(dataset.rows(), ElementsAre(0, 1, 2));
  EXPECT_THAT(prepared.dropped, IsEmpty());
  EXPECT_THAT(prepared.remarks,
              ElementsAre("column 'note' holds text and is left out of the "
                          "inputs"));
}

TEST(ColumnRoles, LeavesOutColumnsThatNumberOrDateTheRows) {
  const PreparedDataset prepared = Make(
      "cycle,day,segment,record,index,row,id,sample,time,timestamp,truth_a,"
      "Time_s,ID,rowing,x,error\n"
      "1,2,3,4,5,6,7,8,9,1,2,3,4,1,2,3\n2,3,4,5,6,7,8,9,1,2,3,4,5,3,3,4\n");
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("rowing", "x"));
}

TEST(ColumnRoles, TakesNoNumberOfARepetitionForASensor) {
  for (const std::string name :
       {"Repetition", "Wiederholung", "repeat no", "Rep"}) {
    EXPECT_THAT(
        InputNames(Make("a," + name + ",error_um\n1,1,2\n2,2,3\n").dataset),
        ElementsAre("a"));
  }
}

TEST(ColumnRoles, TakesNoPartOfAClockForASensor) {
  const PreparedDataset prepared = Make(
      "Hour,Min,Sec,Block,x,error\n8,5,10,1,2,3\n8,5,40,1,3,4\n9,2,0,2,2,4\n");
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("x"));
}

TEST(ColumnRoles, TakesThePositionThatIsNamedForNoError) {
  const char* const text =
      "piezo_um,t [C],err_nm\n0,20,1\n100,20,2\n200,21,3\n0,21,2\n100,21,4\n"
      "200,22,5\n0,22,2\n100,23,3\n200,23,6\n";
  EXPECT_THAT(InputNames(Make(text, {.position = "piezo_um"}).dataset),
              ElementsAre("piezo_um", "t [C]"));
}

TEST(ColumnRoles, TakesNamedColumnsInTheirOrder) {
  const PreparedDataset prepared = Make(kTypical,
                                        {.target = "t1_degC",
                                         .inputs = {"time_s", "position_mm"},
                                         .group = "note",
                                         .weight = "record",
                                         .missing = MissingPolicy::kDropRows});
  const Dataset& dataset = prepared.dataset;
  EXPECT_EQ(dataset.target().name, "t1_degC");
  EXPECT_THAT(InputNames(dataset), ElementsAre("time_s", "position_mm"));
  EXPECT_THAT(dataset.groups().labels, ElementsAre("cold", "warm"));
  // 1 and 3: only their ratio means something.
  EXPECT_EQ(dataset.weights(), Eigen::Vector2d(0.5, 1.5));
}

TEST(ColumnRoles, LeavesTheWeightAndExcludedColumnsOutOfTheInputs) {
  const PreparedDataset prepared = Make("a,b,w,error\n1,2,3,4\n2,3,4,5\n",
                                        {.exclude = {"b"}, .weight = "w"});
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("a"));
  EXPECT_THAT(prepared.dropped, IsEmpty());
}

TEST(ColumnRoles, LeavesOutColumnsOfTheTargetsQuantity) {
  constexpr std::string_view kText =
      "t1_degC,disp_ch1_um,disp_ch2_um\n1,2,3\n2,3,5\n";
  const PreparedDataset prepared = Make(kText, {.target = "disp_ch1_um"});
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("t1_degC"));
  EXPECT_THAT(prepared.remarks,
              ElementsAre("column 'disp_ch2_um' measures an error as the "
                          "target does and is left out; name it in inputs to "
                          "use it"));
  ASSERT_THAT(DroppedNames(prepared), ElementsAre("disp_ch2_um"));
  EXPECT_EQ(prepared.dropped[0].why, "measures the target's quantity");

  const PreparedDataset named =
      Make(kText, {.target = "disp_ch1_um", .inputs = {"disp_ch2_um"}});
  EXPECT_THAT(InputNames(named.dataset), ElementsAre("disp_ch2_um"));
  EXPECT_THAT(named.remarks, IsEmpty());
}

// Other channels of one measurement: they tell the target all too well, and no
// control has them.
TEST(ColumnRoles, LeavesOutErrorsMeasuredBesideTheTarget) {
  const auto inputs = [](std::string_view header, std::string_view target) {
    return InputNames(Make(std::string(header) + "\n1,2,3,4\n2,3,5,9\n",
                           {.target = std::string(target)})
                          .dataset);
  };
  EXPECT_THAT(
      inputs("t1_degC,error_x_mm,error_z_mm,error_yaw_arcsec", "error_z_mm"),
      ElementsAre("t1_degC"));
  EXPECT_THAT(inputs("rpm,X-Verlagerung [µm],Kippung [µrad],Z-Verlagerung [µm]",
                     "Z-Verlagerung [µm]"),
              ElementsAre("rpm"));
  EXPECT_THAT(inputs("T_x_degC,dx,dy,dz", "dz"), ElementsAre("T_x_degC"));
  EXPECT_THAT(inputs("T1_C,Scaling error X (ppm),Squareness (µm/m),backlash_um",
                     "backlash_um"),
              ElementsAre("T1_C"));
  EXPECT_THAT(inputs("CH1 [degC],CH2 [degC],CH3 [um],CH4 [um]", "CH4 [um]"),
              ElementsAre("CH1 [degC]", "CH2 [degC]"));
  // Positions stay, whatever their unit, and so do axes of one letter.
  EXPECT_THAT(inputs("position_um,x_um,y_mm,error_um", "error_um"),
              ElementsAre("position_um", "x_um", "y_mm"));
  EXPECT_THAT(inputs("x1,x2,ya,yz", "yz"), ElementsAre("x1", "x2"));
  EXPECT_THAT(inputs("T_x_degC,T_y_degC,speed,growth_z_mm", "growth_z_mm"),
              ElementsAre("T_x_degC", "T_y_degC", "speed"));
}

TEST(ColumnRoles, FindsTargetAndGroupInAnyCase) {
  const PreparedDataset prepared = Make("Cycle,x,Error_mm\n1,2,3\n2,3,4\n");
  EXPECT_EQ(prepared.dataset.target().name, "Error_mm");
  EXPECT_EQ(prepared.dataset.groups().column, "Cycle");
}

TEST(ColumnRoles, AllowsNoInputsWhereThereIsNothingElse) {
  const PreparedDataset prepared = Make("record,error\n1,3\n2,4\n");
  EXPECT_EQ(prepared.dataset.num_inputs(), 0);
  EXPECT_EQ(prepared.dataset.input_values().rows(), 2);
}

TEST(ColumnRoles, ReadsAnythingInColumnsNotInUse) {
  EXPECT_EQ(Make("time,x,error\ninf,1,2\n,2,3\n1,3,5\n").dataset.num_rows(), 3);
}

TEST(ColumnRoles, UnknownColumnsAreNamedWithTheKnownOnes) {
  constexpr std::string_view kText = "cycle,t1_degC,error\n1,2,3\n2,3,4\n";
  EXPECT_EQ(ErrorOf(kText, {.group = "cycel"}),
            "f.csv: no column 'cycel' (group); did you mean 'cycle'? the "
            "columns are 'cycle', 't1_degC', 'error'");
  EXPECT_THAT(ErrorOf(kText, {.group = "cylce"}),
              HasSubstr("did you mean 'cycle'?"));
  for (const char* typed : {"t1", "T1", "t1_C"}) {
    EXPECT_THAT(ErrorOf(kText, {.inputs = {typed}}),
                HasSubstr("did you mean 't1_degC'?"));
  }
  EXPECT_THAT(ErrorOf("day,error_mm\n1,2\n2,3\n", {.target = "eror"}),
              HasSubstr("did you mean 'error_mm'?"));
  EXPECT_THAT(ErrorOf("day,error_mm\n1,2\n2,3\n", {.session = "dya"}),
              HasSubstr("did you mean 'day'?"));
  EXPECT_EQ(ErrorOf(kText, {.target = "displacement"}),
            "f.csv: no column 'displacement' (target); the columns are "
            "'cycle', 't1_degC', 'error'");
  EXPECT_THAT(ErrorOf(kText, {.inputs = {"T1_degc"}}),
              HasSubstr("(inputs); did you mean 't1_degC'?"));
  EXPECT_THAT(ErrorOf(kText, {.exclude = {"nothing"}}),
              HasSubstr("no column 'nothing' (exclude)"));
  EXPECT_THAT(ErrorOf(kText, {.inputs = {"t1_degC"}, .exclude = {"nothing"}}),
              HasSubstr("no column 'nothing' (exclude)"));
  EXPECT_THAT(ErrorOf(kText, {.weight = "w"}),
              HasSubstr("no column 'w' (weight)"));
}

TEST(ColumnRoles, VeryManyKnownColumnsAreCutShort) {
  std::string header = "error";
  std::string row = "1";
  for (int i = 0; i < 500; ++i) {
    header += ",column" + std::to_string(i);
    row += ",1";
  }
  const std::string error = ErrorOf(header + "\n" + row + "\n", {.group = "g"});
  EXPECT_THAT(error, EndsWith("'column18' and 481 more"));
}

TEST(ColumnRoles, NoTargetOrSeveral) {
  EXPECT_EQ(
      ErrorOf("a,b\n1,2\n"),
      "f.csv: no column's name says that it is an error (error, deviation, "
      "Abweichung); name the measured "
      "error with target (columns of numbers: 'a', 'b')");
  EXPECT_THAT(ErrorOf("a\nx\n"), HasSubstr("no column holds numbers"));
  EXPECT_EQ(ErrorOf("error_x,a,error_y\n1,2,3\n"),
            "f.csv: several columns could be the target; name one with "
            "target: 'error_x', 'error_y'");
}

TEST(ColumnRoles, OneColumnCannotServeTwice) {
  constexpr std::string_view kText = "a,b,error\n1,2,3\n2,3,4\n";
  EXPECT_THAT(ErrorOf(kText, {.inputs = {"a", "error"}}),
              HasSubstr("'error' is the target and cannot be an input"));
  EXPECT_THAT(ErrorOf(kText, {.inputs = {"a", "b", "a"}}),
              HasSubstr("inputs names 'a' twice"));
  EXPECT_THAT(ErrorOf(kText, {.inputs = {"a"}, .exclude = {"a"}}),
              HasSubstr("'a' is named in inputs and in exclude"));
  EXPECT_THAT(ErrorOf(kText, {.target = "a", .weight = "a"}),
              HasSubstr("both the target and the weight"));
  EXPECT_THAT(ErrorOf(kText, {.target = "a", .group = "a"}),
              HasSubstr("both the target and the group"));
}

TEST(ColumnRoles, NoInputIsLeft) {
  EXPECT_EQ(ErrorOf("a,error\n0,1\n0,2\n"),
            "f.csv: no input is left: 'a' is dead (0 in all 2 rows); name "
            "inputs with inputs, or keep dead ones with keep_dead");
  EXPECT_THAT(ErrorOf("a,error\n1,1\n2,2\n", {.exclude = {"a"}}),
              HasSubstr("f.csv: no input is left; name inputs"));
  EXPECT_THAT(ErrorOf("time_s,error_um\n0,1\n1,2\n"),
              HasSubstr("no input is left: 'time_s' is the time; name"));
  EXPECT_THAT(ErrorOf("d1,d2\n1,1\n2,3\n", {.target = "d1"}),
              HasSubstr("'d2' measures the target's quantity"));
}

TEST(ColumnRoles, LeavesOutChannelsThatWereNeverLogged) {
  const PreparedDataset prepared = Make("a,t7,error_um\n1,,1\n2,NaN,3\n");
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("a"));
  EXPECT_THAT(prepared.remarks,
              ElementsAre("input t7 has no number in any row and is left out"));
  EXPECT_THAT(DroppedNames(prepared), ElementsAre("t7"));
}

TEST(ColumnRoles, IsNamedWhereTextTellsDirectionsApart) {
  constexpr std::string_view kRows =
      "x,error_mm,Direction\n1,1,+\n2,3,-\n3,4,+\n";
  EXPECT_THAT(
      Make(kRows).remarks,
      Contains("rows that differ in 'Direction' may need a map each, by "
               "where"));
  EXPECT_THAT(Make(kRows, {.where = {{"Direction", "+"}}}).remarks,
              Not(Contains(HasSubstr("map each"))));
  EXPECT_THAT(Make("x,error_mm,note\n1,1,+\n2,3,-\n").remarks,
              Not(Contains(HasSubstr("map each"))));
}

TEST(ColumnRoles, ColumnOfNumbersIsNoInput) {
  const std::string text = "side,x,error_mm\n1,1,0.1\n1,2,0.2\n2,3,0.4\n";
  EXPECT_THAT(InputNames(Make(text, {.where = {{"side", 1.0}}}).dataset),
              ElementsAre("x"));
}

TEST(ColumnRoles, LeavesOutColumnsWithoutAName) {
  for (const std::string name : {"", "Unnamed: 0"}) {
    const PreparedDataset prepared = Make(name + ",a,error_um\n0,1,2\n1,4,3\n");
    EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("a"));
    EXPECT_THAT(prepared.remarks,
                ElementsAre(HasSubstr("has no name in the header and is left "
                                      "out of the inputs")));
  }
  EXPECT_THAT(ErrorOf(",error_um\n0,1\n1,2\n"),
              HasSubstr("no input is left: 'column_1' has no name"));
  EXPECT_EQ(Make(",error_um\n0,1\n1,2\n", {.inputs = {"column_1"}})
                .dataset.num_inputs(),
            1);
}

// A count of warm-up cycles needs no sensor.
TEST(ColumnRoles, TellSensorsFromPositionsAndCounters) {
  for (const char* name : {"position_mm",
                           "elapsed_cycles",
                           "n_runs",
                           "Lauf",
                           "Cycle No.",
                           "sample index"}) {
    EXPECT_FALSE(IsSensor({.name = name, .unit = UnitOfColumn(name)})) << name;
  }
  for (const char* name : {"t1_degC",
                           "run_degC",
                           "humidity",
                           "no_load",
                           "T",
                           "elapsed_s",
                           "bicycle",
                           "test_stand"}) {
    EXPECT_TRUE(IsSensor({.name = name, .unit = UnitOfColumn(name)})) << name;
  }
}

TEST(ColumnRoles, TellCountersFromAges) {
  for (const char* name : {"elapsed_cycles", "n_runs", "sample index"}) {
    EXPECT_TRUE(CountsCycles({.name = name, .unit = UnitOfColumn(name)}))
        << name;
  }
  for (const char* name : {"age_days", "days since service", "cycles_degC"}) {
    EXPECT_FALSE(CountsCycles({.name = name, .unit = UnitOfColumn(name)}))
        << name;
  }
}

// Days of passes over four places, with one column more, of values by row, that
// begins as `name` does.
std::string MeasuredWith(const std::string& name,
                         const std::function<double(int)>& value) {
  std::string text = name + ",day,x_mm,T1 [degC],error_um\n";
  for (int i = 0; i < 48; ++i) {
    const double warm = 1.0 - std::exp(-0.2 * (i % 24));
    text += CsvNumber(value(i)) + "," + std::to_string(1 + i / 24) + "," +
            std::to_string(100 * (i % 4)) + "," +
            CsvNumber(std::round(2000.0 + i + 500.0 * warm) / 100.0) + "," +
            CsvNumber(std::round(100.0 * (4.0 * warm - i % 4)) / 100.0) + "\n";
  }
  return text;
}

std::vector<std::string> ReadIn(const std::string& text) {
  std::vector<std::string> names =
      InputNames(Make(text, {.target = "error_um"}).dataset);
  std::erase_if(names, [](const std::string& name) {
    return name == "x_mm" || name == "T1 [degC]";
  });
  return names;
}

double Unlike(int i) {
  return 20.0 + std::round(100.0 * std::sin(7.0 * i)) / 8;
}

TEST(ColumnRoles, TakesNothingThatIsMadeOfErrorsForASensor) {
  for (const char* name : {"Residual",
                           "Residuum [um]",
                           "Fit",
                           "Predicted",
                           "Vorhersage",
                           "Used tol %",
                           "Out of tol",
                           "n.i.O.",
                           "U (k=2) [um]",
                           "B [um]"}) {
    EXPECT_THAT(ReadIn(MeasuredWith(name, Unlike)), IsEmpty()) << name;
  }
  for (const char* name : {"Fitting [bar]", "Load", "Speed model [degC]"}) {
    EXPECT_THAT(ReadIn(MeasuredWith(name, Unlike)), ElementsAre(name));
  }
}

TEST(ColumnRoles, TakesNoStatisticForASensor) {
  for (const char* name : {"T1 std [degC]", "Tbed_sd", "Stabw T2 [degC]"}) {
    EXPECT_THAT(ReadIn(MeasuredWith(name, Unlike)), IsEmpty()) << name;
  }
  const std::string of = "n,T2 std [degC]";
  const auto with_std = [&](const std::string& first) {
    std::string text = MeasuredWith(first, Unlike);
    for (std::size_t at = text.find('\n'); at + 1 < text.size();
         at = text.find('\n', at + 1)) {
      text.insert(at + 1, "0.1,");
    }
    return "T2 std [degC]," + text;
  };
  EXPECT_THAT(ReadIn(with_std("n")), IsEmpty());
  // Else it is a speed.
  EXPECT_THAT(ReadIn(MeasuredWith("n", Unlike)), ElementsAre("n"));
}

TEST(ColumnRoles, TakesNothingThatKeepsRecordsForASensor) {
  const auto whole = [](int i) { return 3300.0 + i * 7 % 11; };
  for (const char* name : {"KW",
                           "Attempt",
                           "Charge",
                           "Anzahl Messwerte",
                           "Number of readings",
                           "Millitm",
                           "usec",
                           "CRC",
                           "Pr\u00fcfsumme",
                           "Statuswort",
                           "Probe S/N",
                           "Taster SN",
                           "FW-Version",
                           "Employee ID",
                           "Personalnr.",
                           "Numero di letture"}) {
    EXPECT_THAT(ReadIn(MeasuredWith(name, whole)), IsEmpty()) << name;
  }
  EXPECT_THAT(ReadIn(MeasuredWith("Fw", [](int i) { return 2.1 + i / 24; })),
              IsEmpty());
  for (const char* name : {"SN1 [degC]", "Charge [Ah]"}) {
    EXPECT_THAT(Make(MeasuredWith(name, whole)).reading.sensors,
                Contains(name));
  }
}

TEST(ColumnRoles, TakesNoDurationForASensor) {
  DatasetSelection selection;
  selection.time = "none";
  selection.faults = FaultPolicy::kDropRows;
  const auto lasts = [](int i) {
    return i % 24 == 0 ? 900.0 : 10.0 + 0.1 * (i * 7 % 11);
  };
  for (const char* name :
       {"dt_s", "\u0394t [s]", "Probe time [s]", "Messdauer [s]"}) {
    const PreparedDataset prepared = Make(MeasuredWith(name, lasts), selection);
    EXPECT_THAT(prepared.reading.sensors, ElementsAre("T1 [degC]")) << name;
    EXPECT_EQ(prepared.dataset.num_rows(), 48) << name;
  }
}

TEST(ColumnRoles, TakesNoEncoderOfAnAxisThatStandsForASensor) {
  const auto stands = [](int i) { return 250.0 + 1e-4 * (i * 7 % 11 - 5); };
  for (const char* name : {"Y act [mm]", "Z_ist [mm]"}) {
    EXPECT_THAT(ReadIn(MeasuredWith(name, stands)), IsEmpty()) << name;
  }
  const auto at_zero = [&](int i) { return stands(i) - 250.0; };
  EXPECT_THAT(ReadIn(MeasuredWith("Y act [mm]", at_zero)), IsEmpty());
  EXPECT_THAT(ReadIn(MeasuredWith("Gap [mm]", stands)),
              ElementsAre("Gap [mm]"));
}

TEST(ColumnRoles, TakesAHeightForAPosition) {
  std::string text = "H\u00f6he Z (mm),T1 [degC],error_um\n";
  for (int i = 0; i < 24; ++i) {
    text += std::to_string(-600 * (i % 2)) + "," + CsvNumber(20.05 + 0.1 * i) +
            "," + CsvNumber(i % 2 + 0.3 * i) + "\n";
  }
  EXPECT_THAT(Make(text).reading.sensors, ElementsAre("T1 [degC]"));
  EXPECT_EQ(Make(text).reading.position.column, "H\u00f6he Z (mm)");
}

// A unit of temperature, or digits behind the point, beat every other word.
TEST(ColumnRoles, TakesThermometersWhateverElseTheirNamesSay) {
  for (const char* name : {"No. 1 [degC]",
                           "Temp. Nr. 1",
                           "Pt100-Nr1",
                           "ID1 [degC]",
                           "Min [degC]",
                           "Station 1 degC",
                           "Run 1 [degC]",
                           "Cycle temp",
                           "Position 2 [degC]",
                           "Soll-Temp [degC]",
                           "Zeitrelais-Schrank [degC]",
                           "Error amp. [degC]"}) {
    std::string text = std::string("x_mm,error_um,") + name + "\n";
    for (int i = 0; i < 40; ++i) {
      text += std::to_string(i % 8) + "," + std::to_string(i % 3) + "," +
              CsvNumber(20.05 + 0.1 * i) + "\n";
    }
    const PreparedDataset prepared = MakeDataset(ParseCsv(text, "f.csv"), {});
    EXPECT_THAT(prepared.reading.sensors, ::testing::Contains(name)) << name;
  }
}

}  // namespace
}  // namespace errmap::data
