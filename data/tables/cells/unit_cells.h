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

/// Whether the cells are units or nothing, one of them a unit, each over a cell
/// of the row below that is a number; reads them as ReadUnitCell does.
bool ReadUnitsOverNumbers(const std::vector<std::string>& below,
                          bool decimal_comma,
                          std::vector<std::string>* cells);

/// Whether they rule the names off from the rows, as "|---|:--|" in Markdown.
bool AreRules(const std::vector<std::string>& cells);

/// "error [um]" of a name and the unit below it; the name alone where that
/// states the same unit, nothing where it states another.
std::optional<std::string> NameWithUnit(const std::string& name,
                                        std::string_view unit);

/// Adds the unit in a cell to a name that states none; another cell, or another
/// unit than the name states, changes nothing.
void AddUnitOfCell(const std::string& cell, std::string* name);

}  // namespace errmap::data
