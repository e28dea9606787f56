#include "data/tables/text/labview_text.h"

#include <algorithm>
#include <vector>

#include "data/text.h"

namespace errmap::data {
namespace {

constexpr std::string_view kLabviewBegin = "LabVIEW Measurement";
constexpr std::string_view kHeaderEnd = "***End_of_Header***";
constexpr std::string_view kYUnits = "Y_Unit_Label";
constexpr std::string_view kXDimension = "X_Dimension";
constexpr std::string_view kXValue = "X_Value";

// Where the line at `at` ends, before its line end.
std::size_t EndOfLine(std::string_view text, std::size_t at) {
  return std::min(text.find_first_of("\r\n", at), text.size());
}

std::string_view Behind(std::string_view line, std::string_view key) {
  return line.starts_with(key) ? line.substr(key.size()) : std::string_view();
}

struct Headers {
  std::size_t end = 0;          // of the last line that belongs to them
  std::string_view units;       // "\tmm\tdegC", or ""
  std::string_view dimensions;  // "\tTime\tTime", or ""
};

// Down to the last that ends: there are no names between two of them.
Headers FindHeaders(std::string_view text) {
  Headers headers;
  std::string_view units;
  std::string_view dimensions;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = EndOfLine(text, at);
    const std::string_view line = text.substr(at, end - at);
    if (line.starts_with(kXValue)) break;
    if (line.starts_with(kYUnits)) units = Behind(line, kYUnits);
    if (line.starts_with(kXDimension)) dimensions = Behind(line, kXDimension);
    if (line.starts_with(kHeaderEnd)) {
      headers = {.end = end, .units = units, .dimensions = dimensions};
    }
    at = std::min(text.find_first_not_of("\r\n", end), text.size());
  }
  return headers;
}

}  // namespace

std::optional<std::string> LabviewText(std::string_view text) {
  if (!text.starts_with(kLabviewBegin)) return std::nullopt;
  const Headers headers = FindHeaders(text);
  const bool is_time =
      headers.dimensions.empty() ||
      headers.dimensions.find("Time") != std::string_view::npos;
  if (headers.end == 0 || !is_time) return std::nullopt;
  std::string table;
  table.reserve(text.size());
  for (const char c : text.substr(0, headers.end)) {
    if (c == '\r' || c == '\n') table += c;
  }
  std::string_view rest = text.substr(headers.end);
  const std::size_t names = rest.find_first_not_of("\r\n\t ,;");
  if (names == rest.npos || !rest.substr(names).starts_with(kXValue)) {
    return table + std::string(rest);
  }
  const std::size_t end = EndOfLine(rest, names);
  const std::string line =
      "time_s" + std::string(rest.substr(names + kXValue.size(),
                                         end - names - kXValue.size()));
  // The names move up into the line of the header's end, for the units.
  const std::string_view units = headers.units;
  const bool has_units =
      units.find_first_not_of("\t ,;") != std::string_view::npos;
  table += has_units ? line : "";
  table += rest.substr(0, names);
  table += has_units ? units : line;
  return table + std::string(rest.substr(end));
}

}  // namespace errmap::data
