#pragma once

#include "cli/report/figures/figure_parts.h"

namespace errmap::report {

// Distribution of the residuals: the figures of the report of 1995.

/// Histogram with the normal curve of the same mean and sd (Figure 11).
Figure HistogramFigure(const ResidualContext& context);

/// Normal probability plot (Figure 7).
Figure NormalPlotFigure(const ResidualContext& context);

}  // namespace errmap::report
