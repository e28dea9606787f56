#pragma once

#include <optional>
#include <string>

#include "models/history/view.h"
#include "models/option_list.h"

namespace errmap::models {

/// Options of views in a SPEC: view, history, zero, intercept and angles.
/// Without `view`, a map reads its inputs as measured, and the other options
/// are only checked.
const OptionList<std::optional<ViewOptions>>& ViewOptionList();
/// The option clip of all families that may extrapolate, for their member
/// `clip`.
template <typename Options>
Option<Options> ClipOption() {
  return OptionFor("clip",
                   "guards at the trained range",
                   &Options::clip,
                   OneOf<bool>{{{"auto", true}, {"none", false}}});
}

/// Adds the view= implied by a SPEC: by history= and zero=, or raw if there is
/// only angles= (or intercept=no, if `intercept_counts`). Adds none if the SPEC
/// has no option of views.
void NameTheView(ModelSpec* spec, bool intercept_counts);
inline void NameTheViewOf(ModelSpec* spec) { NameTheView(spec, true); }

/// Returns a key of the options besides view that affect MakeViews.
std::string KeyOf(const std::optional<ViewOptions>& options);

}  // namespace errmap::models
