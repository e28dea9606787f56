#include "models/averaged_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

#include "models/row_scratch.h"

namespace errmap::models {

AveragedModel::AveragedModel(Index num_inputs,
                             std::string rule,
                             std::vector<AveragedMember> members)
    : num_inputs_(num_inputs),
      rule_(std::move(rule)),
      members_(std::move(members)) {
  const auto refuse = [](const std::string& why) {
    throw std::invalid_argument("AveragedModel: " + why);
  };
  if (members_.empty()) refuse("has no members");
  double total = 0.0;
  for (const AveragedMember& member : members_) {
    if (!(member.weight > 0.0 && std::isfinite(member.weight))) {
      refuse("weights must be above 0 and finite");
    }
    if (std::ssize(member.inputs) != member.model->num_inputs()) {
      refuse(member.name + " reads " +
             std::to_string(member.model->num_inputs()) + " inputs, " +
             std::to_string(member.inputs.size()) + " are named");
    }
    for (const Index input : member.inputs) {
      if (input < 0 || input >= num_inputs_) {
        refuse(member.name + " reads an input that is not there");
      }
    }
    if (!(member.lowest <= member.highest)) {
      refuse(member.name + " has bounds that are not a range");
    }
    total += member.weight;
  }
  // Those that come to 1 but for rounding are of a model that was described:
  // divided again, some would change in their last bit.
  const double rounding = std::numeric_limits<double>::epsilon() *
                          static_cast<double>(members_.size());
  if (std::abs(total - 1.0) <= rounding) return;
  for (AveragedMember& member : members_) member.weight /= total;
}

Index AveragedModel::num_parameters() const {
  Index parameters = 0;
  for (const AveragedMember& member : members_) {
    parameters += member.model->num_parameters();
  }
  return parameters;
}

ModelDescription AveragedModel::Describe() const {
  BlendForm form{num_inputs_, rule_, {}};
  for (const AveragedMember& member : members_) {
    BlendForm::Member described{member.name,
                                member.weight,
                                member.inputs,
                                member.lowest,
                                member.highest,
                                member.model->num_parameters(),
                                {}};
    const bool is_told = std::visit(
        [&described]<typename Form>(const Form& known) {
          constexpr bool kCanBeMember =
              std::is_assignable_v<decltype(described.form)&, Form>;
          if constexpr (kCanBeMember) described.form = known;
          return kCanBeMember;
        },
        member.model->Describe());
    if (!is_told) return OpaqueForm{num_inputs_, {}};
    form.members.push_back(std::move(described));
  }
  return form;
}

double AveragedModel::DoPredictRow(const double* inputs) const {
  double mean = 0.0;
  for (const AveragedMember& member : members_) {
    RowScratch own(member.inputs.size());
    for (std::size_t i = 0; i < member.inputs.size(); ++i) {
      own[i] = inputs[member.inputs[i]];
    }
    const double predicted =
        member.model->PredictRow({own.data(), member.inputs.size()});
    mean += member.weight *
            std::min(std::max(predicted, member.lowest), member.highest);
  }
  return mean;
}

PredictionCost CostOf(const BlendForm& form) {
  PredictionCost sum;
  for (const BlendForm::Member& member : form.members) {
    const PredictionCost cost = std::visit(
        [](const auto& known) { return CostOf(known); }, member.form);
    sum.multiplications += cost.multiplications + 1;  // by its weight
    sum.exponentials += cost.exponentials;
  }
  return sum;
}

}  // namespace errmap::models
