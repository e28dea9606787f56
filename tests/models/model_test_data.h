#pragma once

#include <cmath>
#include <string>
#include <variant>

#include <fmt/format.h>

#include "data/column_header.h"
#include "data/csv.h"
#include "data/measurements/dataset.h"
#include "models/error_model.h"
#include "tests/places.h"

namespace errmap::testing {

/// The shipped measurements of NISTIR 5367, Appendix B.
inline data::Dataset ShippedMeasurements() {
  return data::MakeDataset(
             data::ReadCsv(tests::SourceDir() +
                           "/data/sets/nistir5367_xdisp_down.csv"),
             {})
      .dataset;
}

/// Rows of position, two temperatures and a target that is a known quadratic
/// in position and t1_degC; t2_degC has no part in it.
inline data::Dataset QuadraticData(Eigen::Index rows) {
  data::Dataset::Parts parts;
  parts.source = "quadratic";
  for (const char* name : {"position_mm", "t1_degC", "t2_degC"}) {
    parts.inputs.push_back({name, data::UnitOfColumn(name)});
  }
  parts.input_values.resize(rows, 3);
  parts.target = {"error_mm", data::UnitOfColumn("error_mm")};
  parts.target_values.resize(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const double k = static_cast<double>(i);
    const double x = -10.0 * static_cast<double>(i % 7);
    const double t1 = 20.0 + 0.05 * k + 0.3 * std::sin(0.7 * k);
    const double t2 = 22.0 + std::sin(1.9 * k);
    parts.input_values.row(i) << x, t1, t2;
    parts.target_values[i] =
        1e-3 + 2e-4 * x - 3e-6 * x * x + 5e-4 * t1 - 1e-5 * x * t1;
  }
  return data::Dataset(std::move(parts));
}

/// What inner hold-outs chose, as options of a SPEC: ":wfactor=0.001".
inline std::string ChoicesAsOptions(const models::FittedModel& fitted) {
  std::string options;
  for (const models::EffectiveOption& choice : fitted.choices) {
    std::visit(
        [&](const auto& value) {
          options += fmt::format(":{}={}", choice.key, value);
        },
        choice.value);
  }
  return options;
}

}  // namespace errmap::testing
