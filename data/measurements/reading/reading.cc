#include "data/measurements/reading/reading.h"

#include <algorithm>
#include <array>
#include <utility>

#include "data/argument_name.h"
#include "data/measurements/column_checks.h"
#include "data/text.h"
#include "data/way_words.h"

namespace errmap::data {
namespace {

std::string SessionsText(const Reading& reading) {
  const Reading::Sessions& sessions = reading.sessions;
  std::string text = CountText(sessions.count, "session");
  if (sessions.by == "nights" || sessions.by == "clock") {
    text += " (by nights in " + NameInRemark(reading.time.column.value_or("")) +
            ")";
  } else if (sessions.by == "counter") {
    text += " (" + NameInRemark(sessions.counter) + " restarts)";
  } else if (sessions.by == "rest") {
    text += " (by temperatures back at rest)";
  } else if (sessions.by == "file") {
    text += sessions.count == std::ssize(reading.files)
                ? " (one a file)"
                : " (by the names of the files)";
  } else if (sessions.column) {
    text += " (by " + NameInRemark(*sessions.column) + ")";
  }
  return text;
}

// Without a clock no gap does.
std::string WhatPartsThem(const Reading& reading) {
  const bool has_gap = reading.time.column && !reading.sessions.column;
  if (reading.sessions.by == "rest") {
    return ArgumentName("session", "none") + " takes it. If a column has " +
           "the days, name it by " + ArgumentName("session") + ".";
  }
  return ArgumentName(has_gap ? "gap" : "session") + " parts them.";
}

std::string CyclesText(const Reading& reading) {
  if (reading.cycles.count == 0) return "";
  const std::int64_t sessions =
      std::max<std::int64_t>(reading.sessions.count, 1);
  const bool even = reading.cycles.count % sessions == 0;
  return " of " +
         CountText(
             even ? reading.cycles.count / sessions : reading.cycles.count,
             "cycle") +
         (even || sessions == 1 ? "" : " in all");
}

std::string AxisText(const Reading& reading) {
  if (!reading.position.column) return "no axis";
  std::string text = "axis " + NameInRemark(*reading.position.column);
  const Reading::Direction& direction = reading.direction;
  if (!direction.chosen.empty()) return text + ", " + direction.chosen + "ward";
  if (direction.values.size() == 2) return text + ", both ways";
  if (direction.values.size() == 1) text += ", " + direction.values[0] + "ward";
  return text;
}

std::string StepText(const Reading& reading) {
  if (reading.order == "none") return "rows sorted, no order of time";
  if (!reading.time.column) return "no clock";
  if (!reading.time.step_s) return "";
  const double step = *reading.time.step_s;
  if (step >= 3600.0) return "every " + Rounded(step / 3600.0) + " h";
  if (step >= 60.0) return "every " + Rounded(step / 60.0) + " min";
  return "every " + Rounded(step) + " s";
}

}  // namespace

std::string_view ToString(Evidence evidence) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"none", "user", "name", "values", "name+values"});
  return NameOf(kNames, evidence);
}

OpenQuestion::OpenQuestion(const std::string& file, Reading::Question question)
    : InputError([&] {
        std::string text = file + ": " + question.question;
        // What asks nothing has named its answers.
        const bool asks = question.question.ends_with('?');
        for (const Reading::Answer& answer : question.answers) {
          if (asks) text += " " + answer.option + ": " + answer.means + ".";
        }
        return text;
      }()),
      question_(std::move(question)) {}

std::vector<std::string> ReadingLines(const Reading& reading) {
  std::string first = "Read: " + CountText(reading.rows, "row") + " in " +
                      SessionsText(reading) + CyclesText(reading) + "; " +
                      AxisText(reading) + "; " +
                      (reading.sensors.empty()
                           ? "no sensors"
                           : CountText(std::ssize(reading.sensors), "sensor"));
  if (const std::string step = StepText(reading); !step.empty()) {
    first += "; " + step;
  }
  std::vector<std::string> lines = {first + "."};
  if (reading.order == "time") {
    lines.push_back("The rows were not in order of time. They were " +
                    (reading.time.column
                         ? "sorted by " + NameInRemark(*reading.time.column)
                         : "turned upside down") +
                    ".");
  } else if (reading.order == "none") {
    lines.push_back(
        "The rows are not in the order of measurement and have no clock, so no "
        "map gets a memory. "
        "Give the rows as measured, or a column of times.");
  }
  if (reading.target.alternative) {
    lines.push_back("Unsure: " + NameInRemark(*reading.target.column) +
                    " is a position rather than an error; " +
                    ArgumentName("target", *reading.target.alternative) +
                    " maps the error.");
  }
  if (reading.position.column && !reading.position.sure) {
    lines.push_back("Unsure: " + NameInRemark(*reading.position.column) +
                    " is the axis" +
                    (reading.position.alternative
                         ? ", or " + NameInRemark(*reading.position.alternative)
                         : "") +
                    "; " + ArgumentName("position") + " names it.");
  }
  const std::vector<std::string>& labels = reading.direction.labels;
  if (!reading.direction.sure && labels.size() == 2 &&
      FirstIsUp(labels[0], labels[1])) {
    lines.push_back("Unsure: the rows that " +
                    NameInRemark(reading.direction.column.value_or("")) +
                    " calls " + NameInRemark(labels[0]) + " go to lower " +
                    NameInRemark(reading.position.column.value_or("")) +
                    ", those called " + NameInRemark(labels[1]) +
                    " to higher. The words are kept; swap them if up should "
                    "mean higher positions.");
  }
  if (!reading.sessions.sure) {
    lines.push_back("Unsure: " + SessionsText(reading) + "; or " +
                    reading.sessions.alternative.value_or("") + ": " +
                    WhatPartsThem(reading));
  }
  if (reading.time.column && !reading.time.sure) {
    const bool is_date = reading.time.unit == "date";
    lines.push_back(
        "Unsure: " + NameInRemark(*reading.time.column) +
        (is_date ? " is the time" : " is in " + reading.time.unit) +
        (reading.time.alternative ? (is_date ? ", or " : ", or in ") +
                                        NameInRemark(*reading.time.alternative)
                                  : "") +
        "; " + ArgumentName(is_date ? "time" : "time_unit") + " says it.");
  }
  return lines;
}

}  // namespace errmap::data
