#pragma once

#include "cli/json_blocks.h"
#include "cli/study_file/comparison.h"

namespace errmap::cli {

/// What the figures of a report need beyond the other keys of a component:
///
/// {"inputs": [{"name","unit"}],        those that a fitted map reads, at most
///  "inputs_left_out": n,               45, the position first
///  "position": column|null, "group": column|null,
///  "tables": [{"file", "rows_total", "rows": [0-based data rows],
///              "labels": [group labels], "groups": [index into labels],
///              "target": [...], "inputs": [[one per row], ...]}],
///  "holdouts": [{"name", "table": index, "predictions": {MODEL: [...]}}],
///  "correlation": {"columns": [...], "matrix": [[...]]}}
///
/// Tables of more than 5000 rows are thinned evenly. A prediction is null
/// where its row is not held out; of a row held out more than once the first
/// counts, as in "normality". Models that failed under a hold-out are not
/// there. Numbers have 9 significant digits.
Json FigureDataJson(const Comparison& comparison);

}  // namespace errmap::cli
