#pragma once

#include <string>

namespace errmap::report {

/// Returns a page with its style sheet, whose every contrast is at least 4.5 to
/// 1; it runs no script and loads nothing. `title` is text, `body` HTML.
std::string PageHtml(const std::string& title, const std::string& body);

}  // namespace errmap::report
