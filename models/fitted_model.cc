// FittedModel of models/error_model.h: derive, clip, predict, clip.

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "models/error_model.h"
#include "models/history/history.h"
#include "models/row_scratch.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Rows = Eigen::Array<bool, Eigen::Dynamic, 1>;

// Clips `values` to [min - m * range, max + m * range] and marks where it did;
// a value that is NaN stays so.
void Clip(double min,
          double max,
          double margin,
          Eigen::Ref<Eigen::VectorXd> values,
          Rows* clipped) {
  const double widened = margin * (max - min);
  const double low = min - widened;
  const double high = max + widened;
  *clipped = *clipped || values.array() < low || values.array() > high;
  values = values.unaryExpr([low, high](double value) {
    return value < low ? low : value > high ? high : value;
  });
}

MatrixXd ColumnsByName(const data::Dataset& dataset,
                       const std::string& model,
                       const std::vector<TrainedInput>& inputs) {
  MatrixXd values(dataset.num_rows(), static_cast<Index>(inputs.size()));
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

Guards MakeGuards(const std::vector<TrainedInput>& form_inputs,
                  const Eigen::VectorXd& targets) {
  Guards guards;
  const auto size = static_cast<Index>(form_inputs.size());
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
    Clip(guards->input_min[i],
         guards->input_max[i],
         guards->input_margin,
         inside.col(i),
         &prediction.clipped);
  }
  prediction.errors = model->Predict(inside);
  Clip(guards->error_min,
       guards->error_max,
       guards->error_margin,
       prediction.errors,
       &prediction.clipped);
  return prediction;
}

double FittedModel::PredictFormRow(std::span<const double> form_inputs,
                                   bool* clipped) const {
  bool is_clipped = false;
  const auto clip = [&](double value, double min, double max, double margin) {
    const double widened = margin * (max - min);
    const double low = min - widened;
    const double high = max + widened;
    is_clipped = is_clipped || value < low || value > high;
    return value < low ? low : value > high ? high : value;
  };
  double error = 0.0;
  if (!guards) {
    error = model->PredictRow(form_inputs);
  } else {
    if (static_cast<Index>(form_inputs.size()) != guards->input_min.size()) {
      throw std::invalid_argument("PredictFormRow: the guards know " +
                                  std::to_string(guards->input_min.size()) +
                                  " inputs, found " +
                                  std::to_string(form_inputs.size()));
    }
    RowScratch inside(form_inputs.size());
    for (std::size_t i = 0; i < form_inputs.size(); ++i) {
      const auto at = static_cast<Index>(i);
      inside[i] = clip(form_inputs[i],
                       guards->input_min[at],
                       guards->input_max[at],
                       guards->input_margin);
    }
    error = clip(model->PredictRow({inside.data(), form_inputs.size()}),
                 guards->error_min,
                 guards->error_max,
                 guards->error_margin);
  }
  if (clipped != nullptr) *clipped = is_clipped;
  return error;
}

Eigen::VectorXd FittedModel::Predict(const data::Dataset& dataset) const {
  return PredictForm(FormInputs(dataset)).errors;
}

FittedModel MapOfModel(const ModelRecipe& recipe,
                       const data::Dataset& training,
                       std::shared_ptr<const ErrorModel> model) {
  FittedModel fitted;
  fitted.name = recipe.name();
  fitted.kind = recipe.kind();
  fitted.target = training.target();
  fitted.align = training.align();
  std::vector<Index> columns(static_cast<std::size_t>(training.num_inputs()));
  std::iota(columns.begin(), columns.end(), Index{0});
  fitted.inputs = DescribeInputs(training, columns);
  fitted.model = std::move(model);
  fitted.summary.termination = fitting::Termination::kDirect;
  fitted.summary.message.clear();
  return fitted;
}

}  // namespace errmap::models
