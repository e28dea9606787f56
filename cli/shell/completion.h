#pragma once

#include <string>
#include <vector>

#include "cli/shell/command_reference.h"

namespace errmap::cli {

/// The value of help's argument: any command, any topic.
inline constexpr const char* kHelpWord = "COMMAND|TOPIC";

/// A word that may stand where the cursor is.
struct Candidate {
  std::string word;
  std::string description;  // one line; may be ""
};

/// What a shell offers for the word under the cursor.
struct Completion {
  std::vector<Candidate> candidates;
  bool files = false;     // names of files too ...
  std::string extension;  // ... that end so ("csv"); "" = any
  bool folders = false;   // names of folders only
};

/// Completes the last of `words`, those that follow the program's name up to
/// the cursor; it may be "". Commands, options, words that an option is limited
/// to, models with their options, hold-outs, and the columns of the data file
/// named before.
Completion Complete(const ProgramReference& program,
                    const std::vector<std::string>& words);

/// For the shells' scripts: a line per candidate, "word<tab>description", and
/// ":files [extension]" or ":folders" where names of files serve too.
std::string CompletionText(const Completion& completion);

/// One hold-out of each kind, to begin with.
std::vector<std::string> HoldoutExamples();

}  // namespace errmap::cli
