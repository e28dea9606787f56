#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace errmap::cli {

/// Returns the message without clauses that advise an option unknown to
/// `has`: the library does not know which command reads its messages. For
/// a command without --missing, "empty cell; fill it in, or drop such
/// rows with --missing drop-rows" becomes "empty cell; fill it in". Text
/// about another command ("errmap fit ... --model X") and quoted text
/// stay.
std::string WithOwnRemedies(
    std::string_view message,
    const std::function<bool(std::string_view option)>& has);

}  // namespace errmap::cli
