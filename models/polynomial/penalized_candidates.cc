#include "models/polynomial/penalized_candidates.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "models/history/view_options.h"
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
                                  std::optional<int> degree) {
  // More terms than this are left to those who ask for them.
  constexpr Index kMostTerms = 1500;
  constexpr std::size_t kFewInputs = 4;
  const bool has_position = std::ranges::count(is_position, true) > 0;
  const bool has_others = std::ranges::count(is_position, false) > 0;
  std::vector<TermSet> sets = {TermSet::kLinear, TermSet::kSquares};
  if (has_position && has_others) sets.push_back(TermSet::kAxis);
  if (is_position.size() <= kFewInputs) sets.push_back(TermSet::kFull);
  std::erase_if(sets, [&](TermSet set) {
    const int taken = degree.value_or(
        DefaultDegreeOf(set, static_cast<Index>(is_position.size())));
    const auto count = CountTerms(set, is_position, taken);
    return set != TermSet::kLinear && (!count || *count > kMostTerms);
  });
  return sets;
}

}  // namespace

OptionList<BasisOptions> BasisOptionList() {
  OptionList<BasisOptions> list;
  const auto view = [](auto& options) { return &options.view; };
  AddWithin(ViewOptionList(), view, &list);
  list.push_back(OptionFor("terms",
                           "the products that it has",
                           &BasisOptions::terms,
                           AutoOrEnum<TermSet>(TermSetWords()))
                     .When([](const BasisOptions& options) {
                       return options.terms || options.view;
                     }));
  list.push_back(Within<BasisOptions>(
      DegreeOption(), [](auto& options) { return &options.degree; }));
  list.push_back(
      OptionFor("centred",
                "products of standardised, centred or raw inputs",
                &BasisOptions::centring,
                OneOf<Centring>{{{"standard", Centring::kStandardised},
                                 {"yes", Centring::kAll},
                                 {"no", Centring::kNone}}}));
  list.push_back(
      Within<BasisOptions>(TermsOption("exclude", "terms that are never in"),
                           [](auto& options) { return &options.exclude; }));
  list.push_back(Within<BasisOptions>(ClipOption(), view));
  return list;
}

std::vector<BasisCandidate> JudgeBases(const Dataset& training,
                                       const BasisOptions& options,
                                       const PenaltyRule& rule,
                                       const std::vector<Penalty>& penalties,
                                       const InnerFolds& folds,
                                       const FitContext& context) {
  const std::string of_views = KeyOf(options.view);
  // What others may want as well depends on the words of its key alone.
  const bool shareable = context.shared != nullptr && options.exclude.empty() &&
                         !rule.strength && !rule.one_standard_error;
  std::vector<BasisCandidate> judged;
  const auto views = SharedViews(training, options.view, context);
  for (const ViewedRows& made : *views) {
    // Holds all of them.
    const std::shared_ptr<const ViewedRows> viewed(views, &made);
    std::vector<TermSet> sets;
    if (options.terms) {
      sets = {*options.terms};
    } else if (options.view) {
      sets = ServingTerms(viewed->is_position, options.degree);
    } else {
      sets = {TermSet::kFull};
    }
    for (const TermSet set : sets) {
      const int degree = options.degree.value_or(
          DefaultDegreeOf(set, static_cast<Index>(viewed->is_position.size())));
      const PenalizedBasis basis{.terms = set,
                                 .degree = degree,
                                 .centring = options.centring,
                                 .exclude = options.exclude,
                                 .guarded = options.guarded()};
      const std::string of_basis =
          fmt::format("view={} {} terms={} degree={} centring={} guarded={}",
                      viewed->label(),
                      of_views,
                      ToString(set),
                      degree,
                      static_cast<int>(options.centring),
                      basis.guarded);
      // One pass over the rows serves all that will be asked for.
      const auto make = [&](const std::vector<Penalty>& wanted) {
        const auto sums =
            SumBasis(viewed, basis, rule.strength ? nullptr : &folds, context);
        auto fits_of = std::make_shared<FitsByPenalty>();
        for (const Penalty penalty : wanted) {
          fits_of->emplace(
              penalty, FitPenalty(sums, penalty, rule, context.indifference));
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
             .num_excluded = static_cast<Index>(options.exclude.size()),
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
