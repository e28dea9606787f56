#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::cli {

/// A page of cli/manual, as it was built into the program.
struct Topic {
  std::string name;       // "tutorial"
  std::string_view page;  // Markdown
};

/// In the order of cli/manual/pages.cmake; written by CMake.
const std::vector<Topic>& Topics();

std::vector<std::string> TopicNames();

/// Its first heading.
std::string TitleOf(const Topic& topic);

/// The page to be read on a terminal: headings, paragraphs and lists in lines
/// of `width`, blocks of code and tables as they are, links and pictures as
/// their words.
std::string TopicText(const Topic& topic, std::size_t width);

}  // namespace errmap::cli
