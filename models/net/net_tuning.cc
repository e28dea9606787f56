#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include "models/inner_folds.h"
#include "models/net/net_fit.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

// Values tried and their held-out errors, simplest first: by rising number of
// nodes, or by falling wfactor.
template <typename Value>
using Scores = std::vector<std::pair<Value, double>>;

// Returns the first of the lowest errors; end() if there is none.
template <typename Value>
auto Lowest(const Scores<Value>& scores) {
  auto best = scores.end();
  for (auto it = scores.begin(); it != scores.end(); ++it) {
    if (std::isnan(it->second)) continue;
    if (best == scores.end() || it->second < best->second) best = it;
  }
  return best;
}

template <typename Value>
std::string ScoresText(const Scores<Value>& scores, const char* form) {
  std::string list;
  for (const auto& [value, rmse] : scores) {
    if (!list.empty()) list += ", ";
    list += fmt::format(fmt::runtime(form), value, rmse);
  }
  return list;
}

}  // namespace

std::pair<std::int64_t, double> FewestGoodNodes(
    const std::vector<std::pair<std::int64_t, double>>& scores) {
  constexpr double kNearEqual = 1.05;
  const auto best = Lowest(scores);
  if (best == scores.end()) {
    throw std::invalid_argument(
        "hidden=cv: no inner hold-out could be fitted; give a number");
  }
  const double enough = kNearEqual * best->second;
  return *std::find_if(scores.begin(), scores.end(), [&](const auto& score) {
    return score.second <= enough;
  });
}

namespace {

class Tuner {
 public:
  Tuner(const NetDesign& design,
        const NetTuning& tuning,
        const NetTrainers& trainers,
        const data::Dataset& training,
        const FitContext& context)
      : design_(design),
        trainers_(trainers),
        compares_(ComparesBy(tuning, trainers)),
        training_(training),
        context_(context),
        inner_(MakeInnerFolds(training, context)),
        hidden_(design.hidden),
        wfactor_(tuning.fixed_wfactor),
        along_path_(tuning.along_path),
        hopeless_(kOutOfReach * tuning.rival) {
    Index rows = training.num_rows();
    for (const fitting::FoldCodes::Rows& split : inner_.folds.Splits()) {
      rows = std::min(rows, std::ssize(split.train));
    }
    hidden_to_try_ = HiddenToTry(rows);
  }

  void ChooseBoth() {
    for (const std::int64_t hidden : hidden_to_try_) {
      if (hidden <= design_.hidden) hidden_ = hidden;
    }
    hidden_ = std::max(hidden_, hidden_to_try_.front());
    ChooseWfactor();
    const std::int64_t before = hidden_;
    ChooseHidden();
    if (hidden_ != before) ChooseWfactor();
  }

  void ChooseHidden() {
    std::vector<NetTrial> trials;
    for (const std::int64_t hidden : hidden_to_try_) {
      trials.push_back(
          {hidden, WfactorsOf(wfactor_, along_path_), context_.seed});
    }
    const std::vector<double> rmse = InnerHoldoutRmse(
        design_, compares_, training_, inner_, trials, context_);
    by_hidden_.clear();
    for (std::size_t i = 0; i < trials.size(); ++i) {
      by_hidden_.emplace_back(trials[i].hidden, rmse[i]);
    }
    std::tie(hidden_, hidden_rmse_) = FewestGoodNodes(by_hidden_);
  }

  void ChooseWfactor() {
    constexpr std::size_t kPatience = 3;  // places on the path
    NetDesign design = design_;
    design.hidden = hidden_;
    WfactorWalk walk(design,
                     compares_,
                     training_,
                     inner_,
                     context_.seed,
                     along_path_,
                     context_);
    const std::vector<double>& path = WfactorPath();
    std::map<std::size_t, double> tried;  // by place on the path
    // The place of the least error.
    const auto go_down_by = [&](std::size_t stride) {
      double least = std::numeric_limits<double>::infinity();
      std::size_t best = 0;
      for (std::size_t i = 0; i < path.size() && i < best + kPatience + stride;
           i += stride) {
        tried[i] = walk.Step(path[i]);
        if (tried[i] < least) {
          least = tried[i];
          best = i;
        }
        if (tried.size() >= kTrialsBeforeGivenUp && least > hopeless_) break;
      }
      return best;
    };
    if (along_path_) {
      go_down_by(1);
    } else {
      const std::size_t best = go_down_by(2);
      if (best > 0) tried[best - 1] = walk.Step(path[best - 1]);
      if (best + 1 < path.size()) tried[best + 1] = walk.Step(path[best + 1]);
    }
    by_wfactor_.clear();
    for (const auto& [place, rmse] : tried) {
      by_wfactor_.emplace_back(path[place], rmse);
    }
    const auto best = Lowest(by_wfactor_);
    if (best == by_wfactor_.end()) {
      throw std::invalid_argument(
          "wfactor=cv: no inner hold-out could be fitted; give a number");
    }
    std::tie(wfactor_, wfactor_rmse_) = *best;
  }

  // Checks if the brief fits that chose the wfactor are long enough.
  void ChooseIterations() {
    const std::vector<double> full =
        InnerHoldoutRmse(design_,
                         trainers_.full,
                         training_,
                         inner_,
                         {{hidden_, {wfactor_}, context_.seed}},
                         context_);
    by_iterations_ = {{trainers_.brief_iterations, wfactor_rmse_},
                      {trainers_.full_iterations, full.front()}};
    std::tie(iterations_, iterations_rmse_) = *Lowest(by_iterations_);
  }

  TunedNet Result(const NetTuning& tuning) const {
    TunedNet tuned{.hidden = hidden_,
                   .wfactor = wfactor_,
                   .iterations = iterations_,
                   .rmse = 0.0,
                   .folds = inner_.text,
                   .chosen = {}};
    if (tuning.hidden) {
      tuned.chosen.push_back({{"hidden", hidden_},
                              fmt::format("{} hidden nodes", hidden_),
                              hidden_rmse_,
                              ScoresText(by_hidden_, "{}: {:.4g}")});
    }
    if (tuning.wfactor) {
      tuned.chosen.push_back({{"wfactor", wfactor_},
                              fmt::format("wfactor {:.4g}", wfactor_),
                              wfactor_rmse_,
                              ScoresText(by_wfactor_, "{:.2g}: {:.4g}")});
    }
    if (!by_iterations_.empty()) {
      tuned.chosen.push_back({{"iterations", iterations_},
                              fmt::format("{} iterations", iterations_),
                              iterations_rmse_,
                              ScoresText(by_iterations_, "{}: {:.4g}")});
    }
    tuned.rmse = tuned.chosen.back().rmse;
    return tuned;
  }

 private:
  static const NetTrainer& ComparesBy(const NetTuning& tuning,
                                      const NetTrainers& trainers) {
    if (!tuning.wfactor) return trainers.full;
    if (trainers.along_path) return trainers.along_path;
    return trainers.brief ? trainers.brief : trainers.full;
  }

  const NetDesign& design_;
  const NetTrainers& trainers_;
  const NetTrainer& compares_;
  const data::Dataset& training_;
  const FitContext& context_;
  const InnerFolds inner_;
  std::vector<std::int64_t> hidden_to_try_;
  std::int64_t hidden_;
  double wfactor_;
  bool along_path_;
  double hopeless_;  // an RMSE
  double hidden_rmse_ = stats::kNaN;
  double wfactor_rmse_ = stats::kNaN;
  Scores<std::int64_t> by_hidden_;
  Scores<double> by_wfactor_;  // with hidden_ nodes
  // For the wfactor chosen by brief fits.
  std::int64_t iterations_ = 0;  // 0: nothing to choose
  double iterations_rmse_ = stats::kNaN;
  Scores<std::int64_t> by_iterations_;
};

// Continues a fit ended by a limit until another run lowers the cost by at most
// a hundredth. Otherwise its misfit would depend on the length of the run
// instead of on alpha.
fitting::Minimum TrainUntilSettled(const NetTrainer& trainer,
                                   const fitting::RunControl& run,
                                   NetTraining* training) {
  constexpr int kMostRuns = 20;
  constexpr double kSettled = 0.99;
  fitting::Minimum minimum = trainer(*training, run);
  for (int i = 1; i < kMostRuns; ++i) {
    if (minimum.summary.termination != fitting::Termination::kIterationLimit) {
      break;
    }
    const double before = minimum.summary.final_cost;
    training->initial_weights = minimum.x;
    minimum = trainer(*training, run);
    if (!(minimum.summary.final_cost < kSettled * before)) break;
  }
  return minimum;
}

}  // namespace

std::vector<std::int64_t> HiddenToTry(Index rows) {
  constexpr std::int64_t kRowsPerNode = 4;
  std::vector<std::int64_t> tried = {5};
  for (const std::int64_t hidden : {10, 20, 40, 60}) {
    if (hidden * kRowsPerNode <= rows) tried.push_back(hidden);
  }
  return tried;
}

std::vector<double> WfactorsOf(double wfactor, bool along_path) {
  return along_path ? WfactorPathTo(wfactor) : std::vector<double>{wfactor};
}

TunedNet TuneNet(const NetDesign& design,
                 const NetTuning& tuning,
                 const NetTrainers& trainers,
                 const data::Dataset& training,
                 const FitContext& context) {
  Tuner tuner(design, tuning, trainers, training, context);
  if (tuning.hidden && tuning.wfactor) {
    tuner.ChooseBoth();
  } else if (tuning.hidden) {
    tuner.ChooseHidden();
  } else if (tuning.wfactor) {
    tuner.ChooseWfactor();
  }
  if (tuning.wfactor && trainers.brief) tuner.ChooseIterations();
  return tuner.Result(tuning);
}

fitting::DiscrepancyChoice ChooseWfactorByDiscrepancy(
    const NetRows& rows,
    const NetTrainer& trainer,
    double delta,
    const FitContext& context) {
  const fitting::RunControl run{.keep_trace = context.keep_trace};
  NetTraining training = rows.From(context.seed, 0.0);
  const VectorXd start = training.initial_weights;
  return fitting::ChooseByDiscrepancy(
      delta,
      start,
      [&](double wfactor, const VectorXd& from) {
        training.wfactor = wfactor;
        training.initial_weights = from;
        return TrainUntilSettled(trainer, run, &training);
      },
      [&](const VectorXd& w) { return rows.TrainingRms(w); });
}

}  // namespace errmap::models
