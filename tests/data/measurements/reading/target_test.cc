// The error and its sign, or the question for it, by MakeDataset.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "data/measurements/reading/read_table.h"
#include "data/measurements/reading/reading.h"
#include "tests/data/measurements/reading/warming_log.h"

namespace errmap::data {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using warming_log::Fixed;
using warming_log::Log;
using warming_log::Read;
using warming_log::Text;
using warming_log::TimePositionTempError;

TEST(Reading, AsksForTheSignOfACorrection) {
  const std::string text = Text("time_s,position_mm,t1_degC,correction_um",
                                Log().Rows(),
                                TimePositionTempError);
  try {
    Read(text);
    FAIL() << "no question";
  } catch (const OpenQuestion& open) {
    EXPECT_EQ(open.question().topic, "target");
    EXPECT_EQ(open.question().answers.size(), 2U);
    EXPECT_THAT(open.what(),
                AllOf(HasSubstr("-correction_um"), HasSubstr("target")));
  }
  const CsvTable table = ParseCsv(text, "log.csv");
  const PreparedDataset error = MakeDataset(table, {.target = "correction_um"});
  const PreparedDataset against =
      MakeDataset(table, {.target = "-correction_um"});
  EXPECT_EQ(against.dataset.target_values(),
            Eigen::VectorXd(-error.dataset.target_values()));
  EXPECT_EQ(against.reading.target.sign, -1);
  EXPECT_EQ(against.dataset.target().unit.symbol, "um");
}

// Of notes above or below the table.
TEST(Reading, AsksForTheSignThatANoteTells) {
  const std::string rows = Text("time_s,position_mm,t1_degC,error_um",
                                Log().Rows(),
                                TimePositionTempError);
  for (const char* note : {"sign convention: nominal minus actual",
                           "error = target - reading",
                           "positive error: the axis stops short",
                           "Vorzeichen: Soll minus Ist"}) {
    EXPECT_THROW(Read("# " + std::string(note) + "\n" + rows), OpenQuestion)
        << note;
  }
  EXPECT_THROW(Read(rows + "\nNote: Deviation = nominal - actual\n"),
               OpenQuestion);
  EXPECT_NO_THROW(Read("# error = measured - target\n" + rows));
}

TEST(Reading, AsksForTheDifferenceOfWhatWasReadAndCommanded) {
  for (const std::string unit : {"", " [mm]"}) {
    const std::string text = Text("T1," + ("Target" + unit) + ",Actual" + unit,
                                  Log().Rows(),
                                  [](const Log::Row& row) {
                                    return std::vector<std::string>{
                                        Fixed(row.warm),
                                        Fixed(row.position),
                                        Fixed(row.position + row.error / 1e3)};
                                  });
    try {
      Read(text);
      FAIL() << "no question";
    } catch (const OpenQuestion& open) {
      const std::string option = open.question().answers.front().option;
      EXPECT_THAT(option, HasSubstr("Actual"));
      const std::string target =
          "Actual" + unit + "-Target" + (unit.empty() ? " [mm]" : unit);
      EXPECT_THAT(option, HasSubstr(target));
      EXPECT_EQ(Read(text, {.target = target}).target.unit, "mm");
    }
  }
}

TEST(Reading, OffersEachInstrumentThatReadWhatWasCommanded) {
  const std::string text = Text(
      "T1,cmd_mm,encoder_mm,laser_mm", Log().Rows(), [](const Log::Row& row) {
        return std::vector<std::string>{Fixed(row.warm),
                                        Fixed(row.position),
                                        Fixed(row.position + 1e-4 * row.warm),
                                        Fixed(row.position + row.error / 1e3)};
      });
  try {
    Read(text);
    FAIL() << "no question";
  } catch (const OpenQuestion& open) {
    std::vector<std::string> options;
    for (const auto& answer : open.question().answers) {
      options.push_back(answer.option);
    }
    EXPECT_THAT(options,
                ElementsAre(HasSubstr("encoder_mm-cmd_mm"),
                            HasSubstr("laser_mm-cmd_mm")));
  }
}

TEST(Reading, SaysThatATargetIsAPosition) {
  const std::string text =
      Text("T1,Y-Soll,Y-Ist", Log().Rows(), [](const Log::Row& row) {
        return std::vector<std::string>{Fixed(row.warm),
                                        Fixed(row.position),
                                        Fixed(row.position + row.error / 1e3)};
      });
  EXPECT_THROW(Read(text), OpenQuestion);
  const Reading reading = Read(text, {.target = "Y-Ist"});
  EXPECT_FALSE(reading.target.sure);
  EXPECT_THAT(ReadingLines(reading)[1], HasSubstr("Y-Ist-Y-Soll"));
  EXPECT_TRUE(Read(text, {.target = "Y-Ist-Y-Soll [mm]"}).target.sure);
}

TEST(Reading, TakesWhatIsCalledAnErrorInAnyUnitIfNothingElseIs) {
  const auto target_of = [](const std::string& names) {
    return Read(Text("position_mm," + names,
                     Log().Rows(),
                     [](const Log::Row& row) {
                       return std::vector<std::string>{Fixed(row.position),
                                                       Fixed(row.warm),
                                                       Fixed(row.error)};
                     }))
        .target.column;
  };
  EXPECT_EQ(target_of("T1 [degC],Abweichung [mg]"), "Abweichung [mg]");
  EXPECT_EQ(target_of("Ambient (K),Error (K)"), "Error (K)");
  EXPECT_EQ(target_of("Torque error [Nm],XDEV [um]"), "XDEV [um]");
  EXPECT_THROW(target_of("T1 [degC],Fehler Temperatur [degC]"), InputError);
}

TEST(Reading, TakesUnitsOfANoteForEachThingThatItNames) {
  const std::string rows =
      Text("t,X,EXX,T1", Log().Rows(), [](const Log::Row& row) {
        return std::vector<std::string>{Fixed(row.time / 60.0),
                                        Fixed(row.position),
                                        Fixed(row.error),
                                        Fixed(row.warm)};
      });
  const auto read = [&](const std::string& note) {
    return Read("# " + note + "\n" + rows, {.target = "EXX"});
  };
  const Reading named = read("t in min, errors in um, temperatures in degC");
  EXPECT_EQ(named.target.unit, "um");
  EXPECT_EQ(named.time.unit, "min");
  EXPECT_TRUE(named.time.sure);
  const Reading listed = read("units: min, mm, um, degC");
  EXPECT_EQ(listed.position.column, "X [mm]");
  EXPECT_EQ(listed.target.column, "EXX [um]");
  EXPECT_EQ(listed.time.unit, "min");
}

}  // namespace
}  // namespace errmap::data
