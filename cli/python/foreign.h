#pragma once

#include <memory>
#include <string>

#include <pybind11/pybind11.h>

#include "models/error_model.h"

namespace errmap::python {

/// A recipe that fits in Python. `fit(x, y, columns)` gets the training rows as
/// Numbers (m x p), the targets as Numbers (m) and the names of the columns,
/// and returns `predict(x)`, which gives float64 (m). If it raises an
/// exception, the fit has failed for that reason.
std::unique_ptr<models::ModelRecipe> ForeignRecipe(const std::string& name,
                                                   pybind11::object fit);

}  // namespace errmap::python
