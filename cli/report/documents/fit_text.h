#pragma once

#include <string>

#include "cli/report/screen.h"
#include "data/measurements/dataset.h"
#include "data/units.h"
#include "models/error_model.h"
#include "models/sensors/sensitivity.h"
#include "stats/error_metrics.h"

namespace errmap::report {

struct FitTextOptions {
  std::string out;  // file of the map
  bool correlations = false;
  /// True: tables are not cut to the terminal, and long equations are shown.
  bool details = false;
  Terminal terminal;
};

/// Returns what `errmap fit` prints of a map fitted to all rows of `dataset`:
/// its errors there (`train`), its equation, why the fit ended, its starts and
/// interval; tables of correlations and of the regression.
std::string FitText(const models::FittedModel& fitted,
                    const models::Sensitivity& sensitivity,
                    const stats::ErrorMetrics& train,
                    const data::Dataset& dataset,
                    const FitTextOptions& options);

/// Residual statistics as lines for a terminal, in the display unit.
std::string SummaryText(const stats::ErrorMetrics& metrics,
                        const data::Unit& unit,
                        double ks_d,
                        double ks_p_given);

}  // namespace errmap::report
