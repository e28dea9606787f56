#include "models/study/judgement/units_of_analysis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "stats/comparison/unit_losses.h"
#include "stats/indices.h"

namespace errmap::models {
namespace {

// Takes the units that `codes`, one per row of the source, number. One unit
// alone is none: its rows are all that there is to resample.
bool TakeUnits(const HeldOutRows& held,
               const std::vector<Index>& codes,
               const data::Grouping& grouping,
               std::vector<Index>* of_held,
               UnitsOfAnalysis* units) {
  std::vector<Index> found;
  for (const Index row : held.rows) {
    found.push_back(codes[static_cast<std::size_t>(row)]);
  }
  const std::set<Index> present(found.begin(), found.end());
  if (present.size() < 2) return false;
  units->name = data::WordFor(grouping);
  for (const Index code : present) {
    units->labels.push_back(grouping.labels[static_cast<std::size_t>(code)]);
  }
  stats::Renumber(&found);
  *of_held = std::move(found);
  return true;
}

// Codes of the units of the held-out rows; `units` gets name and labels. Where
// sessions and groups are both held out whole, the coarser are the units: what
// shares one may be alike.
std::vector<Index> UnitCodes(const Holdout& holdout,
                             const HeldOutRows& held,
                             UnitsOfAnalysis* units) {
  std::vector<Index> codes;
  const data::Dataset& source = *held.source;
  if (IsOfSessions(holdout, source) && TakeUnits(held,
                                                 source.session_codes(),
                                                 source.log()->sessions,
                                                 &codes,
                                                 units)) {
    units->are_sessions = true;
    return codes;
  }
  if (source.has_groups() &&
      TakeUnits(held, source.groups().codes, source.groups(), &codes, units)) {
    return codes;
  }
  units->name = kBlockOfRows;
  std::vector<Index> places = held.rows;
  const std::vector<Index> blocks =
      stats::BlocksInOrder(stats::Renumber(&places));
  std::map<Index, std::pair<std::size_t, std::size_t>> ends;  // of each block
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto row = static_cast<std::size_t>(held.rows[i]);
    codes.push_back(blocks[static_cast<std::size_t>(places[i])]);
    auto& [first, last] =
        ends.try_emplace(codes.back(), row, row).first->second;
    first = std::min(first, row);
    last = std::max(last, row);
  }
  const std::vector<Index>& data_rows = source.rows();
  for (const auto& [block, rows] : ends) {
    units->labels.push_back(fmt::format(
        "rows {}-{}", data_rows[rows.first], data_rows[rows.second]));
  }
  return codes;
}

// Whether each session begins on a day of its own.
bool BeginOnDaysOfTheirOwn(const data::SessionLog& log) {
  constexpr double kDay = 86400.0;
  std::set<double> days;
  return log.dated && std::ranges::all_of(log.first_rows, [&](Index row) {
           return days.insert(std::floor(log.time[row] / kDay)).second;
         });
}

// Whether no two units of the held-out rows share a session, and none spans
// two. Sessions that were cut by time alone are a guess, unless their dates
// differ: a clock may start anew with each cycle.
bool AreSeparateSessions(const HeldOutRows& held,
                         const std::vector<Index>& units) {
  const data::SessionLog* log = held.source->log().get();
  if (log == nullptr ||
      (log->sessions.column.empty() && !BeginOnDaysOfTheirOwn(*log))) {
    return false;
  }
  const std::vector<Index> sessions = held.source->session_codes();
  std::map<Index, Index> session_of;
  std::map<Index, Index> unit_of;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const Index session = sessions[static_cast<std::size_t>(held.rows[i])];
    if (session_of.try_emplace(units[i], session).first->second != session ||
        unit_of.try_emplace(session, units[i]).first->second != units[i]) {
      return false;
    }
  }
  return true;
}

}  // namespace

HeldOutRows GatherHeldOut(const data::Dataset& dataset,
                          const Holdout& holdout) {
  HeldOutRows held;
  held.source = &holdout.Source(dataset);
  for (std::size_t fold = 0; fold < holdout.folds.size(); ++fold) {
    const std::vector<Index>& rows = holdout.folds[fold].test;
    held.rows.insert(held.rows.end(), rows.begin(), rows.end());
    held.fold_of.insert(held.fold_of.end(), rows.size(), fold);
  }
  return held;
}

VectorXd ResidualsOf(const HeldOutRows& held, const HoldoutResult& result) {
  VectorXd residuals(std::ssize(held.rows));
  Index at = 0;
  for (const FoldResult& fold : result.folds) {
    for (const double predicted : fold.test_predictions) {
      const Index row = held.rows[static_cast<std::size_t>(at)];
      residuals[at++] = held.source->target_values()[row] - predicted;
    }
  }
  return residuals;
}

std::vector<Index> AssignUnits(const Holdout& holdout,
                               const HeldOutRows& held,
                               UnitsOfAnalysis* units) {
  std::vector<Index> codes = UnitCodes(holdout, held, units);
  units->separate_sessions = AreSeparateSessions(held, codes);
  return codes;
}

}  // namespace errmap::models
