// MakeDataset of data/measurements/dataset.h.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/measurements/dataset.h"

namespace errmap::data {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

PreparedDataset Make(std::string_view text,
                     const DatasetSelection& selection = {}) {
  return MakeDataset(ParseCsv(text, "f.csv"), selection);
}

// Message of the InputError, or what happened instead.
std::string ErrorOf(std::string_view text,
                    const DatasetSelection& selection = {}) {
  try {
    Make(text, selection);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<std::string> InputNames(const Dataset& dataset) {
  std::vector<std::string> names;
  for (const ColumnInfo& input : dataset.inputs()) names.push_back(input.name);
  return names;
}

std::vector<double> Column(const Dataset& dataset, Eigen::Index input) {
  const Eigen::VectorXd values = dataset.input_values().col(input);
  return {values.begin(), values.end()};
}

std::vector<std::string> DroppedNames(const PreparedDataset& prepared) {
  std::vector<std::string> names;
  for (const DroppedColumn& d : prepared.dropped) names.push_back(d.column);
  return names;
}

// ---- Which columns.

constexpr std::string_view kTypical =
    "record,cycle,position_mm,time_s,t1_degC,truth_um,note,error_um\n"
    "1,2,10,0,20.5,1,cold,1.5\n"
    "2,2,20,60,20.75,2,,2.5\n"
    "3,1,30,120,21,3,warm,3.5\n";

TEST(MakeDataset, TakesTargetGroupAndInputsByDefault) {
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
              ElementsAre(HasSubstr("time by 'time_s'"),
                          "column 'note' holds text and is left out of the "
                          "inputs"));
}

TEST(MakeDataset, LeavesOutColumnsThatNumberOrDateTheRows) {
  const PreparedDataset prepared = Make(
      "cycle,day,segment,record,index,row,id,sample,time,timestamp,truth_a,"
      "Time_s,ID,rowing,x,error\n"
      "1,2,3,4,5,6,7,8,9,1,2,3,4,1,2,3\n2,3,4,5,6,7,8,9,1,2,3,4,5,3,3,4\n");
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("rowing", "x"));
}

TEST(MakeDataset, TakesNamedColumnsInTheirOrder) {
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

TEST(MakeDataset, WeightsOfAnySizeAreTheSame) {
  const auto weights = [](const std::string& first, const std::string& second) {
    return Make("a,w,error\n1," + first + ",3\n2," + second + ",5\n",
                {.weight = "w"})
        .dataset.weights();
  };
  EXPECT_EQ(weights("0.5", "1.5"), Eigen::Vector2d(0.5, 1.5));
  EXPECT_EQ(weights("0.5e308", "1.5e308"), weights("1", "3"));
  EXPECT_EQ(weights("1e-300", "3e-300"), weights("1", "3"));
  EXPECT_EQ(weights("0.1", "0.1"), Eigen::Vector2d(1.0, 1.0));
  EXPECT_THAT(ErrorOf("a,w,error\n1,1e-10,3\n2,1e25,5\n", {.weight = "w"}),
              AllOf(HasSubstr("line 2 (data row 0), column 'w': weight 1e-10"),
                    HasSubstr("less than 1e-30 of the largest")));
}

TEST(MakeDataset, RefusesTargetsWhoseSquaresCannotBeSummed) {
  for (const char* size : {"e160", "e101", "e-101", "e-170"}) {
    const std::string text =
        std::string("a,error\n1,1") + size + "\n2,-2" + size + "\n3,0" + "\n";
    EXPECT_THAT(ErrorOf(text),
                AllOf(HasSubstr("line 3 (data row 1), column 'error'"),
                      HasSubstr("-2" + std::string(size).replace(
                                           0, 1, size[1] == '-' ? "e" : "e+")),
                      HasSubstr("choose another unit")));
  }
  EXPECT_EQ(Make("a,error\n1,1e99\n2,0\n").dataset.num_rows(), 2);
}

TEST(MakeDataset, LeavesTheWeightAndExcludedColumnsOutOfTheInputs) {
  const PreparedDataset prepared = Make("a,b,w,error\n1,2,3,4\n2,3,4,5\n",
                                        {.exclude = {"b"}, .weight = "w"});
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("a"));
  EXPECT_THAT(prepared.dropped, IsEmpty());
}

TEST(MakeDataset, LeavesOutColumnsOfTheTargetsQuantity) {
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
TEST(MakeDataset, LeavesOutErrorsMeasuredBesideTheTarget) {
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
  // Positions stay, whatever their unit, and so do axes of one letter.
  EXPECT_THAT(inputs("position_um,x_um,y_mm,error_um", "error_um"),
              ElementsAre("position_um", "x_um", "y_mm"));
  EXPECT_THAT(inputs("x1,x2,ya,yz", "yz"), ElementsAre("x1", "x2"));
  EXPECT_THAT(inputs("T_x_degC,T_y_degC,speed,growth_z_mm", "growth_z_mm"),
              ElementsAre("T_x_degC", "T_y_degC", "speed"));
}

TEST(MakeDataset, FindsTargetAndGroupInAnyCase) {
  const PreparedDataset prepared = Make("Cycle,x,Error_mm\n1,2,3\n2,3,4\n");
  EXPECT_EQ(prepared.dataset.target().name, "Error_mm");
  EXPECT_EQ(prepared.dataset.groups().column, "Cycle");
}

TEST(MakeDataset, AllowsNoInputsWhereThereIsNothingElse) {
  const PreparedDataset prepared = Make("record,error\n1,3\n2,4\n");
  EXPECT_EQ(prepared.dataset.num_inputs(), 0);
  EXPECT_EQ(prepared.dataset.input_values().rows(), 2);
}

TEST(MakeDataset, ReadsAnythingInColumnsNotInUse) {
  EXPECT_EQ(Make("time,x,error\ninf,1,2\n,2,3\n1,3,5\n").dataset.num_rows(), 3);
}

TEST(MakeDatasetError, UnknownColumnsAreNamedWithTheKnownOnes) {
  constexpr std::string_view kText = "cycle,t1_degC,error\n1,2,3\n2,3,4\n";
  EXPECT_EQ(ErrorOf(kText, {.group = "cycel"}),
            "f.csv: no column 'cycel' (group); did you mean 'cycle'? the "
            "columns are 'cycle', 't1_degC', 'error'");
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

TEST(MakeDatasetError, VeryManyKnownColumnsAreCutShort) {
  std::string header = "error";
  std::string row = "1";
  for (int i = 0; i < 500; ++i) {
    header += ",column" + std::to_string(i);
    row += ",1";
  }
  const std::string error = ErrorOf(header + "\n" + row + "\n", {.group = "g"});
  EXPECT_THAT(error, EndsWith("'column18' and 481 more"));
}

TEST(MakeDatasetError, NoTargetOrSeveral) {
  EXPECT_EQ(ErrorOf("a,b\n1,2\n"),
            "f.csv: no column's name starts with 'error'; name the measured "
            "error with target (columns of numbers: 'a', 'b')");
  EXPECT_THAT(ErrorOf("a\nx\n"), HasSubstr("no column holds numbers"));
  EXPECT_EQ(ErrorOf("error_x,a,error_y\n1,2,3\n"),
            "f.csv: several columns could be the target; name one with "
            "target: 'error_x', 'error_y'");
}

TEST(MakeDatasetError, TextCannotBeATargetAnInputOrAWeight) {
  constexpr std::string_view kText = "a,note,error\n1,x,3\n2,y,4\n";
  EXPECT_EQ(ErrorOf(kText, {.inputs = {"note"}}),
            "f.csv: column 'note' holds no numbers (data row 0 is 'x') and "
            "cannot be an input; leave it out of inputs");
  EXPECT_THAT(
      ErrorOf(kText, {.target = "note"}),
      AllOf(HasSubstr("'note' holds no numbers"), HasSubstr("with target")));
  EXPECT_THAT(
      ErrorOf(kText, {.weight = "note"}),
      AllOf(HasSubstr("'note' holds no numbers"), HasSubstr("with weight")));
}

TEST(MakeDatasetError, OneColumnCannotServeTwice) {
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

TEST(MakeDatasetError, NoInputIsLeft) {
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

// ---- Which rows.

TEST(MakeDatasetError, BadCellsAreNamedWithTheirPlaceAndRemedy) {
  EXPECT_EQ(ErrorOf("t3_degC,error\n1,1\n# gap\n,2\n3,3\n"),
            "f.csv: line 4 (data row 1), column 't3_degC': empty cell; fill it "
            "in, or leave the column out with exclude = t3_degC, or drop such "
            "rows with missing = drop-rows");
  EXPECT_EQ(ErrorOf("a,error\n1,NA\n2,nan\n3,4\n"),
            "f.csv: line 2 (data row 0), column 'error': 'NA' is a missing "
            "value; fill it in, or drop such rows with missing = drop-rows "
            "(the columns in use have 2 such cells)");
  EXPECT_EQ(ErrorOf("a,error\n1,1\n-Inf,2\n"),
            "f.csv: line 3 (data row 1), column 'a': '-Inf' is not finite; "
            "correct it, or leave the column out with exclude = a");
  EXPECT_THAT(ErrorOf("a,error\n1,1\n1e999,2\n"),
              HasSubstr("'1e999' is beyond the range of a double"));
  EXPECT_THAT(ErrorOf("a,error\n1,1\nbroken,2\n"),
              HasSubstr("'broken' is no number; correct it"));
  EXPECT_THAT(ErrorOf("a,error\n1,1\n\"1,5\",2\n"),
              HasSubstr("'1,5' is no number here; write a decimal point, or "
                        "separate the columns with ; or tab"));
}

TEST(MakeDatasetError, TheFirstBadCellOfTheFileIsNamed) {
  EXPECT_THAT(ErrorOf("a,b,error\n1,1,1\n2,x,2\n,2,3\n"),
              HasSubstr("line 3 (data row 1), column 'b'"));
  EXPECT_THAT(ErrorOf("a,b,error\n1,1,1\n,2,2\n2,x,3\n"),
              HasSubstr("line 3 (data row 1), column 'a'"));
}

TEST(MakeDatasetError, LongAndStrangeCellsStayOnOneLine) {
  const std::string error =
      ErrorOf("a,error\n1,1\n\"" + std::string(500, 'x') + "\",2\n");
  EXPECT_THAT(error, HasSubstr(std::string(40, 'x') + "...'"));
  EXPECT_LT(error.size(), 200U);
  EXPECT_THAT(ErrorOf("a,error\n1,1\n\"p\nq\",2\n"),
              AllOf(HasSubstr("'p\\nq'"), Not(HasSubstr("\n"))));
}

TEST(MakeDataset, DropsRowsWithMissingCellsWhereAsked) {
  const PreparedDataset prepared = Make(
      "cycle,a,error_um\n1,1,1\n1,NA,2\n2,3,\n2,4,4\n,5,5\n3,nAn,6\n3,7,8\n",
      {.missing = MissingPolicy::kDropRows});
  EXPECT_THAT(prepared.dataset.rows(), ElementsAre(0, 3, 6));
  EXPECT_THAT(Column(prepared.dataset, 0), ElementsAre(1, 4, 7));
  EXPECT_THAT(prepared.dataset.groups().labels, ElementsAre("1", "2", "3"));
  EXPECT_THAT(prepared.remarks,
              ElementsAre("4 of 7 rows are dropped for missing cells; the "
                          "first: f.csv: line 3 (data row 1), column 'a'"));
}

TEST(MakeDatasetError, DropRowsDropsNothingButMissingCells) {
  const DatasetSelection drop{.missing = MissingPolicy::kDropRows};
  EXPECT_THAT(
      ErrorOf("a,error\n1,1\ninf,2\n,3\n", drop),
      HasSubstr("line 3 (data row 1), column 'a': 'inf' is not finite"));
  EXPECT_THAT(ErrorOf("a,error\n1,1\n,2\nN/A,3\n", drop),
              HasSubstr("'N/A' is no number"));
}

TEST(MakeDatasetError, NoRowIsLeft) {
  EXPECT_EQ(ErrorOf("a,b,error\n,1,1\n,2,2\n3,,3\n",
                    {.missing = MissingPolicy::kDropRows}),
            "f.csv: no row is left: each has a missing cell in the columns in "
            "use ('a' lacks 2 of 3); fill them in, or leave such columns out "
            "with exclude");
}

TEST(MakeDataset, LeavesOutChannelsThatWereNeverLogged) {
  const PreparedDataset prepared = Make("a,t7,error_um\n1,,1\n2,NaN,3\n");
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("a"));
  EXPECT_THAT(prepared.remarks,
              ElementsAre("input t7 has no number in any row and is left out"));
  EXPECT_THAT(DroppedNames(prepared), ElementsAre("t7"));
}

TEST(MakeDatasetError, ConstantTarget) {
  EXPECT_EQ(ErrorOf("a,error\n1,0.5\n2,0.5\n"),
            "f.csv: target 'error' is constant (0.5 in all 2 rows), so there "
            "is nothing to map; name another with target");
  EXPECT_THAT(
      ErrorOf("a,error\n1,1\n2,1\n,2\n", {.missing = MissingPolicy::kDropRows}),
      HasSubstr("is constant (1 in all 2 rows)"));
  EXPECT_THAT(ErrorOf("a,error\n1,1\n"), HasSubstr("has a single row"));
}

TEST(MakeDatasetError, WeightThatIsNotPositive) {
  EXPECT_EQ(ErrorOf("a,w,error\n1,1,1\n2,0,2\n", {.weight = "w"}),
            "f.csv: line 3 (data row 1), column 'w': weight 0 is not positive; "
            "correct it or remove the row");
}

TEST(MakeDatasetError, DecimalCommasAndPointsAreNotMixed) {
  EXPECT_EQ(ErrorOf("a;error\n1,5;2\n1.234;3\n"),
            "f.csv: line 3 (data row 1), column 'a': decimal point (1.234), "
            "but decimal comma (1,5) at line 2 (data row 0), column 'a'; write "
            "all numbers one way, without thousands separators");
  EXPECT_THAT(ErrorOf("a;error\n1.5;2\n2;3,5\n"),
              AllOf(HasSubstr("column 'a'"), HasSubstr("column 'error'")));
  // Whole numbers are neither, and columns not in use may be of any kind.
  EXPECT_EQ(ErrorOf("time;a;error\n1.5;1;2\n2.5;2;3,5\n"), "no error");
  // A day of the month is a label and not a number in error.
  EXPECT_EQ(ErrorOf("d;a;error\n03.05;1,5;2\n04.05;2;3,5\n", {.group = "d"}),
            "no error");
}

// ---- Dead and repeated inputs.

TEST(MakeDataset, LeavesOutDeadInputsWithARemark) {
  std::string text = "zero,constant,stuck,live,error_um\n";
  for (int i = 0; i < 10; ++i) {
    text += i == 4 ? "0,21.5,7," : "0,21.5,8,";
    text.append(std::to_string(i)).append(",");
    text.append(std::to_string(i)).append("\n");
  }
  const PreparedDataset prepared = Make(text);
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("live"));
  EXPECT_THAT(Column(prepared.dataset, 0),
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_THAT(
      prepared.remarks,
      ElementsAre("input zero is dead (0 in all 10 rows) and is left out; "
                  "keep_dead keeps it",
                  "input constant is dead (21.5 in all 10 rows) and is left "
                  "out; keep_dead keeps it",
                  "input stuck is dead (8 in 9 of 10 rows) and is left out; "
                  "keep_dead keeps it",
                  "input live repeats the target error_um value for value; "
                  "exclude = live leaves it out"));
  EXPECT_THAT(DroppedNames(prepared), ElementsAre("zero", "constant", "stuck"));
  EXPECT_EQ(prepared.dropped[0].why, "is dead (0 in all 10 rows)");
}

TEST(MakeDataset, KeepsDeadInputsWhereAskedAndSaysSo) {
  const PreparedDataset prepared =
      Make("zero,nought,a,error_um\n0,0,1,1\n0,0,2,3\n", {.keep_dead = true});
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("zero", "nought", "a"));
  EXPECT_THAT(
      prepared.remarks,
      ElementsAre("input zero is dead (0 in all 2 rows) and is kept",
                  "input nought is dead (0 in all 2 rows) and is kept"));
  EXPECT_THAT(prepared.dropped, IsEmpty());
}

TEST(MakeDataset, KeepsInputsWithLessThanNineTenthsOfOneValue) {
  std::string text = "a,error_um\n";
  for (int i = 0; i < 19; ++i) {  // 17 of 19 is 89.5 %
    text += (i < 2 ? "1," : "0,") + std::to_string(i) + "\n";
  }
  EXPECT_THAT(Make(text).remarks, IsEmpty());
}

TEST(MakeDataset, JudgesDeadInputsByTheRowsKept) {
  const PreparedDataset prepared = Make("a,b,error\n5,1,1\n5,2,2\n6,,3\n",
                                        {.missing = MissingPolicy::kDropRows});
  EXPECT_THAT(DroppedNames(prepared), ElementsAre("a"));
}

TEST(MakeDataset, NamesInputsThatRepeatOthersAndKeepsThem) {
  const PreparedDataset prepared =
      Make("t3,t4,t5,t6,error_um\n1,0,1.0,-0,1\n2,2,2,2,3\n");
  EXPECT_EQ(prepared.dataset.num_inputs(), 4);
  EXPECT_THAT(
      prepared.remarks,
      ElementsAre("input t5 repeats t3 value for value; both are kept",
                  "input t6 repeats t4 value for value; both are kept"));
}

TEST(MakeDataset, TakesRowsOnlyToJudgeAsTheyAre) {
  const PreparedDataset prepared =
      Make("a,b,error\n1,x,5\n1,,5\n",
           {.inputs = {}, .keep_dead = true, .only_to_judge = true});
  EXPECT_EQ(prepared.dataset.num_rows(), 2);
  EXPECT_EQ(prepared.dataset.num_inputs(), 0);
}

TEST(MakeDatasetError, MissingGroup) {
  EXPECT_EQ(ErrorOf("cycle,a,error\n1,1,1\n,2,2\n"),
            "f.csv: line 3 (data row 1), column 'cycle': empty cell; fill it "
            "in, or drop such rows with missing = drop-rows");
}
// ---- Rows by the value of a column.

constexpr std::string_view kBothWays =
    "direction,day,cycle,x,error_mm\n"
    "down,1,1,1,0.1\n"
    "up,1,1,2,\n"
    "down,2,2,3,0.2\n"
    "up,2,2,4,0.4\n"
    "down,2,3,5,0.5\n";

TEST(MakeDatasetWhere, KeepsTheRowsOfOneTextUnderTheirNumbersInTheFile) {
  // The empty cell is in a row that nobody asked for.
  const auto prepared = Make(kBothWays, {.where = {{"direction", "down"}}});
  EXPECT_THAT(prepared.dataset.rows(), ElementsAre(0, 2, 4));
  EXPECT_THAT(prepared.dataset.groups().labels, ElementsAre("1", "2", "3"));
  EXPECT_THAT(InputNames(prepared.dataset), ElementsAre("x"));
  EXPECT_THAT(prepared.remarks, ElementsAre(HasSubstr("2 sessions by 'day'")));
}

TEST(MakeDatasetWhere, IsNamedWhereTextTellsDirectionsApart) {
  constexpr std::string_view kRows =
      "x,error_mm,Direction\n1,1,+\n2,3,-\n3,4,+\n";
  EXPECT_THAT(Make(kRows).remarks,
              Contains("rows that differ in 'Direction' may need a map each: "
                       "where"));
  EXPECT_THAT(Make(kRows, {.where = {{"Direction", "+"}}}).remarks,
              Not(Contains(HasSubstr("map each"))));
  EXPECT_THAT(Make("x,error_mm,note\n1,1,+\n2,3,-\n").remarks,
              Not(Contains(HasSubstr("map each"))));
}

TEST(MakeDatasetWhere, TakesNumbersAndSeveralColumnsAtOnce) {
  const auto prepared =
      Make(kBothWays, {.where = {{"direction", "down"}, {"day", 2.0}}});
  EXPECT_THAT(prepared.dataset.rows(), ElementsAre(2, 4));
  EXPECT_THAT(Make(kBothWays, {.where = {{"direction", "down"}, {"day", "2"}}})
                  .dataset.rows(),
              ElementsAre(2, 4));
}

TEST(MakeDatasetWhere, ColumnOfNumbersIsNoInput) {
  const std::string text = "side,x,error_mm\n1,1,0.1\n1,2,0.2\n2,3,0.4\n";
  EXPECT_THAT(InputNames(Make(text, {.where = {{"side", 1.0}}}).dataset),
              ElementsAre("x"));
}

TEST(MakeDatasetWhere, UnknownColumnAndAbsentValueAreNamed) {
  EXPECT_THAT(ErrorOf(kBothWays, {.where = {{"directon", "down"}}}),
              AllOf(HasSubstr("no column 'directon' (where)"),
                    HasSubstr("did you mean 'direction'?")));
  EXPECT_THAT(ErrorOf(kBothWays, {.where = {{"direction", "left"}}}),
              HasSubstr("f.csv: no row is left where 'direction' is 'left'; "
                        "the column has 'down', 'up'"));
  EXPECT_THAT(
      ErrorOf(kBothWays, {.where = {{"direction", "up"}, {"day", 7.0}}}),
      HasSubstr("no row is left where 'day' is '7' and the columns before it "
                "are as asked; the column has '1', '2'"));
}

TEST(MakeDatasetWhere, MissingCellsAreCountedAmongTheRowsAskedFor) {
  const auto prepared = Make(
      std::string(kBothWays) + "up,3,3,6,0.6\n",
      {.missing = MissingPolicy::kDropRows, .where = {{"direction", "up"}}});
  EXPECT_THAT(prepared.dataset.rows(), ElementsAre(3, 5));
  EXPECT_THAT(prepared.remarks, Contains(HasSubstr("1 of 3 rows is dropped")));
}

TEST(MakeDataset, RemarksOnErrorsThatNoMachineHas) {
  const auto remarks = [](const std::string& header, double scale) {
    return Make("a," + header + "\n1," + std::to_string(3.0 * scale) + "\n2," +
                std::to_string(4.0 * scale) + "\n")
        .remarks;
  };
  EXPECT_THAT(
      remarks("error_mm", 1.0),
      ElementsAre("error_mm is 3.54 mm RMS, more than machine tools err "
                  "by; if it is in another unit, write that into its "
                  "name: error_um, 'error [mm]'"));
  EXPECT_THAT(remarks("error_um", 1e-3),
              ElementsAre(HasSubstr("0.00354 um RMS, less than")));
  EXPECT_THAT(remarks("error_um", 1.0), IsEmpty());
  EXPECT_THAT(remarks("error_um", 100.0), IsEmpty());
  EXPECT_THAT(remarks("error_mm", 1e-3), IsEmpty());
  EXPECT_THAT(remarks("error_arcsec", 1e5), IsEmpty());
}

TEST(MakeDataset, SaysWhichUnitOfTheTargetIsOnlyAssumed) {
  EXPECT_THAT(Make("a,error_x\n1,0.02\n2,0.03\n").remarks,
              ElementsAre("error_x: no unit in its name, taken as mm"));
}

TEST(MakeDataset, RefusesUnknownUnitsInBracketsAndOnTheTarget) {
  EXPECT_THAT(ErrorOf("a,error [furlong]\n1,2\n2,3\n"),
              HasSubstr("f.csv: column 'error [furlong]': 'furlong' is no unit "
                        "known here; rename the column, with one of these in "
                        "brackets: nm, um, mm, cm, m, in,"));
  EXPECT_THAT(
      ErrorOf("a,error_m\n1,2\n2,3\n"),
      HasSubstr("'m' counts as a unit in brackets or parentheses only"));
  EXPECT_THAT(ErrorOf("a (left),error_mm\n1,2\n2,3\n"),
              HasSubstr("column 'a (left)': 'left' is no unit known here"));
  EXPECT_EQ(Make("a (left),b,error_mm\n1,1,2\n2,0,3\n", {.inputs = {"b"}})
                .dataset.num_inputs(),
            1);
}

TEST(MakeDataset, NamesInputsWhoseUnitIsNotRead) {
  EXPECT_THAT(Make("t1_K,T_in,error_um\n1,1,2\n2,0,3\n").remarks,
              ElementsAre("no unit is read from 't1_K': 'K' counts as a unit "
                          "in brackets or parentheses only"));
}

TEST(MakeDataset, LeavesOutColumnsWithoutAName) {
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

TEST(MakeDataset, RefusesNumbersThatStandThereAsText) {
  EXPECT_THAT(ErrorOf("position_mm,a,error_mm\n12.7 mm,1,2\n25 mm,4,3\n"),
              HasSubstr("f.csv: line 2 (data row 0), column 'position_mm': "
                        "'12.7 mm' is no plain number; write it without its "
                        "unit and without thousands separators"));
  EXPECT_THAT(ErrorOf("Position;a;error_mm\n1.234,5;1;2\n2.000,5;4;3\n"),
              HasSubstr("'1.234,5' is no plain number"));
  EXPECT_THAT(ErrorOf("x,a,error_mm\n\"1,234.5\",1,2\n\"2,000.5\",4,3\n"),
              HasSubstr("column 'x': '1,234.5' is no plain number"));
  EXPECT_THAT(ErrorOf("position,a,error_mm\nleft,1,2\nright,4,3\n"),
              HasSubstr("column 'position': 'left' is no number"));
  EXPECT_THAT(ErrorOf("position_mm,a,error_mm\n,1,2\n,4,3\n"),
              HasSubstr("column 'position_mm': empty cell"));
  EXPECT_EQ(Make("when,a,error_mm\n2024-01-01,1,2\n2024-01-02,4,3\n")
                .dataset.num_inputs(),
            1);
}

TEST(MakeDataset, DropsRowsOfFailedReadingsWhereAsked) {
  std::string text = "a,w,error_mm\n";
  for (int i = 0; i < 20; ++i) {
    text += std::to_string(i % 7) + "," + std::to_string(1 + i) + "," +
            (i == 4 ? "9999" : std::to_string(i)) + "\n";
  }
  const PreparedDataset kept = Make(text, {.weight = "w"});
  EXPECT_EQ(kept.dataset.num_rows(), 20);
  ASSERT_EQ(kept.faults.size(), 1U);
  EXPECT_THAT(kept.faults[0].rows, ElementsAre(4));
  const PreparedDataset dropped =
      Make(text, {.weight = "w", .faults = FaultPolicy::kDropRows});
  EXPECT_EQ(dropped.dataset.num_rows(), 19);
  EXPECT_EQ(dropped.dataset.rows()[4], 5);
  EXPECT_EQ(dropped.dataset.weights()[4] / dropped.dataset.weights()[0], 6.0);
  EXPECT_EQ(dropped.dataset.target_values()[4], 5.0);
  EXPECT_EQ(dropped.faults.size(), 1U);
}

}  // namespace
}  // namespace errmap::data
