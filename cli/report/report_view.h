#pragma once

#include <string>
#include <vector>

#include "cli/report/number_text.h"
#include "models/study/record/study_record.h"

namespace errmap::report {

using models::ComponentRecord;
using models::ModelRecord;
using models::ResultRecord;

/// The data of one component that all parts of a report use. It refers to the
/// record, which must outlive it.
struct ReportView {
  const ComponentRecord* component = nullptr;
  std::string name;
  std::string shown_unit;  // of the target, for display: "µm"
  double scale = 1.0;      // shown value = value * scale
  std::vector<std::string> holdouts;
  /// The hold-out of the recommendation, else the first one; "" = none.
  std::string decisive;
  bool decisive_is_unseen = false;  // whole groups or sessions are held out
  std::string neighbours;           // the one compared with it, "" = none
  std::string later;  // predicts later sessions from earlier ones, "" = none
  std::string recommended;  // model, "" = none
  /// By test RMSE under `decisive`, failed ones last.
  std::vector<const ModelRecord*> models;
};

ReportView ViewOf(const ComponentRecord& component);

/// Returns a hold-out by its name, or null.
const models::HoldoutRecord* HoldoutOf(const ReportView& view,
                                       const std::string& holdout);
/// Returns a model by its name, or null.
const ModelRecord* ModelOf(const ReportView& view, const std::string& model);

/// Returns the index of `model`, which must be one of view.models.
std::size_t PlaceOf(const ReportView& view, const ModelRecord& model);

/// Returns the results of a model under a hold-out, or null.
const ResultRecord* ResultOf(const ModelRecord& model,
                             const std::string& holdout);
const ResultRecord* ResultOf(const ReportView& view,
                             const std::string& model,
                             const std::string& holdout);
/// Returns its test RMSE in the target's unit, or NaN.
double TestRmse(const ModelRecord& model, const std::string& holdout);

/// Formats errors as in the report.
ErrorText ErrorTextOf(const ReportView& view);
/// Formats errors as on a terminal.
ErrorText ErrorTextOf(const ComponentRecord& component);

/// Returns a unit's symbol for display: "um" -> "µm", "degC" -> "°C".
std::string PrettyUnit(const std::string& symbol);

/// True if whole sessions or groups are predicted from those before them.
bool IsOfLaterUnits(const models::HoldoutRecord& holdout);
/// Returns the last such hold-out other than `decisive`, or null.
const models::HoldoutRecord* LaterHoldoutOf(const ComponentRecord& component,
                                            const std::string& decisive);
/// "unseen cycle", "later day", "another file", "neighbours": the name of a
/// hold-out's errors in tables and figures.
std::string UnseenWords(const ReportView& view, const std::string& holdout);

}  // namespace errmap::report
