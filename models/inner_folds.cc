#include "models/inner_folds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include <fmt/format.h>

#include "stats/holdout.h"
#include "stats/indices.h"
#include "stats/not_a_number.h"

namespace errmap::models {
namespace {

Index NumGroups(const data::Dataset& dataset) {
  const std::vector<Index>& codes = dataset.groups().codes;
  return static_cast<Index>(std::set<Index>(codes.begin(), codes.end()).size());
}

// A fold for each row: group after group to the next of `count`.
std::vector<Index> DealtInTurn(std::vector<Index> groups, Index count) {
  stats::Renumber(&groups);
  for (Index& group : groups) group %= count;
  return groups;
}

// The kind that the rows allow.
InnerHoldout KindFor(const data::Dataset& training, InnerHoldout wanted) {
  const Index sessions = training.num_sessions();
  if (wanted == InnerHoldout::kDecisive) {
    wanted = sessions >= kFewestSessionsToDecide ? InnerHoldout::kWholeSessions
                                                 : InnerHoldout::kWholeGroups;
  }
  if (wanted == InnerHoldout::kWholeSessions && sessions < 2) {
    wanted = InnerHoldout::kWholeGroups;
  }
  if (wanted == InnerHoldout::kWholeGroups && NumGroups(training) < 2) {
    wanted = InnerHoldout::kBlocks;
  }
  return wanted;
}

}  // namespace

InnerFolds MakeInnerFolds(const data::Dataset& training,
                          const FitContext& context,
                          GroupDeal deal) {
  constexpr Index kFolds = 5;
  const InnerHoldout kind = KindFor(training, context.inner_holdout);
  const Index groups = NumGroups(training);
  std::vector<Index> codes;
  Index units = training.num_rows();
  std::string of;  // what is held out whole
  if (kind == InnerHoldout::kWholeSessions) {
    codes = training.session_codes();
    units = training.num_sessions();
    of = training.log()->sessions.column;
  } else if (kind == InnerHoldout::kWholeGroups ||
             (kind == InnerHoldout::kForward && groups >= 2)) {
    codes = training.groups().codes;
    units = groups;
    of = training.groups().column;
  }
  const Index count = std::min(kFolds, units);
  InnerFolds inner;
  inner.whole_sessions = kind == InnerHoldout::kWholeSessions;
  inner.units = of.empty() ? count : units;
  switch (kind) {
    case InnerHoldout::kForward:
      // Blocks in order need one more to start from.
      inner.text = count > 1 ? fmt::format("forward:{}", count - 1)
                             : fmt::format("kfold:{}", count);
      break;
    case InnerHoldout::kRows:
      inner.text = fmt::format("kfold:{}", count);
      break;
    default:
      inner.text = fmt::format("{}:{}", ToString(kind), count);
      break;
  }
  inner.in_turn = deal == GroupDeal::kInTurn && !of.empty() &&
                  context.inner_holdout == InnerHoldout::kWholeGroups;
  if (inner.in_turn) {
    inner.folds.codes = DealtInTurn(codes, count);
    inner.text += " of " + of;
    return inner;
  }
  const auto made = stats::MakeFolds(stats::ParseHoldout(inner.text),
                                     training.num_rows(),
                                     codes,
                                     context.seed);
  if (!of.empty()) inner.text += " of " + of;
  inner.folds.forward = kind == InnerHoldout::kForward;
  inner.folds.codes.assign(static_cast<std::size_t>(training.num_rows()), 0);
  for (std::size_t fold = 0; fold < made.size(); ++fold) {
    for (const Index row : made[fold].test) {
      inner.folds.codes[static_cast<std::size_t>(row)] =
          static_cast<Index>(fold) + inner.folds.first_judged();
    }
  }
  return inner;
}

InnerError TypicalError(const InnerFolds& folds,
                        const VectorXd& mean_squares,
                        const VectorXd& weights,
                        double indifference) {
  const VectorXd shares = weights / weights.sum();
  const auto spread = [&](const VectorXd& values, double mean) {
    if (values.size() < 2) return stats::kNaN;
    const double variance =
        shares.dot(VectorXd((values.array() - mean).square()));
    return std::sqrt(variance / static_cast<double>(values.size() - 1));
  };
  if (!folds.whole_sessions) {
    const double mean = shares.dot(mean_squares);
    return {mean, spread(mean_squares, mean)};
  }
  // Adding what does not matter keeps a fold without error from deciding.
  const double floor =
      std::max(indifference * indifference, std::numeric_limits<double>::min());
  const VectorXd logs = (mean_squares.array() + floor).log();
  const double mean = shares.dot(logs);
  const double typical = std::exp(mean);
  return {typical, typical * spread(logs, mean)};
}

double TypicalRmse(const InnerFolds& folds,
                   const VectorXd& squares,
                   const VectorXd& rows,
                   double indifference) {
  return std::sqrt(
      TypicalError(folds, squares.cwiseQuotient(rows), rows, indifference)
          .mean_square);
}

}  // namespace errmap::models
