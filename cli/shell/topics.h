#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace errmap::cli {

/// A page of cli/manual, built into the program.
struct Topic {
  std::string name;       // "tutorial"
  std::string_view page;  // Markdown
};

/// Returns the topics in the order of cli/manual/pages.cmake; written by CMake.
const std::vector<Topic>& Topics();

std::vector<std::string> TopicNames();

/// Returns its first heading.
std::string TitleOf(const Topic& topic);

/// Formats the page for a terminal: headings, paragraphs and lists in lines of
/// `width`, code blocks and tables unchanged, links and pictures as their
/// words.
std::string TopicText(const Topic& topic, std::size_t width);

}  // namespace errmap::cli
