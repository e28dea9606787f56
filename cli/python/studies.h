#pragma once

#include <pybind11/pybind11.h>

namespace errmap::python {

/// Adds compare, fit and folds, and the study that compare returns.
void DefineStudies(pybind11::module_* module);

}  // namespace errmap::python
