#include "models/file_recipe.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "data/files/atomic_file.h"
#include "data/sha256.h"
#include "models/model_file.h"

namespace errmap::models {
namespace {

constexpr std::string_view kPrefix = "file:";

// The map's figures mean nothing in another unit; we do not guess at factors.
void RequireUnit(const std::string& what,
                 const data::Unit& of_map,
                 const data::Unit& of_data) {
  if (of_map.symbol == of_data.symbol) return;
  const auto shown = [](const data::Unit& unit) {
    return unit.symbol.empty() ? std::string("no unit") : unit.symbol;
  };
  throw std::invalid_argument(
      fmt::format("{} is in {} for the map and in {} in the data; convert "
                  "the column",
                  what,
                  shown(of_map),
                  shown(of_data)));
}

class FileRecipe final : public ModelRecipe {
 public:
  FileRecipe(std::string name, std::string sha256, FittedModel map)
      : name_(std::move(name)),
        sha256_(std::move(sha256)),
        map_(std::move(map)) {
    map_.summary.termination = fitting::Termination::kDirect;
    map_.summary.message =
        fmt::format("read from a file ({}), not fitted here", map_.name);
    map_.name = name_;
  }

  std::string name() const override { return name_; }
  ModelKind kind() const override { return ModelKind::kFile; }
  // What the file held decides the outcome, not its name.
  std::vector<EffectiveOption> options() const override {
    return {{"sha256", sha256_}};
  }

  std::optional<std::string> WhatIsMissing(
      const data::Dataset& dataset) const override {
    for (const TrainedInput& input : map_.inputs) {
      if (dataset.FindInput(input.column.name) < 0) {
        return fmt::format("an input '{}'", input.column.name);
      }
    }
    return std::nullopt;
  }

  std::optional<Index> NumCoefficients(
      const data::Dataset& /*dataset*/) const override {
    return map_.model->num_parameters();
  }

  FittedModel Fit(const data::Dataset& training,
                  const FitContext& /*context*/) const override {
    if (const auto missing = WhatIsMissing(training)) {
      throw std::invalid_argument(
          fmt::format("the data lack {} that the map reads", *missing));
    }
    RequireUnit("the target", map_.target.unit, training.target().unit);
    for (const TrainedInput& input : map_.inputs) {
      const auto at =
          static_cast<std::size_t>(training.FindInput(input.column.name));
      RequireUnit("'" + input.column.name + "'",
                  input.column.unit,
                  training.inputs()[at].unit);
    }
    return map_;
  }

 private:
  std::string name_;
  std::string sha256_;
  FittedModel map_;
};

}  // namespace

std::string FileOfSpec(std::string_view spec) {
  if (!spec.starts_with(kPrefix)) return "";
  std::string path(spec.substr(kPrefix.size()));
  if (path.size() >= 2 && path.front() == '"' && path.back() == '"') {
    path = path.substr(1, path.size() - 2);
  }
  return path;
}

std::unique_ptr<ModelRecipe> MakeFileRecipe(std::string_view spec) {
  if (!spec.starts_with(kPrefix)) return nullptr;
  const std::string path = FileOfSpec(spec);
  if (path.empty()) {
    throw std::invalid_argument(
        fmt::format("model '{}': names no file; write file:model.json", spec));
  }
  const std::string content = data::ReadFile(path, data::kMostTextOfPrograms);
  return std::make_unique<FileRecipe>(
      std::string(spec), data::Sha256(content), ModelFromJson(content, path));
}

}  // namespace errmap::models
