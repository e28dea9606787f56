#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "models/history/view_options.h"
#include "models/inner_folds.h"
#include "models/polynomial/penalized_fit.h"
#include "models/polynomial/term_dictionary.h"
#include "models/shared_work.h"

namespace errmap::models {
namespace {

using data::Dataset;
using fitting::Penalty;

using FitsByPenalty = std::map<Penalty, std::shared_ptr<const PenalizedFit>>;

struct SetToTry {
  TermSet set = TermSet::kLinear;
  int degree = 1;
};

// The sets worth a try over these inputs, in order of size.
std::vector<SetToTry> ServingTerms(const std::vector<bool>& is_position,
                                   std::optional<int> degree) {
  // More terms than this are left to those who ask for them.
  constexpr Index kMostCandidateTerms = 1500;
  // So few inputs have few products; beside a position kAxis has those that
  // matter.
  constexpr Index kFewForCubes = 4;
  constexpr Index kFewForSquares = 12;
  const bool has_position = std::ranges::count(is_position, true) > 0;
  const bool has_others = std::ranges::count(is_position, false) > 0;
  const auto inputs = std::ssize(is_position);
  std::vector<SetToTry> serving;
  const auto add = [&](TermSet set, int most) {
    const int taken = degree.value_or(most);
    const auto count = CountTerms(set, is_position, taken);
    if (set == TermSet::kLinear || (count && *count <= kMostCandidateTerms)) {
      serving.push_back({set, taken});
    }
  };
  add(TermSet::kLinear, 1);
  add(TermSet::kSquares, 2);
  if (has_position && has_others) add(TermSet::kAxis, 3);
  if (inputs <= kFewForCubes) {
    add(TermSet::kFull, 3);
  } else if (!has_position && inputs <= kFewForSquares) {
    add(TermSet::kFull, 2);
  }
  return serving;
}

// Fits penalized maps to views of some rows, shared with other recipes that
// need the same.
class BasisJudge {
 public:
  BasisJudge(const BasisOptions& options,
             const PenaltyRule& rule,
             const InnerFolds& folds,
             const FitContext& context)
      : options_(options), rule_(rule), folds_(folds), context_(context) {}

  std::vector<SetToTry> SetsFor(const ViewedRows& viewed) const {
    if (options_.view && !options_.terms) {
      return ServingTerms(viewed.is_position, options_.degree);
    }
    const TermSet set = options_.terms.value_or(TermSet::kFull);
    const auto inputs = std::ssize(viewed.is_position);
    return {{set, options_.degree.value_or(DefaultDegreeOf(set, inputs))}};
  }

  // Every one of `penalties` over a basis.
  void Judge(const std::shared_ptr<const ViewedRows>& viewed,
             const SetToTry& tried,
             const std::vector<Penalty>& penalties,
             std::vector<BasisCandidate>* judged) {
    const PenalizedBasis basis{.terms = tried.set,
                               .degree = tried.degree,
                               .centring = options_.centring,
                               .exclude = options_.exclude,
                               .guarded = options_.clip,
                               .between = BetweenIn(*viewed)};
    const auto fits = FitsOf(viewed, basis, penalties);
    for (const Penalty penalty : penalties) {
      judged->push_back({.viewed = viewed,
                         .fit = fits->at(penalty),
                         .terms = basis.terms,
                         .degree = basis.degree,
                         .num_excluded = std::ssize(options_.exclude),
                         .guarded = basis.guarded,
                         .label = fmt::format("{}, {}, {}",
                                              fitting::ToString(penalty),
                                              viewed->label(),
                                              ToString(basis.terms))});
    }
    const auto ridge = fits->find(Penalty::kRidge);
    if (ridge == fits->end()) return;
    least_ridge_ =
        std::fmin(least_ridge_, ridge->second->candidate.held_out_rmse);
  }

 private:
  // A result can be shared if it depends only on the words of its key.
  bool is_shareable() const {
    return context_.shared != nullptr && options_.exclude.empty() &&
           !rule_.strength && !rule_.one_standard_error;
  }

  // One pass over the rows serves all that are wanted.
  std::shared_ptr<const FitsByPenalty> FitAll(
      const std::shared_ptr<const ViewedRows>& viewed,
      const PenalizedBasis& basis,
      const std::vector<Penalty>& wanted) const {
    const SummedBasis sums(viewed, basis, rule_.strength ? nullptr : &folds_);
    auto fits = std::make_shared<FitsByPenalty>();
    for (const Penalty penalty : wanted) {
      fits->emplace(
          penalty,
          FitPenalty(
              sums, penalty, rule_, context_.indifference, promising_rmse()));
    }
    return fits;
  }

  std::shared_ptr<const FitsByPenalty> FitsOf(
      const std::shared_ptr<const ViewedRows>& viewed,
      const PenalizedBasis& basis,
      const std::vector<Penalty>& penalties) const {
    if (!is_shareable()) return FitAll(viewed, basis, penalties);
    const std::vector<Penalty> wanted =
        context_.shared->every_penalty
            ? std::vector{Penalty::kRidge, Penalty::kLasso}
            : penalties;
    std::string key;
    for (const Penalty penalty : wanted) key += fitting::ToString(penalty);
    key += fmt::format(
        " view={} {} terms={} degree={} centring={} guarded={} in_turn={}"
        " between={} promising={}",
        viewed->label(),
        KeyOf(options_.view),
        ToString(basis.terms),
        basis.degree,
        static_cast<int>(basis.centring),
        basis.guarded,
        folds_.in_turn,
        basis.between,
        promising_rmse());
    return context_.shared->Get<FitsByPenalty>(
        key, [&] { return FitAll(viewed, basis, wanted); });
  }

  // An input that only grows acts mostly between sessions, and a drift is not
  // an offset of each.
  double BetweenIn(const ViewedRows& viewed) const {
    constexpr double kInViews = 0.25;
    if (!folds_.whole_sessions) return 1.0;
    const bool has_offsets = options_.view && !viewed.grows();
    return options_.between.value_or(has_offsets ? kInViews : 1.0);
  }

  double promising_rmse() const { return kOutOfReach * least_ridge_; }

  const BasisOptions& options_;
  const PenaltyRule& rule_;
  const InnerFolds& folds_;
  const FitContext& context_;
  double least_ridge_ = std::numeric_limits<double>::infinity();
};

}  // namespace

OptionList<BasisOptions> BasisOptionList() {
  OptionList<BasisOptions> list;
  AddWithin(ViewOptionList(), &BasisOptions::view, &list);
  list.insert(list.end(),
              {OptionFor("terms",
                         "the products that it has",
                         &BasisOptions::terms,
                         AutoOrEnum<TermSet>(TermSetWords()))
                   .When([](const BasisOptions& options) {
                     return options.terms || options.view;
                   }),
               Within(DegreeOption(), &BasisOptions::degree),
               OptionFor("centred",
                         "products of standardised, centred or raw inputs",
                         &BasisOptions::centring,
                         OneOf<Centring>{{{"standard", Centring::kStandardised},
                                          {"yes", Centring::kAll},
                                          {"no", Centring::kNone}}}),
               Within(TermsOption("exclude", "terms that are always left out"),
                      &BasisOptions::exclude),
               ClipOption<BasisOptions>(),
               OptionFor("between",
                         "weight of what differs between sessions",
                         &BasisOptions::between,
                         Number{0.0001, 1.0})});
  return list;
}

std::vector<BasisCandidate> JudgeBases(const Dataset& training,
                                       const BasisOptions& options,
                                       const PenaltyRule& rule,
                                       const std::vector<Penalty>& penalties,
                                       const InnerFolds& folds,
                                       const FitContext& context) {
  std::vector<BasisCandidate> judged;
  BasisJudge judge(options, rule, folds, context);
  const auto views = SharedViews(training, options.view, context);
  for (const ViewedRows& made : *views) {
    // Holds all of them.
    const std::shared_ptr<const ViewedRows> viewed(views, &made);
    for (const SetToTry& tried : judge.SetsFor(*viewed)) {
      judge.Judge(viewed, tried, penalties, &judged);
    }
  }
  return judged;
}

}  // namespace errmap::models
