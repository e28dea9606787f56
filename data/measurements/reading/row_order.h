#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace errmap::data {

/// The places (n) of rows in the order of their times (n): by one clock for all
/// where the sessions (n names; "": none) lie apart in it, else in each session
/// by itself, these by number or in order of appearance. Nothing where times
/// come again in other rows, as those of a clock that starts anew would.
std::optional<std::vector<Eigen::Index>> OrderOfTime(
    const Eigen::VectorXd& time, const std::vector<std::string>& sessions);

/// Whether a file begins before another ends, as one for each way does: the
/// times (n) of rows, and the file that each is of.
bool FilesInterleave(const Eigen::VectorXd& time,
                     const std::vector<Eigen::Index>& files);

/// Whether the number of the cycle (n) changes every few rows, and not to the
/// next one or to the first, or at one position (n codes; none: not known).
bool AreMixed(const std::vector<double>& cycles,
              const std::vector<Eigen::Index>& positions);

}  // namespace errmap::data
