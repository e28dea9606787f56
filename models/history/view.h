#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/history.h"

namespace errmap::models {

/// Form in which a map reads its inputs. Positions are unchanged in every view.
enum class View {
  kRaw,             // as measured
  kHistory,         // and passed through first-order filters
  kZero,            // minus their values in the first row
  kHistoryAndZero,  // inputs and filtered inputs minus those
};
/// Returns "raw", "history", "zero", "history+zero": values of view=, in order.
const std::vector<std::string>& ViewWords();
std::string_view ToString(View view);
View ViewOf(std::string_view word);  // of one of these words

/// Options of a map that may transform its inputs.
struct ViewOptions {
  std::optional<View> view = {};  // empty: chosen on inner hold-outs
  /// Time constants of the filters, above 0, in the unit of time. Empty: from
  /// MakeTimeConstants; an empty list: views with filters are not offered.
  std::optional<std::vector<double>> time_constants = {};
  /// False: views with a zero are not offered.
  bool zero = true;
  /// False: no intercept in any view. True: an intercept, except in a zeroed
  /// view if each session begins with a negligible error.
  bool intercept = true;
  /// True: sine and cosine replace angles. Empty: chosen with the view if an
  /// angle turns far enough; otherwise angles stay.
  std::optional<bool> sine_and_cosine = {};

  bool operator==(const ViewOptions&) const = default;
};

/// Training rows in one view.
struct ViewedRows {
  View view = View::kRaw;
  bool sine_and_cosine = false;            // instead of angles
  std::shared_ptr<const History> history;  // null: the rows as measured
  std::shared_ptr<const data::Dataset> rows;
  std::vector<bool> is_position;  // (inputs of rows)
  std::vector<bool> only_grows;   // likewise: ColumnsThatOnlyGrow
  bool intercept = true;

  std::string label() const;  // "history+zero", "raw with sine and cosine"
  bool grows() const { return std::ranges::count(only_grows, true) > 0; }
};

/// Returns the views of `options` that these rows allow, simplest first;
/// without options, only the rows as measured. Filters and zeros need an input
/// besides positions. Filters also need sessions of some length, and zeros two
/// sessions or more. With filters, a zero alone is offered only if it was
/// named. Throws std::invalid_argument if a view requested by name is not
/// possible.
std::vector<ViewedRows> MakeViews(const data::Dataset& training,
                                  const std::optional<ViewOptions>& options,
                                  double indifference);

/// Returns the same for the fitted rows, shared through context.shared with
/// other recipes that use them at the same time.
std::shared_ptr<const std::vector<ViewedRows>> SharedViews(
    const data::Dataset& training,
    const std::optional<ViewOptions>& options,
    const FitContext& context);

/// Returns the median session length of `training` / 100, / 30 and / 10, for
/// use as default time constants. Empty if sessions have none.
std::vector<double> MakeTimeConstants(const data::Dataset& training);

/// Returns the largest size of the target in the first rows of sessions, for
/// those in `training`; NaN if it has none.
double LargestFirstError(const data::Dataset& training);

/// Returns, for each input of `rows`, true if it hardly ever returns to earlier
/// values, as with an age. With three sessions or more, their means only rise
/// or only fall. On average less than a tenth of a later session's rows is
/// within earlier values. Later measurements lie beyond the earlier ones, so a
/// map is linear in these inputs.
std::vector<bool> ColumnsThatOnlyGrow(const data::Dataset& rows);

}  // namespace errmap::models
