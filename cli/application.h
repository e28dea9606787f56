#pragma once

#include <string>
#include <vector>

namespace errmap::cli {

/// Runs the command line and returns the exit status: 0 done, 2 the command
/// line is wrong, 3 the input is unusable, 4 every fit failed, 5 not judged
/// or in doubt, 130 interrupted, 1 anything else. Errors are one line on
/// stderr.
int RunApplication(int argc, char** argv);

/// Runs a command within another program that holds a HostedRun: `words` are
/// the command and its arguments.
int RunHosted(std::vector<std::string> words);

}  // namespace errmap::cli
