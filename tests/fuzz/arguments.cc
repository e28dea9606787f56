#include <csignal>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

#include "cli/command.h"
#include "cli/shell/standard_streams.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/scratch_folder.h"

namespace errmap::fuzz {
namespace {

namespace fs = std::filesystem;

// 36 rows of three cycles, a map of them, and a file of every other kind.
std::map<std::string, std::string> SmallFiles() {
  std::string data = "cycle,position_mm,t1_degC,error_mm\n";
  for (int row = 0; row < 36; ++row) {
    data += std::to_string(row / 12) + "," + std::to_string(row % 12) + "," +
            std::to_string(20 + row * row % 7) + ",0.00" +
            std::to_string(row * 17 % 10) + "\n";
  }
  return {
      {"d.csv", data},
      {"m.json",
       R"({"schema":"errmap-model-1","version":"0.1.0","name":"poly:position",)"
       R"("kind":"polynomial","target":{"name":"error_mm","unit":"mm"},)"
       R"("inputs":[{"name":"position_mm","unit":"mm","min":0,"max":11,)"
       R"("mean":5.5,"sd":3.5}],"parameters":2,"polynomial":)"
       R"({"input_offset":[5.5],"input_scale":[0.18],"intercept":0.001,)"
       R"("terms":[{"powers":[1],"coefficient":0.002}],"equation":""}})"},
      {"study.toml",
       "seed = 1\n[[component]]\ndata = \"d.csv\"\n"
       "[[model]]\nuse = \"mean\"\n"},
      {"machine.toml",
       "name = \"m\"\nlength = \"mm\"\nangle = \"rad\"\n[[link]]\n"
       "name = \"Z\"\nbranch = \"tool\"\njoint = \"linear\"\n"
       "axis = [0, 0, 1]\ncoordinate = \"position_mm\"\n"
       "errors = { EZZ = \"m.json\" }\n"},
      {"p.csv", "row,predicted\n0,0.001\n1,0.002\n"},
      {"s.csv", "row,holdout,fold,role\n0,a,0,train\n1,a,0,test\n"},
  };
}

// The folder as it was before the first run, in which the process works.
void Restore(const ScratchFolder& folder) {
  static const std::map<std::string, std::string> files = SmallFiles();
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder.path(), ignored)) {
    fs::remove_all(entry.path(), ignored);
  }
  for (const auto& [name, content] : files) folder.Write(name, content);
}

std::vector<std::string> WordsOf(std::string_view bytes) {
  std::vector<std::string> words{"errmap"};
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    words.emplace_back(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  return words;
}

// Words that would leave the folder, and commands that work for seconds.
bool IsAllowed(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word.find('/') != word.npos || word.find("..") != word.npos ||
        word.find('\0') != word.npos) {
      return false;
    }
  }
  const bool is_long =
      words.size() > 1 && (words[1] == "certify" || words[1] == "simulate" ||
                           words[1] == "netcg" || words[1] == "cost");
  return !is_long || words.back() == "--help";
}

}  // namespace

void RunWithArguments(std::string_view bytes) {
  std::vector<std::string> words = WordsOf(bytes);
  if (!IsAllowed(words)) return;
  static const ScratchFolder folder;
  static const bool is_prepared = [] {
    cli::InstallInterruptFlag();
    return std::raise(SIGINT) == 0;
  }();
  Require(is_prepared);
  const fs::path before = fs::current_path();
  Restore(folder);
  fs::current_path(folder.path());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const int status =
      cli::RunApplication(static_cast<int>(words.size()), argv.data());
  fs::current_path(before);
  // As the command line promises; 130 where a fit was asked for.
  Require((status >= 0 && status <= 4) || status == 130);
}

}  // namespace errmap::fuzz
