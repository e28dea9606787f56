#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/report/tables/report_tables.h"

namespace errmap::report {
namespace {

using models::RegressionRecord;

// A penalised fit has none of it.
models::LeastSquaresRecord LeastSquaresOf(const RegressionRecord& regression) {
  return regression.least_squares.value.value_or(models::LeastSquaresRecord());
}

std::string FigureText(const Cell& figure) {
  return Table{.nothing = "n/a"}.Shown(figure);
}

// "x minus its centre: ..." if the table's terms are of centred inputs.
std::string CentresText(const models::ByName<double>& centres) {
  if (centres.empty()) return "";
  std::string text = " Here an input means its value minus its centre:";
  for (const auto& [name, centre] : centres) {
    text += fmt::format("{} {} {} {:.9g}",
                        text.ends_with(':') ? "" : ",",
                        name,
                        centre < 0.0 ? "+" : "-",
                        std::abs(centre));
  }
  return text + ".";
}

// No map was made without the row that one coefficient follows.
std::string PredictedR2Text(const models::LeastSquaresRecord& fit) {
  const std::int64_t rows = fit.rows_of_leverage_1;
  return rows > 0
             ? fmt::format(
                   "Predicted R2 n/a ({} of leverage 1, {} a coefficient "
                   "to itself)",
                   Count(rows, "row"),
                   rows == 1 ? "which has" : "each with")
             : fmt::format("Predicted R2 {} (PRESS {}; terms taken as given)",
                           FigureText(Fixed{fit.predicted_r2, 6}),
                           FigureText(Number{fit.press, 7}));
}

std::string PenaltyText(const models::PenaltyRecord& fit) {
  const models::PenaltyChoiceRecord& chosen = fit.cross_validation;
  std::string text =
      fmt::format("{:.1f} effective parameters.", fit.effective_parameters);
  if (chosen.penalty.empty() || chosen.mse.empty()) return text;
  return text + fmt::format(
                    " Cross-validation over {}: least RMSE {} among {} "
                    "penalties from {} down to {}.",
                    chosen.holdout,
                    FigureText(Number{
                        std::sqrt(*std::ranges::min_element(chosen.mse)), 5}),
                    chosen.penalty.size(),
                    FigureText(Number{chosen.penalty.front(), 3}),
                    FigureText(Number{chosen.penalty.back(), 3}));
}

}  // namespace

Table StepTable(const RegressionRecord& regression) {
  Table table{.title = "Steps (+ entered, - left, * chosen)"};
  for (const models::StepRecord& step : regression.steps) {
    const bool chosen = std::ssize(table.rows) == regression.chosen_step;
    table.Add({{{"step", false},
                (chosen ? "* " : "  ") +
                    (step.term ? (step.entered ? "+ " : "- ") + *step.term
                               : std::string("(start)"))},
               {{"terms"}, step.terms},
               {{"F"}, Number{step.f, 4}},
               {{"p"}, P{step.p}},
               {{"RSS"}, Number{step.rss, 5}},
               {{"AIC"}, Fixed{step.aic, 3}},
               {{"AICc"}, Fixed{step.aicc, 3}},
               {{"BIC"}, Fixed{step.bic, 3}},
               {{"adj R2"}, Fixed{step.adjusted_r2, 6}},
               {{"PRESS"}, Number{step.press, 5}},
               {{"Cp"}, Number{step.cp, 5}},
               {{"CV"}, Number{step.cv, 5}}});
  }
  table.note = fmt::format(
      "Ended: {}. AIC = n ln(RSS/n) + 2k with k coefficients, as R's step() "
      "has "
      "it; BIC with k ln n; F and p belong to the term that entered or left.",
      regression.ended);
  return table;
}

Table CoefficientTable(const RegressionRecord& regression) {
  const models::LeastSquaresRecord fit = LeastSquaresOf(regression);
  Table table{.title = regression.centres.empty()
                           ? "Coefficients"
                           : "Coefficients, of centred inputs"};
  table.note = "In the target's own unit.";
  if (fit.after_selection) {
    table.note +=
        " The terms were chosen with these same rows: p-values, intervals and "
        "R2 are optimistic.";
  }
  if (regression.penalised.value) {
    table.note +=
        " Shrunken estimates have no valid standard errors or p-values, so "
        "none are shown.";
  }
  if (fit.bootstrap.repetitions > 0) {
    table.note += fmt::format(
        " 'chosen in' is the share of {} bootstrap repetitions (each {} drawn "
        "with replacement) that chose the term.",
        fit.bootstrap.repetitions,
        fit.bootstrap.unit);
  }
  table.note += CentresText(regression.centres);
  for (const models::CoefficientRecord& term : regression.coefficients) {
    const models::TermRecord more =
        term.of_term.value.value_or(models::TermRecord());
    table.Add({{{"term", false}, term.term},
               {{"estimate"}, Number{term.estimate, 9}},
               {{"std. error"}, Number{term.standard_error, 5}},
               {{"t"}, Number{term.t}},
               {{"p"}, P{term.p}},
               {{"95 % from"}, Number{term.ci95[0], 5}},
               {{"95 % to"}, Number{term.ci95[1], 5}},
               {{"standardised"}, Number{more.standardised}},
               {{"VIF"}, Number{more.vif}},
               {{"chosen in, %", true, "share of bootstrap repetitions"},
                Number{kPercent * more.bootstrap_inclusion, 3}}});
  }
  table.SayIfEmpty("The coefficients' statistics were not kept.");
  return table;
}

Table AnovaTable(const RegressionRecord& regression) {
  Table table{.title = "Analysis of variance"};
  table.columns = {{"source", false},
                   {"df"},
                   {"sum of squares"},
                   {"mean square"},
                   {"F"},
                   {"p"}};
  if (!regression.least_squares.value) return table;
  const models::AnovaRecord& anova = regression.least_squares.value->anova;
  const auto df = static_cast<double>(anova.regression_df);
  const auto row = [&](const char* source, double of_df, double sum) {
    table.rows.push_back(
        {source,
         Number{of_df, 12},
         Number{sum, 7},
         Number{of_df > 0.0 ? sum / of_df : models::kNotKnown, 7}});
  };
  row("regression", df, anova.regression_ss);
  table.rows.back().insert(table.rows.back().end(),
                           {Number{anova.f, 6}, P{anova.p}});
  row("residual", anova.residual_df, anova.residual_ss);
  row("total", df + anova.residual_df, anova.total_ss);
  table.rows.back().pop_back();  // no mean square
  return table;
}

Table ExcludedTerms(const RegressionRecord& regression) {
  const auto terms = LeastSquaresOf(regression).excluded;
  Table table{.title = fmt::format("Terms left out ({})", terms.size())};
  constexpr std::size_t kMost = 40;
  for (std::size_t i = 0; i < std::min(terms.size(), kMost); ++i) {
    table.Add({{{"term", false}, terms[i].term},
               {{"F if it entered"}, Number{terms[i].f}},
               {{"p"}, P{terms[i].p}},
               {{"chosen in, %"},
                Number{kPercent * terms[i].bootstrap_inclusion, 3}}});
  }
  if (terms.size() > kMost) {
    table.note = fmt::format(
        "The first {} of {}; all are in results.json.", kMost, terms.size());
  }
  table.SayIfEmpty("No term was left out.");
  return table;
}

Table AliasedTerms(const RegressionRecord& regression) {
  const auto terms = LeastSquaresOf(regression).aliased;
  Table table{.title = fmt::format("Aliased terms ({})", terms.size())};
  table.note = "The terms in the model determine them.";
  for (const auto& term : terms) {
    table.Add({{{"term", false}, term.term}, {{"why", false}, term.why}});
  }
  table.SayIfEmpty("No term is aliased.");
  return table;
}

std::string RegressionSummary(const RegressionRecord& regression,
                              const ErrorText& error) {
  if (regression.penalised.value)
    return PenaltyText(*regression.penalised.value);
  const models::LeastSquaresRecord fit = LeastSquaresOf(regression);
  if (!std::isfinite(fit.s)) return "";
  return fmt::format(
      "s {} on {} degrees of freedom, R2 {}, adjusted R2 {}. {}. Largest "
      "residual {} (row {}), largest leverage {}. Condition number {} (columns "
      "of unit length), effective rank {} of {}.",
      error.WithUnit(fit.s),
      FigureText(Number{fit.anova.residual_df, 12}),
      FigureText(Fixed{fit.r2, 6}),
      FigureText(Fixed{fit.adjusted_r2, 6}),
      PredictedR2Text(fit),
      error.WithUnit(fit.largest_residual),
      fit.largest_residual_row,
      FigureText(Number{fit.largest_leverage, 4}),
      FigureText(Number{fit.condition, 4}),
      fit.effective_rank,
      regression.coefficients.size());
}

std::vector<const ModelRecord*> PolynomialsOf(const ReportView& view) {
  std::vector<const ModelRecord*> all;
  for (const ModelRecord* model : view.models) {
    if (!model->equation && !model->regression) continue;
    if (model->kind == models::ModelKind::kBaseline) continue;
    all.insert(model->name == view.recommended ? all.begin() : all.end(),
               model);
  }
  return all;
}

}  // namespace errmap::report
