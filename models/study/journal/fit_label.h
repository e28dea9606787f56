#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/study/study.h"

namespace errmap::models {

/// Version of errmap and, where it can be had, the start of the SHA-256 of the
/// running program: another build may give other bits.
const std::string& ProgramIdentity();

/// Keys of the fits of one component's study: SHA-256 of all that an outcome
/// depends on, so that two fits of one key have the same outcome, wherever they
/// stand. `holdouts` must outlive them. Each row is hashed once.
class FitLabels {
 public:
  FitLabels(std::string component,
            const data::Dataset& dataset,
            const std::vector<Holdout>& holdouts,
            const std::vector<std::unique_ptr<ModelRecipe>>& recipes,
            const StudyOptions& options,
            std::string program = ProgramIdentity());

  const std::string& component() const { return component_; }
  std::string KeyOf(const StudyTask& task) const;
  /// Of all fits, as StudyTasks orders them.
  std::vector<std::string> Keys() const;

 private:
  struct Model {
    std::string name;
    std::string options;
  };

  std::string component_;
  const std::vector<Holdout>& holdouts_;
  StudyOptions options_;
  std::string program_;
  std::vector<StudyTask> tasks_;
  std::vector<Model> models_;
  std::string all_rows_;
  std::vector<std::vector<std::string>> rows_;  // by hold-out and fold
};

}  // namespace errmap::models
