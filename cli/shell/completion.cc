#include "cli/shell/completion.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>

#include "cli/shell/help_text.h"
#include "data/csv.h"
#include "models/recipe_catalog.h"
#include "stats/holdout.h"

namespace errmap::cli {
namespace {

// Words typed so far, as options and positionals.
struct ParsedWords {
  std::vector<std::string> positionals;
  std::set<std::string> given;            // names of options
  const OptionReference* open = nullptr;  // its value is to come
};

const OptionReference* FindOption(const CommandReference& command,
                                  const std::string& name) {
  for (const OptionReference& option : command.options) {
    if (std::ranges::find(option.names, name) != option.names.end()) {
      return &option;
    }
  }
  return nullptr;
}

ParsedWords Parse(const CommandReference& command,
                  const std::vector<std::string>& words) {
  ParsedWords parsed;
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const std::string& word = words[i];
    if (parsed.open != nullptr) {
      parsed.open = nullptr;
    } else if (!word.starts_with("-")) {
      parsed.positionals.push_back(word);
    } else {
      const std::size_t equals = word.find('=');
      const OptionReference* option =
          FindOption(command, word.substr(0, equals));
      if (option == nullptr) continue;
      parsed.given.insert(option->names.front());
      const bool has_value = equals != std::string::npos;
      if (!option->value.empty() && !has_value) parsed.open = option;
    }
  }
  return parsed;
}

// Adds `before` + word for each word that goes on from `typed`.
void Offer(const std::vector<std::string>& words,
           const std::string& before,
           const std::string& typed,
           Completion* completion) {
  for (const std::string& word : words) {
    if (!word.starts_with(typed)) continue;
    completion->candidates.push_back({before + word, ""});
  }
}

// "net:scg:hidden=60:w" -> "net:scg:hidden=60:wfactor=".
void OfferModel(const std::string& before,
                const std::string& typed,
                Completion* completion) {
  std::vector<std::string> types = models::ModelTypes();
  types.emplace_back("poly:formula=");
  Offer(types, before, typed, completion);
  for (const std::string& type : models::ModelTypes()) {
    if (!typed.starts_with(type + ":")) continue;
    const std::size_t last = typed.rfind(':');
    const std::string done = typed.substr(0, last + 1);
    std::vector<std::string> keys;
    for (const models::ModelOption& option : models::OptionsOfModel(type)) {
      const std::string key = option.name + "=";
      if (done.find(":" + key) == std::string::npos) keys.push_back(key);
    }
    Offer(keys, before + done, typed.substr(last + 1), completion);
  }
}

void OfferHoldout(const std::string& before,
                  const std::string& typed,
                  Completion* completion) {
  Offer(HoldoutExamples(), before, typed, completion);
  if (typed.starts_with("file:")) {
    completion->files = true;
    completion->extension = "csv";
  }
}

// Column names of the first of `files` that is a table; none if none is.
std::vector<std::string> ColumnsOf(const std::vector<std::string>& files) {
  constexpr std::size_t kMostBytes = 1
                                     << 16;  // A header, but not a whole file.
  for (const std::string& file : files) {
    std::error_code ignored;  // A pipe would be waited for, or be robbed.
    if (!std::filesystem::is_regular_file(file, ignored)) continue;
    std::ifstream stream(file, std::ios::binary);
    std::string text(kMostBytes, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    text.resize(text.rfind('\n') + 1);  // npos + 1 = 0: no line at all
    try {
      std::vector<std::string> names;
      for (const auto& column : data::ParseCsv(text, file).columns) {
        names.push_back(column.name);
      }
      return names;
    } catch (const data::InputError&) {
      // Not a table, or a bad one: others will say so.
    }
  }
  return {};
}

// "FILE.csv", "FILE", "NAME=FILE", "study.toml".
void OfferFiles(const std::string& value, Completion* completion) {
  const std::size_t dot = value.rfind('.');
  completion->files = true;
  if (dot != std::string::npos) completion->extension = value.substr(dot + 1);
}

bool IsList(const std::string& value) {
  return value == "LIST" || value.ends_with(",...");
}

bool IsFile(const std::string& value) {
  return value.ends_with("FILE") || value.ends_with(".csv") ||
         value.ends_with(".json") || value.ends_with(".toml");
}

// `before` is what stands before the value in the same word ("--target=").
void OfferValue(const OptionReference& option,
                const std::vector<std::string>& files,
                std::string before,
                std::string typed,
                Completion* completion) {
  const std::string& value = option.value;
  const std::string& name = option.names.back();
  if (IsList(value)) {
    const std::size_t start = typed.rfind(',') + 1;  // npos + 1 = 0
    before += typed.substr(0, start);
    typed.erase(0, start);
  }
  if (!option.choices.empty()) {
    Offer(option.choices, before, typed, completion);
  } else if (name == "--model" || name == "--models") {
    OfferModel(before, typed, completion);
  } else if (name == "--holdout") {
    OfferHoldout(before, typed, completion);
  } else if (value == "DIR") {
    completion->folders = true;
  } else if (IsFile(value)) {
    OfferFiles(value, completion);
  } else if (value == "COL" || value == "A,B,...") {
    Offer(ColumnsOf(files), before, typed, completion);
  }
}

void OfferOptions(const CommandReference& command,
                  const std::set<std::string>& given,
                  const std::string& typed,
                  Completion* completion) {
  for (const OptionReference& option : command.options) {
    if (given.contains(option.names.front()) && !option.repeatable) continue;
    if (!option.names.back().starts_with(typed)) continue;
    completion->candidates.push_back({option.names.back(), option.description});
  }
  Offer({"--help"}, "", typed, completion);
}

Completion CompleteCommand(const CommandReference& command,
                           const std::vector<std::string>& words) {
  Completion completion;
  const ParsedWords parsed = Parse(command, words);
  const std::string& typed = words.back();
  const std::size_t equals = typed.find('=');
  if (parsed.open != nullptr) {
    OfferValue(*parsed.open, parsed.positionals, "", typed, &completion);
  } else if (typed.starts_with("--") && equals != std::string::npos) {
    if (const auto* option = FindOption(command, typed.substr(0, equals))) {
      OfferValue(*option,
                 parsed.positionals,
                 typed.substr(0, equals + 1),
                 typed.substr(equals + 1),
                 &completion);
    }
  } else if (typed.starts_with("-") ||
             parsed.positionals.size() >= command.positionals.size()) {
    OfferOptions(command, parsed.given, typed, &completion);
  } else {
    OfferValue(command.positionals[parsed.positionals.size()],
               {},
               "",
               typed,
               &completion);
  }
  return completion;
}

void OfferCommands(const ProgramReference& program,
                   const std::string& typed,
                   Completion* completion) {
  for (const CommandReference& command : program.commands) {
    if (!command.name.starts_with(typed)) continue;
    completion->candidates.push_back({command.name, command.description});
  }
}

std::string FirstLine(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

std::vector<std::string> HoldoutExamples() {
  std::vector<std::string> examples;
  for (const stats::HoldoutForm& form : stats::HoldoutForms()) {
    examples.insert(examples.end(), form.examples.begin(), form.examples.end());
  }
  return examples;
}

Completion Complete(const ProgramReference& program,
                    const std::vector<std::string>& words) {
  if (words.empty()) return Complete(program, {""});
  Completion completion;
  if (words.size() == 1) {
    OfferCommands(program, words.front(), &completion);
    if (words.front().starts_with("-")) {
      Offer({"--help", "--version"}, "", words.front(), &completion);
    }
    return completion;
  }
  for (const CommandReference& command : program.commands) {
    if (command.name != words.front()) continue;
    completion = CompleteCommand(command, words);
    if (words.size() == 2 && !words.back().starts_with("-") &&
        !command.positionals.empty() &&
        command.positionals.front().value == kHelpWord) {
      OfferCommands(program, words.back(), &completion);
      for (const Topic& topic : Topics()) {
        if (!topic.name.starts_with(words.back())) continue;
        completion.candidates.push_back({topic.name, TitleOf(topic)});
      }
    }
  }
  return completion;
}

std::string CompletionText(const Completion& completion) {
  std::string text;
  for (const Candidate& candidate : completion.candidates) {
    // A name of several lines cannot be told to a shell.
    if (candidate.word.find_first_of("\n\t") != std::string::npos) continue;
    text += candidate.word;
    if (!candidate.description.empty()) {
      text += "\t" + FirstLine(candidate.description);
    }
    text += "\n";
  }
  if (completion.files) {
    text += completion.extension.empty()
                ? ":files\n"
                : ":files " + completion.extension + "\n";
  }
  if (completion.folders) text += ":folders\n";
  return text;
}

}  // namespace errmap::cli
