#pragma once

#include <cstdlib>
#include <string>

#include <sys/wait.h>

#include "tests/cli/cli_fixture.h"

namespace errmap {

/// The program as a shell starts it.
class CliShell : public Cli {
 protected:
  /// The program with words and redirections as a shell reads them; stdout is
  /// empty where `words` redirect it.
  Outcome Shell(const std::string& words) const {
    const std::string line = "cd '" + scratch_.path().string() + "' && '" +
                             tests::Binary() + "' " + words + " 2>.err";
    const int status = std::system(line.c_str());
    return {WEXITSTATUS(status), "", Read(".err")};
  }

  /// Status of the program in a shell's background, sent a signal after a
  /// second; its answer is in the file "out".
  int Background(const std::string& words, const std::string& signal) const {
    return Shell("--version > out; '" + tests::Binary() + "' " + words +
                 " > out & p=$!; sleep 1; kill -" + signal + " $p; wait $p")
        .status;
  }
};

}  // namespace errmap
