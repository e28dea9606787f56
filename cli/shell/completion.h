#pragma once

#include <string>
#include <vector>

#include "cli/shell/command_reference.h"

namespace errmap::cli {

/// The placeholder of help's argument: any command or topic.
inline constexpr const char* kHelpWord = "COMMAND|TOPIC";

/// A word that can be inserted at the cursor.
struct Candidate {
  std::string word;
  std::string description;  // one line; may be ""
};

/// The choices that a shell offers for the word under the cursor.
struct Completion {
  std::vector<Candidate> candidates;
  bool files = false;     // also names of files ...
  std::string extension;  // ... with this extension ("csv"); "" = any
  bool folders = false;   // only names of folders
};

/// Completes the last of `words`, which are those between the program's name
/// and the cursor; it may be "". Offers commands, options, an option's allowed
/// words, models with their options, hold-outs, and the columns of the data
/// file named before.
Completion Complete(const ProgramReference& program,
                    const std::vector<std::string>& words);

/// Returns text for the shells' scripts: one line "word<tab>description" for
/// each candidate, and ":files [extension]" or ":folders" if file names are
/// allowed too.
std::string CompletionText(const Completion& completion);

/// Returns one example of each kind of hold-out.
std::vector<std::string> HoldoutExamples();

}  // namespace errmap::cli
