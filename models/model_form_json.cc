#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "models/blend/form_to_model.h"
#include "models/model_json.h"

// Each kind of form in a model file: written, and read.

namespace errmap::models {
namespace {

using Eigen::Index;
using Json = ModelJson;
using Node = ModelJsonNode;

Json FormToJson(const PolynomialForm& form, const std::string& equation) {
  Json terms = Json::array();
  for (const PolynomialTerm& term : form.terms) {
    terms.push_back(
        {{"powers", term.powers}, {"coefficient", term.coefficient}});
  }
  Json bends = Json::array();
  for (const BendRange& range : form.bends_within) {
    bends.push_back(
        {{"input", range.input}, {"min", range.min}, {"max", range.max}});
  }
  return {{"input_offset", NumbersToJson(form.input_offset)},
          {"input_scale", NumbersToJson(form.input_scale)},
          {"intercept", form.intercept},
          {"terms", std::move(terms)},
          {"bends_within", std::move(bends)},
          {"equation", equation}};
}

Json FormToJson(const NetForm& form) {
  return {{"nodes", {form.w1.cols() - 1, form.w1.rows(), form.w2.rows()}},
          {"output", ToString(form.output)},
          {"input_offset", NumbersToJson(form.input_offset)},
          {"input_scale", NumbersToJson(form.input_scale)},
          {"target_slope", NumbersToJson(form.target_slope)},
          {"target_offset", NumbersToJson(form.target_offset)},
          {"w1", NumbersToJson(form.w1)},
          {"w2", NumbersToJson(form.w2)}};
}

// Bounds may be infinite, which JSON has no word for: null.
Json BoundToJson(double bound) {
  return std::isfinite(bound) ? Json(bound) : Json(nullptr);
}

Json FormToJson(const BlendForm& form) {
  Json members = Json::array();
  for (const BlendForm::Member& member : form.members) {
    Json json = {{"name", member.name},
                 {"weight", member.weight},
                 {"inputs", member.inputs},
                 {"lowest", BoundToJson(member.lowest)},
                 {"highest", BoundToJson(member.highest)},
                 {"parameters", member.parameters}};
    if (const auto* polynomial = std::get_if<PolynomialForm>(&member.form)) {
      json["polynomial"] = FormToJson(*polynomial, "");
    } else {
      json["net"] = FormToJson(std::get<NetForm>(member.form));
    }
    members.push_back(std::move(json));
  }
  return {{"rule", form.rule}, {"members", std::move(members)}};
}

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
  if (const auto bends = node.Find("bends_within")) {
    for (const Node& element : bends->Elements()) {
      form.bends_within.push_back({element.At("input").Count(),
                                   element.At("min").Number(),
                                   element.At("max").Number()});
    }
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

}  // namespace

void WriteForm(const ErrorModel& model,
               const std::string& equation,
               ModelJson* document) {
  const ModelDescription description = model.Describe();
  RequireFormula(description, "a model file");
  if (const auto* polynomial = std::get_if<PolynomialForm>(&description)) {
    (*document)["polynomial"] = FormToJson(*polynomial, equation);
  } else if (const auto* net = std::get_if<NetForm>(&description)) {
    (*document)["net"] = FormToJson(*net);
  } else {
    (*document)["blend"] = FormToJson(std::get<BlendForm>(description));
  }
}

void ReadForm(const ModelJsonNode& document,
              Index num_inputs,
              FittedModel* fitted) {
  const bool is_blend =
      fitted->kind == ModelKind::kBlend || document.Find("blend").has_value();
  const bool is_net = fitted->kind == ModelKind::kNet;
  const Node form = document.At(is_blend ? "blend"
                                : is_net ? "net"
                                         : "polynomial");
  try {
    ModelDescription description;
    if (is_blend) {
      description = ReadBlend(form, num_inputs);
    } else if (is_net) {
      description = ReadNet(form);
    } else {
      fitted->equation = form.At("equation").Text();
      description = ReadPolynomial(form);
    }
    fitted->model =
        ModelOfForm(std::move(description), document.At("parameters").Count());
  } catch (const std::invalid_argument& error) {
    form.Refuse(error.what());
  }
}

}  // namespace errmap::models
