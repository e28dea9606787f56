#include "models/blend/blend_recipe.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "models/averaged_model.h"
#include "models/blend/form_to_model.h"
#include "models/history/view_options.h"
#include "models/history/with_history.h"
#include "models/inner_folds.h"
#include "models/net/net_recipe.h"
#include "models/option_list.h"
#include "models/polynomial/penalized_fit.h"
#include "models/polynomial/polynomial_model.h"
#include "stats/eigen.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

using data::Dataset;
// Which candidates an average is of.
enum class Among { kAll, kStraight };

// Result of inner hold-outs for a candidate.
struct Score {
  double rmse = 0.0;
  bool straight = false;
};

// The power of the errors' inverse: one error a unit. Of days one goes into how
// large errors are at all; below four that does not count, or what a study
// holds out would be mapped by another rule than what it hands over. Groups of
// one run resemble each other, so that many say less than they are many.
double PowerOf(const InnerFolds& folds) {
  constexpr Index kLeastOfSessions = 3;
  constexpr Index kMost = 8;
  const Index units = std::min(folds.units, kMost);
  return static_cast<double>(
      folds.whole_sessions ? std::max(units - 1, kLeastOfSessions) : units);
}

// The least that one of them errs; what has no error at all leaves nothing to
// the others.
double LeastOf(const std::vector<Score>& scores, Among among) {
  double least = std::numeric_limits<double>::infinity();
  for (const Score& score : scores) {
    if (among == Among::kStraight && !score.straight) continue;
    if (score.rmse < least) least = score.rmse;
  }
  return std::max(least, std::numeric_limits<double>::min());
}

VectorXd WeightsAmong(const std::vector<Score>& scores,
                      Among among,
                      double power) {
  const double least = LeastOf(scores, among);
  VectorXd weights = VectorXd::Zero(std::ssize(scores));
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const Score& score = scores[i];
    if (std::isnan(score.rmse)) continue;
    if (among == Among::kStraight && !score.straight) continue;
    weights[static_cast<Index>(i)] =
        std::pow(std::max(score.rmse, least) / least, -power);
  }
  return weights / weights.sum();
}

// For rows beyond the known ones, a bend that helps between them is worth less
// than it seems. The average of all is therefore averaged with that of the
// straight lines, which count as much if their errors are equal, and an eighth
// as much if they are twice as large.
VectorXd AveragedWithLines(const std::vector<Score>& scores, double power) {
  constexpr double kShrinkPower = 3.0;
  VectorXd all = WeightsAmong(scores, Among::kAll, power);
  const double least = LeastOf(scores, Among::kStraight);
  if (std::isinf(least)) return all;
  const double share =
      std::pow(least / LeastOf(scores, Among::kAll), -kShrinkPower);
  return (all + share * WeightsAmong(scores, Among::kStraight, power)) /
         (1.0 + share);
}

// A member before it knows its place among the inputs of all.
struct Part {
  std::string name;
  double weight = 0.0;
  FittedModel map;  // its form reads columns of its own view
};

class BlendRecipe final : public ModelRecipe {
 public:
  BlendRecipe(const BlendOptions& options, std::string name)
      : name_(CheckedName(options, std::move(name))), options_(options) {
    if (!options_.bases.view) options_.bases.view.emplace();
  }

  std::string name() const override { return name_; }
  ModelKind kind() const override { return ModelKind::kBlend; }

  std::vector<EffectiveOption> options() const override {
    return InEffect(options_);
  }

  std::optional<std::string> WhatIsMissing(
      const Dataset& dataset) const override {
    if (dataset.num_inputs() > 0) return std::nullopt;
    return "inputs: a blend needs at least one";
  }

  FittedModel Fit(const Dataset& training,
                  const FitContext& context) const override {
    if (const auto missing = WhatIsMissing(training)) {
      throw std::invalid_argument("the data lack " + *missing);
    }
    const InnerFolds folds = MakeInnerFolds(training, context);
    const std::vector<BasisCandidate> bases =
        JudgeBases(training,
                   options_.bases,
                   {},
                   {fitting::Penalty::kRidge, fitting::Penalty::kLasso},
                   folds,
                   context);
    std::vector<Score> scores;
    bool grows = false;
    for (const BasisCandidate& basis : bases) {
      scores.push_back({basis.fit->candidate.held_out_rmse,
                        basis.terms == TermSet::kLinear});
      grows = grows || basis.viewed->grows();
    }
    std::optional<FittedModel> net;
    // Inputs that only grow need a straight line beyond the data, which a net
    // lacks.
    if (options_.net && !grows) {
      net = FitNet(training, context);
      scores.push_back({.rmse = net->inner_rmse});
    }
    const double power = PowerOf(folds);
    const VectorXd weights = grows ? WeightsAmong(scores, Among::kAll, power)
                                   : AveragedWithLines(scores, power);

    std::vector<Part> parts = CollapseBases(training, bases, weights);
    if (net && weights[weights.size() - 1] > kLeastWeight) {
      parts.push_back({net->name, weights[weights.size() - 1], *net});
    }
    FittedModel fitted = Average(training, grows, parts);
    fitted.summary.message = fmt::format(
        "{} candidates weighted by error^-{:.0f} on inner hold-outs ({})",
        scores.size(),
        power,
        folds.text);
    return fitted;
  }

 private:
  // Less than this is not worth its arithmetic in a control.
  static constexpr double kLeastWeight = 0.01;

  // By default NetInViews, which a comparison fits, too.
  FittedModel FitNet(const Dataset& training, const FitContext& context) const {
    FitContext alone = context;
    alone.explain = false;
    alone.keep_trace = false;
    NetOptions net = NetInViews();
    net.view = options_.bases.view;
    net.clip = options_.bases.clip;
    return MakeRecipe(net)->Fit(training, alone);
  }

  // "curves over the position from readings and slow averages".
  static std::string PlainName(View view, TermSet terms) {
    constexpr const char* kTerms[] = {
        "lines", "curves", "curves over the position", "curves and products"};
    constexpr const char* kInputs[] = {"readings",
                                       "readings and slow averages",
                                       "changes since the start",
                                       "slow changes since the start"};
    return fmt::format("{} from {}",
                       kTerms[static_cast<int>(terms)],
                       kInputs[static_cast<int>(view)]);
  }

  // "74 % curves from readings", ..., largest first.
  static std::vector<std::string> SharesOf(std::vector<Part> parts) {
    std::ranges::stable_sort(parts, std::greater(), &Part::weight);
    std::vector<std::string> shares;
    for (const Part& part : parts) {
      shares.push_back(
          fmt::format("{:.0f} % {}", 100.0 * part.weight, part.name));
    }
    return shares;
  }

  // Members of one basis are polynomials of the same terms: one equation.
  static std::vector<Part> CollapseBases(
      const Dataset& training,
      const std::vector<BasisCandidate>& bases,
      const VectorXd& weights) {
    std::vector<Part> parts;
    std::map<std::pair<std::string, TermSet>, std::vector<std::size_t>> alike;
    for (std::size_t i = 0; i < bases.size(); ++i) {
      alike[{bases[i].viewed->label(), bases[i].terms}].push_back(i);
    }
    for (const auto& [basis, members] : alike) {
      double weight = 0.0;
      PenalizedCandidate mean;
      const BasisCandidate& any = bases[members.front()];
      mean.coefficients =
          VectorXd::Zero(any.fit->candidate.coefficients.size());
      for (const std::size_t i : members) {
        const double share = weights[static_cast<Index>(i)];
        weight += share;
        mean.intercept += share * bases[i].fit->candidate.intercept;
        mean.coefficients += share * bases[i].fit->candidate.coefficients;
      }
      if (!(weight > kLeastWeight)) continue;
      mean.intercept /= weight;
      mean.coefficients /= weight;
      const std::string name = PlainName(any.viewed->view, any.terms);
      parts.push_back({name,
                       weight,
                       MapOfCandidate(name,
                                      training,
                                      *any.viewed,
                                      any.fit->DesignOf(*any.viewed),
                                      mean,
                                      any.guarded)});
    }
    return parts;
  }

  // An average among the members gives its own members in its place.
  static void AddMember(AveragedMember member,
                        std::vector<AveragedMember>* members) {
    const ModelDescription description = member.model->Describe();
    const auto* average = std::get_if<BlendForm>(&description);
    if (average == nullptr) {
      members->push_back(std::move(member));
      return;
    }
    for (const BlendForm::Member& inner : average->members) {
      AveragedMember own = member;
      own.name = fmt::format("{}, {}", member.name, inner.name);
      own.weight = member.weight * inner.weight;
      own.inputs.clear();
      for (const Index input : inner.inputs) {
        own.inputs.push_back(member.inputs[static_cast<std::size_t>(input)]);
      }
      own.model = std::visit(
          [&](const auto& form) { return ModelOfForm(form, inner.parameters); },
          inner.form);
      members->push_back(std::move(own));
    }
  }

  // The columns that the members read, and how they come about.
  struct ReadByMembers {
    History history;

    std::vector<Index> PlacesOf(const FittedModel& map) {
      if (map.history == nullptr) return PlacesOf(map.inputs);
      const History& own = *map.history;
      history.time_unit = own.time_unit;
      history.session = own.session;
      history.time = own.time;
      for (const DerivedInput& input : own.derived) {
        if (std::ranges::none_of(
                history.derived, [&](const DerivedInput& known) {
                  return known.column.name == input.column.name;
                })) {
          history.derived.push_back(input);
        }
      }
      std::vector<Index> places;
      for (const std::string& column : own.form_inputs) {
        places.push_back(PlaceOf(column));
      }
      return places;
    }

   private:
    std::vector<Index> PlacesOf(const std::vector<TrainedInput>& inputs) {
      std::vector<Index> places;
      for (const TrainedInput& input : inputs) {
        places.push_back(PlaceOf(input.column.name));
      }
      return places;
    }

    Index PlaceOf(const std::string& column) {
      std::vector<std::string>& columns = history.form_inputs;
      const auto found = std::ranges::find(columns, column);
      const Index place = found - columns.begin();
      if (found == columns.end()) columns.push_back(column);
      return place;
    }
  };

  // One map that reads what any of the parts reads.
  FittedModel Average(const Dataset& training,
                      bool grows,
                      const std::vector<Part>& parts) const {
    ReadByMembers read_by;
    std::vector<AveragedMember> members;
    for (const Part& part : parts) {
      constexpr double kNoBound = std::numeric_limits<double>::infinity();
      const Bounds allowed = part.map.guards ? part.map.guards->ErrorBounds()
                                             : Bounds{-kNoBound, kNoBound};
      AveragedMember member{.name = part.name,
                            .weight = part.weight,
                            .inputs = read_by.PlacesOf(part.map),
                            .lowest = allowed.low,
                            .highest = allowed.high,
                            .model = part.map.model};
      AddMember(std::move(member), &members);
    }
    const History& history = read_by.history;
    const Dataset read = DeriveDataset(training, history);
    const std::vector<Index> all =
        stats::AllIndices(std::ssize(history.form_inputs));
    FittedModel fitted = NewMap(name_, ModelKind::kBlend, training);
    fitted.remarks = SharesOf(parts);
    fitted.inputs = DescribeInputs(read, all);
    if (options_.bases.clip) {
      fitted.guards =
          MakeClampLimits(fitted.inputs, training.target_values(), grows);
    }
    fitted.model = std::make_shared<AveragedModel>(
        std::ssize(all), "likelihood", std::move(members));
    if (!history.derived.empty()) {
      fitted = WithHistory(std::move(fitted), training, history);
    }
    return fitted;
  }

  std::string name_;
  BlendOptions options_;
};

OptionList<BlendOptions> List() {
  OptionList<BlendOptions> list = {
      OptionFor("net",
                "net:scg:view=auto among the members",
                &BlendOptions::net,
                OneOf<bool>{{{"no", false}, {"yes", true}}})
          .Always()};
  AddWithin(BasisOptionList(), &BlendOptions::bases, &list);
  return list;
}

}  // namespace

template <>
const std::vector<ListedModel<BlendOptions>>& ListedModels() {
  static const std::vector<ListedModel<BlendOptions>> models = {
      {.name = "blend",
       .about = "an average of maps that see the inputs differently",
       .defaults = {},
       .options = List,
       .complete = NameTheViewOf}};
  return models;
}

void BlendOptions::Validate() const { ValidateOptions(*this); }

std::unique_ptr<ModelRecipe> MakeRecipe(const BlendOptions& options,
                                        std::string name) {
  return std::make_unique<BlendRecipe>(options, std::move(name));
}

template BlendOptions OptionsOf(std::string_view spec);
template std::string SpecOf(const BlendOptions& options);

}  // namespace errmap::models
