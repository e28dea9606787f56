#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "models/study/judgement/residual_assessment.h"
#include "models/study/record/component_study.h"
#include "models/study/record/study_record.h"

// The parts of a component's record, each made by a file of this folder.

namespace errmap::models {

// ---- fit_blocks.cc ----

SummaryRecord MakeRecord(const fitting::FitSummary& summary);
/// One or more starts.
StartsRecord MakeRecord(const std::vector<StartResult>& starts);
ByName<OptionValue> MakeRecord(const std::vector<EffectiveOption>& options);

/// Makes the record of a fit: its time and outcome; empty lists are left out.
FitRecord MakeFitRecord(double fit_seconds,
                        const fitting::FitSummary& summary,
                        const std::vector<std::string>& remarks,
                        const std::vector<EffectiveOption>& choices,
                        const std::vector<StartResult>& starts);

// ---- make_judgement_record.cc ----

/// Returns the 95 % interval of a model's RMSE under a hold-out; NaN if there
/// are too few units.
IntervalRecord RmseInterval(const HoldoutComparison& tests, std::size_t model);

/// Returns nothing if there is no goal or it could not be judged.
std::optional<bool> MeetsGoal(GoalStanding standing);

/// Adds hold-out results: the models compared with each other, and the
/// recommended model on its own. The caller adds its cost, reasons and caveats.
void AddJudgement(const ComponentStudy& study, ComponentRecord* record);

/// Makes the record of a component that was judged with re-zeroing.
RezeroRecord MakeRezeroRecord(const ComponentStudy& study);

// ---- make_residual_record.cc ----

/// A test that does not apply has NaN and the reason.
NormalityRecord MakeRecord(const stats::Normality& normality,
                           const stats::MonteCarloP& monte_carlo);

/// Makes the record of serial tests over the whole order and within groups,
/// halves, biases by group and position, and variance against fitted.
RandomnessRecord MakeRecord(const ResidualReport& report);

/// Returns the prediction of each of the `num_rows` rows of the data set, or of
/// the hold-out's test data. If a row is held out more than once
/// (groups:K:repeats=R), the first counts; if never, it is NaN.
VectorXd HeldOutPredictions(const Holdout& holdout,
                            const HoldoutResult& result,
                            Index num_rows);

/// Returns a model's held-out residuals in the file's order, with groups and
/// positions, by HeldOutPredictions. The model must not have failed under that
/// hold-out.
ResidualInputs HeldOutResiduals(const ComponentStudy& comparison,
                                std::size_t model,
                                std::size_t holdout);

// ---- make_figure_record.cc ----

/// Makes the rows used in the figures. Each table has the target, the inputs of
/// a fitted map (at most 45, the position first) and every model's held-out
/// predictions. Tables of more than 5000 rows are thinned evenly. A row held
/// out more than once has its first prediction. Models that failed under a
/// hold-out are missing. Numbers have 9 significant digits.
FiguresRecord MakeFiguresRecord(const ComponentStudy& study);

/// Returns weighted Pearson correlations of the inputs and the target.
CorrelationRecord Correlate(const data::Dataset& dataset);

}  // namespace errmap::models
