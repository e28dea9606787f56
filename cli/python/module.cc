// errmap._core: the library as the package `errmap` calls it.

#include "cli/python/module.h"

#include <exception>

#include <pybind11/pybind11.h>

#include "cli/command.h"
#include "data/input_error.h"

PYBIND11_MODULE(_core, module) {
  module.doc() = "The library of errmap; use the package errmap.";
  pybind11::register_exception_translator([](std::exception_ptr error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const errmap::data::InputError& wrong) {
      PyErr_SetString(PyExc_ValueError, wrong.what());
    } catch (const errmap::cli::UsageError& wrong) {
      PyErr_SetString(PyExc_ValueError, wrong.what());
    }
  });
  errmap::python::DefineTables(&module);
  errmap::python::DefineCommands(&module);
  errmap::python::DefineStudies(&module);
}
