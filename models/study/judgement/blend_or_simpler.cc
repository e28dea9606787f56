#include "models/study/judgement/blend_or_simpler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <variant>
#include <vector>

#include "models/study/judgement/recommendation.h"
#include "stats/error_metrics.h"

namespace errmap::models {
namespace {

// The geometric mean over sessions, so that one extreme session does not decide
// alone, such as the first one, which is predicted from few.
double TypicalRmse(const HoldoutComparison& comparison, std::size_t model) {
  return stats::GeometricMean(
      comparison.unit_rmse.col(*comparison.PlaceOf(model)));
}

// The model of least typical error.
std::optional<std::size_t> MostTypical(const HoldoutComparison& comparison,
                                       const Wanted& wanted) {
  std::optional<std::size_t> best;
  for (const std::size_t model : comparison.models) {
    if (wanted(model) && (!best || TypicalRmse(comparison, model) <
                                       TypicalRmse(comparison, *best))) {
      best = model;
    }
  }
  return best;
}

// A constant, a line of one column or a plane of all: what a map must not lose
// to where it has never been.
bool IsSimple(const ModelResult& model) {
  if (model.baseline) return true;
  if (!model.final_fit || model.final_fit->history != nullptr) return false;
  const ModelDescription form = model.final_fit->model->Describe();
  const auto* polynomial = std::get_if<PolynomialForm>(&form);
  return polynomial != nullptr &&
         std::ranges::all_of(polynomial->terms, [](const PolynomialTerm& term) {
           return std::accumulate(term.powers.begin(), term.powers.end(), 0) ==
                  1;
         });
}

class Chooser {
 public:
  Chooser(const HoldoutComparison& decides,
          const HoldoutComparison& strictest,
          const HoldoutComparison* forward,
          const StudyResult& study,
          const Wanted& is_map)
      : decides_(decides), forward_(forward), study_(study), is_map_(is_map) {
    vetoes_.push_back(&strictest);
    if (forward != nullptr) vetoes_.push_back(forward);
  }

  BlendOrSimpler Choose(std::size_t blend) const {
    const auto proven = BestWhere(decides_, [&](std::size_t model) {
      return is_map_(model) && model != blend &&
             decides_.units.separate_sessions && !IsVetoed(model) &&
             decides_.ThatItIsBetter(model, blend) == Confidence::kEstablished;
    });
    const std::size_t use = proven.value_or(blend);
    for (const HoldoutComparison* veto : vetoes_) {
      if (const auto simple = FarBetter(*veto, use)) {
        return {.model = *simple, .vetoed_by = veto};
      }
    }
    const auto baseline = BestWhere(decides_, [&](std::size_t model) {
      return is_map_(model) && study_.models[model].baseline;
    });
    const bool beaten =
        baseline && RmseOf(decides_, *baseline) < RmseOf(decides_, use) &&
        (forward_ == nullptr || !forward_->PlaceOf(*baseline) ||
         !forward_->PlaceOf(use) ||
         TypicalRmse(*forward_, *baseline) < TypicalRmse(*forward_, use));
    return {.model = beaten ? *baseline : use};
  }

 private:
  std::optional<std::size_t> FarBetter(const HoldoutComparison& veto,
                                       std::size_t model) const {
    constexpr double kFar = 2.0;
    const auto simple = MostTypical(veto, [&](std::size_t other) {
      return is_map_(other) && IsSimple(study_.models[other]);
    });
    return simple && veto.PlaceOf(model) &&
                   TypicalRmse(veto, model) > kFar * TypicalRmse(veto, *simple)
               ? simple
               : std::nullopt;
  }

  bool IsVetoed(std::size_t model) const {
    return std::ranges::any_of(vetoes_, [&](const HoldoutComparison* veto) {
      return FarBetter(*veto, model).has_value();
    });
  }

  const HoldoutComparison& decides_;
  const HoldoutComparison* forward_;
  const StudyResult& study_;
  const Wanted& is_map_;
  std::vector<const HoldoutComparison*> vetoes_;
};

bool HasSensors(const ModelResult& model) {
  return model.final_fit.has_value() && !SensorsOf(*model.final_fit).empty();
}

bool IsWorthMore(std::size_t model,
                 std::size_t baseline,
                 const HoldoutComparison& comparison) {
  constexpr double kLeastGain = 0.9;
  if (!(RmseOf(comparison, model) <
        kLeastGain * RmseOf(comparison, baseline))) {
    return false;
  }
  constexpr double kLeastRmse = std::numeric_limits<double>::min();
  const auto logs_of = [&](std::size_t of) {
    return comparison.unit_rmse.col(*comparison.PlaceOf(of))
        .array()
        .max(kLeastRmse)
        .log()
        .eval();
  };
  const Eigen::ArrayXd ratio = logs_of(model) - logs_of(baseline);
  const auto count = static_cast<double>(ratio.size());
  if (count < 2.0) return true;
  const double variance = (ratio - ratio.mean()).square().sum() / (count - 1.0);
  return ratio.mean() < -std::sqrt(variance / count);
}

}  // namespace

BlendOrSimpler ChooseBlendOrSimpler(std::size_t blend,
                                    const HoldoutComparison& decides,
                                    const HoldoutComparison& strictest,
                                    const HoldoutComparison* forward,
                                    const StudyResult& study,
                                    const Wanted& is_map) {
  return Chooser(decides, strictest, forward, study, is_map).Choose(blend);
}

std::optional<std::size_t> BetterWithoutSensors(
    std::size_t model,
    const HoldoutComparison& comparison,
    const StudyResult& study,
    const Wanted& is_map) {
  if (!HasSensors(study.models[model])) return std::nullopt;
  const Wanted is_free = [&](std::size_t other) {
    return is_map(other) && study.models[other].baseline &&
           !HasSensors(study.models[other]);
  };
  const auto passed = [&](std::size_t other) {
    return !is_free(other) || IsWorthMore(model, other, comparison);
  };
  if (std::ranges::all_of(comparison.models, passed)) return std::nullopt;
  return BestWhere(comparison, is_free);
}

}  // namespace errmap::models
