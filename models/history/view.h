#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/history/history.h"
#include "models/model_spec.h"

namespace errmap::models {

/// Which form of the inputs a map reads. Positions stay as they are in each.
enum class View {
  kRaw,             // as measured
  kHistory,         // and passed through first-order filters
  kZero,            // less their values in the session's first row
  kHistoryAndZero,  // both: inputs and filtered inputs less those values
};
std::string_view ToString(View view);  // the words of view=
View ViewOf(std::string_view word);    // of one of these words

/// What a SPEC says of views: view=, history=, zero=, intercept=, angles=.
struct ViewOptions {
  /// Whether any of them was given: else the map reads its inputs as they are.
  bool given = false;
  std::optional<View> view;            // empty: chosen on inner hold-outs
  std::vector<double> time_constants;  // unit of time; empty: MakeTimeConstants
  bool with_history = true;            // of the views to choose from
  bool with_zero = true;
  /// A map without intercept in zeroed views: always, or where each session
  /// begins at zero within the indifference.
  bool never_intercept = false;
  /// Sine and cosine of angles in place of the angles; empty: chosen with the
  /// view where an angle turns far enough, else not.
  std::optional<bool> sine_and_cosine;

  static ViewOptions Take(SpecOptions* options);
  /// Takes clip=: whether maps in views are guarded.
  bool TakeClip(SpecOptions* options) const;
  /// Those that are not the default.
  void Describe(std::vector<EffectiveOption>* options) const;
  /// Words that tell which views MakeViews gives, but for the view alone.
  std::string Key() const;
};

/// Training rows in one view.
struct ViewedRows {
  View view = View::kRaw;
  bool sine_and_cosine = false;            // of angles, in their place
  std::shared_ptr<const History> history;  // null: the rows as they are
  std::shared_ptr<const data::Dataset> rows;
  std::vector<bool> is_position;  // (inputs of rows)
  bool intercept = true;

  std::string label() const;  // "history+zero", "raw with sine and cosine"
};

/// The views of `options` that these rows allow, simplest first: filters need
/// an input besides positions and sessions with a length, the zero two
/// sessions or more. Throws std::invalid_argument where a view that was asked
/// for by name is not possible.
std::vector<ViewedRows> MakeViews(const data::Dataset& training,
                                  const ViewOptions& options,
                                  double indifference);

/// The same of the rows that are fitted, shared with the recipes that hold them
/// at the same time by way of context.shared.
std::shared_ptr<const std::vector<ViewedRows>> SharedViews(
    const data::Dataset& training,
    const ViewOptions& options,
    const FitContext& context);

/// The median length of the sessions of `training` / 100, / 30 and / 10: what
/// serves where nothing is known of the machine. Empty without a length.
std::vector<double> MakeTimeConstants(const data::Dataset& training);

/// Largest size of the target in the first rows of those sessions of which
/// `training` has the first row; NaN where it has none.
double LargestFirstError(const data::Dataset& training);

/// "position*" columns, which are neither filtered nor zeroed.
bool IsPosition(const data::ColumnInfo& column);

}  // namespace errmap::models
