#include "models/blend/form_to_model.h"

#include <utility>
#include <vector>

#include "models/averaged_model.h"
#include "models/net/feedforward_net.h"
#include "models/polynomial/polynomial_model.h"

namespace errmap::models {
namespace {

std::shared_ptr<const ErrorModel> ModelOf(PolynomialForm form,
                                          Index parameters) {
  return std::make_shared<PolynomialModel>(std::move(form), parameters);
}

std::shared_ptr<const ErrorModel> ModelOf(NetForm form, Index /*parameters*/) {
  return std::make_shared<FeedforwardNet>(std::move(form));
}

std::shared_ptr<const ErrorModel> ModelOf(BlendForm form,
                                          Index /*parameters*/) {
  std::vector<AveragedMember> members;
  for (BlendForm::Member& member : form.members) {
    const Index parameters = member.parameters;
    members.push_back(
        {std::move(member.name),
         member.weight,
         std::move(member.inputs),
         member.lowest,
         member.highest,
         std::visit(
             [&](auto& inner) { return ModelOf(std::move(inner), parameters); },
             member.form)});
  }
  return std::make_shared<AveragedModel>(
      form.num_inputs, std::move(form.rule), std::move(members));
}

std::shared_ptr<const ErrorModel> ModelOf(const OpaqueForm& form,
                                          Index /*parameters*/) {
  RequireFormula(form, "a model from plain data");
  return nullptr;
}

}  // namespace

std::shared_ptr<const ErrorModel> ModelOfForm(ModelDescription form,
                                              Index parameters) {
  return std::visit(
      [&](auto& known) { return ModelOf(std::move(known), parameters); }, form);
}

}  // namespace errmap::models
