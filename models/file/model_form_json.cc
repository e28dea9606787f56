#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "models/blend/form_to_model.h"
#include "models/file/map_members_json.h"
#include "models/file/model_json.h"
#include "models/record_json.h"

// Each kind of form in a model file: written, and read.

namespace errmap::models {
namespace {

using Json = ModelJson;
using Node = ModelJsonNode;

// A form is its members, and some are more.

template <typename Form>
Json FormToJson(const Form& form, const std::string& /*equation*/) {
  return ToJson(form);
}

Json FormToJson(const PolynomialForm& form, const std::string& equation) {
  Json json = ToJson(form);
  json["equation"] = equation;
  return json;
}

Json FormToJson(const NetForm& form, const std::string& /*equation*/) {
  Json json = {{"nodes", {form.w1.cols() - 1, form.w1.rows(), form.w2.rows()}}};
  json.update(ToJson(form));
  return json;
}

Json FormToJson(const BlendForm& form, const std::string& /*equation*/) {
  Json members = Json::array();
  for (const BlendForm::Member& member : form.members) {
    Json json = ToJson(member);
    json.erase("form");  // it is told by its key
    std::visit(
        [&json](const auto& of_member) {
          json[FileKeyOf(&of_member)] = FormToJson(of_member, "");
        },
        member.form);
    members.push_back(std::move(json));
  }
  return {{"rule", form.rule}, {"members", std::move(members)}};
}

template <typename Form>
void ReadFormAt(const Node& node, Form* form) {
  ReadMembers(node, form);
}

void ReadFormAt(const Node& node, PolynomialForm* form) {
  ReadMembers(node, form, {}, {"bends_within"});
  for (const Node& element : node.At("terms").Elements()) {
    for (const Node& power : element.At("powers").Elements()) {
      constexpr Index kMostPower = 64;
      if (power.Count() > kMostPower) power.Refuse("is too high a power");
    }
  }
}

void ReadFormAt(const Node& node, NetForm* form) {
  ReadMembers(node, form);
  std::vector<Index> nodes;
  ReadMembers(node.At("nodes"), &nodes);
  if (nodes != std::vector<Index>{
                   form->w1.cols() - 1, form->w1.rows(), form->w2.rows()}) {
    node.At("nodes").Refuse("does not agree with the shapes of w1 and w2");
  }
}

void ReadFormAt(const Node& node, BlendForm* form);

// Reads the first form whose key is there, and returns its place.
template <typename... Forms>
Node ReadOneOf(const Node& around, std::variant<Forms...>* form) {
  std::optional<Node> found;
  std::vector<std::string> keys;
  const auto look = [&]<typename Form>(const Form* form_type) {
    if constexpr (requires { FileKeyOf(form_type); }) {
      keys.emplace_back(FileKeyOf(form_type));
      if (found) return;
      if (const auto node = around.Find(keys.back())) {
        found.emplace(*node);
        ReadFormAt(*node, &form->template emplace<Form>());
      }
    }
  };
  (look(static_cast<const Forms*>(nullptr)), ...);
  if (!found) around.RefuseWithout(keys);
  return *found;
}

void ReadFormAt(const Node& node, BlendForm* form) {
  form->rule = node.At("rule").Text();
  for (const Node& element : node.At("members").Elements()) {
    BlendForm::Member& member = form->members.emplace_back();
    // Bounds that are infinite are null.
    ReadMembers(element, &member, {}, {"lowest", "highest"});
    ReadOneOf(element, &member.form);
  }
}

}  // namespace

void WriteForm(const ErrorModel& model,
               const std::string& equation,
               ModelJson* document) {
  std::visit(
      [&](const auto& form) {
        if constexpr (requires { FileKeyOf(&form); }) {
          (*document)[FileKeyOf(&form)] = FormToJson(form, equation);
        } else {
          RequireFormula(form, "a model file");
        }
      },
      model.Describe());
}

void ReadForm(const ModelJsonNode& document,
              Index num_inputs,
              FittedModel* fitted) {
  ModelDescription description;
  const Node form = ReadOneOf(document, &description);
  if (std::holds_alternative<PolynomialForm>(description)) {
    fitted->equation = form.At("equation").Text();
  }
  if (auto* const blend = std::get_if<BlendForm>(&description)) {
    blend->num_inputs = num_inputs;
  }
  try {
    fitted->model =
        ModelOfForm(std::move(description), document.At("parameters").Count());
  } catch (const std::invalid_argument& error) {
    form.Refuse(error.what());
  }
}

}  // namespace errmap::models
