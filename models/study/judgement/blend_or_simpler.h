#pragma once

#include <cstddef>

#include "models/study/judgement/choice.h"
#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// Chooses between the average of maps and a simpler map.
struct BlendOrSimpler {
  std::size_t model = 0;  // index into StudyResult::models
  const HoldoutComparison* vetoed_by = nullptr;  // null: no veto
};

/// An average of maps with different input views is safer than one choice among
/// near-equals. It is used unless separate days establish that a single map is
/// better, or a baseline beats it (in later sessions, too, if these were
/// predicted). Folds lack sessions, so a map of many columns looks worse there
/// than it is. So a simple map can veto it only if its error is less than half
/// as large.
///
/// `decides` chooses among the models that `is_map` accepts. `strictest` and
/// `forward` (which may be null) can veto.
BlendOrSimpler ChooseBlendOrSimpler(std::size_t blend,
                                    const HoldoutComparison& decides,
                                    const HoldoutComparison& strictest,
                                    const HoldoutComparison* forward,
                                    const StudyResult& study,
                                    const Wanted& is_map);

}  // namespace errmap::models
