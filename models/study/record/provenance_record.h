#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/study/record/record.h"

// Where a study came from: the program, its command line, the study as it was
// carried out, and the files that it read.

namespace errmap::models {

struct ComponentConfigurationRecord {
  LeftOut<std::string> name;
  LeftOut<std::string> data;
  LeftOut<std::vector<std::string>> more_data;  // further files of it
  LeftOut<ByName<std::variant<std::int64_t, double, std::string>>> where;
  LeftOut<std::string> target;
  LeftOut<std::vector<std::string>> inputs;
  LeftOut<std::vector<std::string>> exclude;
  LeftOut<std::string> group;
  LeftOut<std::string> time;
  LeftOut<std::string> session;
  LeftOut<data::Alignment> align;  // where there is one
  LeftOut<std::string> weight;
  data::MissingPolicy missing = data::MissingPolicy::kError;
  data::FaultPolicy faults = data::FaultPolicy::kKeep;
  bool keep_dead = false;
  LeftOut<double> goal;
  LeftOut<double> indifference;
  /// By which another command reads the same measurements: what was not left to
  /// the defaults, a flag with an empty value.
  LeftOut<ByName<std::string>> options;
};

/// The study as it was carried out, with the words of a study file.
struct ConfigurationRecord {
  std::uint64_t seed = 0;
  LeftOut<double> goal;
  LeftOut<double> indifference;
  LeftOut<std::string> choose;  // where it is not "auto"
  LeftOut<std::string> prefer;  // where it is not "least-error"
  LeftOut<std::vector<std::string>> holdouts;
  LeftOut<std::vector<std::string>> models;
  LeftOut<std::string> rezero;
  std::vector<ComponentConfigurationRecord> component;
};

struct InputFileRecord {
  std::string file;
  std::string sha256;

  bool operator==(const InputFileRecord&) const = default;
};

struct ProvenanceRecord {
  std::string version;
  std::string command_line;
  ConfigurationRecord configuration;
  std::vector<InputFileRecord> inputs;
  std::string compiler;
  ByName<std::string> libraries;
  std::string platform;
};

}  // namespace errmap::models
