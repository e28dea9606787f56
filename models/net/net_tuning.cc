#include "models/net/net_tuning.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

namespace errmap::models {
namespace {

using Eigen::Index;

// Held-out errors: of wfactors by half decades of log10, of hidden nodes by
// their number.
using Scores = std::map<std::int64_t, double>;

double WfactorOf(std::int64_t half_decades) {
  constexpr double kPerDecade = 2.0;
  return std::pow(10.0, static_cast<double>(half_decades) / kPerDecade);
}

// The last of the lowest errors; end() where there is none.
Scores::const_iterator Lowest(const Scores& scores) {
  auto best = scores.end();
  for (auto it = scores.begin(); it != scores.end(); ++it) {
    if (std::isnan(it->second)) continue;
    if (best == scores.end() || it->second <= best->second) best = it;
  }
  return best;
}

// The lowest error; of equal ones the larger wfactor, since it is simpler.
std::int64_t BestWfactor(const Scores& scores) {
  const auto best = Lowest(scores);
  if (best == scores.end()) {
    throw std::invalid_argument(
        "wfactor=cv: no inner hold-out could be fitted; give a number");
  }
  return best->first;
}

std::int64_t FewestGoodNodes(const Scores& scores) {
  constexpr double kNearEqual = 1.05;
  const auto best = Lowest(scores);
  if (best == scores.end()) {
    throw std::invalid_argument(
        "hidden=cv: no inner hold-out could be fitted; give a number");
  }
  const double enough = kNearEqual * best->second;
  return std::find_if(scores.begin(),
                      scores.end(),
                      [&](const auto& score) { return score.second <= enough; })
      ->first;
}

class Tuner {
 public:
  Tuner(const NetDesign& design,
        const NetTuning& tuning,
        const NetTrainer& trainer,
        const data::Dataset& training,
        const FitContext& context)
      : design_(design),
        trainer_(trainer),
        training_(training),
        context_(context),
        inner_(MakeInnerFolds(training, context)),
        hidden_(design.hidden),
        wfactor_(tuning.fixed_wfactor) {
    Index rows = training.num_rows();
    const fitting::FoldCodes& folds = inner_.folds;
    for (Index fold = folds.first_judged(); fold < folds.count(); ++fold) {
      rows = std::min(rows, static_cast<Index>(folds.Split(fold).train.size()));
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
    if (hidden_ != before) AdjustWfactor();
  }

  void ChooseHidden() {
    std::vector<NetTrial> trials;
    for (const std::int64_t hidden : hidden_to_try_) {
      trials.push_back({hidden, wfactor_, context_.seed});
    }
    const std::vector<double> rmse = Judge(trials);
    by_hidden_.clear();
    for (std::size_t i = 0; i < trials.size(); ++i) {
      by_hidden_[trials[i].hidden] = rmse[i];
    }
    hidden_ = FewestGoodNodes(by_hidden_);
  }

  void ChooseWfactor() {
    constexpr std::int64_t kLeast = -14;  // 1e-7
    constexpr std::int64_t kDecade = 2;
    constexpr std::int64_t kMost = 0;  // 1
    std::vector<std::int64_t> decades;
    for (std::int64_t i = kLeast; i <= kMost; i += kDecade) {
      decades.push_back(i);
    }
    JudgeWfactors(decades);
    const std::int64_t coarse = BestWfactor(by_wfactor_);
    JudgeWfactors({coarse - 1, coarse + 1});
    exponent_ = BestWfactor(by_wfactor_);
    wfactor_ = WfactorOf(exponent_);
  }

  TunedNet Result(const NetTuning& tuning) const {
    TunedNet tuned{hidden_, wfactor_, inner_.text, {}};
    if (tuning.hidden) {
      std::string scores;
      for (const auto& [hidden, rmse] : by_hidden_) {
        if (!scores.empty()) scores += ", ";
        scores += fmt::format("{}: {:.4g}", hidden, rmse);
      }
      tuned.chosen.push_back(
          {{"hidden", hidden_}, by_hidden_.at(hidden_), std::move(scores)});
    }
    if (tuning.wfactor) {
      std::string scores;
      for (const auto& [exponent, rmse] : by_wfactor_) {
        if (!scores.empty()) scores += ", ";
        scores += fmt::format("{:.2g}: {:.4g}", WfactorOf(exponent), rmse);
      }
      tuned.chosen.push_back({{"wfactor", wfactor_},
                              by_wfactor_.at(exponent_),
                              std::move(scores)});
    }
    return tuned;
  }

 private:
  std::vector<double> Judge(const std::vector<NetTrial>& trials) const {
    return InnerHoldoutRmse(
        design_, trainer_, training_, inner_, trials, context_);
  }

  void JudgeWfactors(const std::vector<std::int64_t>& exponents) {
    std::vector<NetTrial> trials;
    for (const std::int64_t exponent : exponents) {
      trials.push_back({hidden_, WfactorOf(exponent), context_.seed});
    }
    const std::vector<double> rmse = Judge(trials);
    for (std::size_t i = 0; i < exponents.size(); ++i) {
      by_wfactor_[exponents[i]] = rmse[i];
    }
  }

  // For another number of nodes, beside the wfactor of the last.
  void AdjustWfactor() {
    constexpr std::int64_t kDecade = 2;
    by_wfactor_ = {{exponent_, by_hidden_.at(hidden_)}};
    JudgeWfactors({exponent_ - kDecade,
                   exponent_ - 1,
                   exponent_ + 1,
                   exponent_ + kDecade});
    exponent_ = BestWfactor(by_wfactor_);
    wfactor_ = WfactorOf(exponent_);
  }

  const NetDesign& design_;
  const NetTrainer& trainer_;
  const data::Dataset& training_;
  const FitContext& context_;
  const InnerFolds inner_;
  std::vector<std::int64_t> hidden_to_try_;
  std::int64_t hidden_;
  double wfactor_;
  std::int64_t exponent_ = 0;  // of wfactor_, where it is chosen
  Scores by_hidden_;
  Scores by_wfactor_;  // with hidden_ nodes
};

}  // namespace

std::vector<std::int64_t> HiddenToTry(Index rows) {
  constexpr std::int64_t kRowsPerNode = 4;
  std::vector<std::int64_t> tried = {5};
  for (const std::int64_t hidden : {10, 20, 40, 60}) {
    if (hidden * kRowsPerNode <= rows) tried.push_back(hidden);
  }
  return tried;
}

TunedNet TuneNet(const NetDesign& design,
                 const NetTuning& tuning,
                 const NetTrainer& trainer,
                 const data::Dataset& training,
                 const FitContext& context) {
  Tuner tuner(design, tuning, trainer, training, context);
  if (tuning.hidden && tuning.wfactor) {
    tuner.ChooseBoth();
  } else if (tuning.hidden) {
    tuner.ChooseHidden();
  } else if (tuning.wfactor) {
    tuner.ChooseWfactor();
  }
  return tuner.Result(tuning);
}

}  // namespace errmap::models
