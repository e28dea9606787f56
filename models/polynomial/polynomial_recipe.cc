#include "models/polynomial/polynomial_recipe.h"

#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "models/polynomial/polynomial_basis.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/polynomial_model.h"
#include "models/polynomial/selection_recipe.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;

constexpr int kMostDegree = 12;

// `zero` (no compensation at all) and `mean`.
class ConstantRecipe final : public PolynomialRecipe {
 public:
  ConstantRecipe(std::string name, bool is_zero)
      : PolynomialRecipe(std::move(name)), is_zero_(is_zero) {}

  ModelKind kind() const override { return ModelKind::kBaseline; }
  std::optional<Index> NumCoefficients(const Dataset&) const override {
    return is_zero_ ? 0 : 1;
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (!is_zero_) return FitTerms(training, {}, {}, context);
    FittedModel fitted = NewModel(training);
    fitted.summary.message = "nothing to fit";
    PolynomialForm form;
    fitted.equation = EquationText(form, fitted.target, {}, 1.0);
    fitted.model = std::make_shared<PolynomialModel>(std::move(form), 0);
    return fitted;
  }

 private:
  bool is_zero_;
};

// A form of the report in position x and one temperature T.
struct PositionTemperatureForm {
  const char* type;
  std::vector<TermPowers> terms;  // powers of (x, T); of one input where only
  bool uses_position;             // that one is used
  bool uses_temperature;
};

const std::vector<PositionTemperatureForm>& PositionTemperatureForms() {
  static const std::vector<PositionTemperatureForm> forms = {
      {"poly:position", {{1}, {2}}, true, false},
      {"poly:temperature", {{1}}, false, true},
      {"poly:eq7", {{1, 0}, {2, 0}, {0, 1}, {0, 2}}, true, true},
      {"poly:eq8", {{1, 0}, {2, 0}, {0, 1}, {1, 1}}, true, true},
      {"poly:eq9", {{1, 0}, {2, 0}, {0, 1}}, true, true}};
  return forms;
}

class PositionTemperatureRecipe final : public PolynomialRecipe {
 public:
  PositionTemperatureRecipe(const ModelSpec& spec,
                            const PositionTemperatureForm& form)
      : PolynomialRecipe(spec.text), form_(form) {
    SpecOptions options(spec);
    if (form_.uses_position) position_ = options.TakeText("position", "");
    if (form_.uses_temperature) temperature_ = options.TakeText("T", "");
    options.RefuseOthers();
  }

  std::vector<EffectiveOption> options() const override {
    std::vector<EffectiveOption> options;
    if (!position_.empty()) options.push_back({"position", position_});
    if (!temperature_.empty()) options.push_back({"T", temperature_});
    return options;
  }

  std::optional<std::string> WhatIsMissing(
      const Dataset& dataset) const override {
    if (form_.uses_position && position_.empty() &&
        FindPosition(dataset, "") < 0) {
      return "a position: no input's name starts with 'position' "
             "(position=NAME names one)";
    }
    if (form_.uses_temperature && temperature_.empty() &&
        TemperatureCandidates(dataset).empty()) {
      return "a temperature: there is no input other than the position";
    }
    return std::nullopt;
  }

  std::optional<Index> NumCoefficients(const Dataset&) const override {
    return static_cast<Index>(form_.terms.size()) + 1;
  }

  // T is the candidate that leaves the smallest residual sum of squares in
  // the training rows (the first of equals).
  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (const auto missing = WhatIsMissing(training)) {
      throw std::invalid_argument("the data lack " + *missing);
    }
    std::vector<Index> columns;
    if (form_.uses_position) {
      columns.push_back(FindPosition(training, position_));
    }
    if (!form_.uses_temperature) {
      return FitTerms(training, columns, form_.terms, context);
    }
    FitContext plain = context;
    plain.explain = false;
    double lowest = std::numeric_limits<double>::infinity();
    columns.push_back(-1);
    std::vector<Index> best;
    for (const Index candidate : TemperatureCandidates(training)) {
      columns.back() = candidate;
      const double cost =
          FitTerms(training, columns, form_.terms, plain).summary.final_cost;
      if (best.empty() || cost < lowest) {
        lowest = cost;
        best = columns;
      }
    }
    return FitTerms(training, best, form_.terms, context);
  }

 private:
  std::vector<Index> TemperatureCandidates(const Dataset& dataset) const {
    if (!temperature_.empty()) {
      const Index named = dataset.FindInput(temperature_);
      if (named < 0) {
        throw std::invalid_argument("T='" + temperature_ +
                                    "' is not among the inputs");
      }
      return {named};
    }
    const Index position = FindPosition(dataset, position_);
    std::vector<Index> candidates = AllColumns(dataset);
    std::erase(candidates, position);
    return candidates;
  }

  const PositionTemperatureForm& form_;
  std::string position_;
  std::string temperature_;
};

// All terms up to a degree.
class FullRecipe final : public PolynomialRecipe {
 public:
  explicit FullRecipe(const ModelSpec& spec) : PolynomialRecipe(spec.text) {
    SpecOptions options(spec);
    degree_ =
        static_cast<int>(options.TakeInteger("degree", 2, 1, kMostDegree));
    options.RefuseOthers();
  }

  std::vector<EffectiveOption> options() const override {
    return {{"degree", std::int64_t{degree_}}};
  }

  std::optional<Index> NumCoefficients(const Dataset& dataset) const override {
    const auto terms = CountTerms(dataset.num_inputs(), degree_);
    return terms ? *terms + 1 : std::numeric_limits<Index>::max();
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    const Index coefficients = *NumCoefficients(training);
    if (coefficients > training.num_rows()) {
      throw std::invalid_argument(fmt::format(
          "degree {} in {} inputs has {} coefficients, more than the {} "
          "training rows",
          degree_,
          training.num_inputs(),
          coefficients,
          training.num_rows()));
    }
    return FitTerms(training,
                    AllColumns(training),
                    AllTerms(training.num_inputs(), degree_),
                    context);
  }

 private:
  int degree_;
};

}  // namespace

std::unique_ptr<ModelRecipe> MakePolynomialRecipe(const ModelSpec& spec) {
  if (spec.type == "zero" || spec.type == "mean") {
    SpecOptions(spec).RefuseOthers();
    return std::make_unique<ConstantRecipe>(spec.text, spec.type == "zero");
  }
  for (const PositionTemperatureForm& form : PositionTemperatureForms()) {
    if (spec.type == form.type) {
      return std::make_unique<PositionTemperatureRecipe>(spec, form);
    }
  }
  if (spec.type == "poly:full") return std::make_unique<FullRecipe>(spec);
  return MakeSelectionRecipe(spec);
}

}  // namespace errmap::models
