#pragma once

#include <cstddef>

#include "models/study/judgement/choice.h"
#include "models/study/judgement/holdout_comparison.h"
#include "models/study/study.h"

namespace errmap::models {

/// The average of maps, or what is simpler.
struct BlendOrSimpler {
  std::size_t model = 0;  // index into StudyResult::models
  const HoldoutComparison* vetoed_by = nullptr;  // null: by none
};

/// One choice among near-equals is a gamble, which an average of maps that
/// see the inputs differently is not: it is used unless a single map is
/// established to be better by days that are separate. An average that a
/// baseline beats, in the later sessions as well where these were foretold, is
/// no map at all. Folds lack sessions, so that a map of many columns looks
/// worse there than it is: a veto takes twice the error.
///
/// `decides` chooses among the models that `is_map` accepts; `strictest` and
/// `forward`, which may be null, veto.
BlendOrSimpler ChooseBlendOrSimpler(std::size_t blend,
                                    const HoldoutComparison& decides,
                                    const HoldoutComparison& strictest,
                                    const HoldoutComparison* forward,
                                    const StudyResult& study,
                                    const Wanted& is_map);

}  // namespace errmap::models
