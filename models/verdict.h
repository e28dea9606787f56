#pragma once

#include <optional>
#include <string>
#include <vector>

#include "models/study.h"

namespace errmap::models {

/// Which model has the lowest held-out RMSE under one hold-out.
struct Verdict {
  std::string holdout;
  bool whole_groups = false;  // held out whole groups, as another day would
  std::ptrdiff_t best = -1;   // index into StudyResult::models; -1: none
  std::ptrdiff_t next = -1;   // second best, or -1
};

/// One verdict per hold-out of the study, in order.
std::vector<Verdict> JudgeHoldouts(const StudyResult& study,
                                   const std::vector<Holdout>& holdouts);

/// The verdict that a user should go by: the first that held whole groups out,
/// else the first with a winner; null where nothing was fitted.
const Verdict* DecisiveVerdict(const std::vector<Verdict>& verdicts);

/// "polynomial", "neural" or "baseline".
std::string_view ChoiceWord(ModelKind kind);

}  // namespace errmap::models
