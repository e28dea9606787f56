#include "models/error_model.h"

#include <array>
#include <stdexcept>

#include "data/text.h"
#include "stats/summary.h"

namespace errmap::models {

std::string_view ToString(OutputFunction output) {
  return output == OutputFunction::kSigmoid ? "sigmoid" : "linear";
}

std::string_view ToString(ModelKind kind) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"baseline", "polynomial", "net", "blend", "file"});
  return data::NameOf(kNames, kind);
}

std::string_view ToString(InnerHoldout inner) {
  constexpr auto kNames = std::to_array<std::string_view>(
      {"decisive", "sessions", "groups", "blocks", "rows", "forward"});
  return data::NameOf(kNames, inner);
}

PredictionCost CostOf(const OpaqueForm& form) { return form.cost; }

PredictionCost CostOf(const ModelDescription& form) {
  return std::visit([](const auto& known) { return CostOf(known); }, form);
}

void RequireFormula(const ModelDescription& form, std::string_view what) {
  if (!std::holds_alternative<OpaqueForm>(form)) return;
  throw std::invalid_argument(
      std::string(what) +
      " needs a map's formula, and a model of a program's own has none");
}

VectorXd ErrorModel::Predict(const MatrixXd& inputs) const {
  if (inputs.cols() != num_inputs()) {
    throw std::invalid_argument(
        "Predict: the model reads " + std::to_string(num_inputs()) +
        " inputs, found " + std::to_string(inputs.cols()) + " columns");
  }
  return DoPredict(inputs);
}

VectorXd ErrorModel::DoPredict(const MatrixXd& inputs) const {
  VectorXd errors(inputs.rows());
  VectorXd row(inputs.cols());
  for (Index i = 0; i < inputs.rows(); ++i) {
    row = inputs.row(i);
    errors[i] = DoPredictRow(row.data());
  }
  return errors;
}

double ErrorModel::PredictRow(std::span<const double> inputs) const {
  if (std::ssize(inputs) != num_inputs()) {
    throw std::invalid_argument(
        "PredictRow: the model reads " + std::to_string(num_inputs()) +
        " inputs, found " + std::to_string(inputs.size()));
  }
  return DoPredictRow(inputs.data());
}

ModelDescription ErrorModel::Describe() const {
  return OpaqueForm{num_inputs(), {}};
}

Index FindPosition(const data::Dataset& dataset, const std::string& wanted) {
  if (!wanted.empty()) {
    const Index index = dataset.FindInput(wanted);
    if (index < 0) {
      throw std::invalid_argument("position='" + wanted +
                                  "' is not among the inputs");
    }
    return index;
  }
  for (Index i = 0; i < dataset.num_inputs(); ++i) {
    if (data::IsPosition(dataset.inputs()[static_cast<std::size_t>(i)])) {
      return i;
    }
  }
  return -1;
}

std::vector<TrainedInput> DescribeInputs(const data::Dataset& training,
                                         const std::vector<Index>& columns) {
  std::vector<TrainedInput> inputs;
  for (const Index column : columns) {
    const stats::SampleSummary summary =
        stats::Summarize(training.input_values().col(column));
    inputs.push_back({training.inputs()[static_cast<std::size_t>(column)],
                      summary.min,
                      summary.max,
                      summary.mean,
                      summary.n > 1 ? summary.sd : 0.0});
  }
  return inputs;
}

}  // namespace errmap::models
