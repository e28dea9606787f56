#pragma once

#include <atomic>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cli/report/screen.h"

namespace errmap::cli {

/// Opens closed standard streams so that they can be neither read nor printed
/// to. Otherwise a file opened later could get their numbers, and so our
/// messages. Call it before any file is opened.
void HoldStandardStreams();

/// Returns text that cannot control a terminal. Controls (C0 but line feed and
/// tab, DEL, C1) and bytes that are not UTF-8 become \\u00XX, which JSON reads
/// back.
std::string WithoutControls(std::string_view text);

/// The only function that writes results to standard output, WithoutControls.
/// PrintError remembers a failed write, so that files are still written after a
/// lost answer. Later results are then not printed.
void PrintResult(std::string_view text);

/// As PrintResult, but bold; for terminals.
void PrintStrong(std::string_view text);

/// Returns errno of the first failed write of PrintResult; 0 if none.
int PrintError();

/// The only function that writes messages to standard error: "errmap: ...", in
/// one line. A message that cannot be written is lost.
void WriteMessage(std::string_view text);

/// From now on, messages mention only these options as remedies
/// (WithOwnRemedies).
void AdviseOnly(std::set<std::string, std::less<>> options);
/// From now on, messages may mention any option.
void AdviseAny();

/// Draws on a terminal, unfiltered; only for the program's own text.
void DrawOnTerminal(std::string_view text);

/// Returns the message without clauses that advise an option unknown to `has`,
/// since the library does not know which command shows its messages. For a
/// command without --missing, "empty cell; fill it in, or drop such rows with
/// --missing drop-rows" becomes "empty cell; fill it in". Text about another
/// command ("errmap fit ... --model X") and quoted text stay.
std::string WithOwnRemedies(
    std::string_view message,
    const std::function<bool(std::string_view option)>& has);

/// Turns Ctrl-C (SIGINT), SIGTERM and SIGHUP (a closed terminal) into a flag
/// that fits check. A second signal ends the program at once. A signal that was
/// ignored at the program's start stays ignored.
const std::atomic<bool>& InstallInterruptFlag();

/// Returns the capabilities of standard output; 80 columns if it is not a
/// terminal. The environment's COLUMNS, LINES and NO_COLOR take precedence.
report::Terminal OutputTerminal();

/// PrintResult with bold strong lines if standard output has colours.
void PrintScreen(const report::Screen& screen);

/// Returns a message with a line feed. If standard error is a terminal, breaks
/// it at blanks to fit.
std::string MessageLines(std::string_view line);

/// PrintResult of running text, in lines no wider than OutputTerminal().
void PrintFitted(std::string_view text);

/// Replaces the streams and signals of the process if another program runs
/// commands (RunHosted).
struct Host {
  const std::atomic<bool>* stop = nullptr;  // set: a command ends early
  std::string printed = {};                 // to standard output
  std::vector<std::string> messages = {};   // without "errmap: "
};

/// Returns null if the process is errmap's own.
Host* CurrentHost();

/// Makes `host` the current one for its lifetime; only one at a time.
class HostedRun {
 public:
  explicit HostedRun(Host* host);
  ~HostedRun();
  HostedRun(const HostedRun&) = delete;
  HostedRun& operator=(const HostedRun&) = delete;
};

}  // namespace errmap::cli
