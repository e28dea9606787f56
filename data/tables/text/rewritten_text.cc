#include "data/tables/text/rewritten_text.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "data/tables/cells/csv_cells.h"
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

namespace {

constexpr std::size_t kLinesLooked = 50;

// The first lines that are neither blank nor comments.
std::vector<std::string_view> FirstLines(std::string_view text) {
  std::vector<std::string_view> lines;
  const char* const end = text.data() + text.size();
  for (const char* p = text.data(); p != end && lines.size() < kLinesLooked;) {
    const char* const stop = std::find_if(p, end, IsLineEnd);
    const std::string_view line =
        Trimmed({p, static_cast<std::size_t>(stop - p)});
    if (!line.empty() && !line.starts_with('#')) lines.push_back(line);
    p = PastLineEnd(stop, end);
  }
  return lines;
}

constexpr std::string_view kBetween = ",;\t|";
constexpr std::string_view kBackslashQuote = "\\\"";

// "a \"b\" c" for "a ""b"" c": where a quote behind a backslash does not close
// a cell, or the next one does.
bool HasBackslashQuotes(std::string_view line) {
  for (std::size_t at = line.find(kBackslashQuote); at != line.npos;
       at = line.find(kBackslashQuote, at + 2)) {
    const std::size_t next =
        at + (line.substr(at + 2).starts_with('"') ? 3 : 2);
    const bool ends =
        next == line.size() || kBetween.find(line[next]) != kBetween.npos;
    if (ends == (next == at + 3)) return true;
  }
  return false;
}

// 'x';'y': each quote at a line's end or beside a delimiter.
bool IsInSingleQuotes(std::string_view line) {
  if (line.size() < 2 || line.front() != '\'' || line.back() != '\'') {
    return false;
  }
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    if (line[i] == '"') return false;
    if (line[i] == '\'' && kBetween.find(line[i - 1]) == kBetween.npos &&
        kBetween.find(line[i + 1]) == kBetween.npos) {
      return false;
    }
  }
  return true;
}

// "x;y": one quoted cell with others in it.
bool IsQuotedWhole(std::string_view line) {
  if (line.size() < 2 || line.front() != '"' || line.back() != '"') {
    return false;
  }
  line = line.substr(1, line.size() - 2);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '"') continue;
    if (i + 1 == line.size() || line[i + 1] != '"') return false;
    ++i;
  }
  return true;
}

// Whether the lines are, and have as many delimiters of one kind each: a column
// of words or of decimal commas has none in its name.
bool AreQuotedWhole(const std::vector<std::string_view>& lines) {
  return lines.size() > 1 && std::ranges::all_of(lines, IsQuotedWhole) &&
         std::ranges::any_of(std::string_view(",;\t|"), [&](char delimiter) {
           const auto cells = std::ranges::count(lines[0], delimiter);
           return cells > 0 &&
                  std::ranges::all_of(lines, [&](std::string_view line) {
                    return std::ranges::count(line, delimiter) == cells;
                  });
         });
}

std::string WithoutQuotesOfLines(std::string_view text) {
  std::string plain;
  const char* const end = text.data() + text.size();
  for (const char* p = text.data(); p != end;) {
    const char* const stop = std::find_if(p, end, IsLineEnd);
    std::string_view line = Trimmed({p, static_cast<std::size_t>(stop - p)});
    const bool is_quoted = IsQuotedWhole(line);
    if (is_quoted) line = line.substr(1, line.size() - 2);
    for (std::size_t i = 0; i < line.size(); ++i) {
      plain += line[i];
      if (is_quoted && line[i] == '"') ++i;  // the second of two
    }
    p = PastLineEnd(stop, end);
    plain.append(stop, p);
  }
  return plain;
}

// Cells that so many blanks or more part.
std::size_t CellsParted(std::string_view line, std::string_view blanks) {
  std::size_t cells = 1;
  for (std::size_t at = line.find(blanks); at != line.npos;
       at = line.find(blanks, at)) {
    ++cells;
    at = line.find_first_not_of(' ', at);
  }
  return cells;
}

// The names have single blanks in them, the rows as many cells as there are
// names two blanks apart.
bool IsSetApart(const std::vector<std::string_view>& lines) {
  constexpr std::size_t kFewest = 3;
  constexpr std::string_view kOfNumbers = "0123456789+-.";
  if (lines.size() < kFewest || kOfNumbers.find(lines[0][0]) != kOfNumbers.npos)
    return false;
  const std::size_t names = CellsParted(lines[0], "  ");
  return names > 1 && CellsParted(lines[0], " ") != names &&
         std::ranges::all_of(lines, [&](std::string_view line) {
           return line.find_first_of(",;\t|\"") == line.npos &&
                  CellsParted(line, "  ") == names;
         });
}

std::string WithTabs(std::string_view text) {
  std::string parted;
  parted.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] != ' ') {
      parted += text[at++];
      continue;
    }
    const std::size_t next =
        std::min(text.find_first_not_of(' ', at), text.size());
    const bool is_inside = !parted.empty() && !IsLineEnd(parted.back()) &&
                           next < text.size() && !IsLineEnd(text[next]);
    if (is_inside) parted += next - at > 1 ? '\t' : ' ';
    at = next;
  }
  return parted;
}

// Length of a sign of programs ("//") or of MATLAB ("%"), alone or before a
// remark; else 0.
std::size_t SignOfRemark(std::string_view line) {
  const std::size_t size = line.starts_with("//") ? 2 : line.starts_with('%');
  const bool ends =
      line.size() == size || line[size] == ' ' || IsLineEnd(line[size]);
  return ends ? size : 0;
}

// Comments as they are known.
std::string WithHashes(std::string_view text) {
  std::string hashed(text);
  for (std::size_t at = 0; at < hashed.size();
       at = std::min(hashed.find_first_of("\n\r", at), hashed.size() - 1) + 1) {
    const std::size_t size = SignOfRemark(std::string_view(hashed).substr(at));
    hashed.replace(at, size, size, '#');
  }
  return hashed;
}

}  // namespace

std::optional<std::string> RewrittenText(std::string_view text) {
  if (auto table = LabviewText(text)) return table;
  if (SignOfRemark(text) > 0) return WithHashes(text);
  const std::vector<std::string_view> lines = FirstLines(text);
  if (std::ranges::any_of(lines, HasBackslashQuotes)) {
    std::string doubled(text);
    for (std::size_t at = doubled.find(kBackslashQuote); at != doubled.npos;
         at = doubled.find(kBackslashQuote, at)) {
      doubled.replace(at, 2, 2, '"');
    }
    return doubled;
  }
  if (lines.size() > 1 && std::ranges::all_of(lines, IsInSingleQuotes)) {
    std::string quoted(text);
    std::ranges::replace(quoted, '\'', '"');
    return quoted;
  }
  if (AreQuotedWhole(lines)) return WithoutQuotesOfLines(text);
  if (IsSetApart(lines)) return WithTabs(text);
  return std::nullopt;
}

}  // namespace errmap::data
