#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace errmap::report {

/// A word as a shell reads it back: in quotes where it needs them.
std::string ShellWord(const std::string& word);

/// A command that begins in column `indent` and goes on in the next line, four
/// columns further in, where it would pass `width`.
std::string ShellCommand(const std::vector<std::string>& words,
                         std::size_t width,
                         std::size_t indent);

}  // namespace errmap::report
