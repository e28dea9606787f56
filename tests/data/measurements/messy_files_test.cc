// Files as people have them: what is unambiguous is read as if it were clean,
// all else is one line that says what to do. The same measurements stand in
// each, so that each must give the same numbers.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iconv.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/tables/text/gzip.h"
#include "tests/data/measurements/as_measured.h"
#include "tests/data/measurements/make_dataset_test_data.h"
#include "tests/data/packed_parts.h"

namespace errmap::data {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace as_measured;

std::string WithCommas(std::string text) {
  std::ranges::replace(text, '.', ',');
  return text;
}

std::string InUtf16(const std::string& text, bool little, bool mark) {
  std::string wide = !mark ? "" : little ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) {
    wide += little ? c : '\0';
    wide += little ? '\0' : c;
  }
  return wide;
}

std::string Encoded(std::string text, const char* encoding) {
  const iconv_t converter = iconv_open(encoding, "UTF-8");
  std::string encoded(text.size(), '\0');
  char* in = text.data();
  char* out = encoded.data();
  std::size_t left = text.size();
  std::size_t room = encoded.size();
  EXPECT_NE(iconv(converter, &in, &left, &out, &room),
            static_cast<std::size_t>(-1));
  iconv_close(converter);
  encoded.resize(encoded.size() - room);
  return encoded;
}

TEST(MessyFiles, WhatIsUnambiguousIsSimplyRead) {
  const Rows rows = Measured();
  const Dataset clean = Make(Joined(rows)).dataset;
  const auto padded = [&](std::size_t header, std::size_t row) {
    return Joined(Changed(rows, [&](std::size_t i, auto* cells) {
      cells->resize(cells->size() + (i == 0 ? header : row));
    }));
  };
  Rows units = rows;
  units[0] = {"day", "cycle", "time", "position", "t1", "t2", "error"};
  Rows bracketed = units;
  units.insert(units.begin() + 1, {"", "-", "s", "mm", "degC", "degC", "um"});
  bracketed.insert(bracketed.begin() + 1,
                   {"[-]", "[-]", "[s]", "[mm]", "[°C]", "(°C)", "[µm]"});
  Rows stated = rows;
  stated.insert(stated.begin() + 1, units[1]);
  const std::vector<std::pair<const char*, std::string>> files = {
      {"units below the names", Joined(units)},
      {"units in brackets", Joined(bracketed)},
      {"units twice", Joined(stated)},
      {"sep=;", "sep=;\n" + Joined(rows, ";")},
      {"sep=, and CRLF", "sep=,\r\n" + Joined(rows, ",", "\r\n")},
      {"quoted sep=|", "\"sep=|\"\n" + Joined(rows, "|")},
      {"bars", Joined(rows, "|")},
      {"bars between blanks", Joined(rows, " | ")},
      {"blanks", Joined(rows, " ")},
      {"many blanks", Joined(rows, "    ")},
      {"decimal commas", WithCommas(Joined(rows, ";"))},
      {"decimal commas, tabs", WithCommas(Joined(rows, "\t"))},
      {"UTF-16", InUtf16(Joined(rows), true, true)},
      {"UTF-16, other order", InUtf16(Joined(rows), false, true)},
      {"UTF-16 without a mark", InUtf16(Joined(rows), true, false)},
      {"packed by gzip", Gzip(Joined(rows))},
      {"packed by gzip in two parts and a block of zeros",
       Gzip(Joined(rows).substr(0, 99)) + Gzip(Joined(rows).substr(99)) +
           std::string(512, '\0')},
      {"UTF-8 with a mark", "\xEF\xBB\xBF" + Joined(rows)},
      {"lone CR", Joined(rows, ",", "\r")},
      {"separators at each end", padded(3, 3)},
      {"separators at the rows' ends", padded(0, 3)},
      {"one more at the header's end", padded(1, 0)},
      {"rows of separators below", Joined(rows) + ",,,,,,\n,,,,,,\n"},
      {"a title", "Machine 7\n" + Joined(rows)},
      {"a title as bzip2's files begin", "BZH machine\n" + Joined(rows)},
      {"names in a comment", "# " + Joined(rows)},
  };
  for (const auto& [what, text] : files) {
    SCOPED_TRACE(what);
    const PreparedDataset prepared = Make(text);
    EXPECT_EQ(prepared.dataset.target_values(), clean.target_values());
    EXPECT_EQ(prepared.dataset.input_values(), clean.input_values());
    EXPECT_EQ(prepared.dataset.target().unit.symbol, "um");
    EXPECT_EQ(prepared.dataset.inputs()[1].unit.symbol, "degC");
    EXPECT_EQ(prepared.dataset.num_sessions(), kDays);
    EXPECT_THAT(prepared.dropped, IsEmpty());
  }
}

// As R writes a table: words in quotes, and a number before each row that the
// line of names has no name for.
TEST(MessyFiles, RowsMayBeNumberedWithoutAName) {
  const Dataset clean = Make(Joined(Measured())).dataset;
  for (const char* separator : {" ", ",", "\t"}) {
    const std::string text =
        Joined(Changed(Measured(),
                       [](std::size_t row, auto* cells) {
                         for (std::string& cell : *cells) {
                           if (row == 0) cell = '"' + cell + '"';
                         }
                         if (row == 0) return;
                         cells->insert(cells->begin(),
                                       '"' + std::to_string(row) + '"');
                       }),
               separator);
    const PreparedDataset prepared = Make(text);
    EXPECT_EQ(prepared.dataset.target_values(), clean.target_values());
    EXPECT_EQ(prepared.dataset.input_values(), clean.input_values());
  }
}

TEST(MessyFiles, ARowMayHoldOneReading) {
  const Rows rows = Measured();
  const Dataset clean = Make(Joined(rows)).dataset;
  Rows each = {{"day", "cycle", "time_s", "position_mm", "name", "value"}};
  Rows units = {
      {"day", "cycle", "time_s", "position_mm", "name", "unit", "value"}};
  for (std::size_t row = 1; row < rows.size(); ++row) {
    for (std::size_t i = 4; i < rows[row].size(); ++i) {
      each.emplace_back(rows[row].begin(), rows[row].begin() + 4);
      units.push_back(each.back());
      each.back().insert(each.back().end(), {rows[0][i], rows[row][i]});
      const std::size_t at = rows[0][i].find('_');
      units.back().insert(
          units.back().end(),
          {rows[0][i].substr(0, at), rows[0][i].substr(at + 1), rows[row][i]});
    }
  }
  for (const Rows& readings : {each, units}) {
    const PreparedDataset prepared = Make(Joined(readings));
    EXPECT_EQ(prepared.dataset.target_values(), clean.target_values());
    EXPECT_EQ(prepared.dataset.input_values(), clean.input_values());
    EXPECT_EQ(prepared.dataset.target().unit.symbol, "um");
  }
}

TEST(MessyFiles, PositionsMayBeWordsOfAProgram) {
  const Dataset clean = Make(Joined(Measured())).dataset;
  for (const char* word : {"X", "G1 X", "N10 G01 X", "X="}) {
    const PreparedDataset prepared =
        Make(Joined(Changed(Measured(), [&](std::size_t row, auto* cells) {
          std::string& cell = (*cells)[3];
          cell = row == 0 ? "position_mm" : word + cell + ".0";
        })));
    EXPECT_EQ(prepared.dataset.input_values(), clean.input_values()) << word;
  }
}

// By the words that the first lines then have.
TEST(MessyFiles, TextMayBeInAnEncodingOfThePlace) {
  const Dataset clean = Make(Joined(Measured())).dataset;
  const std::string german =
      "Tag,Zyklus,Zeit [s],Position [mm],T1 [°C],T2 [°C],Abweichung [µm]";
  for (const auto& [encoding, names] :
       std::vector<std::pair<const char*, std::string>>{
           {"LATIN1", german},
           {"CP850", german},
           {"MACINTOSH", german},
           {"MACINTOSH",
            "Jour,Cycle,Durée [s],Position [mm],T1 [°C],T2 [°C],Écart [µm]"},
           {"CP1250",
            "Dzień,Cykl,Czas [s],Położenie [mm],T1 [°C],T2 [°C],Błąd [µm]"},
           {"CP1251",
            "День,Цикл,Время [s],Положение [мм],Темп. 1 [°C],Темп. 2 [°C],"
            "Погрешность [мкм]"},
           {"CP1254",
            "gün,Çevrim,Zaman [s],Konum [mm],T1 sıcaklığı [°C],T2 sıcaklığı "
            "[°C],Hata [µm]"},
           {"CP932",
            "day,サイクル,時間 [s],位置[mm],温度1[℃],温度2[℃],誤差[μm]"},
           {"GB18030", "day,循环,时间 [s],位置[mm],温度1[℃],温度2[℃],误差[μm]"},
           {"CP949",
            "day,사이클,시간 [s],위치[mm],온도1[℃],온도2[℃],오차[㎛]"}}) {
    SCOPED_TRACE(encoding);
    Rows rows = Measured();
    rows[0] = {names};
    const PreparedDataset prepared = Make(Encoded(Joined(rows), encoding));
    EXPECT_EQ(prepared.dataset.target_values(), clean.target_values());
    EXPECT_EQ(prepared.dataset.input_values(), clean.input_values());
    EXPECT_EQ(prepared.dataset.target().unit.symbol, "um");
    EXPECT_EQ(prepared.dataset.target().name,
              names.substr(names.rfind(',') + 1));
  }
}

TEST(MessyFiles, WordsForMissingCellsAreMissingCells) {
  for (const char* word :
       {"",        "NA",   "NaN",   "n/a",     "#N/A",    "#NV",     "NULL",
        "null",    "-",    "--",    "?",       "None",    "missing", "(null)",
        "1.#QNAN", "-nan", ".",     "#DIV/0!", "#VALUE!", "OPEN",    "OL",
        "OVER",    "ERR",  "Fault", "NC",      "---"}) {
    SCOPED_TRACE(word);
    const std::string text = Joined(WithCell(7, kT1, word));
    EXPECT_THAT(ErrorOf(text),
                HasSubstr("line 9 (data row 7), column 't1_degC'"));
    EXPECT_THAT(ErrorOf(text), HasSubstr("missing = drop-rows"));
    EXPECT_EQ(
        Make(text, {.missing = MissingPolicy::kDropRows}).dataset.num_rows(),
        kDays * kCycles * kPositions - 1);
  }
}

TEST(MessyFiles, RowsOfTotalsTellNoSessionsAndNoTimes) {
  for (const std::string row :
       {"3 Average,,,200,24,21,9.5\n", "Gesamtergebnis,,,200,24,21,9.5\n"}) {
    const PreparedDataset prepared =
        Make(Joined(Measured()) + row, {.missing = MissingPolicy::kDropRows});
    EXPECT_EQ(prepared.reading.sessions.count, kDays);
    EXPECT_EQ(prepared.dataset.num_rows(), kDays * kCycles * kPositions);
  }
}

TEST(MessyFiles, AllElseIsOneLineThatSaysWhatToDo) {
  const Rows rows = Measured();
  const std::string text = Joined(rows);
  using namespace std::string_literals;
  const std::vector<std::pair<std::string, const char*>> files = {
      {"PK\x03\x04 rest of a sheet", "archive that is damaged"},
      {errmap::testing::ZipOf({{"mimetype", "ods"}}), "other than xlsx; save"},
      {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"s,
       "(xls, or with a password); save it as xlsx or CSV"},
      {"\x1F\x8B\x08\0"s, "is not gzip, or is cut off"},
      {Gzip(text) + Gzip(text).substr(0, 99), "is not gzip, or is cut off"},
      {"BZh91AY&SY\x1D"s, "compressed (bzip2)"},
      {"%PDF-1.4\n", "PDF"},
      {"<!doctype html><table></table>\n", "web page"},
      {"<table border=1><tr><td>1</td></tr></table>\n", "web page"},
      {"{\n \"schema\": \"errmap-model-1\"}\n", "this is JSON"},
      {"[{\"x\": 1}, {\"x\": 2}]\n", "this is JSON"},
      {"INSERT INTO t VALUES (1, 2);\n", "this is SQL"},
      {text + "4,5,6\n", "line 122 (data row 120): 3 fields"},
      {text + "End of file,,,,,,\n", "'End of file' where the other rows"},
      {text + "Mean,,,200,24,21,9.5\n", "a row of totals or a remark"},
      {text + "3 Average,,,,24,21,9.5\n", "column 'day': '3 Average'"},
      {text + "3,Mean,4380,200,24,21,9.5\n", "column 'cycle': 'Mean'"},
      {text + text.substr(text.find('\n') + 1), "120 rows repeat others"},
      {text + text, "120 rows repeat others"},
      {Joined(WithCell(7, kT1, "warm")), "'warm' is not a number"},
      {Joined(WithCell(7, kT1, "1,5")), "8 fields where the header has 7"},
  };
  for (const auto& [messy, line] : files) {
    const std::string error = ErrorOf(messy);
    EXPECT_THAT(error, HasSubstr(line));
    EXPECT_EQ(error.find('\n'), std::string::npos);
  }
  Rows other = rows;
  other.insert(other.begin() + 1, {"", "", "s", "mm", "degC", "degC", "mm"});
  EXPECT_THAT(ErrorOf(Joined(other)),
              HasSubstr("line 2: the unit 'mm' of column 'error_um'"));
}

TEST(MessyFiles, DatesWithHalvesOfTheDayHaveTheMonthFirst) {
  const auto at = [](const char* form) {
    return Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
      if (i == 0) {
        (*cells)[kTime] = "time";
        return;
      }
      const int seconds = std::stoi((*cells)[kTime]);
      const int minutes = 11 * 60 + seconds / 60;
      std::string text(64, '\0');
      text.resize(static_cast<std::size_t>(
          std::snprintf(text.data(),
                        text.size(),
                        form,
                        (*cells)[kDay].c_str(),
                        (minutes / 60 - 1) % 12 + 1,
                        minutes % 60,
                        seconds % 60,
                        minutes < 12 * 60 ? 'A' : 'P')));
      (*cells)[kTime] = text;
    }));
  };
  for (const char* form :
       {"3/%s/2024 %d:%02d:%02d %cM", "3/%s/2024 %d:%02d:%02d %c.M."}) {
    const PreparedDataset prepared = Make(at(form));
    const Eigen::VectorXd& time = prepared.dataset.log()->time;
    EXPECT_EQ(prepared.time_column, "time");
    EXPECT_EQ(time[kPositions] - time[0], 600.0);
    EXPECT_EQ(time[kCycles * kPositions] - time[0], 86400.0);
  }
}

TEST(MessyFiles, ATargetOfTwoUnitsIsAskedFor) {
  const auto named = [](const std::string& name) {
    Rows rows = Measured();
    rows[0][kError] = name;
    return Joined(rows);
  };
  EXPECT_EQ(Make(named("error_um_mean")).dataset.target().unit.symbol, "um");
  EXPECT_THAT(
      ErrorOf(named("error_10um")),
      HasSubstr("'10um' can be read in several ways; rename the column, "
                "its unit in brackets at the end: 'error [um]'"));
}

TEST(MessyFiles, StopAtATimeThatCannotBeRead) {
  const auto with_times = [](const std::string& begin) {
    return Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
      (*cells)[kTime] = i == 0 ? "time" : begin + std::to_string(100 + i);
    }));
  };
  for (const char* begin : {"2024-W10-1 08.", "4/2024 8h", "W10 2024:"}) {
    EXPECT_THAT(ErrorOf(with_times(begin)),
                HasSubstr("is not a time; write it as 2024-03-01T12:00:05, or "
                          "use no clock, with time = none"));
    EXPECT_NO_THROW(Make(with_times(begin), {.time = "none"}));
  }
  EXPECT_NO_THROW(Make(with_times("shift ")));
}

TEST(MessyFiles, DifferencesOfTheOtherSignAreAskedAbout) {
  const auto error_of = [](const std::string& name) {
    return ErrorOf(
        Joined(Changed(Measured(), [&](std::size_t row, auto* cells) {
          if (row == 0) cells->back() = name;
        })));
  };
  for (const char* name : {"Error (Soll-Ist) [um]",
                           "Err. N-A [um]",
                           "Error T-M [um]",
                           "Errore (teorico - reale) [um]",
                           "Error: encoder - laser [um]",
                           "Error*(-1) [um]",
                           "Position error sign reversed [um]"}) {
    EXPECT_THAT(error_of(name), HasSubstr("or the correction")) << name;
  }
  for (const char* name : {"Error (actual - nominal) [um]",
                           "Ist-Soll Fehler [um]",
                           "X-error [um]",
                           "Run-in error [um]",
                           "Error X-Y [um]",
                           "Error - X axis [um]"}) {
    EXPECT_EQ(error_of(name), "no error") << name;
  }
}

TEST(MessyFiles, TheErrorIsHeldAgainstWhatItIsTheDifferenceOf) {
  std::string actual_name = "actual_mm";
  const auto error_of = [&](double factor, const std::string& unit) {
    return ErrorOf(
        Joined(Changed(Measured(), [&](std::size_t row, auto* cells) {
          std::string actual = actual_name;
          if (row == 0) {
            if (actual == "actual") (*cells)[kPosition] = "commanded";
            cells->back() = "error_" + unit;
          } else {
            const double error = std::stod(cells->back());
            actual = Fixed(std::stod((*cells)[3]) + 1e-3 * error);
            cells->back() = Fixed(factor * error);
          }
          cells->push_back(actual);
        })));
  };
  EXPECT_EQ(error_of(1.0, "um"), "no error");
  EXPECT_THAT(error_of(-1.0, "um"), HasSubstr("is the opposite of"));
  EXPECT_THAT(error_of(1.0, "mm"), HasSubstr("is 1000 times"));
  EXPECT_EQ(error_of(0.94, "um"), "no error");  // of another reference
  // Without a unit positions are in mm.
  actual_name = "actual";
  EXPECT_EQ(error_of(1.0, "um"), "no error");
  EXPECT_THAT(error_of(-1.0, "um"),
              AllOf(HasSubstr("is the opposite of"),
                    HasSubstr("actual-commanded [mm]")));
}

TEST(MessyFiles, AnErrorWithoutAUnitIsAskedAbout) {
  for (const char* name : {"Abweichung", "EXX", "Deviation"}) {
    Rows rows = Measured();
    rows[0].back() = name;
    EXPECT_THAT(ErrorOf(Joined(rows)), HasSubstr("in which unit is")) << name;
  }
}

TEST(MessyFiles, AnErrorWithASignForSecondsOfArcIsOfferedInThem) {
  Rows rows = Measured();
  rows[0].back() = "Pitch error \"";
  EXPECT_THAT(ErrorOf(Joined(rows)), HasSubstr("[arcsec]: in arcsec"));
}

TEST(MessyFiles, NumbersMayBeWrittenAsByFortranOrATypesetter) {
  const Dataset clean = Make(Joined(Measured())).dataset;
  const auto values = [](const char* unit, const char* minus, const char* e) {
    return Make(Joined(Changed(Measured(),
                               [&](std::size_t row, auto* cells) {
                                 if (row == 0) return;
                                 std::string& cell = cells->back();
                                 if (cell.starts_with('-')) {
                                   cell = minus + cell.substr(1);
                                 }
                                 cell += std::string(e) + unit;
                               })))
        .dataset.target_values();
  };
  EXPECT_EQ(values("", "-", "D+00"), clean.target_values());
  EXPECT_EQ(values(" um", "\u2212", ""), clean.target_values());
}

TEST(MessyFiles, AnErrorHasAUnitAndACodeHasNone) {
  Rows rows = Measured();
  rows[0].back() = "Deviation (um)";
  for (std::size_t row = 0; row < rows.size(); ++row) {
    rows[row].push_back(row == 0 ? "Error code" : row % 40 == 0 ? "12" : "0");
  }
  EXPECT_EQ(Make(Joined(rows)).dataset.target().name, "Deviation (um)");
  rows[0].back() = "Raw error (um)";
  EXPECT_THAT(ErrorOf(Joined(rows)), HasSubstr("several columns"));
}

}  // namespace
}  // namespace errmap::data
