#include "models/polynomial/selection_bootstrap.h"

#include <map>
#include <mutex>

#include "fitting/interruption.h"
#include "fitting/parallel_for.h"
#include "models/regression_record.h"
#include "stats/not_a_number.h"
#include "stats/random.h"

namespace errmap::models {

namespace {

// The share of repetitions in which each candidate (m) is chosen.
VectorXd BootstrapInclusion(const DesignRows& rows,
                            const std::vector<Index>& units,
                            int repetitions,
                            const ChooseTerms& choose,
                            const FitContext& context) {
  const Index count = rows.response.size();
  // Units are numbered anew: a code may have no rows here.
  std::map<Index, Index> number;
  std::vector<Index> unit_of(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < unit_of.size(); ++i) {
    const Index code = units.empty() ? static_cast<Index>(i) : units[i];
    unit_of[i] = number.emplace(code, std::ssize(number)).first->second;
  }
  const auto num_units = static_cast<std::uint64_t>(number.size());
  // Draws are made in order, so that threads change nothing.
  stats::Random random(context.seed);
  std::vector<VectorXd> weights;
  for (int i = 0; i < repetitions; ++i) {
    VectorXd times = VectorXd::Zero(static_cast<Index>(num_units));
    for (std::uint64_t draw = 0; draw < num_units; ++draw) {
      times[static_cast<Index>(random.Below(num_units))] += 1.0;
    }
    VectorXd weight = times(unit_of);
    if (rows.weights.size() != 0) weight = weight.cwiseProduct(rows.weights);
    weights.push_back(std::move(weight));
  }
  VectorXd shares = VectorXd::Zero(rows.terms.cols());
  std::mutex mutex;
  bool stopped = false;
  fitting::ParallelFor(context.threads, repetitions, [&](int i) {
    if (fitting::IsInterrupted()) {
      const std::lock_guard lock(mutex);
      stopped = true;
      return;
    }
    const fitting::RegressionProblem problem{
        rows.terms,
        rows.response,
        weights[static_cast<std::size_t>(i)],
        rows.intercept,
        rows.observations};
    const std::vector<Index> chosen = choose(problem);
    const std::lock_guard lock(mutex);
    for (const Index term : chosen) shares[term] += 1.0;
  });
  if (stopped) {
    return VectorXd::Constant(shares.size(), stats::kNaN);
  }
  return shares / static_cast<double>(repetitions);
}

}  // namespace

void ReportInclusion(const TermDictionary& dictionary,
                     const DesignRows& rows,
                     const std::vector<Index>& units,
                     const std::vector<Index>& chosen,
                     int repetitions,
                     const ChooseTerms& choose,
                     const FitContext& context,
                     RegressionRecord* report) {
  const data::Dataset& training = dictionary.design.dataset();
  LeastSquaresRecord& fit = *report->least_squares.value;
  fit.bootstrap = {
      .repetitions = repetitions,
      .unit = training.has_groups() ? training.groups().column : "row"};
  const VectorXd shares =
      BootstrapInclusion(rows, units, repetitions, choose, context);
  for (const Index term : chosen) {
    report->coefficients.emplace_back().of_term.value =
        TermRecord{.bootstrap_inclusion = shares[term]};
  }
  const std::vector<std::string> names = dictionary.design.TermNames();
  std::map<std::string, double> share_of;
  for (std::size_t j = 0; j < names.size(); ++j) {
    share_of[names[j]] = shares[static_cast<Index>(j)];
  }
  for (ExcludedRecord& excluded : fit.excluded) {
    excluded.bootstrap_inclusion = share_of[excluded.term];
  }
}

}  // namespace errmap::models
