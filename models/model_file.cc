#include "models/model_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/atomic_file.h"
#include "data/formats/nesting.h"
#include "data/text.h"
#include "models/blend/form_to_model.h"
#include "models/history/history.h"
#include "models/history/history_state.h"
#include "models/map_experience.h"
#include "models/version.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "errmap-model-1";

Json ToJson(const Eigen::VectorXd& vector) {
  return std::vector<double>(vector.begin(), vector.end());
}

Json ToJson(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Index i = 0; i < matrix.rows(); ++i) {
    rows.push_back(ToJson(Eigen::VectorXd(matrix.row(i).transpose())));
  }
  return rows;
}

Json ToJson(const PolynomialForm& form, const std::string& equation) {
  Json terms = Json::array();
  for (const PolynomialTerm& term : form.terms) {
    terms.push_back(
        {{"powers", term.powers}, {"coefficient", term.coefficient}});
  }
  return {{"input_offset", ToJson(form.input_offset)},
          {"input_scale", ToJson(form.input_scale)},
          {"intercept", form.intercept},
          {"terms", std::move(terms)},
          {"equation", equation}};
}

Json ToJson(const NetForm& form) {
  return {{"nodes", {form.w1.cols() - 1, form.w1.rows(), form.w2.rows()}},
          {"output", ToString(form.output)},
          {"input_offset", ToJson(form.input_offset)},
          {"input_scale", ToJson(form.input_scale)},
          {"target_slope", ToJson(form.target_slope)},
          {"target_offset", ToJson(form.target_offset)},
          {"w1", ToJson(form.w1)},
          {"w2", ToJson(form.w2)}};
}

Json ToJson(const History& history) {
  Json derived = Json::array();
  for (const DerivedInput& input : history.derived) {
    Json entry = {{"name", input.column.name},
                  {"unit", input.column.unit.symbol},
                  {"of", input.of},
                  {"filter", ToString(input.filter)}};
    if (input.filter == Filter::kEma) entry["tau"] = input.tau;
    derived.push_back(std::move(entry));
  }
  return {{"time_unit", history.time_unit},
          {"session", history.session},
          {"latest_start",
           std::isfinite(history.latest_start) ? Json(history.latest_start)
                                               : Json()},
          {"derived", std::move(derived)},
          {"form_inputs", history.form_inputs}};
}

// "90", "95".
std::string LevelKey(double coverage) {
  constexpr double kPercent = 100.0;
  return std::to_string(std::lround(coverage * kPercent));
}

Json ToJson(const Guards& guards) {
  return {{"input_margin", guards.input_margin},
          {"error_margin", guards.error_margin},
          {"input_min", ToJson(guards.input_min)},
          {"input_max", ToJson(guards.input_max)},
          {"error_min", guards.error_min},
          {"error_max", guards.error_max}};
}

Json ToJson(const PredictionInterval& interval) {
  Json json = {{"holdout", interval.holdout},
               {"unit", interval.unit},
               {"groups", interval.units}};
  Json at_least = Json::array();
  for (const PredictionInterval::Level& level : interval.levels) {
    const std::string key = LevelKey(level.coverage);
    json[key] = std::isfinite(level.half_width) ? Json(level.half_width)
                                                : Json(nullptr);
    if (level.at_least) at_least.push_back(key);
  }
  json["at_least"] = std::move(at_least);
  return json;
}

// What no prediction depends on is written with so many digits.
constexpr int kDigits = 6;

double Rounded(double value) {
  return std::strtod(fmt::format("{:.{}g}", value, kDigits).c_str(), nullptr);
}

Eigen::VectorXd Rounded(const Eigen::VectorXd& values) {
  return values.unaryExpr([](double value) { return Rounded(value); });
}

Eigen::MatrixXd Rounded(const Eigen::MatrixXd& values) {
  return values.unaryExpr([](double value) { return Rounded(value); });
}

Json ToJson(const Applicability& trained,
            const std::vector<TrainedInput>& inputs) {
  Json derived = Json::array();
  for (const Applicability::Derived& input : trained.derived) {
    derived.push_back({{"name", input.column.name},
                       {"unit", input.column.unit.symbol},
                       {"min", input.min},
                       {"max", input.max}});
  }
  Json columns = Json::array();
  for (const Index column : trained.columns) {
    columns.push_back(inputs[static_cast<std::size_t>(column)].column.name);
  }
  return {{"derived", std::move(derived)},
          {"columns", std::move(columns)},
          {"rows", trained.rows},
          {"mean", ToJson(Rounded(trained.mean))},
          {"scale", ToJson(Rounded(trained.scale))},
          {"directions", ToJson(Rounded(trained.directions))},
          {"rest", ToJson(Rounded(trained.rest))},
          {"states", ToJson(Rounded(trained.states))},
          {"distance_limit", Rounded(trained.distance_limit)},
          {"leverage_limit", Rounded(trained.leverage_limit)},
          {"relation_limit", ToJson(Rounded(trained.relation_limit))}};
}

Json ToJson(const HeldOutErrors& errors) {
  Json units = Json::array();
  for (const HeldOutErrors::Unit& unit : errors.units) {
    units.push_back({{"label", unit.label},
                     {"rmse", Rounded(unit.rmse)},
                     {"elapsed", ToJson(Rounded(unit.elapsed))},
                     {"position", ToJson(Rounded(unit.position))},
                     {"residuals", ToJson(Rounded(unit.residuals))}});
  }
  return {{"time_unit", errors.time_unit},
          {"position", errors.position},
          {"rmse", Rounded(errors.rmse)},
          {"units", std::move(units)}};
}

// Bounds may be infinite, which JSON has no word for: null.
Json BoundToJson(double bound) {
  return std::isfinite(bound) ? Json(bound) : Json(nullptr);
}

Json ToJson(const BlendForm& form) {
  Json members = Json::array();
  for (const BlendForm::Member& member : form.members) {
    Json json = {{"name", member.name},
                 {"weight", member.weight},
                 {"inputs", member.inputs},
                 {"lowest", BoundToJson(member.lowest)},
                 {"highest", BoundToJson(member.highest)},
                 {"parameters", member.parameters}};
    if (const auto* polynomial = std::get_if<PolynomialForm>(&member.form)) {
      json["polynomial"] = ToJson(*polynomial, "");
    } else {
      json["net"] = ToJson(std::get<NetForm>(member.form));
    }
    members.push_back(std::move(json));
  }
  return {{"rule", form.rule}, {"members", std::move(members)}};
}

// A value of a document together with its place, for messages.
class Node {
 public:
  Node(const Json& value, std::string path, const std::string& source)
      : value_(value), path_(std::move(path)), source_(source) {}

  [[noreturn]] void Refuse(const std::string& why) const {
    throw data::InputError(
        fmt::format("{}: {}{}; fit the model again or restore the file",
                    source_,
                    path_.empty() ? "" : "key '" + path_ + "': ",
                    why));
  }

  Node At(const std::string& key) const {
    if (!value_.is_object()) Refuse("must be an object");
    const auto found = value_.find(key);
    if (found == value_.end()) Refuse("has no key '" + key + "'");
    return {*found, path_.empty() ? key : path_ + "." + key, source_};
  }

  // Nothing where the key is not there, as in older files, or null.
  std::optional<Node> Find(const std::string& key) const {
    if (!value_.is_object()) Refuse("must be an object");
    const auto found = value_.find(key);
    if (found == value_.end() || found->is_null()) return std::nullopt;
    return At(key);
  }

  std::vector<Node> Elements() const {
    if (!value_.is_array()) Refuse("must be an array");
    std::vector<Node> elements;
    for (std::size_t i = 0; i < value_.size(); ++i) {
      elements.emplace_back(
          value_[i], fmt::format("{}[{}]", path_, i), source_);
    }
    return elements;
  }

  std::string Text() const {
    if (!value_.is_string()) Refuse("must be text");
    return value_.get<std::string>();
  }

  double Number() const {
    if (!value_.is_number()) Refuse("must be a finite number");
    const double number = value_.get<double>();
    if (!std::isfinite(number)) Refuse("must be a finite number");
    return number;
  }

  Index Count() const {
    if (!value_.is_number_integer() || value_.get<std::int64_t>() < 0) {
      Refuse("must be a whole number of at least 0");
    }
    return value_.get<Index>();
  }

  Eigen::VectorXd Vector() const {
    const std::vector<Node> elements = Elements();
    Eigen::VectorXd vector(static_cast<Index>(elements.size()));
    for (std::size_t i = 0; i < elements.size(); ++i) {
      vector[static_cast<Index>(i)] = elements[i].Number();
    }
    return vector;
  }

  Eigen::MatrixXd Matrix() const {
    const std::vector<Node> rows = Elements();
    if (rows.empty()) return {};
    Eigen::MatrixXd matrix;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Eigen::VectorXd row = rows[i].Vector();
      if (i == 0) matrix.resize(static_cast<Index>(rows.size()), row.size());
      if (row.size() != matrix.cols()) {
        rows[i].Refuse(fmt::format(
            "has {} numbers, the first row has {}", row.size(), matrix.cols()));
      }
      matrix.row(static_cast<Index>(i)) = row.transpose();
    }
    return matrix;
  }

 private:
  const Json& value_;
  std::string path_;
  const std::string& source_;
};

PolynomialForm ReadPolynomial(const Node& node) {
  PolynomialForm form;
  form.input_offset = node.At("input_offset").Vector();
  form.input_scale = node.At("input_scale").Vector();
  form.intercept = node.At("intercept").Number();
  for (const Node& element : node.At("terms").Elements()) {
    PolynomialTerm term;
    for (const Node& power : element.At("powers").Elements()) {
      constexpr Index kMostPower = 64;
      const Index value = power.Count();
      if (value > kMostPower) power.Refuse("is too high a power");
      term.powers.push_back(static_cast<int>(value));
    }
    term.coefficient = element.At("coefficient").Number();
    form.terms.push_back(std::move(term));
  }
  return form;
}

NetForm ReadNet(const Node& node) {
  NetForm form;
  form.input_offset = node.At("input_offset").Vector();
  form.input_scale = node.At("input_scale").Vector();
  form.target_slope = node.At("target_slope").Vector();
  form.target_offset = node.At("target_offset").Vector();
  form.w1 = node.At("w1").Matrix();
  form.w2 = node.At("w2").Matrix();
  const std::string output = node.At("output").Text();
  if (output == ToString(OutputFunction::kSigmoid)) {
    form.output = OutputFunction::kSigmoid;
  } else if (output == ToString(OutputFunction::kLinear)) {
    form.output = OutputFunction::kLinear;
  } else {
    node.At("output").Refuse("must be 'sigmoid' or 'linear', found '" + output +
                             "'");
  }
  std::vector<Index> nodes;
  for (const Node& count : node.At("nodes").Elements()) {
    nodes.push_back(count.Count());
  }
  if (nodes !=
      std::vector<Index>{form.w1.cols() - 1, form.w1.rows(), form.w2.rows()}) {
    node.At("nodes").Refuse("does not agree with the shapes of w1 and w2");
  }
  return form;
}

BlendForm ReadBlend(const Node& node, Index num_inputs) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  BlendForm form;
  form.num_inputs = num_inputs;
  form.rule = node.At("rule").Text();
  for (const Node& element : node.At("members").Elements()) {
    BlendForm::Member member;
    member.name = element.At("name").Text();
    member.weight = element.At("weight").Number();
    for (const Node& input : element.At("inputs").Elements()) {
      member.inputs.push_back(input.Count());
    }
    const auto lowest = element.Find("lowest");
    member.lowest = lowest ? lowest->Number() : -kInfinity;
    const auto highest = element.Find("highest");
    member.highest = highest ? highest->Number() : kInfinity;
    member.parameters = element.At("parameters").Count();
    if (const auto net = element.Find("net")) {
      member.form = ReadNet(*net);
    } else {
      member.form = ReadPolynomial(element.At("polynomial"));
    }
    form.members.push_back(std::move(member));
  }
  return form;
}

data::ColumnInfo ReadColumn(const Node& node) {
  return {node.At("name").Text(), data::UnitOfSymbol(node.At("unit").Text())};
}

TrainedInput ReadInput(const Node& node) {
  const TrainedInput input{ReadColumn(node),
                           node.At("min").Number(),
                           node.At("max").Number(),
                           node.At("mean").Number(),
                           node.At("sd").Number()};
  if (input.min > input.max) node.At("min").Refuse("is above max");
  if (input.sd < 0.0) node.At("sd").Refuse("must be at least 0");
  return input;
}

ModelKind ReadKind(const Node& node) {
  const std::string kind = node.Text();
  for (const ModelKind known : {ModelKind::kBaseline,
                                ModelKind::kPolynomial,
                                ModelKind::kNet,
                                ModelKind::kBlend}) {
    if (kind == ToString(known)) return known;
  }
  node.Refuse("unknown kind of model '" + kind + "'");
}

Filter ReadFilter(const Node& node) {
  const std::string filter = node.Text();
  for (const Filter known :
       {Filter::kEma, Filter::kZero, Filter::kSine, Filter::kCosine}) {
    if (filter == ToString(known)) return known;
  }
  node.Refuse("must be 'ema', 'zero', 'sine' or 'cosine', found '" + filter +
              "'");
}

History ReadHistory(const Node& node, const std::vector<TrainedInput>& inputs) {
  History history;
  history.time_unit = node.At("time_unit").Text();
  if (history.time_unit != "s" && history.time_unit != "rows") {
    node.At("time_unit").Refuse("must be 's' or 'rows'");
  }
  history.session = node.At("session").Text();
  if (const auto start = node.Find("latest_start")) {
    history.latest_start = start->Number();
  }
  for (const Node& element : node.At("derived").Elements()) {
    DerivedInput input;
    input.column = ReadColumn(element);
    input.of = element.At("of").Text();
    input.filter = ReadFilter(element.At("filter"));
    if (input.filter == Filter::kEma) input.tau = element.At("tau").Number();
    history.derived.push_back(std::move(input));
  }
  for (const Node& name : node.At("form_inputs").Elements()) {
    history.form_inputs.push_back(name.Text());
  }
  std::vector<data::ColumnInfo> columns;
  for (const TrainedInput& input : inputs) columns.push_back(input.column);
  try {
    const HistoryState check(history, columns);
  } catch (const std::invalid_argument& error) {
    node.Refuse(error.what());
  }
  return history;
}

Guards ReadGuards(const Node& node, Index num_inputs) {
  Guards guards;
  guards.input_margin = node.At("input_margin").Number();
  guards.error_margin = node.At("error_margin").Number();
  guards.input_min = node.At("input_min").Vector();
  guards.input_max = node.At("input_max").Vector();
  guards.error_min = node.At("error_min").Number();
  guards.error_max = node.At("error_max").Number();
  if (guards.input_min.size() != num_inputs ||
      guards.input_max.size() != num_inputs) {
    node.Refuse(
        fmt::format("needs {} numbers in input_min and input_max", num_inputs));
  }
  return guards;
}

Eigen::VectorXd ReadVector(const Node& node, Index size) {
  Eigen::VectorXd values = node.Vector();
  if (values.size() != size) {
    node.Refuse(fmt::format("needs {} numbers, has {}", size, values.size()));
  }
  return values;
}

double ReadPositive(const Node& node) {
  const double value = node.Number();
  if (!(value > 0.0)) node.Refuse("must be above 0");
  return value;
}

Eigen::VectorXd ReadPositive(const Node& node, Index size) {
  Eigen::VectorXd values = ReadVector(node, size);
  if (!(values.array() > 0.0).all()) node.Refuse("must be above 0");
  return values;
}

std::vector<Index> ReadColumnsOf(const Node& node,
                                 const std::vector<TrainedInput>& inputs) {
  std::vector<Index> columns;
  for (const Node& name : node.Elements()) {
    const auto found = std::ranges::find(
        inputs, name.Text(), [](const TrainedInput& input) -> const auto& {
          return input.column.name;
        });
    if (found == inputs.end()) name.Refuse("is no input of the map");
    columns.push_back(found - inputs.begin());
  }
  return columns;
}

Applicability ReadApplicability(const Node& node, const FittedModel& fitted) {
  Applicability trained;
  for (const Node& element : node.At("derived").Elements()) {
    trained.derived.push_back({.column = ReadColumn(element),
                               .min = element.At("min").Number(),
                               .max = element.At("max").Number()});
    if (fitted.history == nullptr ||
        std::ranges::find(fitted.history->form_inputs,
                          trained.derived.back().column.name) ==
            fitted.history->form_inputs.end()) {
      element.Refuse("is no input of the form");
    }
  }
  trained.columns = ReadColumnsOf(node.At("columns"), fitted.inputs);
  const auto size = static_cast<Index>(trained.columns.size());
  trained.rows = node.At("rows").Count();
  if (trained.rows < 2) node.At("rows").Refuse("must be at least 2");
  trained.mean = ReadVector(node.At("mean"), size);
  trained.scale = ReadPositive(node.At("scale"), size);
  trained.directions = node.At("directions").Matrix();
  trained.rest = ReadPositive(node.At("rest"), size);
  trained.states = node.At("states").Matrix();
  if (trained.directions.rows() != size || trained.directions.cols() < 1) {
    node.At("directions").Refuse(fmt::format("needs {} rows", size));
  }
  if (trained.states.rows() < 1 ||
      trained.states.cols() != trained.directions.cols()) {
    node.At("states").Refuse(
        fmt::format("needs rows of {} numbers", trained.directions.cols()));
  }
  trained.distance_limit = ReadPositive(node.At("distance_limit"));
  trained.leverage_limit = ReadPositive(node.At("leverage_limit"));
  trained.relation_limit = ReadPositive(node.At("relation_limit"), size);
  return trained;
}

HeldOutErrors ReadHeldOut(const Node& node) {
  HeldOutErrors errors;
  errors.time_unit = node.At("time_unit").Text();
  errors.position = node.At("position").Text();
  errors.rmse = node.At("rmse").Number();
  for (const Node& element : node.At("units").Elements()) {
    HeldOutErrors::Unit unit;
    unit.label = element.At("label").Text();
    unit.rmse = element.At("rmse").Number();
    unit.residuals = element.At("residuals").Vector();
    if (unit.residuals.size() == 0) element.Refuse("has no residuals");
    unit.elapsed = ReadVector(element.At("elapsed"), unit.residuals.size());
    unit.position =
        ReadVector(element.At("position"),
                   errors.position.empty() ? 0 : unit.residuals.size());
    errors.units.push_back(std::move(unit));
  }
  if (errors.units.size() < 2) node.At("units").Refuse("needs two units");
  return errors;
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
    const std::string key = LevelKey(level.coverage);
    if (const auto half_width = node.Find(key)) {
      level.half_width = half_width->Number();
      if (!(level.half_width >= 0.0)) half_width->Refuse("must be at least 0");
    }
    level.at_least = std::ranges::find(at_least, key) != at_least.end();
  }
  return interval;
}

// Of two values of one key a reader would take either.
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

FittedModel ReadModel(const Node& root) {
  const std::string schema = root.At("schema").Text();
  if (schema != kSchema) {
    root.At("schema").Refuse(
        fmt::format("this version reads {}, found '{}'", kSchema, schema));
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
  const bool is_blend =
      fitted.kind == ModelKind::kBlend || root.Find("blend").has_value();
  const bool is_net = fitted.kind == ModelKind::kNet;
  const Node form = root.At(is_blend ? "blend" : is_net ? "net" : "polynomial");
  try {
    ModelDescription description;
    if (is_blend) {
      description = ReadBlend(form, static_cast<Index>(form_inputs));
    } else if (is_net) {
      description = ReadNet(form);
    } else {
      fitted.equation = form.At("equation").Text();
      description = ReadPolynomial(form);
    }
    fitted.model = ModelOfForm(std::move(description), parameters.Count());
  } catch (const std::invalid_argument& error) {
    form.Refuse(error.what());
  }
  if (fitted.model->num_inputs() != static_cast<Index>(form_inputs)) {
    root.At(fitted.history != nullptr ? "history" : "inputs")
        .Refuse(fmt::format("names {} inputs, the model reads {}",
                            form_inputs,
                            fitted.model->num_inputs()));
  }
  if (const auto guards = root.Find("guards")) {
    fitted.guards = ReadGuards(*guards, fitted.model->num_inputs());
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
  if (fitted.model->num_parameters() != parameters.Count()) {
    parameters.Refuse(fmt::format("is {}, the model has {}",
                                  parameters.Count(),
                                  fitted.model->num_parameters()));
  }
  fitted.summary.message = "read from a file";
  return fitted;
}

}  // namespace

std::string ModelToJson(const FittedModel& fitted,
                        const Provenance& provenance) {
  Json inputs = Json::array();
  for (const TrainedInput& input : fitted.inputs) {
    inputs.push_back({{"name", input.column.name},
                      {"unit", input.column.unit.symbol},
                      {"min", input.min},
                      {"max", input.max},
                      {"mean", input.mean},
                      {"sd", input.sd}});
  }
  Json document = {
      {"schema", kSchema},
      {"version", Version()},
      {"name", fitted.name},
      {"kind", ToString(fitted.kind)},
      {"target",
       {{"name", fitted.target.name}, {"unit", fitted.target.unit.symbol}}},
      {"inputs", std::move(inputs)},
      {"parameters", fitted.model->num_parameters()}};
  const ModelDescription description = fitted.model->Describe();
  RequireFormula(description, "a model file");
  if (const auto* polynomial = std::get_if<PolynomialForm>(&description)) {
    document["polynomial"] = ToJson(*polynomial, fitted.equation);
  } else if (const auto* net = std::get_if<NetForm>(&description)) {
    document["net"] = ToJson(*net);
  } else {
    document["blend"] = ToJson(std::get<BlendForm>(description));
  }
  if (fitted.align != data::Alignment::kNone) {
    document["target"]["align"] = data::ToString(fitted.align);
  }
  document["history"] =
      fitted.history != nullptr ? ToJson(*fitted.history) : Json();
  document["guards"] = fitted.guards ? ToJson(*fitted.guards) : Json();
  document["interval"] = fitted.interval ? ToJson(*fitted.interval) : Json();
  document["applicability"] = fitted.applicability != nullptr
                                  ? ToJson(*fitted.applicability, fitted.inputs)
                                  : Json();
  document["held_out"] =
      fitted.held_out != nullptr ? ToJson(*fitted.held_out) : Json();
  document["provenance"] = Json::object();
  for (const auto& [key, value] : provenance) {
    document["provenance"][key] = value;
  }
  constexpr int kIndent = 1;
  return document.dump(kIndent) + "\n";
}

void SaveModel(const FittedModel& fitted,
               const Provenance& provenance,
               const std::string& path) {
  data::WriteFileAtomically(path, ModelToJson(fitted, provenance));
}

FittedModel LoadModel(const std::string& path) {
  return ModelFromJson(data::ReadFile(path, data::kMostTextOfPrograms), path);
}

FittedModel ModelFromJson(const std::string& text, const std::string& source) {
  Json document;
  try {
    data::RequireShallowJson(text);
    document = ParseUniqueKeys(text);
  } catch (const data::InputError& error) {
    throw data::InputError(fmt::format("{}: {}", source, error.what()));
  } catch (const Json::exception& error) {
    throw data::InputError(
        fmt::format("{}: is no JSON model file: {}", source, error.what()));
  }
  return ReadModel(Node(document, "", source));
}

}  // namespace errmap::models
