#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace errmap::report {

/// Returns the word in single quotes.
std::string ShellQuoted(const std::string& word);
/// Quotes a word so that a shell reads it back, if it needs quotes.
std::string ShellWord(const std::string& word);

/// Writes a command from column `indent`. It continues on a new line, indented
/// by four more columns, before it would exceed `width`.
std::string ShellCommand(const std::vector<std::string>& words,
                         std::size_t width,
                         std::size_t indent);

}  // namespace errmap::report
