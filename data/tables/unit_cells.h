#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::data {

/// Whether a cell below a name is a unit or nothing: "mm", "[um]", "-"; a unit
/// comes back without its brackets, nothing as "".
bool ReadUnitCell(std::string* cell);

/// Whether all cells are units or nothing, one of them a unit.
bool AreUnitCells(std::vector<std::string> cells);

/// "error [um]" of a name and the unit below it; the name alone where that
/// states the same unit, nothing where it states another.
std::optional<std::string> NameWithUnit(const std::string& name,
                                        std::string_view unit);

}  // namespace errmap::data
