#pragma once

#include <string>
#include <string_view>

namespace errmap::report {

/// Text as it must stand in HTML, in an attribute in quotes too: & < > " '
/// become entities, control characters blanks, and bytes that are no UTF-8 are
/// taken for Latin-1.
std::string HtmlText(std::string_view text);

/// The same, and no line ends between a figure and its % or unit.
std::string HtmlSentence(std::string_view text);

/// A name out of somebody's data: escaped, and kept from turning the text
/// around it (<bdi>).
std::string HtmlName(std::string_view name);

/// A text in backquotes and names alike, for Markdown: what it means there is
/// escaped, line breaks become blanks.
std::string MarkdownText(std::string_view text);

}  // namespace errmap::report
