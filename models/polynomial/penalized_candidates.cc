#include "models/polynomial/penalized_candidates.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "models/polynomial/term_dictionary.h"
#include "models/shared_work.h"

namespace errmap::models {
namespace {

using data::Dataset;
using Eigen::Index;
using fitting::Penalty;

using FitsByPenalty = std::map<Penalty, std::shared_ptr<const PenalizedFit>>;

// The sets worth a try over these inputs, in order of size.
std::vector<TermSet> ServingTerms(const std::vector<bool>& is_position,
                                  int degree) {
  // More terms than this are left to those who ask for them.
  constexpr Index kMostTerms = 1500;
  constexpr std::size_t kFewInputs = 4;
  const bool has_position = std::ranges::count(is_position, true) > 0;
  const bool has_others = std::ranges::count(is_position, false) > 0;
  std::vector<TermSet> sets = {TermSet::kLinear, TermSet::kSquares};
  if (has_position && has_others) sets.push_back(TermSet::kAxis);
  if (is_position.size() <= kFewInputs) sets.push_back(TermSet::kFull);
  std::erase_if(sets, [&](TermSet set) {
    const int taken =
        degree > 0
            ? degree
            : DefaultDegreeOf(set, static_cast<Index>(is_position.size()));
    const auto count = CountTerms(set, is_position, taken);
    return set != TermSet::kLinear && (!count || *count > kMostTerms);
  });
  return sets;
}

}  // namespace

PenalizedChoices PenalizedChoices::Take(SpecOptions* options) {
  PenalizedChoices taken;
  taken.view = ViewOptions::Take(options);
  std::vector<std::string> words = {"auto"};
  std::ranges::copy(TermSetWords(), std::back_inserter(words));
  const std::size_t set = options->TakeChoice("terms", 0, words);
  if (set > 0) taken.terms = static_cast<TermSet>(set - 1);
  constexpr std::int64_t kMostDegree = 4;
  taken.degree =
      static_cast<int>(options->TakeInteger("degree", 0, 1, kMostDegree));
  const std::string exclude = options->TakeText("exclude", "");
  if (!exclude.empty()) taken.exclude = ParseTerms(exclude, "exclude");
  constexpr std::size_t kYes = 1;
  constexpr std::size_t kNo = 2;
  const std::size_t centred =
      options->TakeChoice("centred", 0, {"standard", "yes", "no"});
  if (centred == kYes) taken.centring = Centring::kAll;
  if (centred == kNo) taken.centring = Centring::kNone;
  if (options->TakeChoice("clip", 0, {"auto", "none"}) == 1) taken.clip = false;
  return taken;
}

void PenalizedChoices::Describe(std::vector<EffectiveOption>* options) const {
  view.Describe(options);
  if (terms) {
    options->push_back({"terms", std::string(ToString(*terms))});
  } else if (view.given) {
    options->push_back({"terms", std::string("auto")});
  }
  TermOptions{.degree = degree,
              .centring = centring == Centring::kNone ? Centring::kNone
                                                      : Centring::kAll,
              .include = {},
              .exclude = exclude}
      .Describe(options);
  if (centring == Centring::kAll) {
    options->push_back({"centred", std::string("yes")});
  }
  if (clip && view.given) options->push_back({"clip", std::string("none")});
}

bool PenalizedChoices::chooses_basis() const {
  return view.given && (!view.view || !terms);
}

std::vector<BasisCandidate> JudgeBases(const Dataset& training,
                                       const PenalizedChoices& choices,
                                       const std::vector<Penalty>& penalties,
                                       const InnerFolds& folds,
                                       const FitContext& context) {
  const std::string of_views = choices.view.Key();
  // What others may want as well depends on the words of its key alone.
  const bool shareable = context.shared != nullptr && choices.exclude.empty() &&
                         !choices.rule.strength &&
                         !choices.rule.one_standard_error;
  std::vector<BasisCandidate> judged;
  const auto views = SharedViews(training, choices.view, context);
  for (const ViewedRows& made : *views) {
    // Holds all of them.
    const std::shared_ptr<const ViewedRows> viewed(views, &made);
    std::vector<TermSet> sets;
    if (choices.terms) {
      sets = {*choices.terms};
    } else if (choices.view.given) {
      sets = ServingTerms(viewed->is_position, choices.degree);
    } else {
      sets = {TermSet::kFull};
    }
    for (const TermSet set : sets) {
      const int degree =
          choices.degree > 0
              ? choices.degree
              : DefaultDegreeOf(set,
                                static_cast<Index>(viewed->is_position.size()));
      const PenalizedBasis basis{.terms = set,
                                 .degree = degree,
                                 .centring = choices.centring,
                                 .exclude = choices.exclude,
                                 .guarded = choices.guarded()};
      const std::string of_basis =
          fmt::format("view={} {} terms={} degree={} centring={} guarded={}",
                      viewed->label(),
                      of_views,
                      ToString(set),
                      degree,
                      static_cast<int>(choices.centring),
                      basis.guarded);
      // One pass over the rows serves all that will be asked for.
      const auto make = [&](const std::vector<Penalty>& wanted) {
        const auto sums = SumBasis(
            viewed, basis, choices.rule.strength ? nullptr : &folds, context);
        auto fits_of = std::make_shared<FitsByPenalty>();
        for (const Penalty penalty : wanted) {
          fits_of->emplace(
              penalty,
              FitPenalty(sums, penalty, choices.rule, context.indifference));
        }
        return fits_of;
      };
      for (const Penalty penalty : penalties) {
        const bool all = shareable && context.shared->every_penalty;
        const std::vector<Penalty> wanted =
            all ? std::vector{Penalty::kRidge, Penalty::kLasso}
                : std::vector{penalty};
        const std::string key = fmt::format(
            "{} {}", all ? "penalized" : fitting::ToString(penalty), of_basis);
        const auto fit = (shareable ? *context.shared->Get<FitsByPenalty>(
                                          key, [&] { return make(wanted); })
                                    : *make(wanted))
                             .at(penalty);
        judged.push_back(
            {.viewed = viewed,
             .fit = fit,
             .terms = set,
             .degree = degree,
             .num_excluded = static_cast<Index>(choices.exclude.size()),
             .guarded = basis.guarded,
             .label = fmt::format("{}, {}, {}",
                                  fitting::ToString(penalty),
                                  viewed->label(),
                                  ToString(set))});
      }
    }
  }
  return judged;
}

}  // namespace errmap::models
