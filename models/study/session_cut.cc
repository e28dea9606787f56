#include "models/study/session_cut.h"

namespace errmap::models {

bool IsOfSessions(const Holdout& holdout, const data::Dataset& dataset) {
  const bool groups_are_coarser =
      holdout.whole_groups &&
      static_cast<Eigen::Index>(dataset.groups().labels.size()) <
          dataset.num_sessions();
  return holdout.whole_sessions && !groups_are_coarser;
}

}  // namespace errmap::models
