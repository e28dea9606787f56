#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace errmap::data {

/// The parts of the name of a column of readings at one position, such as
/// "e@-215.9mm_um", "X=25 mm", "Error at 50 mm (um)", "e_50mm_um",
/// "err_um(50)", "X50 [um]".
struct PlacedName {
  std::string quantity;  // "error_um"
  std::string unit;      // of the position; "" of "err_50" and "50"
  double position = 0.0;
  bool is_marked = false;  // by "@" or "="
};
std::optional<PlacedName> ReadPlacedName(std::string_view name);

/// True for numbers of a day, a month and a year: "2026-03-02", "02.03.2026",
/// "2.3.26".
bool IsNumericDate(std::string_view text);

/// The parts of the name of a column of one run, such as "Run 3 up [um]", "Lauf
/// 1 rückwärts", "x2↓ (µm)", "Day 2 Run 1", "2026-03-02". Missing parts are 0
/// or "", such as the run of "Error up [um]".
struct RunName {
  std::string quantity = {};  // "error [um]"
  int session = 0;
  std::string date = {};
  int run = 0;
  std::string direction = {};  // "up", "down", or ""
  bool is_letter = false;      // that says the way, directly before a number

  bool is_numbered() const { return session > 0 || run > 0 || !date.empty(); }
};
std::optional<RunName> ReadRunName(std::string_view name);

}  // namespace errmap::data
