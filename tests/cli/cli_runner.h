#pragma once

// Runs the program as a user does: a process of its own in a scratch folder,
// with stdout, stderr and the exit status caught apart.

#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <signal.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/types.h>
#include <sys/wait.h>

#include "data/sha256.h"
#include "tests/places.h"

namespace errmap {

struct Outcome {
  int status = -1;  // 128 + signal where a signal ended the process
  std::string out;
  std::string err;
};

/// A folder that vanishes with its owner.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name =
        (std::filesystem::temp_directory_path() / "errmap_cli_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error(name);
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The program while it runs.
class Process {
 public:
  Process(const std::filesystem::path& folder, std::vector<std::string> words)
      : out_(folder / ".stdout"), err_(folder / ".stderr") {
    words.insert(words.begin(), tests::Binary());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ > 0) return;
    const int out = open(out_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    const int err = open(err_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    if (chdir(folder.c_str()) == 0 && dup2(out, STDOUT_FILENO) >= 0 &&
        dup2(err, STDERR_FILENO) >= 0) {
      execv(argv.front(), argv.data());
    }
    _exit(127);
  }
  ~Process() {
    if (pid_ <= 0) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// True once the program catches SIGINT; false where it never does.
  bool WaitUntilInterruptible() const { return WaitUntilCaught(true); }

  /// Until the first Ctrl-C was taken: the next one ends the process.
  bool WaitUntilInterrupted() const { return WaitUntilCaught(false); }

  void Interrupt() const { kill(pid_, SIGINT); }
  void Kill() const { kill(pid_, SIGKILL); }

  /// Processor time that it has used, all threads: what another load of the
  /// machine does not change. Also after Wait.
  double CpuSeconds() const {
    if (pid_ < 0) return cpu_seconds_;
    std::ifstream status("/proc/" + std::to_string(pid_) + "/stat");
    std::string word;
    std::getline(status, word, ')');  // the name may hold blanks
    constexpr int kFieldsBetween = 11;
    for (int i = 0; i < kFieldsBetween; ++i) status >> word;
    double user = 0.0;
    double system = 0.0;
    status >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

  Outcome Wait() {
    int status = 0;
    rusage usage{};
    wait4(pid_, &status, 0, &usage);
    pid_ = -1;
    const auto seconds = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) +
             1e-6 * static_cast<double>(time.tv_usec);
    };
    cpu_seconds_ = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    const int code =
        WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, TextOf(out_), TextOf(err_)};
  }

  static std::string TextOf(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
  }

 private:
  bool WaitUntilCaught(bool wanted) const {
    constexpr int kMostPolls = 30'000;
    for (int poll = 0; poll < kMostPolls; ++poll) {
      std::ifstream status("/proc/" + std::to_string(pid_) + "/status");
      std::string key;
      while (status >> key && key != "SigCgt:") {
      }
      unsigned long long caught = 0;
      status >> std::hex >> caught;
      if ((((caught >> (SIGINT - 1)) & 1U) != 0) == wanted) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }

  std::filesystem::path out_;
  std::filesystem::path err_;
  pid_t pid_ = -1;
  double cpu_seconds_ = 0.0;  // of all threads, once it has ended
};

inline std::string SetPath(const std::string& name) {
  return tests::SourceDir() + "/data/sets/" + name;
}

/// A test with a scratch folder, which is the program's working folder.
class CliTest : public ::testing::Test {
 protected:
  using Json = nlohmann::ordered_json;

  Outcome Run(const std::vector<std::string>& words) const {
    return Process(scratch_.path(), words).Wait();
  }

  /// stdout of a run that must end well, as JSON.
  Json RunJson(const std::vector<std::string>& words) const {
    const Outcome outcome = Run(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    Json document = Json::parse(outcome.out, nullptr, false);
    EXPECT_FALSE(document.is_discarded()) << outcome.out;
    return document;
  }

  /// A model file whose checksum holds.
  void WriteMapFile(const std::string& name, Json map) const {
    map.erase("checksum");
    std::string text = map.dump();
    text.pop_back();
    Write(name, text + ",\"checksum\":\"" + data::Sha256(text) + "\"}");
  }

  void Write(const std::string& name, std::string_view text) const {
    std::ofstream stream(scratch_ / name, std::ios::binary);
    stream << text;
    stream.close();
    ASSERT_TRUE(stream.good()) << name;
  }

  std::string Read(const std::string& name) const {
    return Process::TextOf(scratch_ / name);
  }

  bool Exists(const std::string& name) const {
    return std::filesystem::exists(scratch_ / name);
  }

  ScratchFolder scratch_;
};

/// The message of a run that failed as it must: this status, nothing on
/// stdout, one line on stderr that begins with the program's name.
inline std::string RefusalOf(const Outcome& outcome, int status) {
  EXPECT_EQ(outcome.status, status) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(outcome.err.starts_with("errmap: ")) << outcome.err;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  return outcome.err;
}

}  // namespace errmap
