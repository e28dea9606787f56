#include "models/polynomial/polynomial_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/text.h"
#include "fitting/interruption.h"
#include "models/history/view.h"
#include "models/polynomial/polynomial_model.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

using data::Dataset;
constexpr Index kRowsAtATime = 4096;

// The terms that the solution left out, with a word on why for the first.
std::vector<AliasedRecord> NameAliased(
    const std::vector<std::string>& names,
    const DesignRows& rows,
    const fitting::LeastSquaresFit& solution) {
  constexpr std::size_t kMostExplained = 10;
  std::vector<Index> kept;
  std::vector<std::string> kept_names;
  for (Index j = 0; j < rows.terms.cols(); ++j) {
    if (std::binary_search(
            solution.aliased.begin(), solution.aliased.end(), j + 1)) {
      continue;
    }
    kept.push_back(j);
    kept_names.push_back(names[static_cast<std::size_t>(j)]);
  }
  const MatrixXd others = rows.terms(Eigen::all, kept);
  std::vector<AliasedRecord> aliased;
  for (const Index column : solution.aliased) {
    const Index term = column - 1;
    if (term < 0) continue;  // there is no intercept
    aliased.push_back(
        {names[static_cast<std::size_t>(term)],
         aliased.size() < kMostExplained
             ? WhyAliased(
                   rows.terms.col(term), others, kept_names, rows.intercept)
             : "follows from the other terms"});
  }
  return aliased;
}

// "a, b and 3 more".
std::string FirstOf(std::vector<std::string> names) {
  constexpr std::size_t kMostNamed = 5;
  const std::size_t more = names.size() - std::min(names.size(), kMostNamed);
  names.resize(names.size() - more);
  return fmt::format("{}{}",
                     data::JoinWords(names, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

// The second pass: what needs every row.
fitting::RowDiagnostics JudgeRows(const PolynomialDesign& design,
                                  const fitting::RegressionDiagnostics& fit) {
  fitting::RowDiagnostics judged;
  const Dataset& dataset = design.dataset();
  for (Index first = 0; first < design.rows(); first += kRowsAtATime) {
    fitting::ThrowIfInterrupted();
    const Index count = std::min(kRowsAtATime, design.rows() - first);
    const bool weighted = dataset.weights().size() != 0;
    judged.Add(fit,
               design.Rows(first, count),
               dataset.target_values().segment(first, count),
               weighted ? VectorXd(dataset.weights().segment(first, count))
                        : VectorXd());
  }
  return judged;
}

struct Solved {
  DesignRows rows;
  fitting::LeastSquaresFit solution;
};

Solved SolveRows(const PolynomialDesign& design,
                 const FormOptions& form_options,
                 const FitContext& context) {
  Solved solved{CollectRows(design, {}, context), {}};
  DesignRows& rows = solved.rows;
  const bool are_observations = rows.are_observations();
  if (!form_options.intercept) rows.intercept.setZero(rows.response.size());
  // Always the same, so that the same rows give the same bits.
  constexpr double kDigits = 13.0;
  fitting::LeastSquaresOptions options;
  if (are_observations) {
    options.digits = kDigits;
    options.with_deviations = context.explain;
    options.exact = [&] { return design.Exact(); };
  }
  options.noise = [&](const VectorXd& combination) {
    const double noise = design.Noise(combination);
    if (are_observations) return noise;
    // A triangle's entries are rounded by its reduction, too.
    constexpr double kReduction = 16.0 * std::numeric_limits<double>::epsilon();
    const VectorXd parts =
        combination.tail(rows.terms.cols())
            .cwiseProduct(rows.terms.colwise().norm().transpose());
    return noise + kReduction * parts.norm();
  };
  solved.solution = fitting::SolveRegression(rows.Problem(), options);
  return solved;
}

// Uses a triangle if there are too many rows to refine digits; but the rows
// decide which terms follow from others.
Solved Solve(const PolynomialDesign& design,
             const FormOptions& form_options,
             const FitContext& context) {
  const auto terms = static_cast<double>(design.num_terms());
  const double rank = terms + (form_options.intercept ? 1.0 : 0.0);
  const FitContext preferring = PreferTriangle(
      design, fitting::kMostRefinedValues * terms / rank, context);
  Solved solved = SolveRows(design, form_options, preferring);
  // An intercept that is not there follows from anything.
  const std::size_t no_terms = form_options.intercept ? 0 : 1;
  const bool all_clear = solved.solution.aliased.size() <= no_terms &&
                         solved.solution.nearly_aliased.empty();
  if (all_clear ||
      preferring.most_design_values == context.most_design_values) {
    return solved;
  }
  return SolveRows(design, form_options, context);
}

void FillLeastSquares(const fitting::RegressionDiagnostics& fit,
                      const fitting::RowDiagnostics& rows,
                      LeastSquaresRecord* record) {
  record->anova = {.regression_df = fit.regression_degrees_of_freedom(),
                   .regression_ss = fit.regression_sum_of_squares,
                   .residual_df = fit.residual_degrees_of_freedom,
                   .residual_ss = fit.residual_sum_of_squares,
                   .total_ss = fit.total_sum_of_squares,
                   .f = fit.f,
                   .p = fit.f_p};
  record->s = fit.s;
  record->r2 = fit.r2;
  record->adjusted_r2 = fit.adjusted_r2;
  record->press = rows.press;
  record->predicted_r2 = rows.PredictedR2(fit);
  record->rows_of_leverage_1 = rows.leverage_one;
  record->largest_residual = rows.largest_residual;
  record->largest_residual_row = rows.largest_residual_row;
  record->largest_leverage = rows.largest_leverage;
  record->condition = fit.condition;
  record->effective_rank = fit.effective_rank;
  record->bits = fit.bits;
}

CoefficientRecord CoefficientOf(const std::string& term,
                                const fitting::CoefficientEstimate& fit,
                                double factor) {
  return {.term = term,
          .estimate = factor * fit.estimate,
          .standard_error = factor * fit.standard_error,
          .t = fit.t,
          .p = fit.p,
          .ci95 = {factor * fit.lower, factor * fit.upper},
          .of_term = {}};
}

// Result of fitting terms.
struct FittedTerms {
  PolynomialForm form;               // of those that are not aliased
  std::vector<std::string> aliased;  // left out: they follow from others
  std::vector<std::string> nearly;   // kept, though they all but do
};

FittedTerms TermsOf(const PolynomialDesign& design,
                    const std::vector<TermPowers>& terms,
                    const fitting::LeastSquaresFit& solution) {
  const std::vector<std::string> names = design.TermNames();
  FittedTerms kept;
  kept.form = {design.scaling().offset,
               design.scaling().scale,
               solution.coefficients[0],
               {}};
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Index column = static_cast<Index>(i) + 1;
    const auto is_among = [&](const std::vector<Index>& columns) {
      return std::binary_search(columns.begin(), columns.end(), column);
    };
    if (is_among(solution.aliased)) {
      kept.aliased.push_back(names[i]);
    } else {
      kept.form.terms.push_back({terms[i], solution.coefficients[column]});
      if (is_among(solution.nearly_aliased)) kept.nearly.push_back(names[i]);
    }
  }
  return kept;
}

void RemarkOnTerms(const FittedTerms& kept,
                   std::size_t num_terms,
                   const fitting::LeastSquaresFit& solution,
                   const DesignRows& rows,
                   FittedModel* fitted) {
  constexpr double kFewRowsToSpare = 10.0;
  const double to_spare =
      rows.observations - static_cast<double>(solution.rank);
  if (to_spare < kFewRowsToSpare) {
    fitted->remarks.push_back(
        fmt::format("{} coefficients leave only {} of {} rows to estimate the "
                    "error: the fit says little about other rows",
                    solution.rank,
                    to_spare,
                    rows.observations));
  }
  if (!kept.aliased.empty()) {
    fitted->remarks.push_back(fmt::format(
        "{} of {} terms follow from the others in the training rows and "
        "are left out: {}",
        kept.aliased.size(),
        num_terms,
        FirstOf(kept.aliased)));
  }
  if (!kept.nearly.empty()) {
    fitted->remarks.push_back(
        fmt::format("{} of {} terms nearly follow from the others and were "
                    "distinguished in 106 bits: {}",
                    kept.nearly.size(),
                    num_terms,
                    FirstOf(kept.nearly)));
  }
}

// Returns true if a plane has an input that only grows.
bool GrowsStraight(const PolynomialForm& form,
                   const std::vector<TrainedInput>& inputs,
                   const Dataset& training) {
  for (const PolynomialTerm& term : form.terms) {
    if (std::accumulate(term.powers.begin(), term.powers.end(), 0) > 1) {
      return false;
    }
  }
  const std::vector<bool> only_grow = ColumnsThatOnlyGrow(training);
  return std::ranges::any_of(inputs, [&](const TrainedInput& input) {
    return only_grow[static_cast<std::size_t>(
        training.FindInput(input.column.name))];
  });
}

}  // namespace

std::vector<Index> AllColumns(const Dataset& dataset) {
  return stats::AllIndices(dataset.num_inputs());
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

FittedModel PolynomialRecipe::FitTerms(const Dataset& training,
                                       const std::vector<Index>& inputs,
                                       const std::vector<TermPowers>& terms,
                                       const FitContext& context,
                                       const FormOptions& form_options,
                                       RegressionRecord* report) const {
  const Index coefficients =
      std::ssize(terms) + (form_options.intercept ? 1 : 0);
  if (training.num_rows() < coefficients) {
    throw std::invalid_argument(
        fmt::format("{} coefficients cannot be fitted to {} rows",
                    coefficients,
                    training.num_rows()));
  }
  const PolynomialDesign design(
      training,
      inputs,
      PolynomialScaling(training, inputs, terms, form_options.centring),
      terms);
  const Solved solved = Solve(design, form_options, context);
  const DesignRows& rows = solved.rows;
  const fitting::LeastSquaresFit& solution = solved.solution;

  FittedModel fitted = NewMap(name_, kind(), training);
  fitted.inputs = DescribeInputs(training, inputs);
  FittedTerms kept = TermsOf(design, terms, solution);
  PolynomialForm& form = kept.form;
  RemarkOnTerms(kept, terms.size(), solution, rows, &fitted);
  fitted.summary.message =
      fmt::format("solved by QR in {} bits", solution.bits);
  fitted.summary.final_cost = 0.5 * solution.residual_sum_of_squares;
  fitted.equation = EquationText(
      form,
      fitted.target,
      fitted.inputs,
      std::sqrt(solution.residual_sum_of_squares / rows.observations));
  if (guarded_) {
    fitted.guards =
        MakeClampLimits(fitted.inputs,
                        training.target_values(),
                        GrowsStraight(form, fitted.inputs, training));
  }
  fitted.model =
      std::make_shared<PolynomialModel>(std::move(form), solution.rank);

  if (context.explain) {
    auto complete = std::make_shared<RegressionRecord>();
    if (report != nullptr) *complete = std::move(*report);
    if (complete->method.empty()) complete->method = "least squares";
    const fitting::RegressionDiagnostics fit =
        fitting::Diagnose(rows.Problem(), solution);
    FillCoefficientTable(design, fit, complete.get());
    auto& of_rows = complete->least_squares.value;
    if (!of_rows) of_rows.emplace();
    FillLeastSquares(fit, JudgeRows(design, fit), &*of_rows);
    for (AliasedRecord& alias :
         NameAliased(design.TermNames(), rows, solution)) {
      of_rows->aliased.push_back(std::move(alias));
    }
    constexpr double kWorthSaying = 1e8;
    if (fit.condition > kWorthSaying) {
      fitted.remarks.push_back(fmt::format(
          "condition number {:.2g}: single coefficients follow the last digits "
          "of the data; trust predictions inside the data only",
          fit.condition));
    }
    fitted.regression = std::move(complete);
  }
  return fitted;
}

std::string WhyAliased(const VectorXd& column,
                       const MatrixXd& others,
                       const std::vector<std::string>& names,
                       const VectorXd& intercept) {
  const fitting::AliasRelation relation =
      fitting::ExplainAlias(column, others, intercept);
  if (relation.constant) return "is constant";
  constexpr std::size_t kMostNamed = 4;
  std::vector<std::string> parts;
  for (const Index part : relation.columns) {
    if (parts.size() == kMostNamed) {
      parts.push_back("...");
      break;
    }
    parts.push_back(names[static_cast<std::size_t>(part)]);
  }
  return fmt::format("{} {}",
                     parts.size() == 1 ? "repeats" : "follows from",
                     data::JoinWords(parts, ", "));
}

void FillCoefficientTable(const PolynomialDesign& design,
                          const fitting::RegressionDiagnostics& fit,
                          RegressionRecord* report) {
  const std::vector<std::string> names = design.TermNames();
  const std::vector<CoefficientRecord> known =
      std::exchange(report->coefficients, {});
  if (fit.has_intercept) {
    report->coefficients.push_back(
        CoefficientOf("(intercept)", fit.intercept, 1.0));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    // From scaled inputs to the inputs' units: a factor per power.
    double factor = 1.0;
    for (std::size_t input = 0; input < design.terms()[i].size(); ++input) {
      factor *= std::pow(design.scaling().scale[static_cast<Index>(input)],
                         design.terms()[i][input]);
    }
    const fitting::CoefficientEstimate& estimate = fit.coefficients[i];
    report->coefficients.push_back(CoefficientOf(names[i], estimate, factor));
    TermRecord& term = report->coefficients.back().of_term.value.emplace();
    if (i < known.size()) term = *known[i].of_term.value;
    term.standardised = estimate.standardised;
    term.vif = estimate.vif;
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

}  // namespace errmap::models
