#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/input_error.h"

namespace errmap::data {

/// Evidence for the role of a column.
enum class Evidence { kNone, kUser, kName, kValues, kNameAndValues };
/// "none", "user", "name", "values", "name+values".
std::string_view ToString(Evidence evidence);

/// Interpretation of a table: for every role the column or rule, the evidence,
/// whether it is certain, and the next best alternative. Plain data, stored
/// unchanged in results.json and map files. Columns are those of the table. A
/// role without a column was derived from others ("by").
struct Reading {
  struct Target {
    std::optional<std::string> column;
    int sign = 1;  // -1: a correction, whose error is its negative
    std::string unit;
    Evidence evidence = Evidence::kNone;
    bool sure = false;
    std::optional<std::string> alternative;
  };
  struct Position {
    std::optional<std::string> column;
    Evidence evidence = Evidence::kNone;
    bool sure = false;
    std::optional<std::string> alternative;
  };
  struct Direction {
    std::optional<std::string> column;
    std::string by;                        // "column", "position", ""
    std::vector<std::string> values = {};  // "up", "down" of the position
    std::vector<std::string> labels = {};  // the column's words for them
    std::string chosen = {};  // the only one of these in use; "": all
    Evidence evidence = Evidence::kNone;
    bool sure = false;
  };
  struct Time {
    std::optional<std::string> column;  // "Datum + Uhrzeit" of two
    std::string unit;                   // s, ms, min, h, days, date, rows, ...
    std::string origin;                 // "1970", "midnight", "begin", ""
    std::optional<double> step_s;
    Evidence evidence = Evidence::kNone;
    bool sure = false;
    std::optional<std::string> alternative;
  };
  struct Cycles {
    std::optional<std::string> column;
    std::string by;          // "column", "position", ""
    std::int64_t count = 0;  // in all sessions
    Evidence evidence = Evidence::kNone;
    bool sure = false;
  };
  struct Sessions {
    std::optional<std::string> column;
    std::string by;  // column, nights, dates, clock, rest, counter, file, one
    std::string counter;  // the column that restarts with each
    std::int64_t count = 0;
    std::vector<std::int64_t> first_rows;  // in the order of the rows
    std::optional<double> gap_s;
    Evidence evidence = Evidence::kNone;
    bool sure = false;
    std::optional<std::string> alternative;
  };
  struct LeftOut {
    std::string column;
    std::string why;
  };
  struct RowLeftOut {
    std::int64_t row = 0;
    std::string why;
  };
  struct Answer {
    std::string option;
    std::string means;
  };
  struct Question {
    std::string topic;
    std::string question;
    std::vector<Answer> answers = {};
  };

  std::string schema = "errmap-reading-1";
  std::int64_t rows = 0;           // in use
  std::int64_t rows_filtered = 0;  // left out by filters, the way among them
  std::vector<std::string> files;
  Target target;
  Position position;
  Direction direction;
  Time time;
  std::string order = "file";  // or "time", "none": sorted by something else
  Cycles cycles;
  Sessions sessions;
  std::vector<std::string> positions;  // of other axes, inputs as well
  std::vector<std::string> sensors;
  std::vector<std::string> switches;
  std::vector<std::string> counters;
  std::vector<LeftOut> left_out;
  std::vector<RowLeftOut> rows_left_out;
  std::vector<std::string> remarks;
  std::vector<Question> questions;
};

/// Thrown if no choice is cautious (a sign, a unit): the run ends with the
/// question.
class OpenQuestion : public InputError {
 public:
  OpenQuestion(const std::string& file, Reading::Question question);
  const Reading::Question& question() const { return question_; }

 private:
  Reading::Question question_;
};

/// "Read: 1020 rows in 6 days (by nights in DateTime) of 10 cycles; axis
/// x_pos_mm, upward; 5 thermometers; every 5 s.", and a line for each uncertain
/// point, with the option that settles it.
std::vector<std::string> ReadingLines(const Reading& reading);

}  // namespace errmap::data
