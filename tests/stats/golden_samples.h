#pragma once

// The fixed samples of tests/golden and the report's Appendix B.

#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "data/csv.h"
#include "tests/places.h"

namespace errmap {

inline Eigen::VectorXd ReadCsvColumn(const std::string& path,
                                     const std::string& column) {
  const data::CsvTable table = data::ReadCsv(path);
  const auto index = table.Find(column);
  if (index < 0) throw std::runtime_error(path + " has no " + column);
  const std::vector<double> values =
      table.columns[static_cast<std::size_t>(index)].values;
  return Eigen::Map<const Eigen::VectorXd>(
      values.data(), static_cast<Eigen::Index>(values.size()));
}

inline Eigen::VectorXd AppendixB(const std::string& column) {
  return ReadCsvColumn(
      tests::SourceDir() + "/data/sets/nistir5367_appendix_b.csv", column);
}

inline const std::vector<std::string>& GoldenSampleNames() {
  static const std::vector<std::string> names = {"appendix_b_residual",
                                                 "sample_normal_20",
                                                 "sample_t3_20",
                                                 "sample_uniform_20",
                                                 "sample_normal_397",
                                                 "sample_t3_397",
                                                 "sample_uniform_397",
                                                 "sample_normal_5000",
                                                 "sample_t3_5000",
                                                 "sample_uniform_5000"};
  return names;
}

inline Eigen::VectorXd GoldenSample(const std::string& name) {
  if (name == "appendix_b_residual") return AppendixB("residual_mm");
  return ReadCsvColumn(tests::TestDir() + "/golden/samples/" + name + ".csv",
                       "value");
}

}  // namespace errmap
