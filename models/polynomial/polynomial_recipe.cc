#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "models/history/view_options.h"
#include "models/option_list.h"
#include "models/polynomial/polynomial_basis.h"
#include "models/polynomial/polynomial_fit.h"
#include "models/polynomial/polynomial_model.h"
#include "models/polynomial/polynomial_options.h"

namespace errmap::models {
namespace {

using data::Dataset;
// `zero` (no compensation at all) and `mean`.
class ConstantRecipe final : public PolynomialRecipe {
 public:
  ConstantRecipe(const ConstantOptions& options, std::string name)
      : PolynomialRecipe(CheckedName(options, std::move(name)), false),
        is_zero_(options.is_zero) {}

  ModelKind kind() const override { return ModelKind::kBaseline; }
  std::optional<Index> NumCoefficients(const Dataset&) const override {
    return is_zero_ ? 0 : 1;
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (!is_zero_) return FitTerms(training, {}, {}, context);
    FittedModel fitted = NewMap(name(), kind(), training);
    fitted.summary.message = "nothing to fit";
    PolynomialForm form;
    fitted.equation = EquationText(form, fitted.target, {}, 1.0);
    fitted.model = std::make_shared<PolynomialModel>(std::move(form), 0);
    return fitted;
  }

 private:
  bool is_zero_;
};

struct TermsOfForm {
  std::string_view type;
  std::string_view about;
  std::vector<TermPowers> terms;  // powers of (x, T); of one input where only
  bool uses_position;             // that one is used
  bool uses_temperature;
};

// In the order of PositionTemperatureForm.
const std::vector<TermsOfForm>& Forms() {
  static const std::vector<TermsOfForm> forms = {
      {"poly:position",
       "a parabola over the position, no sensor",
       {{1}, {2}},
       true,
       false},
      {"poly:temperature",
       "a straight line over one temperature",
       {{1}},
       false,
       true},
      {"poly:eq7",
       "Eq. 7 of 1995: quadratic in position and in T",
       {{1, 0}, {2, 0}, {0, 1}, {0, 2}},
       true,
       true},
      {"poly:eq8",
       "Eq. 8 of 1995: quadratic in position, T, product",
       {{1, 0}, {2, 0}, {0, 1}, {1, 1}},
       true,
       true},
      {"poly:eq9",
       "Eq. 9 of 1995: quadratic in position, linear in T",
       {{1, 0}, {2, 0}, {0, 1}},
       true,
       true}};
  return forms;
}

const TermsOfForm& FormOf(PositionTemperatureForm form) {
  return Forms()[static_cast<std::size_t>(form)];
}

class PositionTemperatureRecipe final
    : public PolynomialRecipeWith<PositionTemperatureOptions> {
 public:
  PositionTemperatureRecipe(const PositionTemperatureOptions& options,
                            std::string name)
      : PolynomialRecipeWith(options, std::move(name), options.clip),
        form_(FormOf(options.form)) {}

  std::optional<std::string> WhatIsMissing(
      const Dataset& dataset) const override {
    if (form_.uses_position && options_.position.empty() &&
        FindPosition(dataset, "") < 0) {
      return "a position: no input has a name such as position_mm "
             "(position=NAME names one)";
    }
    if (form_.uses_temperature && options_.temperature.empty() &&
        TemperatureCandidates(dataset).empty()) {
      return "a temperature: no input is anything but a position";
    }
    return std::nullopt;
  }

  std::optional<Index> NumCoefficients(const Dataset&) const override {
    return std::ssize(form_.terms) + 1;
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
      columns.push_back(FindPosition(training, options_.position));
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
    if (!options_.temperature.empty()) {
      const Index named = dataset.FindInput(options_.temperature);
      if (named < 0) {
        throw std::invalid_argument("T='" + options_.temperature +
                                    "' is not among the inputs");
      }
      return {named};
    }
    const Index position = FindPosition(dataset, options_.position);
    std::vector<Index> candidates = AllColumns(dataset);
    std::erase_if(candidates, [&](Index i) {
      return i == position ||
             data::IsPosition(dataset.inputs()[static_cast<std::size_t>(i)]);
    });
    return candidates;
  }

  const TermsOfForm& form_;
};

// All terms up to a degree.
class FullRecipe final : public PolynomialRecipeWith<FullOptions> {
 public:
  FullRecipe(const FullOptions& options, std::string name)
      : PolynomialRecipeWith(options, std::move(name), options.clip) {}

  std::optional<Index> NumCoefficients(const Dataset& dataset) const override {
    const auto terms = CountTerms(dataset.num_inputs(), options_.degree);
    return terms ? *terms + 1 : std::numeric_limits<Index>::max();
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    const Index coefficients = *NumCoefficients(training);
    if (coefficients > training.num_rows()) {
      throw std::invalid_argument(fmt::format(
          "degree {} in {} inputs has {} coefficients, more than the {} "
          "training rows",
          options_.degree,
          training.num_inputs(),
          coefficients,
          training.num_rows()));
    }
    return FitTerms(training,
                    AllColumns(training),
                    AllTerms(training.num_inputs(), options_.degree),
                    context);
  }
};

}  // namespace

template <>
const std::vector<ListedModel<ConstantOptions>>& ListedModels() {
  const auto none = [] { return OptionList<ConstantOptions>(); };
  static const std::vector<ListedModel<ConstantOptions>> models = {
      {.name = "zero",
       .about = "no compensation: what the machine does by itself",
       .defaults = {.is_zero = true},
       .options = none},
      {.name = "mean",
       .about = "one offset for all",
       .defaults = {},
       .options = none}};
  return models;
}

template <>
const std::vector<ListedModel<PositionTemperatureOptions>>& ListedModels() {
  using Options = PositionTemperatureOptions;
  static const auto models = [] {
    std::vector<ListedModel<Options>> all;
    for (const TermsOfForm& form : Forms()) {
      const auto list = [&form] {
        OptionList<Options> options;
        if (form.uses_position) {
          options.push_back(
              OptionFor("position", "its column", &Options::position, Words()));
        }
        if (form.uses_temperature) {
          options.push_back(OptionFor(
              "T", "the column of T", &Options::temperature, Words()));
        }
        options.push_back(ClipOption<Options>());
        return options;
      };
      all.push_back({.name = std::string(form.type),
                     .about = std::string(form.about),
                     .defaults = {.form = static_cast<PositionTemperatureForm>(
                                      &form - Forms().data())},
                     .options = list});
    }
    return all;
  }();
  return models;
}

template <>
const std::vector<ListedModel<FullOptions>>& ListedModels() {
  constexpr std::int64_t kMostDegree = 12;
  const auto list = [] {
    OptionList<FullOptions> options = {OptionFor("degree",
                                                 "the highest power of a term",
                                                 &FullOptions::degree,
                                                 IntegerRange{1, kMostDegree})
                                           .Always()};
    options.front().always_in_spec = true;
    options.push_back(ClipOption<FullOptions>());
    return options;
  };
  static const std::vector<ListedModel<FullOptions>> models = {
      {.name = "poly:full",
       .about = "every product of the inputs up to a degree",
       .defaults = {},
       .options = list}};
  return models;
}

std::string_view PositionTemperatureOptions::type() const {
  return FormOf(form).type;
}

void ConstantOptions::Validate() const { ValidateOptions(*this); }
void PositionTemperatureOptions::Validate() const { ValidateOptions(*this); }
void FullOptions::Validate() const { ValidateOptions(*this); }

std::unique_ptr<ModelRecipe> MakeRecipe(const ConstantOptions& options,
                                        std::string name) {
  return std::make_unique<ConstantRecipe>(options, std::move(name));
}

std::unique_ptr<ModelRecipe> MakeRecipe(
    const PositionTemperatureOptions& options, std::string name) {
  return std::make_unique<PositionTemperatureRecipe>(options, std::move(name));
}

std::unique_ptr<ModelRecipe> MakeRecipe(const FullOptions& options,
                                        std::string name) {
  return std::make_unique<FullRecipe>(options, std::move(name));
}

template ConstantOptions OptionsOf(std::string_view spec);
template std::string SpecOf(const ConstantOptions& options);
template PositionTemperatureOptions OptionsOf(std::string_view spec);
template std::string SpecOf(const PositionTemperatureOptions& options);
template FullOptions OptionsOf(std::string_view spec);
template std::string SpecOf(const FullOptions& options);

}  // namespace errmap::models
