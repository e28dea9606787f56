#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/csv.h"

namespace errmap::data {

/// Reads a cell below a name that has a unit or means no unit: "mm", "[um]",
/// "-". The unit is returned without its brackets, nothing as "".
bool ReadUnitCell(std::string* cell);

/// True if all cells are units or nothing, and at least one is a unit.
bool AreUnitCells(std::vector<std::string> cells);

/// Reads cells as ReadUnitCell does. True if all are units or nothing, at least
/// one is a unit, and each is above a number in the next row.
bool ReadUnitsOverNumbers(const std::vector<std::string>& below,
                          bool decimal_comma,
                          std::vector<std::string>* cells);

/// True if the cells separate the names from the rows, as "|---|:--|" in
/// Markdown.
bool AreRules(const std::vector<std::string>& cells);

/// Returns "error [um]" for a name and the unit below it. Returns the name
/// alone if it states the same unit, and nothing if it states another.
std::optional<std::string> NameWithUnit(const std::string& name,
                                        std::string_view unit);

/// Adds the unit in a cell to a name that states none. Any other cell, or a
/// name with another unit, changes nothing.
void AddUnitOfCell(const std::string& cell, std::string* name);

/// Returns an angle in degrees, read from degrees, minutes and, if present,
/// seconds ("-27°30'15.5"", "27° 30.5'"). Nothing for other cells.
std::optional<double> ReadAngle(std::string_view cell, bool decimal_comma);

/// Converts the angles in columns that hold mostly these to degrees. Adds
/// "[deg]" to their names.
void TakeAngleCells(bool decimal_comma, CsvTable* table);

}  // namespace errmap::data
