#pragma once

#include <string>

#include "cli/netcg/netcg_run.h"

namespace errmap::netcg {

/// Which figures a report shows.
enum class NetcgStatistics {
  kAsPrinted,  // as the program printed them; a line points to the errata
  kCorrected,  // right ones, in the same places; lines say what they are
};

/// The run report in the layout of NISTIR 5367, Appendix B.
std::string RunReport(const NetcgSpecification& specification,
                      const NetcgResult& result,
                      NetcgStatistics statistics);

/// "achieved error goal", "iteration limit", ...: how the report ends.
std::string EndingOf(int ierr);

/// The graphics file of the error curve; of reals in that precision.
std::string ErrorCurveGraph(const NetcgResult& result,
                            NetcgPrecision precision);

/// The graphics file of the residuals of the first output.
std::string ResidualGraph(const NetcgFigures& figures);

/// What the 1995 program and its report have wrong, a line each.
std::string NetcgErrata();

}  // namespace errmap::netcg
