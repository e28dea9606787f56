#include "models/promise/probe_study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "models/promise/held_out_errors.h"
#include "models/promise/session_offset.h"
#include "models/study/judgement/units_of_analysis.h"
#include "stats/spread_sample.h"

namespace errmap::models {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// The held-out rows of one session in order of time.
struct Session {
  std::vector<Index> places;   // into the held-out rows
  std::vector<bool> is_probe;  // (places) of the largest number
  std::vector<Index> probes;   // places of the probes, in order
};

// Each probe is the first row at its time or after it.
void TakeProbes(const VectorXd& elapsed,
                Index most,
                double spacing,
                Session* session) {
  session->is_probe.assign(session->places.size(), false);
  double next = 0.0;
  for (std::size_t i = 0; i < session->places.size(); ++i) {
    if (static_cast<Index>(session->probes.size()) == most) return;
    const double time = elapsed[session->places[i]];
    if (time < next) continue;
    session->probes.push_back(session->places[i]);
    session->is_probe[i] = true;
    next = time + spacing;
  }
}

std::vector<Session> SessionsOf(const std::vector<Index>& codes,
                                const VectorXd& elapsed,
                                Index most,
                                double spacing) {
  std::map<Index, Session> by_code;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    by_code[codes[i]].places.push_back(static_cast<Index>(i));
  }
  std::vector<Session> sessions;
  for (auto& [code, session] : by_code) {
    std::ranges::stable_sort(
        session.places, {}, [&](Index i) { return elapsed[i]; });
    TakeProbes(elapsed, most, spacing, &session);
    sessions.push_back(std::move(session));
  }
  return sessions;
}

HeldOutErrors ErrorsOfOthers(const std::vector<Session>& sessions,
                             std::size_t but,
                             const VectorXd& elapsed,
                             const VectorXd& residuals) {
  // Pairs of rows count by the square; these are as many as maps carry.
  constexpr Index kMostRows = 48;
  HeldOutErrors errors;
  errors.time_unit = "s";
  for (std::size_t s = 0; s < sessions.size(); ++s) {
    if (s == but) continue;
    const std::vector<Index> places =
        stats::SpreadSample(sessions[s].places, kMostRows);
    errors.units.push_back({.label = "",
                            .rmse = 0.0,
                            .elapsed = elapsed(places),
                            .position = {},
                            .residuals = residuals(places)});
  }
  return errors;
}

// Sum of squares of the scored rows of a session after so many probes.
double SquaresAfter(const Session& session,
                    Index probes,
                    const OffsetModel& model,
                    const VectorXd& elapsed,
                    const VectorXd& residuals) {
  OffsetFilter filter(model);
  double squares = 0.0;
  Index used = 0;
  for (std::size_t i = 0; i < session.places.size(); ++i) {
    const Index place = session.places[i];
    filter.Advance(elapsed[place]);
    if (!session.is_probe[i]) {
      squares += std::pow(residuals[place] - filter.offset(), 2);
    } else if (used < probes) {
      filter.Update(residuals[place]);
      ++used;
    }
  }
  return squares;
}

void RequireSense(const std::vector<Index>& numbers, double spacing) {
  if (numbers.empty() || std::ranges::min(numbers) < 0 || !(spacing > 0.0)) {
    throw std::invalid_argument(
        "StudyProbes: needs numbers of probes from 0 on and a spacing above 0");
  }
}

}  // namespace

ProbeStudy StudyProbes(const data::Dataset& dataset,
                       const Holdout& holdout,
                       std::size_t holdout_index,
                       const StudyResult& study,
                       std::vector<Index> numbers,
                       double spacing) {
  RequireSense(numbers, spacing);
  const HeldOutRows held = GatherHeldOut(dataset, holdout);
  const data::Dataset& source = *held.source;
  if (source.log() == nullptr) {
    throw std::invalid_argument("the data have no sessions to probe");
  }
  const std::vector<Index> all_codes = source.session_codes();
  std::vector<Index> codes;
  for (const Index row : held.rows) {
    codes.push_back(all_codes[static_cast<std::size_t>(row)]);
  }
  const VectorXd elapsed = ElapsedOf(source)(held.rows);
  const std::vector<Session> sessions =
      SessionsOf(codes, elapsed, std::ranges::max(numbers), spacing);
  ProbeStudy result{.holdout = holdout.name,
                    .unit = data::WordFor(source.log()->sessions),
                    .spacing = spacing,
                    .time_unit = source.log()->time_unit,
                    .numbers = std::move(numbers),
                    .scored_rows = 0,
                    .rows = {}};
  for (const Session& session : sessions) {
    result.scored_rows +=
        static_cast<Index>(session.places.size() - session.probes.size());
  }
  if (sessions.size() < 2 || result.scored_rows == 0) {
    throw std::invalid_argument("no row is left to score, or one session only");
  }
  for (const ModelResult& model : study.models) {
    const HoldoutResult& judged = model.holdouts[holdout_index];
    if (!judged.ok()) continue;
    const VectorXd residuals = ResidualsOf(held, judged);
    if (!residuals.allFinite()) continue;
    ProbeStudy::Row& row = result.rows.emplace_back();
    row.model = model.name;
    std::vector<double> squares(result.numbers.size(), 0.0);
    for (std::size_t s = 0; s < sessions.size(); ++s) {
      const OffsetModel offset =
          FitOffset(ErrorsOfOthers(sessions, s, elapsed, residuals));
      for (std::size_t n = 0; n < squares.size(); ++n) {
        squares[n] += SquaresAfter(
            sessions[s], result.numbers[n], offset, elapsed, residuals);
      }
    }
    for (const double sum : squares) {
      row.rmse.push_back(
          std::sqrt(sum / static_cast<double>(result.scored_rows)));
    }
  }
  return result;
}

ProbesRecord MakeRecord(const ProbeStudy& study) {
  ProbesRecord record{.holdout = study.holdout,
                      .unit = study.unit,
                      .spacing = study.spacing,
                      .time_unit = study.time_unit,
                      .numbers = {study.numbers.begin(), study.numbers.end()},
                      .scored_rows = study.scored_rows,
                      .models = {}};
  for (const ProbeStudy::Row& row : study.rows) {
    record.models.push_back({.model = row.model, .rmse = row.rmse});
  }
  return record;
}

}  // namespace errmap::models
