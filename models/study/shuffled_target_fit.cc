#include "models/study/shuffled_target_fit.h"

#include <array>
#include <cmath>
#include <vector>

#include "data/text.h"
#include "fitting/interruption.h"
#include "models/net/net_recipe.h"
#include "models/study/fold_pool.h"
#include "stats/indices.h"
#include "stats/random.h"

namespace errmap::models {
namespace {

using data::Dataset;
// The stream of the shuffle is not that of the folds and weights.
constexpr std::uint64_t kShuffleStream = 0x6D656D6F72697365ULL;

// The fit to targets in another order, of the same recipe and start.
void RefitShuffled(const ModelRecipe& recipe,
                   const Dataset& training,
                   const FittedModel& fitted,
                   const FitContext& context,
                   ShuffledTargetFit* found) {
  if (fitting::IsInterrupted()) {
    found->why_not = "interrupted";
    return;
  }
  FitContext plain = context;
  plain.shared = nullptr;  // these are other rows
  plain.explain = false;
  plain.keep_trace = false;
  for (const StartResult& start : fitted.starts) {
    if (start.chosen) plain.seed = start.seed;
  }
  const Dataset shuffled =
      ShuffleTargets(training, context.seed ^ kShuffleStream);
  const FittedModel refit = recipe.Fit(shuffled, plain);
  switch (refit.summary.termination) {
    case fitting::Termination::kFailed:
      found->why_not = "the fit to shuffled targets: " + refit.summary.message;
      break;
    case fitting::Termination::kInterrupted:
      found->why_not = "interrupted";
      break;
    default:
      found->shuffled_r2 = Judge(shuffled, refit.Predict(shuffled)).r2;
  }
}

void Assess(const ModelRecipe& recipe,
            const Dataset& training,
            const FittedModel& fitted,
            const FitContext& context,
            ShuffledTargetFit* found) {
  const auto rows = static_cast<double>(fitted.RowsLearntFrom(training));
  found->weights_per_row =
      static_cast<double>(fitted.model->num_parameters()) / rows;
  found->train_r2 = Judge(training, fitted.Predict(training)).r2;
  const auto* net = dynamic_cast<const NetRecipe*>(&recipe);
  if (net == nullptr) {
    RefitShuffled(recipe, training, fitted, context, found);
    return;
  }
  if (!fitting::IsInterrupted()) {
    found->effective_parameters = net->EffectiveParametersOf(fitted, training);
    found->effective_per_row = found->effective_parameters / rows;
    if (std::isnan(found->effective_parameters)) {
      found->why_not = "effective parameters: too many rows and weights";
    }
  }
  RefitShuffled(*net->WithChoicesOf(fitted), training, fitted, context, found);
}

}  // namespace

std::string_view ToString(NoiseLearning learning) {
  constexpr auto kNames =
      std::to_array<std::string_view>({"unknown", "little", "some", "much"});
  return data::NameOf(kNames, learning);
}

NoiseLearning ShuffledTargetFit::learning() const {
  const double share = std::fmax(shuffled_r2, effective_per_row);
  if (std::isnan(share)) return NoiseLearning::kUnknown;
  if (share >= kMuchNoise) return NoiseLearning::kMuch;
  return share >= kSomeNoise ? NoiseLearning::kSome : NoiseLearning::kLittle;
}

ShuffledTargetFit FitShuffledTargets(const ModelRecipe& recipe,
                                     const Dataset& training,
                                     const FittedModel& fitted,
                                     const FitContext& context) {
  ShuffledTargetFit found;
  try {
    Assess(recipe, training, fitted, context, &found);
  } catch (const std::bad_alloc&) {
    found.why_not = "not enough memory";
  } catch (const std::exception& error) {
    found.why_not = error.what();
  }
  return found;
}

Dataset ShuffleTargets(const Dataset& dataset, std::uint64_t seed) {
  std::vector<Index> order = stats::AllIndices(dataset.num_rows());
  stats::Random(seed).Shuffle(order);
  return Dataset({.source = dataset.source(),
                  .inputs = dataset.inputs(),
                  .input_values = dataset.input_values(),
                  .target = dataset.target(),
                  .target_values = dataset.target_values()(order),
                  .groups = dataset.groups(),
                  .weights = dataset.weights(),
                  .rows = dataset.rows(),
                  .align = dataset.align(),
                  .log = dataset.log(),
                  .log_rows = dataset.log_rows()});
}

}  // namespace errmap::models
