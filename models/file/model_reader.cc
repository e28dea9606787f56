#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "data/files/atomic_file.h"
#include "data/formats/nesting.h"
#include "data/input_error.h"
#include "data/text.h"
#include "models/file/checksum.h"
#include "models/file/map_members_json.h"
#include "models/file/model_json.h"
#include "models/history/history.h"
#include "models/history/history_state.h"
#include "models/map_experience.h"
#include "models/model_file.h"

namespace errmap::models {

data::ColumnInfo ReadColumn(const ModelJsonNode& node) {
  data::ColumnInfo column{.name = node.At("name").Text(),
                          .unit = data::UnitOfSymbol(node.At("unit").Text())};
  // Maps of before have no roles: RoleOf goes by the name.
  if (const auto role = node.Find("role")) {
    column.role = ReadWord<data::Role>(*role);
  }
  return column;
}

namespace {

using Json = ModelJson;
using Node = ModelJsonNode;

TrainedInput ReadInput(const Node& node) {
  TrainedInput input;
  ReadMembers(node, &input);
  if (input.min > input.max) node.At("min").Refuse("is above max");
  if (input.sd < 0.0) node.At("sd").Refuse("must be at least 0");
  return input;
}

ModelKind ReadKind(const Node& node) {
  const std::string kind = node.Text();
  // All that have a name, but for those made elsewhere.
  for (int i = 0;; ++i) {
    const auto known = static_cast<ModelKind>(i);
    if (ToString(known).empty()) break;
    if (kind == ToString(known) && known != ModelKind::kFile) return known;
  }
  node.Refuse("unknown kind of model '" + kind + "'");
}

double ReadPositive(const Node& node) {
  const double value = node.Number();
  if (!(value > 0.0)) node.Refuse("must be above 0");
  return value;
}

// Reads changes in the order of the history's columns.
std::vector<RowChange> ReadRowChanges(
    const Node& node,
    const History& history,
    const std::vector<data::ColumnInfo>& columns) {
  std::vector<RowChange> changes;
  const std::vector<std::string> names = history.columns();
  for (const Node& element : node.Elements()) {
    const Node name = element.At("column");
    const auto found = std::ranges::find(names, name.Text());
    const auto at = static_cast<std::size_t>(found - names.begin());
    if (found == names.end() || columns[at].name != *found) {
      name.Refuse(
          "must be a column of the history, and the inputs must be in its "
          "order");
    }
    changes.push_back({*found,
                       ReadPositive(element.At("largest")),
                       ReadPositive(element.At("mean"))});
  }
  return changes;
}

// Reads the starts of sessions, which older files lack.
void ReadStartReadings(const Node& node, History* history) {
  const auto readings = node.Find("start_readings");
  if (!readings) return;
  const std::vector<std::string> names = history->columns();
  for (const Node& element : readings->Elements()) {
    ReadMembers(element, &history->start_readings.emplace_back());
    if (std::ranges::count(names, history->start_readings.back().column) == 0) {
      element.At("column").Refuse("must be a column of the history");
    }
  }
}

History ReadHistory(const Node& node, const std::vector<TrainedInput>& inputs) {
  History history;
  ReadMembers(node,
              &history,
              {"derived", "start_readings", "row_changes"},
              {"time",
               "gap",
               "latest_start",
               "longest_step",
               "start_limit",
               "start_clock",
               "start_clock_late"});
  if (history.time_unit != "s" && history.time_unit != "rows") {
    node.At("time_unit").Refuse("must be 's' or 'rows'");
  }
  for (const Node& element : node.At("derived").Elements()) {
    DerivedInput& input = history.derived.emplace_back();
    ReadMembers(element, &input, {"tau", "between"});
    if (RunsInTime(input.filter)) {
      input.tau = element.At("tau").Number();
      // The first maps held the later reading and do not say so.
      const auto between = element.Find("between");
      input.between = between ? ReadWord<Between>(*between) : Between::kHeld;
    }
  }
  std::vector<data::ColumnInfo> columns;
  for (const TrainedInput& input : inputs) columns.push_back(input.column);
  try {
    const HistoryState check(history, columns);
  } catch (const std::invalid_argument& error) {
    node.Refuse(error.what());
  }
  ReadStartReadings(node, &history);
  if (const auto changes = node.Find("row_changes")) {
    history.row_changes = ReadRowChanges(*changes, history, columns);
  }
  return history;
}

ClampLimits ReadClampLimits(const Node& node, Index num_inputs) {
  ClampLimits guards;
  ReadMembers(node, &guards);
  if (guards.input_min.size() != num_inputs ||
      guards.input_max.size() != num_inputs) {
    node.Refuse(
        fmt::format("needs {} numbers in input_min and input_max", num_inputs));
  }
  return guards;
}

void RequireSize(const Node& node, const VectorXd& values, Index size) {
  if (values.size() != size) {
    node.Refuse(fmt::format("needs {} numbers, has {}", size, values.size()));
  }
}

void RequirePositive(const Node& node, const VectorXd& values, Index size) {
  RequireSize(node, values, size);
  if (!(values.array() > 0.0).all()) node.Refuse("must be above 0");
}

void RequireSquare(const Node& node, const MatrixXd& matrix, Index size) {
  if (matrix.rows() == size && matrix.cols() == size) return;
  node.Refuse(fmt::format("needs {0} rows of {0} numbers", size));
}

// But for what rounding to the six digits of a file may take from its least
// eigenvalue, of as many columns.
bool IsPositiveDefinite(MatrixXd matrix) {
  constexpr double kHalfDigit = 5e-6;
  const auto size = static_cast<double>(matrix.rows());
  matrix.diagonal().array() += size * kHalfDigit * matrix.cwiseAbs().maxCoeff();
  return Eigen::LLT<MatrixXd>(matrix).info() == Eigen::Success;
}

std::vector<Index> ReadColumnsOf(const Node& node,
                                 const std::vector<TrainedInput>& inputs) {
  std::vector<Index> columns;
  for (const Node& name : node.Elements()) {
    const auto found = std::ranges::find(
        inputs, name.Text(), [](const TrainedInput& input) -> const auto& {
          return input.column.name;
        });
    if (found == inputs.end()) name.Refuse("is not an input of the map");
    columns.push_back(found - inputs.begin());
  }
  return columns;
}

Applicability ReadApplicability(const Node& node, const FittedModel& fitted) {
  Applicability trained;
  ReadMembers(node, &trained, {"columns"}, {"repeats", "standing", "changes"});
  // The first starts were of single rows and without changes.
  if (trained.sessions && trained.sessions->starts &&
      trained.sessions->starts->changes.size() == 0) {
    trained.sessions->starts.reset();
  }
  for (std::size_t i = 0; i < trained.derived.size(); ++i) {
    if (fitted.history == nullptr ||
        std::ranges::find(fitted.history->form_inputs,
                          trained.derived[i].column.name) ==
            fitted.history->form_inputs.end()) {
      node.At("derived").Elements()[i].Refuse("is not an input of the form");
    }
  }
  trained.columns = ReadColumnsOf(node.At("columns"), fitted.inputs);
  const auto size = std::ssize(trained.columns);
  if (const auto standing = node.Find("standing")) {
    const StandingStill& still = trained.standing;
    RequireSize(standing->At("others_move"), still.others_move, size);
    RequireSize(standing->At("resolution"), still.resolution, size);
    RequireSize(standing->At("quiet"), still.quiet, size);
    RequireSize(standing->At("jump"), still.jump, size);
    RequireSize(standing->At("pace"), still.pace, size);
  }
  if (trained.rows < 2) node.At("rows").Refuse("must be at least 2");
  RequireSize(node.At("mean"), trained.mean, size);
  RequirePositive(node.At("scale"), trained.scale, size);
  if (trained.repeats.size() > 0) {
    RequireSize(node.At("repeats"), trained.repeats, size);
  }
  if (trained.sessions) {
    RequirePositive(
        node.At("sessions").At("scatter"), trained.sessions->scatter, size);
    const Node& precision = node.At("sessions").At("precision");
    RequireSquare(precision, trained.sessions->precision, size);
    if (!(trained.sessions->precision.diagonal().minCoeff() > 0.0) ||
        !IsPositiveDefinite(trained.sessions->precision)) {
      precision.Refuse("must be positive definite");
    }
    if (const auto& starts = trained.sessions->starts) {
      const Node node_of_starts = node.At("sessions").At("starts");
      RequireSize(node_of_starts.At("mean"), starts->mean, size);
      RequireSquare(node_of_starts.At("covariance"), starts->covariance, size);
      RequireSquare(node_of_starts.At("changes"), starts->changes, size);
      if (starts->sessions < 2) {
        node_of_starts.At("sessions").Refuse("must be at least 2");
      }
    }
  }
  RequirePositive(node.At("rest"), trained.rest, size);
  RequirePositive(node.At("relation_limit"), trained.relation_limit, size);
  ReadPositive(node.At("distance_limit"));
  ReadPositive(node.At("leverage_limit"));
  if (trained.directions.rows() != size || trained.directions.cols() < 1) {
    node.At("directions").Refuse(fmt::format("needs {} rows", size));
  }
  if (trained.states.rows() < 1 ||
      trained.states.cols() != trained.directions.cols()) {
    node.At("states").Refuse(
        fmt::format("needs rows of {} numbers", trained.directions.cols()));
  }
  return trained;
}

HeldOutErrors ReadHeldOut(const Node& node) {
  HeldOutErrors errors;
  ReadMembers(node, &errors, {"units"}, {"temperature"});
  for (const Node& element : node.At("units").Elements()) {
    HeldOutErrors::Unit& unit = errors.units.emplace_back();
    ReadMembers(element, &unit, {"temperature"}, {"predicted"});
    const Index rows = unit.residuals.size();
    if (rows == 0) element.Refuse("has no residuals");
    RequireSize(element.At("elapsed"), unit.elapsed, rows);
    if (!std::ranges::is_sorted(unit.elapsed)) {
      element.At("elapsed").Refuse("must not fall");
    }
    RequireSize(element.At("position"),
                unit.position,
                errors.position.empty() ? 0 : rows);
    if (unit.predicted.size() > 0) {
      RequireSize(element.At("predicted"), unit.predicted, rows);
    }
    if (!errors.temperature.empty()) {
      ReadMembers(element.At("temperature"), &unit.temperature);
      RequireSize(element.At("temperature"), unit.temperature, rows);
    }
  }
  if (errors.units.size() < 2) node.At("units").Refuse("needs two units");
  return errors;
}

// Half-width for rows inside or outside the trained range; older files do not
// distinguish them.
double ReadHalfWidth(const Node& interval,
                     const char* place,
                     const std::string& key,
                     double otherwise) {
  const auto widths = interval.Find(place);
  const auto width = widths ? widths->Find(key) : std::nullopt;
  if (!width) return otherwise;
  if (!(width->Number() >= 0.0)) width->Refuse("must be at least 0");
  return width->Number();
}

PredictionInterval ReadInterval(const Node& node) {
  PredictionInterval interval{.holdout = node.At("holdout").Text(),
                              .unit = "",
                              .units = node.At("groups").Count(),
                              .levels = {}};
  if (const auto unit = node.Find("unit")) interval.unit = unit->Text();
  std::vector<std::string> at_least;
  if (const auto keys = node.Find("at_least")) {
    for (const Node& key : keys->Elements()) at_least.push_back(key.Text());
  }
  for (const double coverage : PredictionInterval::kCoverages) {
    PredictionInterval::Level& level = interval.levels.emplace_back();
    level.coverage = coverage;
    const std::string key = CoverageKey(level.coverage);
    if (const auto half_width = node.Find(key)) {
      level.half_width = half_width->Number();
      if (!(level.half_width >= 0.0)) half_width->Refuse("must be at least 0");
    }
    level.inside = ReadHalfWidth(node, "inside", key, level.half_width);
    level.outside = ReadHalfWidth(node, "outside", key, level.half_width);
    level.at_least = std::ranges::find(at_least, key) != at_least.end();
  }
  const auto whole = node.Find("whole");
  // Older files tell by the hold-out's name alone.
  interval.of_sessions = whole ? whole->Text() == kWholeSessions
                               : interval.holdout.starts_with("sessions");
  if (const auto good_for = node.Find("good_for")) {
    interval.good_for = good_for->Count();
    interval.lag1 = node.At("lag1").Number();
  }
  return interval;
}

// With two values of one key, a reader would take either.
Json ParseUniqueKeys(const std::string& text) {
  std::vector<std::set<std::string>> keys;  // of the objects around
  std::string repeated;
  const auto look = [&](int, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) {
      keys.emplace_back();
    } else if (event == Json::parse_event_t::object_end) {
      keys.pop_back();
    } else if (event == Json::parse_event_t::key &&
               !keys.back().insert(parsed.get<std::string>()).second) {
      repeated = parsed.get<std::string>();
    }
    return true;
  };
  Json document = Json::parse(text, look);
  if (repeated.empty()) return document;
  throw data::InputError("has the key " + data::QuotedName(repeated) +
                         " twice in one object");
}

LearntRows ReadLearntRows(const Node& node) {
  LearntRows learnt;
  ReadMembers(node, &learnt);
  for (const char* key : {"measured", "readings"}) {
    const auto filter = node.Find(key);
    if (!filter) continue;
    const std::string bits = filter->At("bits").Text();
    if (bits.empty() ||
        bits.find_first_not_of("0123456789abcdef") != std::string::npos) {
      filter->At("bits").Refuse("must be hexadecimal digits");
    }
  }
  if (learnt.every < 1) node.At("every").Refuse("must be at least 1");
  return learnt;
}

data::ColumnFilter ReadColumnFilter(const Node& node) {
  data::ColumnFilter filter{.column = node.At("column").Text(), .value = {}};
  if (const auto number = node.Find("number")) {
    filter.value = number->Number();
  } else {
    filter.value = node.At("text").Text();
  }
  return filter;
}

FittedModel ReadModel(const Node& root) {
  const std::string schema = root.At("schema").Text();
  if (schema != kModelSchema) {
    root.At("schema").Refuse(
        fmt::format("this version reads {}, found '{}'", kModelSchema, schema));
  }
  FittedModel fitted;
  fitted.name = root.At("name").Text();
  fitted.kind = ReadKind(root.At("kind"));
  const Node target = root.At("target");
  fitted.target = ReadColumn(target);
  if (const auto align = target.Find("align")) {
    if (align->Text() != ToString(data::Alignment::kFirst)) {
      align->Refuse("must be 'first' or null");
    }
    fitted.align = data::Alignment::kFirst;
  }
  if (const auto where = root.Find("where")) {
    for (const Node& element : where->Elements()) {
      fitted.where.push_back(ReadColumnFilter(element));
    }
  }
  for (const Node& element : root.At("inputs").Elements()) {
    fitted.inputs.push_back(ReadInput(element));
    const std::string& name = fitted.inputs.back().column.name;
    if (std::ranges::count(fitted.inputs, name, [](const TrainedInput& input) {
          return input.column.name;
        }) > 1) {
      element.At("name").Refuse("'" + name + "' stands there twice");
    }
  }
  std::size_t form_inputs = fitted.inputs.size();
  if (const auto history = root.Find("history")) {
    fitted.history =
        std::make_shared<History>(ReadHistory(*history, fitted.inputs));
    form_inputs = fitted.history->form_inputs.size();
  }
  const Node parameters = root.At("parameters");
  ReadForm(root, static_cast<Index>(form_inputs), &fitted);
  if (fitted.model->num_inputs() != static_cast<Index>(form_inputs)) {
    root.At(fitted.history != nullptr ? "history" : "inputs")
        .Refuse(fmt::format("names {} inputs, the model reads {}",
                            form_inputs,
                            fitted.model->num_inputs()));
  }
  if (const auto guards = root.Find("guards")) {
    fitted.guards = ReadClampLimits(*guards, fitted.model->num_inputs());
  }
  if (const auto interval = root.Find("interval")) {
    fitted.interval = ReadInterval(*interval);
  }
  if (const auto trained = root.Find("applicability")) {
    fitted.applicability =
        std::make_shared<Applicability>(ReadApplicability(*trained, fitted));
  }
  if (const auto held_out = root.Find("held_out")) {
    fitted.held_out = std::make_shared<HeldOutErrors>(ReadHeldOut(*held_out));
  }
  if (const auto learnt = root.Find("learnt")) {
    fitted.learnt = std::make_shared<LearntRows>(ReadLearntRows(*learnt));
  }
  if (const auto reading = root.Find("reading")) {
    auto read = std::make_shared<data::Reading>();
    ReadMembers(
        *reading, read.get(), {}, {"counter", "chosen", "rows_filtered"});
    fitted.reading = std::move(read);
  }
  if (fitted.model->num_parameters() != parameters.Count()) {
    parameters.Refuse(fmt::format("is {}, the model has {}",
                                  parameters.Count(),
                                  fitted.model->num_parameters()));
  }
  fitted.summary.message = "read from a file";
  return fitted;
}

// Said of a file that has none, which older versions wrote.
std::optional<std::string> CheckSum(const Node& root,
                                    const std::string& text,
                                    const std::string& source) {
  const auto sum = root.Find(kChecksumKey);
  if (!sum) {
    return fmt::format(
        "{} has no checksum: a changed number would go unnoticed", source);
  }
  if (HasChecksum(text, sum->Text())) return std::nullopt;
  throw data::InputError(
      fmt::format("{}: was changed after errmap wrote it; use another copy, or "
                  "remove its key '{}' if that was meant",
                  source,
                  kChecksumKey));
}

}  // namespace

FittedModel ModelFromJson(const std::string& text, const std::string& source) {
  Json document;
  try {
    data::RequireShallowJson(text);
    document = ParseUniqueKeys(text);
  } catch (const data::InputError& error) {
    throw data::InputError(fmt::format("{}: {}", source, error.what()));
  } catch (const Json::parse_error& error) {
    throw data::InputError(
        text.find('{') != text.find_first_not_of(" \t\r\n")
            ? source +
                  ": is not a map (JSON written by errmap); name the map "
                  "first, then its data"
            : fmt::format("{}: is not a complete map: its JSON is invalid at "
                          "byte {} of {}; use another copy, or run errmap fit "
                          "again",
                          source,
                          std::min(error.byte, text.size()),
                          text.size()));
  } catch (const Json::out_of_range&) {
    throw data::InputError(source + ": has a number that is too large");
  }
  const Node root(document, "", source);
  const std::optional<std::string> remark = CheckSum(root, text, source);
  FittedModel fitted = ReadModel(root);
  if (remark) fitted.remarks.push_back(*remark);
  return fitted;
}

FittedModel LoadModel(const std::string& path) {
  return ModelFromJson(data::ReadFile(path, data::kMostTextOfPrograms), path);
}

}  // namespace errmap::models
