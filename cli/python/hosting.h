#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>

#include <pybind11/pybind11.h>

#include "cli/python/tables.h"
#include "cli/shell/host.h"
#include "cli/shell/standard_streams.h"

namespace errmap::python {

/// Tables and texts that commands read in place of files, by name.
struct Inputs {
  std::map<std::string, Table> tables;
  std::map<std::string, std::string> texts;
};

/// Runs `work` in its own thread, without Python's lock, with `inputs` as files
/// and `host` for streams. Meanwhile it checks Python's signals and calls
/// `each_moment` (may be empty) with the lock held. A signal sets `host->stop`.
/// Rethrows exceptions of `work`. Returns true if a signal came; its Python
/// error is then set.
bool RunHostedWork(const Inputs& inputs,
                   cli::Host* host,
                   std::atomic<bool>* stop,
                   const std::function<void()>& work,
                   const std::function<void()>& each_moment);

void DefineCommands(py::module_* module);

}  // namespace errmap::python
