#pragma once

#include <optional>
#include <string>

#include "models/history/view.h"
#include "models/option_list.h"

namespace errmap::models {

/// What a SPEC may say of views: view, history, zero, intercept and angles. A
/// map without `view` reads its inputs as they are, and the others are checked
/// only.
const OptionList<std::optional<ViewOptions>>& ViewOptionList();
/// clip, of all that may extrapolate: a member of that name.
template <typename Options>
Option<Options> ClipOption() {
  return OptionFor("clip",
                   "guards at the trained range",
                   &Options::clip,
                   OneOf<bool>{{{"auto", true}, {"none", false}}});
}

/// Adds the view= that a SPEC implies: that of history= and zero=, raw where
/// there are only angles=sincos and the like (or intercept=no, where that
/// `counts`); none where there is no word of views.
void NameTheView(ModelSpec* spec, bool intercept_counts);
inline void NameTheViewOf(ModelSpec* spec) { NameTheView(spec, true); }

/// Words that tell which views MakeViews gives, but for the view alone.
std::string KeyOf(const std::optional<ViewOptions>& options);

}  // namespace errmap::models
