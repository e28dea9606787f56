#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace errmap::cli {

/// Gives standard streams that are closed a place where nothing can be read or
/// printed, so that no file which is opened later gets their numbers and with
/// them our messages. To be called before any file is opened.
void HoldStandardStreams();

/// Text that commands no terminal: controls (C0 but line feed and tab, DEL, C1)
/// and bytes that are no UTF-8 as \\u00XX, which JSON reads back.
std::string WithoutControls(std::string_view text);

/// The one way of results to standard output, WithoutControls. A write that
/// fails is kept for PrintError, so that one lost answer does not cost the
/// files after it; what comes after it is not written.
void PrintResult(std::string_view text);

/// The same in bold; for terminals.
void PrintStrong(std::string_view text);

/// errno of the first write of PrintResult that failed; 0: none.
int PrintError();

/// The one way of messages to standard error: "errmap: ...", one line whatever
/// stands in it. One that cannot be written is lost: there is nowhere to say
/// so.
void WriteMessage(std::string_view text);

/// From now on messages advise none but these options (WithOwnRemedies).
void AdviseOnly(std::set<std::string, std::less<>> options);

/// What draws on a terminal, as it is; only of our own words.
void DrawOnTerminal(std::string_view text);

}  // namespace errmap::cli
