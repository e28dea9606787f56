#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.h"

namespace errmap::cli {

class CompareMode;

/// A command of a slice, with its place in the help.
struct SliceCommand {
  AddCommandTo add;
  const char* purpose;  // heading; one that is not there yet, before the last
  AddCommandTo before = nullptr;  // the next one below it; null: at the end
};

/// The arguments of `errmap report` for a slice.
struct ReportArguments {
  std::string folder;
  std::string figures;
  std::string format;
  std::string component;
  bool force = false;
};

/// The arguments of `errmap init` on a folder.
struct InitFolder {
  std::string folder;
  std::string beside;  // the same as seen from the study file
  std::string target;
  std::string out;  // the study file
};

/// A feature in its own folder of cli/ that no other folder includes: its
/// commands, its extensions of core commands, its files, tables and schemas.
/// The program can be built without it: leave its name out of ERRMAP_SLICES.
/// The manual's list (cli/manual/pages.cmake) still names its page.
struct Slice {
  std::vector<SliceCommand> commands;
  /// Its modes of `errmap compare`; null: none.
  std::unique_ptr<CompareMode> (*compare)() = nullptr;
  /// Runs `errmap report` if the folder belongs to the slice, and returns the
  /// exit status.
  std::optional<int> (*report)(const ReportArguments& arguments) = nullptr;
  /// Writes the study file that `errmap init` proposes for a folder.
  void (*init)(const InitFolder& arguments) = nullptr;
};

/// The slices that are built; written by CMake.
std::vector<Slice> Slices();

}  // namespace errmap::cli
