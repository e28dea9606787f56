#pragma once

#include <string>
#include <vector>

#include "cli/report/report_view.h"

namespace errmap::report {

/// Held-out rows of one model under one hold-out, if they have a prediction;
/// errors are in the shown unit.
struct HeldOutRows {
  std::vector<double> row;
  std::vector<double> target;
  std::vector<double> predicted;
  std::vector<double> residual;
  std::vector<double> group;                // index into labels; empty if none
  std::vector<std::vector<double>> inputs;  // (inputs x rows)
  std::vector<std::string> labels;
  std::vector<double> session;  // index into session_labels
  std::vector<std::string> session_labels;
  std::vector<double> time;   // s; empty if unknown
  std::vector<bool> outside;  // the recommended map's range
  bool thinned = false;
  std::string missing;  // the reason if there are none
};

/// Returns the rows that the results keep for figures; `missing` says why if
/// there are none.
HeldOutRows HeldOutRowsOf(const ReportView& view,
                          const std::string& model,
                          const std::string& holdout);

}  // namespace errmap::report
