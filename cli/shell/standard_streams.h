#pragma once

#include <string_view>

namespace errmap::cli {

/// Gives standard streams that are closed a place where nothing can be read or
/// printed, so that no file which is opened later gets their numbers and with
/// them our messages. To be called before any file is opened.
void HoldStandardStreams();

/// The one way of results to standard output. A write that fails is kept for
/// PrintError, so that one lost answer does not cost the files after it; what
/// comes after it is not written.
void PrintResult(std::string_view text);

/// errno of the first write of PrintResult that failed; 0: none.
int PrintError();

/// The one way of messages to standard error, as they are. One that cannot be
/// written is lost: there is nowhere to say so.
void WriteMessage(std::string_view text);

}  // namespace errmap::cli
