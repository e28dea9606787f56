#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.h"

namespace errmap::cli {

class CompareMode;

/// A command of a slice and its place in the help.
struct SliceCommand {
  AddCommandTo add;
  const char* purpose;  // heading; one that is not there yet, before the last
  AddCommandTo before = nullptr;  // the next one below it; null: at the end
};

/// What `errmap report` is told.
struct ReportArguments {
  std::string folder;
  std::string figures;
  std::string format;
  std::string component;
  bool force = false;
};

/// What `errmap init` is told of a folder.
struct InitFolder {
  std::string folder;
  std::string beside;  // the same as seen from the study file
  std::string target;
  std::string out;  // the study file
};

/// A feature that no other room includes: a folder of cli/ with its commands,
/// what commands of the core ask it, its files, tables and schemas. Leave its
/// name out of ERRMAP_SLICES, and the program is built without it; the manual's
/// list (cli/manual/pages.cmake) still names its page.
struct Slice {
  std::vector<SliceCommand> commands;
  /// Its ways to run `errmap compare`; null: none.
  std::unique_ptr<CompareMode> (*compare)() = nullptr;
  /// The exit status of `errmap report`, where the folder is the slice's.
  std::optional<int> (*report)(const ReportArguments& arguments) = nullptr;
  /// Writes the study file that `errmap init` proposes for a folder.
  void (*init)(const InitFolder& arguments) = nullptr;
};

/// Those that are built; written by CMake.
std::vector<Slice> Slices();

}  // namespace errmap::cli
