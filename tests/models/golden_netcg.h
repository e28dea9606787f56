#pragma once

#include <array>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "data/csv.h"
#include "models/net/net_objective.h"
#include "tests/places.h"

namespace errmap::testing {

/// A run of the report's program, as tests/golden/netcg/README.md describes it.
struct GoldenCase {
  nlohmann::json json;
  models::NetShape shape;
  double wfactor = 0.0;
  Eigen::MatrixXd inputs;          // (P x I) as the net sees them
  Eigen::MatrixXd scaled_targets;  // (P x J)
  Eigen::VectorXd initial_weights;

  models::NetObjective Objective() const {
    return {shape,
            inputs,
            scaled_targets,
            wfactor,
            {},
            models::NetArithmetic::kPlain};
  }
};

inline Eigen::MatrixXd ToMatrix(const nlohmann::json& rows) {
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(rows.size()),
                         static_cast<Eigen::Index>(rows[0].size()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      matrix(i, j) =
          rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
  }
  return matrix;
}

inline Eigen::VectorXd ToVector(const nlohmann::json& numbers) {
  const auto values = numbers.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(
      values.data(), static_cast<Eigen::Index>(values.size()));
}

inline std::string GoldenPath(const std::string& name) {
  return tests::TestDir() + "/golden/netcg/" + name;
}

// Patterns and weights of cases a and b, kept in files of their own.
inline void ReadLargeCase(GoldenCase* golden) {
  const auto table =
      data::ReadCsv(GoldenPath(golden->json["table"].get<std::string>()));
  const auto rows = static_cast<Eigen::Index>(table.num_rows);
  golden->inputs.resize(rows, golden->shape.inputs);
  // The target is the last column, or the one that says so.
  std::vector<const data::CsvColumn*> input_columns;
  const data::CsvColumn* target = nullptr;
  for (const auto& column : table.columns) {
    if (column.name.starts_with("error")) {
      target = &column;
    } else {
      input_columns.push_back(&column);
    }
  }
  for (Eigen::Index i = 0; i < golden->shape.inputs; ++i) {
    golden->inputs.col(i) = Eigen::Map<const Eigen::VectorXd>(
        std::vector<double>(input_columns[static_cast<std::size_t>(i)]->values)
            .data(),
        rows);
  }
  if (golden->json.contains("input_min")) {
    // Scaled to 0..1 and written with nine digits, which the run then read.
    const auto lowest = golden->json["input_min"];
    const auto highest = golden->json["input_max"];
    for (Eigen::Index j = 0; j < golden->inputs.cols(); ++j) {
      const double low = lowest[static_cast<std::size_t>(j)];
      const double high = highest[static_cast<std::size_t>(j)];
      for (double& value : golden->inputs.col(j)) {
        std::array<char, 40> text{};
        std::snprintf(
            text.data(), text.size(), "%.9g", (value - low) / (high - low));
        value = std::stod(text.data());
      }
    }
  }
  const auto& scaling = golden->json["target_scaling"];
  const double slope = scaling["slope"];
  const double highest = scaling["tmax"];
  const Eigen::VectorXd targets = Eigen::Map<const Eigen::VectorXd>(
      std::vector<double>(target->values).data(), rows);
  golden->scaled_targets = (targets.array() - highest) * slope + 0.99;
  const auto weights = data::ReadCsv(
      GoldenPath(golden->json["weights_init"].get<std::string>()));
  const std::vector<double>& values = weights.columns.back().values;
  golden->initial_weights.resize(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Drawn in single precision and widened.
    golden->initial_weights[static_cast<Eigen::Index>(i)] =
        static_cast<double>(static_cast<float>(values[i]));
  }
}

inline GoldenCase ReadGoldenCase(const std::string& name) {
  GoldenCase golden;
  std::ifstream(GoldenPath(name + ".json")) >> golden.json;
  if (golden.json.contains("problem")) {
    // The same net and patterns as another case, run differently.
    std::string problem = golden.json["problem"];
    problem.resize(problem.rfind(".json"));
    nlohmann::json merged = ReadGoldenCase(problem).json;
    merged.update(golden.json);
    golden.json = merged;
  }
  const auto& nodes = golden.json["nodes"];
  golden.shape = {
      nodes[0], nodes[1], nodes[2], models::OutputFunction::kSigmoid};
  golden.wfactor = golden.json["wfactor"];
  if (golden.json.contains("table")) {
    ReadLargeCase(&golden);
  } else {
    golden.inputs = ToMatrix(golden.json["inputs"]);
    golden.scaled_targets = ToMatrix(golden.json["targets_scaled"]);
    golden.initial_weights = ToVector(golden.json["weights_init"]);
  }
  return golden;
}

}  // namespace errmap::testing
