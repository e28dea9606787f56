#pragma once

#include <string>
#include <vector>

namespace errmap::data {

/// Whether a cell below a name is a unit or nothing: "mm", "[um]", "-"; a unit
/// comes back without its brackets, nothing as "".
bool ReadUnitCell(std::string* cell);

/// Whether all cells are units or nothing, one of them a unit.
bool AreUnitCells(std::vector<std::string> cells);

}  // namespace errmap::data
