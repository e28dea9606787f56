#include "models/verdict.h"

namespace errmap::models {

std::vector<Verdict> JudgeHoldouts(const StudyResult& study,
                                   const std::vector<Holdout>& holdouts) {
  std::vector<Verdict> verdicts;
  for (std::size_t h = 0; h < holdouts.size(); ++h) {
    Verdict verdict{holdouts[h].name, holdouts[h].whole_groups, -1, -1};
    const auto rmse = [&](std::ptrdiff_t model) {
      return study.models[static_cast<std::size_t>(model)]
          .holdouts[h]
          .test.rmse;
    };
    for (std::size_t i = 0; i < study.models.size(); ++i) {
      if (!study.models[i].holdouts[h].ok()) continue;
      const auto model = static_cast<std::ptrdiff_t>(i);
      if (verdict.best < 0 || rmse(model) < rmse(verdict.best)) {
        verdict.next = verdict.best;
        verdict.best = model;
      } else if (verdict.next < 0 || rmse(model) < rmse(verdict.next)) {
        verdict.next = model;
      }
    }
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

const Verdict* DecisiveVerdict(const std::vector<Verdict>& verdicts) {
  const Verdict* first = nullptr;
  for (const Verdict& verdict : verdicts) {
    if (verdict.best < 0) continue;
    if (verdict.whole_groups) return &verdict;
    if (first == nullptr) first = &verdict;
  }
  return first;
}

std::string_view ChoiceWord(ModelKind kind) {
  switch (kind) {
    case ModelKind::kBaseline:
      return "baseline";
    case ModelKind::kPolynomial:
      return "polynomial";
    case ModelKind::kNet:
      return "neural";
  }
  return "";
}

}  // namespace errmap::models
