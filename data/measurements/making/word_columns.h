#pragma once

#include <string>
#include <vector>

#include "data/csv.h"
#include "data/measurements/dataset.h"

namespace errmap::data {

/// A column of a few values that may part the rows into things that err
/// differently: machines, tools, directions.
struct PartingColumn {
  std::string name;
  std::vector<std::string> values = {};  // distinct, in order of appearance
  std::vector<std::size_t> codes = {};   // (rows asked for) index into values
};

/// That column in these rows of the table; no values where it has one or more
/// than 12, or lacks one of them somewhere.
PartingColumn PartBy(const CsvTable& table,
                     const CsvColumn& column,
                     const std::vector<Eigen::Index>& rows);

/// Whether it changes only where a session (codes of the same rows) does.
bool IsOneInEach(const std::vector<Eigen::Index>& sessions,
                 const PartingColumn& column);

/// Root mean squares of what plain linear maps miss, degrees of freedom taken
/// into account: one for all rows, and one for each value of the column. NaN
/// where the rows are too few to tell.
struct PartingEffect {
  double one = 0.0;
  double each = 0.0;
};
PartingEffect EffectOfParting(const PartingColumn& column,
                              const Eigen::VectorXd& target,
                              const Eigen::MatrixXd& input_values);
/// That the rows differ by the column, as a sentence in the target's unit.
std::string PartingText(const PartingColumn& column,
                        const PartingEffect& effect,
                        const Unit& target);

}  // namespace errmap::data
