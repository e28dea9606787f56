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

Rows WithCell(std::size_t row, std::size_t column, const std::string& text) {
  Rows rows = Measured();
  rows[row + 1][column] = text;
  return rows;
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
      {"UTF-8 with a mark", "\xEF\xBB\xBF" + Joined(rows)},
      {"lone CR", Joined(rows, ",", "\r")},
      {"separators at each end", padded(3, 3)},
      {"separators at the rows' ends", padded(0, 3)},
      {"one more at the header's end", padded(1, 0)},
      {"rows of separators below", Joined(rows) + ",,,,,,\n,,,,,,\n"},
      {"a title", "Machine 7\n" + Joined(rows)},
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
           {"CP1250",
            "Dzień,Cykl,Czas [s],Położenie [mm],T1 [°C],T2 [°C],Błąd [µm]"},
           {"CP1251",
            "День,Цикл,Время [s],Положение [мм],Темп. 1 [°C],Темп. 2 [°C],"
            "Погрешность [мкм]"},
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
      {"\x1F\x8B\x08\0"s, "is no gzip, or is cut off"},
      {"%PDF-1.4\n", "PDF"},
      {"<!doctype html><table></table>\n", "web page"},
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
      {Joined(WithCell(7, kT1, "warm")), "'warm' is no number"},
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

TEST(MessyFiles, AThermometerThatEndsStuckIsLeftOut) {
  const Rows rows = Changed(Measured(), [](std::size_t i, auto* cells) {
    if (i > 46) (*cells)[kT2] = "21.5";  // 62 % of the rows
  });
  const PreparedDataset prepared = Make(Joined(rows));
  EXPECT_THAT(DroppedNames(prepared), ElementsAre("t2_degC"));
  EXPECT_THAT(prepared.remarks,
              Contains("input t2_degC is dead (stuck at 21.5 from data row 46 "
                       "on) and is left out; keep_dead keeps it"));
  EXPECT_EQ(Make(Joined(rows), {.keep_dead = true}).dataset.num_inputs(), 3);
  // One that was asked for stays, and the fault is told.
  const PreparedDataset named =
      Make(Joined(rows), {.inputs = {"t1_degC", "t2_degC"}});
  EXPECT_EQ(named.dataset.num_inputs(), 2);
  ASSERT_EQ(named.faults.size(), 1U);
  EXPECT_EQ(named.faults[0].kind, FaultKind::kStuck);
}

TEST(MessyFiles, InputsThatHoldTheErrorAreLeftOut) {
  const auto with = [](const std::string& name, const auto& value) {
    return Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
      cells->insert(cells->end() - 1, i == 0 ? name : CsvNumber(value(*cells)));
    }));
  };
  const auto error = [](const auto& cells) { return Number(cells[kError]); };
  const auto rounded = [](double value, double decimals) {
    const double scale = std::pow(10.0, decimals);
    return std::round(value * scale) / scale;
  };
  const auto actual = [&](const auto& cells) {
    return rounded(Number(cells[kPosition]) + error(cells) / 1000.0, 6);
  };
  const auto coarse = [&](const auto& cells) {
    return rounded(actual(cells), 4);
  };
  const auto copy = [&](const auto& cells) { return -25.4 * error(cells); };
  const auto counts = [&](const auto& cells) {
    return 12345.0 +
           std::round(2000.0 * Number(cells[kPosition]) + 2.0 * error(cells));
  };
  const auto share = [&](const auto& cells) {
    const double at = Number(cells[kPosition]);
    return at == 0.0 ? 0.0 : rounded(1000.0 * error(cells) / at, 2);
  };
  for (const std::string& text : {with("actual_mm", actual),
                                  with("actual_mm", coarse),
                                  with("raw", copy),
                                  with("raw_counts", counts),
                                  with("err_ppm", share),
                                  with("dev_percent", copy)}) {
    const PreparedDataset prepared = Make(text);
    EXPECT_THAT(InputNames(prepared.dataset),
                ElementsAre("position_mm", "t1_degC", "t2_degC"));
    EXPECT_THAT(
        prepared.remarks,
        Contains(
            AnyOf(HasSubstr("holds the error itself (error_um = "),
                  HasSubstr("reads the position that position_mm commands"))));
  }
  const PreparedDataset asked =
      Make(with("actual_mm", actual), {.inputs = {"position_mm", "actual_mm"}});
  EXPECT_THAT(InputNames(asked.dataset), ElementsAre("position_mm"));
  EXPECT_THAT(asked.doubts, ElementsAre(HasSubstr("The input actual_mm")));
  EXPECT_THAT(ErrorOf(with("raw", copy), {.inputs = {"raw"}}),
              HasSubstr("no input is left: 'raw' holds the error itself"));
  // Two parts of it, of which none tells it alone.
  const auto part = [&](const auto& cells) {
    return rounded(std::sin(Number(cells[kCycle])), 3);
  };
  const std::string halves =
      Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
        const double a = i == 0 ? 0.0 : part(*cells);
        const double b = i == 0 ? 0.0 : rounded(error(*cells) - a, 3);
        cells->insert(
            cells->end() - 1,
            {i == 0 ? "a" : CsvNumber(a), i == 0 ? "b" : CsvNumber(b)});
      }));
  EXPECT_THAT(DroppedNames(Make(halves)), Contains("b"));
}

// A good map is no leak: thermometers that tell the error to their rounding.
TEST(MessyFiles, StatesThatTellTheErrorAreNoLeak) {
  const Rows rows = Changed(Measured(), [](std::size_t i, auto* cells) {
    if (i == 0) return;
    (*cells)[kError] =
        Fixed(1.5 * Number((*cells)[kT1]) + 0.02 * Number((*cells)[kPosition]));
  });
  EXPECT_THAT(Make(Joined(rows)).dropped, IsEmpty());
}

TEST(MessyFiles, RowsThatAreNoMeasurementsAreNamedAndLeftOutByAnOption) {
  const Rows rows = Measured();
  const auto changed = [&](const auto& change) {
    return Joined(Changed(rows, [&](std::size_t i, auto* cells) {
      if (i > 0) change(static_cast<int>(i) - 1, cells);
    }));
  };
  struct Case {
    std::string text;
    FaultKind kind;
    std::vector<Eigen::Index> rows;  // the first of them
    Eigen::Index left;
  };
  Rows twice;
  for (const auto& row : rows) {
    twice.push_back(row);
    if (row != rows.front()) twice.push_back(row);
  }
  const std::vector<Case> cases = {
      {Joined(twice), FaultKind::kRepeated, {1, 3, 5}, 120},
      {changed([](int i, auto* cells) {
         if (i == 38 || i == 39 || i == 118) (*cells)[kError] = "0";
       }),
       FaultKind::kZero,
       {38, 39, 118},
       117},
      {changed([](int i, auto* cells) {
         if (i >= 60) {
           (*cells)[kError] = CsvNumber(Number((*cells)[kError]) / 1000.0);
         }
       }),
       FaultKind::kOtherUnit,
       {60, 61, 62},
       60},
      {changed([](int i, auto* cells) {
         if (i % 3 == 0) (*cells)[kT1] = "-999";
       }),
       FaultKind::kImpossible,
       {0, 3, 6},
       80},
      {changed([](int i, auto* cells) {
         if (i % 4 == 0) (*cells)[kError] = "-999";
       }),
       FaultKind::kOutlying,
       {0, 4, 8},
       90},
      {changed([](int i, auto* cells) {
         if (i == 33 || i == 71 || i == 104) {
           (*cells)[kError] = CsvNumber(Number((*cells)[kError]) * 10.0);
         }
       }),
       FaultKind::kOutlying,
       {33, 71, 104},
       117},
  };
  for (const Case& one : cases) {
    const PreparedDataset kept = Make(one.text);
    ASSERT_EQ(kept.faults.size(), 1U) << ToString(one.kind);
    EXPECT_EQ(kept.faults[0].kind, one.kind);
    EXPECT_TRUE(kept.faults[0].of_cells);
    EXPECT_TRUE(
        std::ranges::equal(one.rows,
                           std::vector(kept.faults[0].rows.begin(),
                                       kept.faults[0].rows.begin() + 3)))
        << ToString(one.kind);
    EXPECT_EQ(
        Make(one.text, {.faults = FaultPolicy::kDropRows}).dataset.num_rows(),
        one.left)
        << ToString(one.kind);
  }
  // Codes for "no reading" change every figure: the answer says so.
  for (const std::size_t i : {3U, 4U}) {
    EXPECT_THAT(Make(cases[i].text).doubts,
                ElementsAre(HasSubstr("-999, which is no reading; ")));
  }
  // Two lost rows whose thermometer reads alike are no reference.
  const PreparedDataset alike = Make(changed([](int i, auto* cells) {
    if (i == 38 || i == 39 || i == 118) {
      (*cells)[kError] = "0";
      (*cells)[kT2] = "22.5";
    }
  }));
  const auto zero =
      std::ranges::find(alike.faults, FaultKind::kZero, &ColumnFault::kind);
  ASSERT_NE(zero, alike.faults.end());
  EXPECT_EQ(zero->rows, (std::vector<Eigen::Index>{38, 39, 118}));
  // A block in the middle, and days by turns, in millimetres.
  const auto in_mm = [&](const auto& where) {
    return changed([&](int i, auto* cells) {
      if (where(i)) {
        (*cells)[kError] = CsvNumber(Number((*cells)[kError]) / 1000.0);
      }
    });
  };
  const auto rows_in_mm = [](const PreparedDataset& made) {
    std::vector<Eigen::Index> found;
    for (const ColumnFault& fault : made.faults) {
      EXPECT_EQ(fault.kind, FaultKind::kOtherUnit);
      found.insert(found.end(), fault.rows.begin(), fault.rows.end());
    }
    std::ranges::sort(found);
    return found;
  };
  const std::function<bool(int)> blocks[] = {
      [](int i) { return i >= 50 && i < 62; },
      [](int i) { return i >= 40 && i < 80; },
      [](int i) { return i / 20 % 2 == 1; },
      [](int i) { return i >= 112; }};
  for (const auto& block : blocks) {
    std::vector<Eigen::Index> expected;
    for (int i = 0; i < 120; ++i) {
      if (block(i)) expected.push_back(i);
    }
    EXPECT_EQ(rows_in_mm(Make(in_mm(block))), expected);
  }
  // A machine that errs by nothing while it is cold is in one unit.
  EXPECT_THAT(Make(changed([](int i, auto* cells) {
                const bool is_cold = i % 40 < 6;
                if (is_cold) (*cells)[kT1] = Fixed(20.002 + 0.001 * (i % 3));
                (*cells)[kError] = CsvNumber(
                    1.5 * (Number((*cells)[kT1]) - 20.0) + 0.0001 * Noise(i));
              })).faults,
              ::testing::Each(::testing::Field(
                  &ColumnFault::kind, ::testing::Ne(FaultKind::kOtherUnit))));
  // To 0.1 um so many rows have few values; a third of them without a beam.
  Rows many = {rows.front()};
  for (int repeat = 0; repeat < 20; ++repeat) {
    for (std::size_t i = 1; i < rows.size(); ++i) {
      many.push_back(rows[i]);
      auto& cells = many.back();
      cells[kDay] = std::to_string(3 * repeat + std::stoi(cells[kDay]));
      cells[kCycle] = std::to_string(24 * repeat + std::stoi(cells[kCycle]));
      cells[kT1] = Fixed(Number(cells[kT1]) + 0.01 * Noise(repeat));
      const double error = Number(cells[kError]) + 0.015 * Noise(repeat);
      cells[kError] = CsvNumber(std::round(10.0 * error) / 10.0);
      if ((i + static_cast<std::size_t>(repeat)) % 3 == 0) cells[kError] = "0";
    }
  }
  const PreparedDataset lost = Make(Joined(many));
  ASSERT_EQ(lost.faults.size(), 1U);
  EXPECT_EQ(lost.faults[0].kind, FaultKind::kZero);
  EXPECT_EQ(lost.faults[0].rows.size(), 800U);
  // Zeros where each is one: the position that errors are measured from.
  const std::string reference = changed([](int, auto* cells) {
    if ((*cells)[kPosition] == "200") (*cells)[kError] = "0";
  });
  EXPECT_THAT(Make(reference).faults, IsEmpty());
  EXPECT_THAT(Make(Joined(rows)).faults, IsEmpty());
  EXPECT_THAT(Make(Joined(rows)).doubts, IsEmpty());
}

TEST(MessyFiles, RowsOfSeveralThingsAreAskedAbout) {
  const auto with = [](const std::string& name,
                       const std::string& one,
                       const std::string& other,
                       bool differ) {
    return Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
      const bool second = (i / kPositions) % 2 == 1;
      if (i > 0 && second && differ) {
        (*cells)[kError] = Fixed(5.0 - Number((*cells)[kError]));
      }
      cells->insert(cells->begin(), i == 0 ? name : second ? other : one);
    }));
  };
  const char* const kInputs[] = {"position_mm", "t1_degC", "t2_degC"};
  for (const char* name : {"machine", "direction", "tool", "axis"}) {
    const PreparedDataset same = Make(with(name, "A", "B", false));
    EXPECT_THAT(same.remarks,
                Contains(HasSubstr("may need a map each, by where")));
    EXPECT_THAT(same.doubts, IsEmpty());
    const PreparedDataset differ = Make(with(name, "A", "B", true));
    EXPECT_THAT(differ.doubts,
                ElementsAre(HasSubstr("Rows differ by " + std::string(name) +
                                      " (A, B): ")));
    EXPECT_THAT(InputNames(differ.dataset),
                ::testing::ElementsAreArray(kInputs));
  }
  const PreparedDataset numbers = Make(with("machine", "1", "2", true));
  EXPECT_THAT(InputNames(numbers.dataset),
              ::testing::ElementsAreArray(kInputs));
  EXPECT_THAT(numbers.doubts, ElementsAre(HasSubstr("machine (1, 2)")));
}

TEST(MessyFiles, CountersAreNoInputsAndCyclesAreGroups) {
  for (const std::string name : {"Zyklus",
                                 "Cycle No.",
                                 "Takt",
                                 "cycle_number",
                                 "Lauf",
                                 "run",
                                 "Messung",
                                 "Nr."}) {
    const PreparedDataset prepared =
        Make(Joined(Changed(Measured(), [&](std::size_t i, auto* cells) {
          if (i == 0) (*cells)[kCycle] = name;
        })));
    EXPECT_THAT(InputNames(prepared.dataset),
                ElementsAre("position_mm", "t1_degC", "t2_degC"))
        << name;
    EXPECT_EQ(prepared.dataset.groups().column, name);
    EXPECT_EQ(prepared.dataset.groups().labels.size(),
              static_cast<std::size_t>(kDays * kCycles))
        << name;
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
                HasSubstr("is no time; write it as 2024-03-01T12:00:05, or go "
                          "without a clock, by time = none"));
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
  const auto error_of = [](double factor, const std::string& unit) {
    return ErrorOf(
        Joined(Changed(Measured(), [&](std::size_t row, auto* cells) {
          std::string actual = "actual_mm";
          if (row == 0) {
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
}

TEST(MessyFiles, AnErrorWithoutAUnitIsAskedAbout) {
  for (const char* name : {"Abweichung", "EXX", "Deviation"}) {
    Rows rows = Measured();
    rows[0].back() = name;
    EXPECT_THAT(ErrorOf(Joined(rows)), HasSubstr("in which unit is")) << name;
  }
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

TEST(MessyFiles, WhatNeverFallsOrNumbersPlacesIsNoSensor) {
  const PreparedDataset prepared =
      Make(Joined(Changed(Measured(), [](std::size_t row, auto* cells) {
        const bool names = row == 0;
        cells->push_back(
            names ? "Op. hours"
                  : Fixed(8000.0 + 0.003 * static_cast<double>(row)));
        cells->push_back(
            names ? "StdOrder"
                  : std::to_string(std::stoi((*cells)[3]) / 100 + 1));
      })));
  EXPECT_THAT(prepared.reading.sensors, ElementsAre("t1_degC", "t2_degC"));
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
