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

/// Which form of the inputs a map reads. Positions stay as they are in each.
enum class View {
  kRaw,             // as measured
  kHistory,         // and passed through first-order filters
  kZero,            // less their values in the session's first row
  kHistoryAndZero,  // both: inputs and filtered inputs less those values
};
/// "raw", "history", "zero", "history+zero": the words of view=, in this order.
const std::vector<std::string>& ViewWords();
std::string_view ToString(View view);
View ViewOf(std::string_view word);  // of one of these words

/// Of a map that may see its inputs in another form than measured.
struct ViewOptions {
  std::optional<View> view = {};  // empty: chosen on inner hold-outs
  /// Of the filters, above 0, in the unit of time; empty: MakeTimeConstants; an
  /// empty list: no view with filters is among those to choose from.
  std::optional<std::vector<double>> time_constants = {};
  /// Whether views with a zero are among those to choose from.
  bool zero = true;
  /// False: a map in a zeroed view never has one; else it has none where each
  /// session begins at zero within the indifference.
  bool intercept = true;
  /// Sine and cosine of angles in place of the angles; empty: chosen with the
  /// view where an angle turns far enough, else not.
  std::optional<bool> sine_and_cosine = {};

  bool operator==(const ViewOptions&) const = default;
};

/// Training rows in one view.
struct ViewedRows {
  View view = View::kRaw;
  bool sine_and_cosine = false;            // of angles, in their place
  std::shared_ptr<const History> history;  // null: the rows as they are
  std::shared_ptr<const data::Dataset> rows;
  std::vector<bool> is_position;  // (inputs of rows)
  std::vector<bool> only_grows;   // likewise: ColumnsThatOnlyGrow
  bool intercept = true;

  std::string label() const;  // "history+zero", "raw with sine and cosine"
  bool grows() const { return std::ranges::count(only_grows, true) > 0; }
};

/// The views of `options` (without them the rows as they are) that these rows
/// allow, simplest first: filters need
/// an input besides positions and sessions with a length, the zero two
/// sessions or more. Throws std::invalid_argument where a view that was asked
/// for by name is not possible.
std::vector<ViewedRows> MakeViews(const data::Dataset& training,
                                  const std::optional<ViewOptions>& options,
                                  double indifference);

/// The same of the rows that are fitted, shared with the recipes that hold them
/// at the same time by way of context.shared.
std::shared_ptr<const std::vector<ViewedRows>> SharedViews(
    const data::Dataset& training,
    const std::optional<ViewOptions>& options,
    const FitContext& context);

/// The median length of the sessions of `training` / 100, / 30 and / 10: what
/// serves where nothing is known of the machine. Empty without a length.
std::vector<double> MakeTimeConstants(const data::Dataset& training);

/// Largest size of the target in the first rows of those sessions of which
/// `training` has the first row; NaN where it has none.
double LargestFirstError(const data::Dataset& training);

/// Inputs of `rows` that hardly ever return to values they had, as an age does:
/// with three sessions or more the sessions' means only rise or only fall, and
/// of a later session on average less than a tenth of the rows lies within what
/// the earlier ones had. All that is measured later lies beyond them, so a map
/// is a straight line in them.
std::vector<bool> ColumnsThatOnlyGrow(const data::Dataset& rows);

}  // namespace errmap::models
