#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace errmap::report {

/// Returns the word in single quotes.
std::string ShellQuoted(const std::string& word);
/// Quotes a word for a shell, if it needs quotes.
std::string ShellWord(const std::string& word);

/// Writes a command from column `indent`. Breaks it before `width`; the next
/// lines are indented by four more columns.
std::string ShellCommand(const std::vector<std::string>& words,
                         std::size_t width,
                         std::size_t indent);

}  // namespace errmap::report
