#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/record.h"

// Origin of a study: the program, its command line, the configuration used, and
// the files it read.

namespace errmap::models {

struct ComponentConfigurationRecord {
  LeftOut<std::string> name;
  LeftOut<std::string> data;
  LeftOut<std::vector<std::string>> more_data;  // its further files
  LeftOut<ByName<std::variant<std::int64_t, double, std::string>>> where;
  LeftOut<std::string> target;
  LeftOut<std::vector<std::string>> inputs;
  LeftOut<std::vector<std::string>> exclude;
  LeftOut<std::string> group;
  LeftOut<std::string> time;
  LeftOut<std::string> session;
  LeftOut<data::Alignment> align;  // if there is one
  LeftOut<std::string> weight;
  data::MissingPolicy missing = data::MissingPolicy::kError;
  data::FaultPolicy faults = data::FaultPolicy::kKeep;
  bool keep_dead = false;
  LeftOut<double> goal;
  LeftOut<double> indifference;
  /// Options with which another command reads the same measurements, without
  /// defaults; a flag has an empty value.
  LeftOut<ByName<std::string>> options;
};

/// The configuration used, with the keys of a study file.
struct ConfigurationRecord {
  std::uint64_t seed = 0;
  LeftOut<double> goal;
  LeftOut<double> indifference;
  LeftOut<std::string> choose;  // if it is not "auto"
  LeftOut<std::string> prefer;  // if it is not "least-error"
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
  ConfigurationRecord configuration = {};
  std::vector<InputFileRecord> inputs;
  std::string compiler;
  ByName<std::string> libraries;
  std::string platform;
};

/// Returns the origin of a result: this version, its compiler, platform, and
/// the numerical libraries by name. OpenBLAS has its options and detected
/// processor, Ceres the version compiled against. The caller adds the
/// configuration.
ProvenanceRecord MakeProvenance(std::string command_line,
                                std::vector<InputFileRecord> inputs);

/// Adds one of the program's own libraries to these; call it before any other
/// function.
void NameLibrary(const std::string& name, const std::string& version);

}  // namespace errmap::models
