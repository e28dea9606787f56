// FittedModel of models/error_model.h: derive, clip, predict, clip.

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "models/error_model.h"
#include "models/history/history.h"
#include "models/row_scratch.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

using Rows = Eigen::Array<bool, Eigen::Dynamic, 1>;

// A value that is NaN stays so.
double Clipped(double value, const Bounds& bounds) {
  return value < bounds.low    ? bounds.low
         : value > bounds.high ? bounds.high
                               : value;
}

// Clips `values` and marks where it did.
void Clip(const Bounds& bounds, Eigen::Ref<VectorXd> values, Rows* clipped) {
  *clipped =
      *clipped || values.array() < bounds.low || values.array() > bounds.high;
  values = values.unaryExpr(
      [bounds](double value) { return Clipped(value, bounds); });
}

MatrixXd ColumnsByName(const data::Dataset& dataset,
                       const std::string& model,
                       const std::vector<TrainedInput>& inputs) {
  MatrixXd values(dataset.num_rows(), std::ssize(inputs));
  Index column = 0;
  for (const TrainedInput& input : inputs) {
    const Index index = dataset.FindInput(input.column.name);
    if (index < 0) {
      throw std::invalid_argument("model " + model + " reads input '" +
                                  input.column.name + "', which " +
                                  dataset.source() + " does not have");
    }
    values.col(column++) = dataset.input_values().col(index);
  }
  return values;
}

}  // namespace

ClampLimits MakeClampLimits(const std::vector<TrainedInput>& form_inputs,
                            const VectorXd& targets,
                            bool grows) {
  ClampLimits guards;
  if (grows) guards.error_margin = 1.0;
  const auto size = std::ssize(form_inputs);
  guards.input_min.resize(size);
  guards.input_max.resize(size);
  for (Index i = 0; i < size; ++i) {
    guards.input_min[i] = form_inputs[static_cast<std::size_t>(i)].min;
    guards.input_max[i] = form_inputs[static_cast<std::size_t>(i)].max;
  }
  guards.error_min = targets.minCoeff();
  guards.error_max = targets.maxCoeff();
  return guards;
}

Index FittedModel::RowsLearntFrom(const data::Dataset& training) const {
  const auto drawn = std::ranges::find(choices, "rows", &EffectiveOption::key);
  return drawn == choices.end() ? training.num_rows()
                                : std::get<std::int64_t>(drawn->value);
}

MatrixXd FittedModel::FormInputs(const data::Dataset& dataset) const {
  return history != nullptr ? DeriveInputs(dataset, *history)
                            : ColumnsByName(dataset, name, inputs);
}

Prediction FittedModel::PredictForm(const MatrixXd& form_inputs) const {
  Prediction prediction;
  prediction.clipped = Rows::Constant(form_inputs.rows(), false);
  if (!guards) {
    prediction.errors = model->Predict(form_inputs);
    return prediction;
  }
  if (form_inputs.cols() != guards->input_min.size()) {
    throw std::invalid_argument(
        "PredictForm: the guards know " +
        std::to_string(guards->input_min.size()) + " inputs, found " +
        std::to_string(form_inputs.cols()) + " columns");
  }
  MatrixXd inside = form_inputs;
  for (Index i = 0; i < inside.cols(); ++i) {
    Clip(guards->InputBounds(i), inside.col(i), &prediction.clipped);
  }
  prediction.errors = model->Predict(inside);
  Clip(guards->ErrorBounds(), prediction.errors, &prediction.clipped);
  return prediction;
}

double FittedModel::PredictFormRow(std::span<const double> form_inputs,
                                   bool* clipped) const {
  bool is_clipped = false;
  const auto clip = [&](double value, const Bounds& bounds) {
    is_clipped = is_clipped || value < bounds.low || value > bounds.high;
    return Clipped(value, bounds);
  };
  double error = 0.0;
  if (!guards) {
    error = model->PredictRow(form_inputs);
  } else {
    if (std::ssize(form_inputs) != guards->input_min.size()) {
      throw std::invalid_argument("PredictFormRow: the guards know " +
                                  std::to_string(guards->input_min.size()) +
                                  " inputs, found " +
                                  std::to_string(form_inputs.size()));
    }
    RowScratch inside(form_inputs.size());
    for (std::size_t i = 0; i < form_inputs.size(); ++i) {
      inside[i] =
          clip(form_inputs[i], guards->InputBounds(static_cast<Index>(i)));
    }
    error = clip(model->PredictRow({inside.data(), form_inputs.size()}),
                 guards->ErrorBounds());
  }
  if (clipped != nullptr) *clipped = is_clipped;
  return error;
}

VectorXd FittedModel::Predict(const data::Dataset& dataset) const {
  return PredictForm(FormInputs(dataset)).errors;
}

FittedModel NewMap(std::string name,
                   ModelKind kind,
                   const data::Dataset& training) {
  FittedModel fitted;
  fitted.name = std::move(name);
  fitted.kind = kind;
  fitted.target = training.target();
  fitted.align = training.align();
  fitted.summary.termination = fitting::Termination::kDirect;
  fitted.summary.message.clear();
  return fitted;
}

FittedModel MapOfModel(const ModelRecipe& recipe,
                       const data::Dataset& training,
                       std::shared_ptr<const ErrorModel> model) {
  FittedModel fitted = NewMap(recipe.name(), recipe.kind(), training);
  const std::vector<Index> columns = stats::AllIndices(training.num_inputs());
  fitted.inputs = DescribeInputs(training, columns);
  fitted.model = std::move(model);
  return fitted;
}

}  // namespace errmap::models
