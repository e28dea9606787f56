#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::report {

/// Treatment of words longer than a line: broken anywhere, or kept whole (paths
/// and commands to be copied).
enum class LongWords { kBroken, kWhole };

/// Breaks `text` at blanks into lines of at most `width` columns, at least one.
std::vector<std::string> WrapLines(std::string_view text,
                                   std::size_t width,
                                   LongWords long_words = LongWords::kBroken);

/// Joins the same lines with line feeds.
std::string WrapText(std::string_view text, std::size_t width);

/// Breaks `text` into lines, each with a line feed. The first begins with
/// `begin`, the others with as many blanks. `width` includes these.
std::string Hanging(std::string begin,
                    std::string_view text,
                    std::size_t width);

/// Returns the number of characters, not bytes, of a UTF-8 text.
std::size_t WidthOf(std::string_view text);

/// Cuts to `most` characters; `dots` replace the middle.
std::string Squeezed(const std::string& text,
                     std::size_t most,
                     std::string_view dots = "...");

}  // namespace errmap::report
