#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace errmap::cli {

/// The message without the clauses that advise an option which `has` does not
/// know: the library does not know which command reads its messages.
/// "empty cell; fill it in, or drop such rows with --missing drop-rows" is
/// "empty cell; fill it in" for a command without --missing. What is said of
/// another command ("errmap fit ... --model X") and what stands in quotation
/// marks stays.
std::string WithOwnRemedies(
    std::string_view message,
    const std::function<bool(std::string_view option)>& has);

}  // namespace errmap::cli
