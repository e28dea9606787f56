#pragma once

#include <pybind11/pybind11.h>

namespace errmap::python {

/// compare, fit and folds, and the study that compare gives.
void DefineStudies(pybind11::module_* module);

}  // namespace errmap::python
