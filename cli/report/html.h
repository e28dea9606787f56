#pragma once

#include <string>
#include <string_view>

namespace errmap::report {

/// Escapes text for HTML, also in quoted attributes: & < > " ' become entities,
/// control characters become blanks. Bytes that are not UTF-8 are read as
/// Latin-1.
std::string HtmlText(std::string_view text);

/// Escapes text, and prevents line breaks between a number and its % or unit.
std::string HtmlSentence(std::string_view text);

/// Escapes a name from the user's data, and isolates its writing direction from
/// the surrounding text (<bdi>).
std::string HtmlName(std::string_view name);

/// Returns a table that scrolls if the screen is narrower; `rows` are HTML.
std::string ScrolledTable(std::string_view label, const std::string& rows);

/// Escapes backquoted text and names for Markdown; line breaks become
/// blanks.
std::string MarkdownText(std::string_view text);

}  // namespace errmap::report
