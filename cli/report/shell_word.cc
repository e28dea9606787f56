#include "cli/report/shell_word.h"

#include <string_view>

namespace errmap::report {

std::string ShellQuoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

std::string ShellWord(const std::string& word) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
      "_-+=:,./^@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
    return word;
  }
  return ShellQuoted(word);
}

std::string ShellCommand(const std::vector<std::string>& words,
                         std::size_t width,
                         std::size_t indent) {
  constexpr std::size_t kContinuation = 2;  // " \\"
  constexpr std::size_t kFurtherIn = 4;
  std::string text;
  std::size_t column = indent;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = ShellWord(words[i]);
    const std::size_t room = i + 1 < words.size() ? kContinuation : 0;
    std::size_t with_value = word.size();
    if (word.starts_with('-') && room > 0 && !words[i + 1].starts_with('-')) {
      with_value += 1 + ShellWord(words[i + 1]).size();
      if (indent + kFurtherIn + with_value + kContinuation > width) {
        with_value = word.size();  // too long for one line
      }
    }
    if (i > 0 && column + 1 + with_value + room > width) {
      // Further left only where a word is too long for the column.
      column = indent + kFurtherIn + word.size() + room > width
                   ? kFurtherIn
                   : indent + kFurtherIn;
      text += " \\\n" + std::string(column, ' ');
    } else if (i > 0) {
      text += ' ';
      ++column;
    }
    text += word;
    column += word.size();
  }
  return text;
}

}  // namespace errmap::report
