#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "cli/python/module.h"

namespace errmap::python {
namespace {

// Calls Python with its lock; its errors become ours.
template <typename Call>
auto InPython(const Call& call) {
  const py::gil_scoped_acquire gil;
  try {
    return call();
  } catch (py::error_already_set& error) {
    const std::string type = py::str(error.type().attr("__name__"));
    const std::string text = py::str(error.value());
    throw std::invalid_argument(type + ": " + text);
  } catch (const py::cast_error&) {
    throw std::invalid_argument("its predictions are not an array of float64");
  }
}

class ForeignModel final : public models::ErrorModel {
 public:
  ForeignModel(Index num_inputs, std::shared_ptr<py::object> predict)
      : num_inputs_(num_inputs), predict_(std::move(predict)) {}

  Index num_inputs() const override { return num_inputs_; }
  Index num_parameters() const override { return 0; }

 private:
  double DoPredictRow(const double* inputs) const override {
    return DoPredict(
        Eigen::Map<const Eigen::RowVectorXd>(inputs, num_inputs_))[0];
  }

  VectorXd DoPredict(const MatrixXd& inputs) const override {
    if (inputs.rows() == 0) return {};
    VectorXd predicted = InPython([&] {
      return ToVector((*predict_)(Numbers{inputs, /*is_column=*/false}));
    });
    if (predicted.size() != inputs.rows()) {
      throw std::invalid_argument(fmt::format(
          "{} predictions of {} rows", predicted.size(), inputs.rows()));
    }
    return predicted;
  }

  Index num_inputs_;
  std::shared_ptr<py::object> predict_;
};

class Recipe final : public models::ModelRecipe {
 public:
  Recipe(std::string name, std::shared_ptr<py::object> fit)
      : name_(std::move(name)), fit_(std::move(fit)) {}

  std::string name() const override { return name_; }
  models::ModelKind kind() const override { return models::ModelKind::kFile; }

  models::FittedModel Fit(
      const data::Dataset& training,
      const models::FitContext& /*context*/) const override {
    std::shared_ptr<py::object> predict = InPython([&] {
      return Kept((*fit_)(Numbers{training.input_values(), false},
                          Numbers{training.target_values(), true},
                          training.InputNames()));
    });
    return MapOfModel(*this,
                      training,
                      std::make_shared<ForeignModel>(training.num_inputs(),
                                                     std::move(predict)));
  }

 private:
  std::string name_;
  std::shared_ptr<py::object> fit_;
};

}  // namespace

std::unique_ptr<models::ModelRecipe> ForeignRecipe(const std::string& name,
                                                   py::object fit) {
  return std::make_unique<Recipe>(name, Kept(std::move(fit)));
}

}  // namespace errmap::python
