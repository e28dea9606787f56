#pragma once

#include "cli/report/figures/figure_parts.h"

namespace errmap::report {

// How the residuals are distributed; the figures of the report of 1995.

/// The histogram with the normal curve of the same mean and sd (Figure 11).
Figure HistogramFigure(const ResidualContext& context);

/// The normal probability plot (Figure 7).
Figure NormalPlotFigure(const ResidualContext& context);

}  // namespace errmap::report
