#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::report {

/// Words that are longer than a line: broken anywhere, or left whole, as paths
/// and commands that are to be copied want it.
enum class LongWords { kBroken, kWhole };

/// `text` in lines of at most `width` columns, broken at blanks.
std::vector<std::string> WrapLines(std::string_view text,
                                   std::size_t width,
                                   LongWords long_words = LongWords::kBroken);

/// The same with line feeds between them.
std::string WrapText(std::string_view text, std::size_t width);

/// Characters, where a text may be no ASCII.
std::size_t WidthOf(std::string_view text);

/// At most `most` characters, "..." in place of the middle.
std::string Squeezed(const std::string& text, std::size_t most);

}  // namespace errmap::report
