#include "models/polynomial_recipe.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fitting/linear_least_squares.h"
#include "fitting/stepwise_selection.h"
#include "models/polynomial_basis.h"
#include "models/polynomial_model.h"
#include "models/scaling.h"
#include "stats/summary.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;

constexpr int kMostDegree = 12;

std::vector<Index> AllColumns(const Dataset& dataset) {
  std::vector<Index> columns(static_cast<std::size_t>(dataset.num_inputs()));
  std::iota(columns.begin(), columns.end(), Index{0});
  return columns;
}

std::vector<std::string> NamesOf(const std::vector<TrainedInput>& inputs) {
  std::vector<std::string> names;
  for (const TrainedInput& input : inputs) names.push_back(input.column.name);
  return names;
}

// The part that every recipe shares: name and options of its spec.
class PolynomialRecipe : public ModelRecipe {
 public:
  explicit PolynomialRecipe(std::string name) : name_(std::move(name)) {}
  std::string name() const override { return name_; }
  ModelKind kind() const override { return ModelKind::kPolynomial; }
  std::vector<EffectiveOption> options() const override { return {}; }
  std::optional<std::string> WhatIsMissing(
      const Dataset& /*dataset*/) const override {
    return std::nullopt;
  }

 protected:
  FittedModel NewModel(const Dataset& training) const {
    FittedModel fitted;
    fitted.name = name_;
    fitted.kind = kind();
    fitted.target = training.target();
    fitted.summary.termination = fitting::Termination::kDirect;
    fitted.summary.message = "solved by pivoted QR";
    return fitted;
  }

  // Least squares of intercept and `terms` in the given columns of `training`.
  FittedModel FitTerms(const Dataset& training,
                       const std::vector<Index>& columns,
                       const std::vector<TermPowers>& terms) const {
    const Index rows = training.num_rows();
    const Index coefficients = static_cast<Index>(terms.size()) + 1;
    if (rows < coefficients) {
      throw std::invalid_argument(fmt::format(
          "{} coefficients cannot be fitted to {} rows", coefficients, rows));
    }
    Eigen::MatrixXd inputs(rows, static_cast<Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) {
      inputs.col(static_cast<Index>(i)) =
          training.input_values().col(columns[i]);
    }
    const ColumnScaling scaling = CentredRangeScaling(inputs);
    Eigen::MatrixXd design(rows, coefficients);
    design.col(0).setOnes();
    design.rightCols(coefficients - 1) =
        TermMatrix(scaling.Apply(inputs), terms);
    const fitting::LeastSquaresFit solution = fitting::SolveLeastSquares(
        design, training.target_values(), training.weights());

    FittedModel fitted = NewModel(training);
    fitted.inputs = DescribeInputs(training, columns);
    const std::vector<std::string> names = NamesOf(fitted.inputs);
    PolynomialForm form{
        scaling.offset, scaling.scale, solution.coefficients[0], {}};
    std::vector<std::string> aliased;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const Index column = static_cast<Index>(i) + 1;
      if (std::binary_search(
              solution.aliased.begin(), solution.aliased.end(), column)) {
        aliased.push_back(TermName(terms[i], names));
      } else {
        form.terms.push_back({terms[i], solution.coefficients[column]});
      }
    }
    if (!solution.aliased.empty()) {
      constexpr std::size_t kMostNamed = 5;
      const std::size_t more =
          aliased.size() - std::min(aliased.size(), kMostNamed);
      aliased.resize(aliased.size() - more);
      fitted.remarks.push_back(fmt::format(
          "{} of {} terms follow from the others in the training rows and "
          "are left out: {}{}",
          solution.aliased.size(),
          terms.size(),
          fmt::join(aliased, ", "),
          more > 0 ? fmt::format(" and {} more", more) : ""));
    }
    fitted.summary.final_cost = 0.5 * solution.residual_sum_of_squares;
    fitted.equation = EquationText(form, fitted.target.name, names);
    fitted.model =
        std::make_shared<PolynomialModel>(std::move(form), solution.rank);
    return fitted;
  }

 private:
  std::string name_;
};

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
                  const FitContext& /*context*/) const override {
    if (!is_zero_) return FitTerms(training, {}, {});
    FittedModel fitted = NewModel(training);
    fitted.summary.message = "nothing to fit";
    PolynomialForm form;
    fitted.equation = EquationText(form, fitted.target.name, {});
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
                  const FitContext& /*context*/) const override {
    if (const auto missing = WhatIsMissing(training)) {
      throw std::invalid_argument("the data lack " + *missing);
    }
    std::vector<Index> columns;
    if (form_.uses_position) {
      columns.push_back(FindPosition(training, position_));
    }
    if (!form_.uses_temperature) {
      return FitTerms(training, columns, form_.terms);
    }
    std::optional<FittedModel> best;
    columns.push_back(-1);
    for (const Index candidate : TemperatureCandidates(training)) {
      columns.back() = candidate;
      FittedModel fitted = FitTerms(training, columns, form_.terms);
      if (!best || fitted.summary.final_cost < best->summary.final_cost) {
        best = std::move(fitted);
      }
    }
    return *std::move(best);
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
                  const FitContext& /*context*/) const override {
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
                    AllTerms(training.num_inputs(), degree_));
  }

 private:
  int degree_;
};

// Terms up to a degree, chosen one by one by BIC.
class StepwiseRecipe final : public PolynomialRecipe {
 public:
  explicit StepwiseRecipe(const ModelSpec& spec) : PolynomialRecipe(spec.text) {
    constexpr std::int64_t kByNumberOfInputs = 0;
    SpecOptions options(spec);
    degree_ = static_cast<int>(
        options.TakeInteger("degree", kByNumberOfInputs, 1, 4));
    options.RefuseOthers();
  }

  std::vector<EffectiveOption> options() const override {
    std::vector<EffectiveOption> options{{"criterion", std::string("bic")},
                                         {"direction", std::string("forward")}};
    if (degree_ > 0) options.push_back({"degree", std::int64_t{degree_}});
    return options;
  }

  std::optional<Index> NumCoefficients(const Dataset&) const override {
    return std::nullopt;
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& /*context*/) const override {
    const int degree = DegreeFor(training.num_inputs());
    RequireMemory(training, degree);
    if (training.num_rows() < 3) {
      throw std::invalid_argument(
          fmt::format("needs at least 3 rows, found {}", training.num_rows()));
    }
    const std::vector<TermPowers> candidates =
        AllTerms(training.num_inputs(), degree);
    const ColumnScaling scaling = CentredRangeScaling(training.input_values());
    const fitting::SelectionResult selection = fitting::SelectForward(
        TermMatrix(scaling.Apply(training.input_values()), candidates),
        training.target_values(),
        training.weights());
    // The map reads only the inputs that a chosen term has.
    std::vector<Index> columns;
    for (Index input = 0; input < training.num_inputs(); ++input) {
      const bool used = std::any_of(
          selection.chosen.begin(), selection.chosen.end(), [&](Index term) {
            return candidates[static_cast<std::size_t>(term)]
                             [static_cast<std::size_t>(input)] > 0;
          });
      if (used) columns.push_back(input);
    }
    std::vector<TermPowers> terms;
    for (const Index chosen : selection.chosen) {
      const TermPowers& all = candidates[static_cast<std::size_t>(chosen)];
      TermPowers powers;
      for (const Index column : columns) {
        powers.push_back(all[static_cast<std::size_t>(column)]);
      }
      terms.push_back(std::move(powers));
    }
    FittedModel fitted = FitTerms(training, columns, terms);
    fitted.summary.message = fmt::format(
        "{} of {} candidate terms up to degree {} chosen by forward BIC",
        terms.size(),
        candidates.size(),
        degree);
    return fitted;
  }

 private:
  int DegreeFor(Index num_inputs) const {
    constexpr Index kFewInputs = 8;
    if (degree_ > 0) return degree_;
    return num_inputs <= kFewInputs ? 3 : 2;
  }

  static void RequireMemory(const Dataset& training, int degree) {
    constexpr double kMostValues = 1.25e8;  // 1 GB of candidates
    const auto terms = CountTerms(training.num_inputs(), degree);
    const double values = terms ? static_cast<double>(*terms) *
                                      static_cast<double>(training.num_rows())
                                : std::numeric_limits<double>::infinity();
    if (values > kMostValues) {
      throw std::invalid_argument(fmt::format(
          "degree {} in {} inputs makes {} candidate terms, too many to hold "
          "for {} rows; use a lower degree or fewer inputs",
          degree,
          training.num_inputs(),
          terms ? std::to_string(*terms) : "countless",
          training.num_rows()));
    }
  }

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
  if (spec.type == "poly:stepwise") {
    return std::make_unique<StepwiseRecipe>(spec);
  }
  return nullptr;
}

}  // namespace errmap::models
