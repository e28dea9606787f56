#include "models/polynomial/polynomial_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "fitting/least_squares/linear_least_squares.h"
#include "models/polynomial/polynomial_model.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kBlockRows = 4096;

std::vector<std::string> InputNames(const std::vector<TrainedInput>& inputs) {
  std::vector<std::string> names;
  for (const TrainedInput& input : inputs) names.push_back(input.column.name);
  return names;
}

fitting::LeastSquaresFit Solve(const DesignRows& rows) {
  MatrixXd design(rows.terms.rows(), rows.terms.cols() + 1);
  if (rows.are_observations()) {
    design.col(0).setOnes();
  } else {
    design.col(0) = rows.intercept;
  }
  design.rightCols(rows.terms.cols()) = rows.terms;
  return fitting::SolveLeastSquares(design, rows.response, rows.weights);
}

// The second pass: what needs every row.
fitting::RowDiagnostics JudgeRows(const PolynomialDesign& design,
                                  const fitting::RegressionDiagnostics& fit) {
  fitting::RowDiagnostics judged;
  const Dataset& dataset = design.dataset();
  for (Index first = 0; first < design.rows(); first += kBlockRows) {
    const Index count = std::min(kBlockRows, design.rows() - first);
    const bool weighted = dataset.weights().size() != 0;
    judged.Add(fit,
               design.Rows(first, count),
               dataset.target_values().segment(first, count),
               weighted ? VectorXd(dataset.weights().segment(first, count))
                        : VectorXd());
  }
  return judged;
}

FittedModel NewMap(const std::string& name, const Dataset& training) {
  FittedModel fitted;
  fitted.name = name;
  fitted.kind = ModelKind::kPolynomial;
  fitted.target = training.target();
  fitted.align = training.align();
  fitted.summary.termination = fitting::Termination::kDirect;
  fitted.summary.message = "solved by pivoted QR";
  return fitted;
}

}  // namespace

std::vector<Index> AllColumns(const Dataset& dataset) {
  std::vector<Index> columns(static_cast<std::size_t>(dataset.num_inputs()));
  std::iota(columns.begin(), columns.end(), Index{0});
  return columns;
}

UsedTerms KeepUsedInputs(const std::vector<TermPowers>& terms,
                         const std::vector<Index>& chosen) {
  UsedTerms used;
  const std::size_t num_inputs = terms.empty() ? 0 : terms.front().size();
  for (std::size_t input = 0; input < num_inputs; ++input) {
    const bool is_used =
        std::any_of(chosen.begin(), chosen.end(), [&](Index term) {
          return terms[static_cast<std::size_t>(term)][input] > 0;
        });
    if (is_used) used.inputs.push_back(static_cast<Index>(input));
  }
  for (const Index term : chosen) {
    TermPowers powers;
    for (const Index input : used.inputs) {
      powers.push_back(terms[static_cast<std::size_t>(term)]
                            [static_cast<std::size_t>(input)]);
    }
    used.terms.push_back(std::move(powers));
  }
  return used;
}

FittedModel PolynomialRecipe::NewModel(const Dataset& training) const {
  FittedModel fitted = NewMap(name_, training);
  fitted.kind = kind();
  return fitted;
}

FittedModel PolynomialRecipe::FitTerms(const Dataset& training,
                                       const std::vector<Index>& inputs,
                                       const std::vector<TermPowers>& terms,
                                       const FitContext& context,
                                       Centring centring,
                                       RegressionReport* report) const {
  const Index coefficients = static_cast<Index>(terms.size()) + 1;
  if (training.num_rows() < coefficients) {
    throw std::invalid_argument(
        fmt::format("{} coefficients cannot be fitted to {} rows",
                    coefficients,
                    training.num_rows()));
  }
  const PolynomialDesign design(
      training,
      inputs,
      PolynomialScaling(training, inputs, terms, centring),
      terms);
  const DesignRows rows =
      CollectRows(design, {}, context.most_design_values, context.threads);
  const fitting::LeastSquaresFit solution = Solve(rows);

  FittedModel fitted = NewModel(training);
  fitted.inputs = DescribeInputs(training, inputs);
  const std::vector<std::string> names = InputNames(fitted.inputs);
  PolynomialForm form{design.scaling().offset,
                      design.scaling().scale,
                      solution.coefficients[0],
                      {}};
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
  fitted.equation = EquationText(
      form,
      fitted.target,
      fitted.inputs,
      std::sqrt(solution.residual_sum_of_squares / rows.observations));
  fitted.model =
      std::make_shared<PolynomialModel>(std::move(form), solution.rank);

  if (context.explain) {
    auto complete = std::make_shared<RegressionReport>();
    if (report != nullptr) *complete = std::move(*report);
    if (complete->method.empty()) complete->method = "least squares";
    complete->fit = fitting::Diagnose({rows.terms,
                                       rows.response,
                                       rows.weights,
                                       rows.intercept,
                                       rows.observations});
    complete->rows = JudgeRows(design, complete->fit);
    complete->weighted = training.weights().size() != 0;
    FillCoefficientTable(design, complete.get());
    for (const Index alias : complete->fit.aliased) {
      complete->aliased.push_back(
          {complete->terms[static_cast<std::size_t>(alias)].name,
           "follows from the other terms"});
    }
    fitted.regression = std::move(complete);
  }
  return fitted;
}

void FillCoefficientTable(const PolynomialDesign& design,
                          RegressionReport* report) {
  const std::vector<std::string> names = design.TermNames();
  report->intercept.name = "(intercept)";
  report->intercept.numbers = report->fit.intercept;
  std::vector<double> inclusion;
  for (const ReportTerm& term : report->terms) {
    inclusion.push_back(term.inclusion);
  }
  report->terms.clear();
  for (std::size_t i = 0; i < names.size(); ++i) {
    // From scaled inputs to the inputs' units: a factor per power.
    double factor = 1.0;
    for (std::size_t input = 0; input < design.terms()[i].size(); ++input) {
      factor *= std::pow(design.scaling().scale[static_cast<Index>(input)],
                         design.terms()[i][input]);
    }
    ReportTerm term{names[i], report->fit.coefficients[i]};
    term.numbers.estimate *= factor;
    term.numbers.standard_error *= factor;
    term.numbers.lower *= factor;
    term.numbers.upper *= factor;
    if (i < inclusion.size()) term.inclusion = inclusion[i];
    report->terms.push_back(std::move(term));
  }
  report->centres.clear();
  for (std::size_t i = 0; i < design.inputs().size(); ++i) {
    const auto column = static_cast<std::size_t>(design.inputs()[i]);
    const double offset = design.scaling().offset[static_cast<Index>(i)];
    if (offset != 0.0) {
      report->centres.emplace_back(design.dataset().inputs()[column].name,
                                   offset);
    }
  }
}

FittedModel MapOfTerms(const std::string& name,
                       const PolynomialDesign& design,
                       double intercept,
                       const VectorXd& coefficients) {
  std::vector<Index> chosen;
  for (Index j = 0; j < coefficients.size(); ++j) {
    if (coefficients[j] != 0.0) chosen.push_back(j);
  }
  const UsedTerms used = KeepUsedInputs(design.terms(), chosen);
  FittedModel fitted = NewMap(name, design.dataset());
  std::vector<Index> columns;
  PolynomialForm form{VectorXd(static_cast<Index>(used.inputs.size())),
                      VectorXd(static_cast<Index>(used.inputs.size())),
                      intercept,
                      {}};
  for (std::size_t i = 0; i < used.inputs.size(); ++i) {
    const Index input = used.inputs[i];
    columns.push_back(design.inputs()[static_cast<std::size_t>(input)]);
    form.input_offset[static_cast<Index>(i)] = design.scaling().offset[input];
    form.input_scale[static_cast<Index>(i)] = design.scaling().scale[input];
  }
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    form.terms.push_back({used.terms[i], coefficients[chosen[i]]});
  }
  fitted.inputs = DescribeInputs(design.dataset(), columns);
  const Index parameters = static_cast<Index>(chosen.size()) + 1;
  fitted.model = std::make_shared<PolynomialModel>(form, parameters);
  const VectorXd residual =
      design.dataset().target_values() - fitted.Predict(design.dataset());
  fitted.equation = EquationText(
      form,
      fitted.target,
      fitted.inputs,
      std::sqrt(residual.squaredNorm() / static_cast<double>(design.rows())));
  return fitted;
}

}  // namespace errmap::models
