#pragma once

#include <string>

#include "cli/report/screen.h"
#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "models/sensors/sensitivity.h"
#include "stats/error_metrics.h"

namespace errmap::report {

struct FitTextOptions {
  std::string out;  // file of the map
  bool correlations = false;
  /// Everything: tables are not cut to the terminal, nor long equations left
  /// out.
  bool details = false;
  Terminal terminal;
};

/// What `errmap fit` tells of a map fitted to all rows of `dataset`: errors
/// there (`train`), equation, how the fit ended, starts, correlations and
/// regression as tables, and the interval.
std::string FitText(const models::FittedModel& fitted,
                    const models::Sensitivity& sensitivity,
                    const stats::ErrorMetrics& train,
                    const data::Dataset& dataset,
                    const FitTextOptions& options);

}  // namespace errmap::report
