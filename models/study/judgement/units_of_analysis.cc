#include "models/study/judgement/units_of_analysis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "stats/comparison/unit_losses.h"

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
  std::map<Index, Index> unit_of;  // by code: units never held out have none
  for (const Index code : found) unit_of[code] = 0;
  if (unit_of.size() < 2) return false;
  units->name = data::WordFor(grouping);
  for (auto& [code, unit] : unit_of) {
    unit = std::ssize(units->labels);
    units->labels.push_back(grouping.labels[static_cast<std::size_t>(code)]);
  }
  for (Index& code : found) code = unit_of[code];
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
  std::vector<Index> ordered = held.rows;
  std::ranges::sort(ordered);
  ordered.erase(std::unique(ordered.begin(), ordered.end()), ordered.end());
  const std::vector<Index> blocks = stats::BlocksInOrder(std::ssize(ordered));
  std::vector<Index> block_of(
      static_cast<std::size_t>(ordered.empty() ? 0 : ordered.back() + 1));
  std::vector<std::pair<Index, Index>> ends;  // data rows of each block
  std::size_t at = 0;
  for (const Index row : ordered) {
    const Index block = blocks[at++];
    block_of[static_cast<std::size_t>(row)] = block;
    const Index data_row = held.source->rows()[static_cast<std::size_t>(row)];
    if (block == std::ssize(ends)) {
      ends.emplace_back(data_row, data_row);
    }
    ends.back().second = data_row;
  }
  for (const auto& [first, last] : ends) {
    units->labels.push_back(fmt::format("rows {}-{}", first, last));
  }
  for (const Index row : held.rows) {
    codes.push_back(block_of[static_cast<std::size_t>(row)]);
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
  held.source =
      holdout.test_data != nullptr ? holdout.test_data.get() : &dataset;
  for (std::size_t fold = 0; fold < holdout.folds.size(); ++fold) {
    const Index size = holdout.test_data != nullptr
                           ? held.source->num_rows()
                           : std::ssize(holdout.folds[fold].test);
    for (Index i = 0; i < size; ++i) {
      held.rows.push_back(
          holdout.test_data != nullptr
              ? i
              : holdout.folds[fold].test[static_cast<std::size_t>(i)]);
      held.fold_of.push_back(fold);
    }
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
