#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/commands/maps/map_warnings.h"
#include "cli/output/claimed_folder.h"
#include "cli/report/number_text.h"
#include "cli/report/text/answers/interval_text.h"
#include "cli/report/text/commands/calibration_check_text.h"
#include "cli/report/text/commands/check_text.h"
#include "cli/shell/command_options.h"
#include "cli/shell/standard_streams.h"
#include "data/columns.h"
#include "data/csv.h"
#include "data/files/atomic_file.h"
#include "data/formula_text.h"
#include "data/input_error.h"
#include "data/measurements/column_match.h"
#include "data/measurements/column_roles.h"
#include "data/measurements/dataset.h"
#include "data/measurements/joined_tables.h"
#include "data/measurements/measured_files.h"
#include "data/text.h"
#include "models/history/map_log.h"
#include "models/history/rows_made_for.h"
#include "models/history/view.h"
#include "models/sensors/sensor_check.h"
#include "models/session/probe_correction.h"
#include "models/uncertainty/learnt_rows.h"
#include "stats/not_a_number.h"

namespace errmap::cli {
namespace {

struct PredictArguments {
  std::string model;
  std::vector<std::string> files;
  std::string out;
  std::string probes;
  models::MapDataArguments log;
  bool quiet = false;
};

// Rows of a table with all readings, and what is read in all of them.
struct WholeRows {
  MatrixXd readings;             // (rows of the table x inputs) NaN: missing
  std::vector<Index> rows = {};  // without missing ones

  MatrixXd inputs() const { return readings(rows, Eigen::all); }
};

WholeRows FindWholeRows(const models::FittedModel& fitted,
                        const data::CsvTable& table) {
  WholeRows whole{.readings =
                      MatrixXd::Constant(static_cast<Index>(table.num_rows),
                                         std::ssize(fitted.inputs),
                                         stats::kNaN)};
  Index column = 0;
  for (const models::TrainedInput& input : fitted.inputs) {
    std::vector<Index> rows;
    const VectorXd values = data::NumericColumn(
        table, input.column.name, data::MissingPolicy::kDropRows, &rows);
    whole.readings.col(column++)(rows) = values;
  }
  for (Index row = 0; row < whole.readings.rows(); ++row) {
    if (whole.readings.row(row).allFinite()) whole.rows.push_back(row);
  }
  return whole;
}

// In a data set whose target is not known, and so 0.
data::Dataset RowsToPredict(const models::FittedModel& fitted,
                            const data::CsvTable& table,
                            const WholeRows& whole,
                            const models::MapLog& map) {
  data::Dataset::Parts parts;
  parts.source = table.file;
  for (const models::TrainedInput& input : fitted.inputs) {
    parts.inputs.push_back(input.column);
  }
  parts.target = fitted.target;
  parts.input_values = whole.inputs();
  parts.target_values = VectorXd::Zero(parts.input_values.rows());
  parts.log = map.log;
  if (map.log != nullptr) {
    for (const Index row : whole.rows) {
      parts.log_rows.push_back(map.first_row + row);
    }
  }
  return data::Dataset(std::move(parts));
}

models::ProbeCorrection Correct(const models::FittedModel& fitted,
                                const models::RowsForMap& today,
                                const PredictArguments& arguments) {
  if (fitted.held_out == nullptr) {
    throw data::InputError(
        "the map has no held-out errors to weight probes by; fit it "
        "with compare, or with fit and without --no-interval");
  }
  data::TableForMap read =
      models::ReadForMap(fitted,
                         {arguments.probes},
                         models::MapColumns::kInputsAndTarget,
                         arguments.log);
  // Where a file is a session, probes are of that of the rows.
  if (const std::ptrdiff_t file = today.table.Find(data::kFileColumn);
      file >= 0 && arguments.files.size() == 1) {
    data::AddFileColumn(today.table.CellText(today.table.At(file), 0),
                        &read.table);
  }
  const models::MapRows probes =
      RowsForMap(fitted,
                 std::move(read),
                 models::ProbeRowsOptions(fitted, arguments.log),
                 arguments.quiet);
  return models::CorrectByProbes(fitted, probes, today, arguments.log);
}

// Of the interval of one row; NaN without one.
double HalfWidth(const models::FittedModel& fitted,
                 std::size_t level,
                 bool inside,
                 const std::optional<models::ProbeCorrection>& probes,
                 Index row) {
  if (!fitted.interval) return std::numeric_limits<double>::quiet_NaN();
  const models::PredictionInterval::Level& promised =
      fitted.interval->levels[level];
  return (inside ? promised.inside : promised.outside) *
         (probes ? probes->track.widening[row] : 1.0);
}

// What is known of the rows of a file.
struct Predicted {
  const models::FittedModel& fitted;
  const data::CsvTable& table;
  const std::vector<Index>& order;  // as data::TableForMap has it
  const models::MapLog& map;
  // Of each row of the table; NaN where a reading is missing.
  VectorXd errors;
  std::vector<bool> is_whole;  // false there
  std::optional<models::ProbeCorrection> probes = {};
  std::vector<models::RowFlag> flags;  // the column that is missing
  std::vector<bool> made_for;          // as models::RowsMadeFor
  std::vector<bool> clipped;           // as models::Prediction

  Index NumWhole() const { return std::ranges::count(is_whole, true); }
  models::Missing MissingBefore(std::size_t row) const {
    return map.log == nullptr
               ? models::Missing::kNothing
               : map.missing[static_cast<std::size_t>(map.first_row) + row];
  }
};

// Why a row is unlike those of training; "" where it is not.
std::string_view WhyOutside(const Predicted& found, std::size_t row) {
  if (!found.is_whole[row]) return "missing";
  if (!found.made_for[row]) return "where";
  const models::RowFlag& flag = found.flags[row];
  if (flag.outside()) return models::ToString(flag.why);
  if (!std::isfinite(found.errors[static_cast<Index>(row)])) {
    return "not finite";
  }
  switch (found.MissingBefore(row)) {
    case models::Missing::kNothing:
      return "";
    case models::Missing::kStart:
      return "start";
    case models::Missing::kReadings:
      return "gap";
  }
  return "";
}

// ",LOWER,UPPER" at each coverage; empty cells without an interval, and where
// the map is clipped: no held-out row tells how it errs there.
std::string IntervalCells(const Predicted& found, bool inside, Index row) {
  const double predicted = found.errors[row];
  std::string cells;
  for (std::size_t i = 0; i < models::PredictionInterval::kCoverages.size();
       ++i) {
    const double half_width =
        HalfWidth(found.fitted, i, inside, found.probes, row);
    cells += std::isfinite(predicted) && std::isfinite(half_width) &&
                     !found.clipped[static_cast<std::size_t>(row)]
                 ? fmt::format(",{},{}",
                               data::CsvNumber(predicted - half_width),
                               data::CsvNumber(predicted + half_width))
                 : ",,";
  }
  return cells;
}

// The column of times: as it is named, as the map was fitted by, or the only
// one that is called so.
std::ptrdiff_t TimeColumn(const Predicted& found, const std::string& named) {
  if (!named.empty()) return found.table.Find(named);
  const models::History* const history = found.fitted.history.get();
  const std::ptrdiff_t of_map =
      history == nullptr ? -1 : found.table.Find(history->time);
  return of_map < 0 ? data::TimeColumn(found.table) : of_map;
}

// The columns that tell a row apart, where the file has them: its number,
// session and cycle, when and where it is.
std::vector<const data::CsvColumn*> IdColumns(const Predicted& found,
                                              const std::string& time) {
  const models::History* const history = found.fitted.history.get();
  std::vector<std::ptrdiff_t> places = {
      found.table.Find("record"),
      history == nullptr ? -1 : found.table.Find(history->session),
      data::CycleColumn(found.table),
      TimeColumn(found, time)};
  for (const models::TrainedInput& input : found.fitted.inputs) {
    if (!data::IsPosition(input.column)) continue;
    places.push_back(found.table.Find(input.column.name));
    break;
  }
  std::vector<const data::CsvColumn*> ids;
  for (const std::ptrdiff_t place : places) {
    if (place >= 0) ids.push_back(&found.table.At(place));
  }
  return ids;
}

// The rows as the file has them.
std::vector<Index> RowsOfFile(const Predicted& found) {
  std::vector<Index> rows = data::AllRows(found.table.num_rows);
  for (std::size_t row = 0; row < found.order.size(); ++row) {
    rows[static_cast<std::size_t>(found.order[row])] = static_cast<Index>(row);
  }
  return rows;
}

std::string PredictionsCsv(const Predicted& found, const std::string& time) {
  const std::vector<const data::CsvColumn*> ids = IdColumns(found, time);
  std::string text;
  for (const data::CsvColumn* id : ids) text += data::CsvField(id->name) + ",";
  text +=
      "predicted,lower_90,upper_90,lower_95,upper_95,inside,why,offender,"
      "unit\n";
  const std::string unit = data::CsvField(found.fitted.target.unit.symbol);
  for (const Index row : RowsOfFile(found)) {
    const auto at = static_cast<std::size_t>(row);
    for (const data::CsvColumn* id : ids) {
      text += data::CsvField(found.table.CellText(*id, at)) + ",";
    }
    const double predicted = found.errors[row];
    const std::string_view why = WhyOutside(found, at);
    text += std::isfinite(predicted) ? data::CsvNumber(predicted) : "";
    text += IntervalCells(found, why.empty(), row);
    text += fmt::format(",{},{},{},{}\n",
                        why.empty() ? 1 : 0,
                        why,
                        data::CsvField(found.flags[at].column.name),
                        unit);
  }
  return data::MarkedCsv(std::move(text));
}

void SayWhatIsPredicted(const Predicted& found) {
  const models::FittedModel& fitted = found.fitted;
  const std::string& unit = fitted.target.unit.symbol;
  const bool aligned = fitted.align == data::Alignment::kFirst;
  Warn(fmt::format("{} predicted as {}{}{}; the compensation is minus that",
                   report::Count(found.NumWhole(), "row"),
                   fitted.target.name,
                   unit.empty() ? "" : " in " + unit,
                   aligned ? " since the session's first row" : ""));
  if (fitted.interval) {
    Warn(report::IntervalLine(
        models::MakeRecord(*fitted.interval),
        report::ErrorText(fitted.target.unit,
                          fitted.interval->levels[0].half_width)));
    const std::string halves =
        report::HalfWidthsLine(*fitted.interval, fitted.target.unit);
    if (!halves.empty()) Warn(halves);
  }
  if (found.probes) Warn(report::OffsetLine(*found.probes, fitted.target.unit));
  SayUnless(false, found.map.warnings);
}

// A spike is named by its row, which is outside.
void SaySensorFault(const models::FittedModel& fitted, const MatrixXd& inputs) {
  const auto fault = models::FindSensorFault(fitted, inputs);
  if (!fault || fault->fault == models::SensorFault::kSpike) return;
  std::string text = report::SensorText(*fault);
  text.pop_back();  // the end of the line
  Warn("warning: " + text);
}

void SayClipped(const Predicted& found) {
  const Index clipped = std::ranges::count(found.clipped, true);
  if (clipped == 0) return;
  Warn(
      fmt::format("warning: {} clipped by the map's guards, since an input "
                  "or the error went far beyond its trained range{}",
                  report::Count(clipped, "row"),
                  found.fitted.interval ? "; no interval there" : ""));
}

// Rows that lack a reading are told by the column of the first.
void SayMissing(const Predicted& found) {
  const Index missing = std::ssize(found.is_whole) - found.NumWhole();
  if (missing == 0) return;
  const auto first = static_cast<std::size_t>(
      std::ranges::find(found.is_whole, false) - found.is_whole.begin());
  Warn(
      fmt::format("warning: {} of {} lack{} a reading, the first {} in data "
                  "row {}: nothing is predicted there",
                  missing,
                  report::Count(std::ssize(found.is_whole), "row"),
                  missing == 1 ? "s" : "",
                  data::QuotedName(found.flags[first].column.name),
                  first));
}

Predicted PredictRows(const models::FittedModel& fitted,
                      const data::TableForMap& read,
                      const WholeRows& whole,
                      const models::MapLog& map,
                      const PredictArguments& arguments) {
  const data::Dataset rows = RowsToPredict(fitted, read.table, whole, map);
  const MatrixXd form_inputs = fitted.FormInputs(rows);
  const models::Prediction prediction = fitted.PredictForm(form_inputs);
  const std::vector<models::RowFlag> flags =
      models::FlagRows(fitted, whole.inputs(), form_inputs);
  const auto num_rows = read.table.num_rows;
  Predicted found{
      .fitted = fitted,
      .table = read.table,
      .order = read.order,
      .map = map,
      .errors = VectorXd::Constant(static_cast<Index>(num_rows), stats::kNaN),
      .is_whole = std::vector<bool>(num_rows),
      .flags = std::vector<models::RowFlag>(num_rows),
      .made_for = models::RowsMadeFor(fitted, read.table),
      .clipped = std::vector<bool>(num_rows)};
  for (std::size_t i = 0; i < whole.rows.size(); ++i) {
    const auto row = static_cast<std::size_t>(whole.rows[i]);
    found.errors[whole.rows[i]] = prediction.errors[static_cast<Index>(i)];
    found.is_whole[row] = true;
    found.flags[row] = flags[i];
    found.clipped[row] = prediction.clipped[static_cast<Index>(i)];
  }
  for (std::size_t row = 0; row < num_rows; ++row) {
    if (found.is_whole[row]) continue;
    const auto readings = whole.readings.row(static_cast<Index>(row));
    Index input = 0;
    while (std::isfinite(readings[input])) ++input;
    found.flags[row].column =
        fitted.inputs[static_cast<std::size_t>(input)].column;
  }
  if (!arguments.probes.empty()) {
    found.probes = Correct(fitted, {read.table, whole.readings}, arguments);
    found.errors += found.probes->track.offset;
  }
  return found;
}

void SayAll(const Predicted& found, const WholeRows& whole) {
  const MatrixXd inputs = whole.inputs();
  SaySensorFault(found.fitted, inputs);
  SayWhatIsPredicted(found);
  SayMissing(found);
  SayOutside(found.fitted.inputs,
             inputs,
             found.flags,
             data::AllRows(found.table.num_rows),
             false);
  SayClipped(found);
  if (const Index learnt =
          models::CountLearntRows(found.fitted, inputs, nullptr);
      learnt > 0) {
    Warn(
        fmt::format("the map was trained on the readings of {} of {}: its "
                    "error on new ones is larger",
                    learnt,
                    report::Count(inputs.rows(), "row")));
  }
  if (const std::string made_for =
          models::MadeForText(found.fitted, found.table);
      !made_for.empty()) {
    Warn("warning: " + made_for);
  }
}

int RunPredict(const PredictArguments& arguments) {
  CheckOutputName("-o", arguments.out, [&] {
    std::vector<std::string> read = arguments.files;
    read.insert(read.end(),
                {arguments.model,
                 arguments.log.after,
                 arguments.log.with,
                 arguments.probes});
    return read;
  }());
  const models::FittedModel fitted = LoadMap(arguments.model, arguments.quiet);
  const data::TableForMap read = models::ReadForMap(
      fitted, arguments.files, models::MapColumns::kInputs, arguments.log);
  const WholeRows whole = FindWholeRows(fitted, read.table);
  const models::MapLog map =
      models::MakeMapLog(fitted, read.table, arguments.log);
  SayRead(read, arguments.quiet);
  const Predicted found = PredictRows(fitted, read, whole, map, arguments);
  const std::string text = PredictionsCsv(found, arguments.log.time);
  if (arguments.out.empty()) {
    PrintResult(text);
  } else {
    data::WriteFileAtomically(arguments.out, text);
  }
  if (!arguments.quiet) SayAll(found, whole);
  return SayNotFinite(found.errors(whole.rows),
                      whole.rows,
                      data::NamesOfFiles(arguments.files))
             ? kEveryFitFailed
             : kDone;
}

}  // namespace

void AddPredictCommand(CLI::App* app, Run* run) {
  const Command<PredictArguments> command(
      app, run, "predict", "Predict the error of every row with a fitted map");
  AddModelArgument(command, &command->model);
  AddOption(command, "DATA FILE.csv", command->files)
      .About("CSV file with its inputs, or several: days of one component")
      .Required();
  AddOption(command, "-o,--output FILE.csv", command->out)
      .About("File to write (default: stdout)")
      .Under(kOutputOptions);
  AddOption(command, "--probes PROBES.csv", command->probes)
      .About(
          "Readings of the same session: the map is shifted by the offset "
          "found before each row. The interval narrows, or widens if they "
          "contradict one offset");
  AddMapDataArguments(command, &command->log);
  AddTargetOfMap(command, &command->log);
  AddJoinedLogArguments(command, &command->log);
  AddFromRest(command, &command->log);
  AddQuietFlag(command, &command->quiet);
  SetFooter(
      command,
      R"(Columns: record; session, cycle, time and position if the data have them;
predicted, lower_90 to upper_95, inside, why, offender and unit. Without an
interval, and where the map is clipped, the bounds are empty. inside is 1 for
rows like those in training, else 0, and why says what differs.
- range: a column (offender) leaves its trained range
- relation: it contradicts the other columns
- distance, leverage: the thermal state is far from all trained ones
- start, gap: the memory of the map lacks earlier rows
- where: the map is not made for such rows
- missing: a reading (offender) is missing, and nothing is predicted
Exit status: 0 done; 4 if a prediction is not finite: its cell stays empty.
Example: errmap predict map.json data/sets/turning_centre/later_days.csv -o predicted.csv)");
  command.Runs(RunPredict);
}

}  // namespace errmap::cli
