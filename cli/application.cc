
#include <algorithm>
#include <csignal>
#include <cstddef>
#include <exception>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>

#include <CLI/CLI.hpp>
#include <CLI/Version.hpp>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include "cli/command.h"
#include "cli/commands/data_arguments.h"
#include "cli/report/shell_word.h"
#include "cli/shell/command_reference.h"
#include "cli/shell/completion.h"
#include "cli/shell/help_text.h"
#include "cli/shell/standard_streams.h"
#include "cli/slice.h"
#include "cli/study_setup/provenance.h"
#include "data/argument_name.h"
#include "data/files/atomic_file.h"
#include "data/files/shown_path.h"
#include "data/input_error.h"
#include "data/measurements/reading/reading.h"
#include "data/text.h"
#include "models/study/record/provenance_record.h"
#include "models/version.h"

namespace errmap::cli {
namespace {

constexpr const char* kAbout =
    "errmap: which map of a machine tool's error holds on another day?";

constexpr const char* kExample =
    "Begin with: errmap compare DATA.csv, or errmap help tutorial\n"
    "errmap help COMMAND explains a command, errmap help TOPIC a topic: ";

int Fail(int status, const std::string& message) {
  WriteMessage(message);
  return status;
}

// CLI11's texts may run over several lines; ours is always one.
std::string OneLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

// A word of the command line with paths as they are shown; they may stand after
// '=' or ':' (--out=/home/me/study, file:/home/me/map.json) and in lists.
std::string ShownWord(const std::string& word) {
  if (word.starts_with('/')) {
    return data::ShownPath(word);  // commas are part of it
  }
  std::string shown;
  for (std::size_t at = 0; at < word.size();) {
    const bool begins =
        word[at] == '/' && at > 0 &&
        std::string_view("=:,\"").find(word[at - 1]) != std::string_view::npos;
    if (!begins) {
      shown += word[at++];
      continue;
    }
    const std::size_t end =
        std::min(word.find_first_of(",\"", at), word.size());
    shown += data::ShownPath(word.substr(at, end - at));
    at = end;
  }
  return shown;
}

// Results must not depend on where and how fast they were made.
std::string ProvenanceCommandLine(int argc, char** argv) {
  std::string line = "errmap";
  for (int i = 1; i < argc; ++i) {
    const std::string word = ShownWord(argv[i]);
    if (data::IsOneOf(word,
                      "--keep-paths --quiet --resume --force --all --details "
                      "--no-cache")) {
      continue;
    }
    const std::string name = word.substr(0, word.find('='));
    if (data::IsOneOf(name, "--jobs --out --output --format --shard -o")) {
      if (name == word) ++i;
      continue;
    }
    if (word.starts_with("-o")) continue;  // -oFILE
    line += " " + report::ShellWord(word);
  }
  return line;
}

// For shells and the build, not for people: no help names them.
constexpr std::string_view kComplete = "__complete";    // WORDS...
constexpr std::string_view kReference = "__reference";  // in Markdown

bool RunHiddenCommand(const CLI::App& app, int argc, char** argv) {
  if (argv[1] == kComplete) {
    const std::vector<std::string> words(argv + 2, argv + argc);
    PrintResult(CompletionText(Complete(DescribeProgram(app), words)));
    return true;
  }
  if (argv[1] == kReference) {
    PrintResult(ReferencePage(DescribeProgram(app)));
    return true;
  }
  return false;
}

std::vector<std::string> CommandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> OptionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      names.push_back("--" + name);
    }
    for (const std::string& name : option->get_snames()) {
      names.push_back("-" + name);
    }
  }
  return names;
}

// CLI11 would only say that a subcommand is required.
void RequireKnownCommand(const CLI::App& app, const std::string& word) {
  if (word.starts_with("-")) return;
  const std::vector<std::string> known = CommandNames(app);
  if (std::ranges::find(known, word) != known.end()) return;
  std::vector<std::string> meant = OptionNames(app);
  meant.insert(meant.begin(), known.begin(), known.end());
  const std::string guess = data::DidYouMean(word, meant);
  throw UsageError(fmt::format("no command '{}'; {}",
                               word,
                               guess.empty()
                                   ? "there are " + data::JoinWords(known, ", ")
                                   : guess + "see errmap --help"));
}

// CLI11's "--goal: 1 required X missing" and "--jobs: Value x not in range 1 to
// 9" in plain words.
std::string PlainWords(std::string text) {
  const std::size_t begin = text.find(": ");
  constexpr std::string_view kOneRequired = ": 1 required ";
  constexpr std::string_view kMissing = " missing";
  constexpr std::string_view kValue = ": Value ";
  constexpr std::string_view kNotInRange = " not in range ";
  if (begin == std::string::npos) return text;
  if (text.find(kOneRequired) == begin && text.ends_with(kMissing)) {
    return text.replace(begin, kOneRequired.size(), ": its value ")
        .replace(text.size() - kMissing.size(), kMissing.size(), " is missing");
  }
  const std::size_t range = text.find(kNotInRange);
  if (text.find(kValue) == begin && range != std::string::npos) {
    const std::size_t found = begin + kValue.size();
    return fmt::format("{} must be {}, found '{}'",
                       text.substr(0, begin),
                       text.substr(range + kNotInRange.size()),
                       text.substr(found, range - found));
  }
  return text;
}

// CLI11 says what it did not expect, and not what was probably meant.
std::string WithSuggestion(const CLI::App& app,
                           const CLI::ParseError& error,
                           int argc,
                           char** argv) {
  const std::string text = OneLine(error.what());
  const bool of_command = !std::string_view(argv[1]).starts_with('-');
  const std::string help =
      fmt::format("see errmap {}--help",
                  of_command ? std::string(argv[1]) + " " : std::string());
  std::vector<std::string> known =
      OptionNames(of_command ? *app.get_subcommand(argv[1]) : app);
  // CLI11 names it, or misses what may be there under a misspelt name.
  const bool lacks = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  const auto at_fault = [&](const std::string& flag) {
    if (!of_command || text.find(flag) != std::string::npos) return true;
    // Short ones may be values: "-o -x".
    return lacks && flag.starts_with("--") &&
           !data::NearestName(flag, known).empty();
  };
  for (int i = of_command ? 2 : 1; i < argc; ++i) {
    const std::string word(argv[i]);
    if (word == "--") break;  // no options from here on
    const std::string flag = word.substr(0, word.find('='));
    double number = 0.0;
    if (!flag.starts_with("-") || data::ParseNumber(word, &number) ||
        !at_fault(flag) || std::ranges::find(known, flag) != known.end()) {
      continue;
    }
    // One letter is as near to any other.
    const bool is_word = flag.size() > 2;
    return fmt::format("no option '{}'; {}{}",
                       flag,
                       is_word ? data::DidYouMean(flag, known) : "",
                       help);
  }
  // "--format: tabel not in {table,json}"
  const std::size_t open = text.find(" not in {");
  const std::size_t begin = text.find(": ");
  if (open != std::string::npos && begin < open && text.ends_with('}')) {
    const std::string found = text.substr(begin + 2, open - begin - 2);
    const std::size_t list = text.find('{', open) + 1;
    known = CLI::detail::split(text.substr(list, text.size() - list - 1), ',');
    return fmt::format("{} must be one of {}, found '{}'; {}{}",
                       text.substr(0, begin),
                       data::JoinWords(known, ", "),
                       found,
                       data::DidYouMean(found, known),
                       help);
  }
  if (of_command && dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const auto extra = app.get_subcommand(argv[1])->remaining();
    return fmt::format(
        "not expected: {}; {}", data::JoinWords(extra, " "), help);
  }
  return PlainWords(text) + "; " + help;
}

struct Purpose {
  std::string_view name;
  std::vector<AddCommandTo> commands;
};

// Puts the command of a slice where it belongs.
void Join(const SliceCommand& command, std::vector<Purpose>* purposes) {
  auto purpose = std::ranges::find(*purposes, command.purpose, &Purpose::name);
  if (purpose == purposes->end()) {
    purpose = purposes->insert(std::prev(purpose), {command.purpose, {}});
  }
  std::vector<AddCommandTo>& commands = purpose->commands;
  commands.insert(std::ranges::find(commands, command.before), command.add);
}

// Every command, under what it serves and in the order of the help.
std::vector<Purpose> Purposes() {
  std::vector<Purpose> purposes = {
      {"Judge: which map holds, and how sure",
       {AddCompareCommand,
        AddLearnCommand,
        AddModelsCommand,
        AddInitCommand,
        AddReadCommand,
        AddReportCommand}},
      {"Use a map", {AddFitCommand, AddPredictCommand, AddEvaluateCommand}},
      {"Hand over to the control", {AddExportCommand, AddCostCommand}},
      {"Another day", {AddCheckCommand, AddWhenCommand, AddUpdateCommand}},
      {"Laboratory", {AddResidualsCommand, AddCertifyCommand}}};
  for (const Slice& slice : Slices()) {
    for (const SliceCommand& command : slice.commands) Join(command, &purposes);
  }
  return purposes;
}

void AddCommands(CLI::App* app, Run* run) {
  for (const Purpose& purpose : Purposes()) {
    for (const AddCommandTo add : purpose.commands) {
      add(app, run);
      app->get_subcommands(nullptr).back()->group(std::string(purpose.name));
    }
  }
}

void PrintHelp(const CLI::App& app, const std::string& name, bool all) {
  const std::size_t width = OutputTerminal().columns;
  const ProgramReference program = DescribeProgram(app);
  if (name.empty()) {
    PrintResult(ProgramHelp(program, width));
    return;
  }
  for (const CommandReference& command : program.commands) {
    if (command.name != name) continue;
    PrintResult(CommandHelp(
        command, all ? HelpOptions::kAll : HelpOptions::kUsual, width));
    return;
  }
  for (const Topic& topic : Topics()) {
    if (topic.name != name) continue;
    PrintResult(TopicText(topic, width));
    return;
  }
  std::vector<std::string> known = CommandNames(app);
  const std::vector<std::string> topics = TopicNames();
  known.insert(known.end(), topics.begin(), topics.end());
  throw UsageError(fmt::format("no command or topic '{}'; {}there are {}",
                               name,
                               data::DidYouMean(name, known),
                               data::JoinWords(known, ", ")));
}

void AddHelpCommand(CLI::App* app) {
  struct Asked {
    std::string name;
    bool all = false;
  };
  auto asked = std::make_shared<Asked>();
  CLI::App* help = app->add_subcommand("help", "Explain a command or a topic");
  help->group("Help");
  help->add_option("WORD", asked->name, "What to explain")
      ->type_name(kHelpWord);
  help->add_flag("--all", asked->all, "Show every option of a command");
  help->footer("Example: errmap help compare --all");
  help->callback([app, asked] { PrintHelp(*app, asked->name, asked->all); });
}

// A line on the compiler and the machine, and one per library.
std::string MadeWith() {
  const models::ProvenanceRecord made = study_setup::MakeProvenance("", {});
  std::string text = made.compiler + "; " + made.platform + "\n";
  for (const auto& [name, version] : made.libraries) {
    text += fmt::format("{} {}\n", name, version);
  }
  return text;
}

// What the command that runs can be advised to do.
void AdviseOwnOptions(const CLI::App& app, const std::string& command) {
  for (const CLI::App* const one : app.get_subcommands(nullptr)) {
    if (one->get_name() != command) continue;
    const std::vector<std::string> names = OptionNames(*one);
    AdviseOnly({names.begin(), names.end()});
  }
}

// "-" where a file is read is standard input.
void NameStandardInput(int argc, char** argv) {
  static std::string input = "/dev/stdin";
  for (int i = 1; i < argc; ++i) {
    const bool is_output = data::IsOneOf(
        argv[i - 1], "-o --output --out --save-split --figure --figures");
    if (!is_output && std::string_view(argv[i]) == "-") argv[i] = input.data();
  }
}

int RunParsed(int argc, char** argv) {
  if (std::find(argv, argv + argc, std::string_view("--keep-paths")) !=
      argv + argc) {
    data::KeepPaths();
  }
  Run run{.command_line = ProvenanceCommandLine(argc, argv)};
  CLI::App app(kAbout, "errmap");
  app.footer(kExample + data::JoinWords(TopicNames(), ", "));
  app.set_version_flag("--version", std::string("errmap ") + models::Version());
  app.require_subcommand(1);
  AddCommands(&app, &run);
  AddHelpCommand(&app);
  if (argc < 2) {
    PrintResult(FirstSteps());
    return kWrongCommandLine;
  }
  if (RunHiddenCommand(app, argc, argv)) return kDone;
  NameStandardInput(argc, argv);
  RequireKnownCommand(app, argv[1]);
  AdviseOwnOptions(app, argv[1]);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const std::string_view word = argv[1];
    PrintHelp(app, word.starts_with('-') ? "" : std::string(word), false);
    return kDone;
  } catch (const CLI::CallForVersion& version) {
    PrintResult(std::string(version.what()) + "\n" + MadeWith());
    return kDone;
  } catch (const CLI::ParseError& error) {
    const std::string word = argc > 1 ? argv[1] : "";
    const bool is_command = !word.empty() && !word.starts_with('-');
    throw UsageError((is_command ? word + ": " : "") +
                     WithSuggestion(app, error, argc, argv));
  }
  return run.status;
}

int RunCommand(int argc, char** argv) {
  try {
    return RunParsed(argc, argv);
  } catch (const UsageError& error) {
    return Fail(kWrongCommandLine, error.what());
  } catch (const data::OpenQuestion& question) {
    return Fail(kWrongCommandLine, question.what());
  } catch (const data::InputError& error) {
    return Fail(kUnusableInput, error.what());
  } catch (const std::bad_alloc&) {
    return Fail(kOtherFailure, "not enough memory");
  } catch (const std::exception& error) {
    return Fail(kOtherFailure, OneLine(error.what()));
  }
}

// Libraries throw where nothing may be thrown (a JSON document allocates while
// it is freed). Files are whole or not there at any moment.
[[noreturn]] void EndAtOnce() {
  try {
    if (std::current_exception() != nullptr) throw;
    Fail(kOtherFailure, "ended by an error that cannot be named");
  } catch (const std::bad_alloc&) {
    DrawOnTerminal("errmap: not enough memory\n");
  } catch (const std::exception& error) {
    Fail(kOtherFailure, error.what());
  } catch (...) {
    Fail(kOtherFailure, "ended by an error that has no text");
  }
  data::EndWriting();
  std::_Exit(kOtherFailure);
}

// OpenBLAS asks again and again for what it was refused, without end: what it
// takes at its first products is asked for before.
bool HasRoomForProducts() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return true;
  }
  constexpr std::size_t kBytes = std::size_t{256} << 20U;
  void* const room = mmap(nullptr,
                          kBytes,
                          PROT_READ | PROT_WRITE,
                          MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE,
                          -1,
                          0);
  if (room == MAP_FAILED) return false;
  munmap(room, kBytes);
  return true;
}

// "keep_dead" is "--keep-dead" here; what only a study can say is its key.
std::string FlagOf(std::string_view member, std::string_view value) {
  if (member == "where") return "where in a study (errmap init writes one)";
  std::string flag = cli::FlagOf(member);
  if (value.empty()) return flag;
  // A value that begins as an option does is read as one behind a blank.
  flag += value.starts_with('-') ? "=" : " ";
  flag += report::ShellWord(std::string(value));
  return flag;
}

}  // namespace

int RunApplication(int argc, char** argv) {
  data::NameArgumentsBy(FlagOf);
  HoldStandardStreams();
  std::set_terminate(EndAtOnce);
  models::NameLibrary("CLI11", CLI11_VERSION);
  if (!HasRoomForProducts()) {
    Fail(kOtherFailure,
         "not enough memory: the address space is limited (ulimit -v) and less "
         "than 256 MiB of it are left");
    // An ordinary end waits for OpenBLAS's threads, which may be asking
    // already.
    std::_Exit(kOtherFailure);
  }
  // A file that grows too long is then a failed write with a message.
  std::signal(SIGXFSZ, SIG_IGN);
  const int status = RunCommand(argc, argv);
  if (PrintError() == 0) return status;
  return Fail(kOtherFailure,
              "cannot write to standard output: " +
                  std::generic_category().message(PrintError()));
}

int RunHosted(std::vector<std::string> words) {
  words.insert(words.begin(), "errmap");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  return RunCommand(static_cast<int>(argv.size()), argv.data());
}

}  // namespace errmap::cli
