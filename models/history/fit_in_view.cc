#include "models/history/fit_in_view.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fitting/interruption.h"
#include "models/history/with_history.h"
#include "models/inner_folds.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

using data::Dataset;
// Root of the TypicalError of `fit` on rows of one view; NaN if a fold cannot
// be fitted.
double HeldOutError(const Dataset& rows,
                    const FitContext& context,
                    const FitRows& fit) {
  const InnerFolds inner = MakeInnerFolds(rows, context);
  const std::vector<fitting::FoldCodes::Rows> splits = inner.folds.Splits();
  VectorXd squares(std::ssize(splits));
  VectorXd sizes(std::ssize(splits));
  Index fold = 0;
  for (const fitting::FoldCodes::Rows& split : splits) {
    if (fitting::IsInterrupted()) return stats::kNaN;
    const Dataset test = rows.SelectRows(split.test);
    try {
      const FittedModel fitted = fit(rows.SelectRows(split.train), context);
      squares[fold] =
          (test.target_values() - fitted.Predict(test)).squaredNorm();
    } catch (const std::invalid_argument&) {
      return stats::kNaN;
    }
    sizes[fold++] = static_cast<double>(test.num_rows());
  }
  return TypicalRmse(inner, squares, sizes, context.indifference);
}

}  // namespace

void NoteView(const ViewedRows& viewed, FittedModel* fitted) {
  fitted->choices.push_back({"view", std::string(ToString(viewed.view))});
  if (viewed.sine_and_cosine) {
    fitted->choices.push_back({"angles", std::string("sincos")});
  }
}

FittedModel FitInView(const Dataset& training,
                      const std::optional<ViewOptions>& options,
                      const FitContext& context,
                      const FitRows& fit) {
  if (!options) return fit(training, context);
  const auto shared = SharedViews(training, *options, context);
  const std::vector<ViewedRows>& views = *shared;
  const ViewedRows* chosen = &views.front();
  std::string tried;
  double least = stats::kNaN;
  if (views.size() > 1) {
    FitContext inner = context;
    inner.explain = false;
    inner.keep_trace = false;
    inner.shared = nullptr;
    for (const ViewedRows& viewed : views) {
      const double error = HeldOutError(*viewed.rows, inner, fit);
      tried += fmt::format(
          "{}{}: {:.4g}", tried.empty() ? "" : ", ", viewed.label(), error);
      if (error < least || std::isnan(least)) {
        least = error;
        chosen = &viewed;
      }
    }
  }
  FittedModel fitted = fit(*chosen->rows, context);
  fitted.inner_rmse = least;
  NoteView(*chosen, &fitted);
  if (!tried.empty()) {
    fitted.remarks.push_back(fmt::format(
        "view {} by inner hold-outs (tried {})", chosen->label(), tried));
  }
  if (chosen->history == nullptr || fitted.inputs.empty()) return fitted;
  return WithHistory(std::move(fitted), training, *chosen->history);
}

}  // namespace errmap::models
