#include <chrono>
#include <future>
#include <utility>

#include <pybind11/stl.h>

#include "cli/command.h"
#include "cli/python/module.h"
#include "data/files_in_memory.h"

namespace errmap::python {
namespace {

using std::chrono::milliseconds;

// (status, what was printed, the messages) of a command.
py::tuple RunCommand(std::vector<std::string> words,
                     const std::map<std::string, Table>& tables,
                     const std::map<std::string, std::string>& texts) {
  std::atomic<bool> stop{false};
  cli::Host host{.stop = &stop};
  int status = 0;
  if (RunHostedWork({tables, texts},
                    &host,
                    &stop,
                    [&] { status = cli::RunHosted(std::move(words)); },
                    {})) {
    throw py::error_already_set();
  }
  return py::make_tuple(status, host.printed, host.messages);
}

}  // namespace

bool RunHostedWork(const Inputs& inputs,
                   cli::Host* host,
                   std::atomic<bool>* stop,
                   const std::function<void()>& work,
                   const std::function<void()>& each_moment) {
  constexpr milliseconds kMoment(20);
  data::FilesInMemory::Tables tables;
  for (const auto& [name, table] : inputs.tables) {
    tables.emplace(name, table.table());
  }
  const py::gil_scoped_release no_gil;
  std::future<void> done = std::async(std::launch::async, [&] {
    const cli::HostedRun hosted(host);
    const data::FilesInMemory files(std::move(tables), inputs.texts);
    work();
  });
  bool interrupted = false;
  // The first looks are frequent: most work is short.
  milliseconds wait(1);
  while (done.wait_for(wait) != std::future_status::ready) {
    wait = std::min(2 * wait, kMoment);
    const py::gil_scoped_acquire gil;
    if (!interrupted && PyErr_CheckSignals() != 0) {
      interrupted = true;
      *stop = true;
    }
    if (!interrupted && each_moment) each_moment();
  }
  done.get();
  return interrupted;
}

void DefineCommands(py::module_* module) {
  module->def("run",
              &RunCommand,
              py::arg("words"),
              py::arg("tables"),
              py::arg("texts"),
              "Run a command of errmap: its exit status, what it prints, and "
              "its messages.");
}

}  // namespace errmap::python
