#include "data/files/atomic_file.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include "data/files/link.h"
#include "data/input_error.h"

namespace errmap::data {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// An empty folder of its own for each test.
class AtomicFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern =
        (fs::temp_directory_path() / "atomic_file_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }

  void TearDown() override { fs::remove_all(folder_); }

  std::string Path(const std::string& name) const { return folder_ / name; }

  std::ptrdiff_t NumEntries() const {
    return std::distance(fs::directory_iterator(folder_), {});
  }

  static mode_t Permissions(const std::string& path) {
    struct stat status {};
    EXPECT_EQ(stat(path.c_str(), &status), 0);
    return status.st_mode & 07777U;
  }

  fs::path folder_;
};

TEST_F(AtomicFile, WritesANewFileThatReadsBackTheSame) {
  const std::string content("one\ntwo\0three\r\n", 15);
  WriteFileAtomically(Path("new.txt"), content);
  EXPECT_EQ(ReadFile(Path("new.txt")), content);
  EXPECT_EQ(NumEntries(), 1);
}

TEST_F(AtomicFile, WritesAndReadsAnEmptyFile) {
  WriteFileAtomically(Path("empty"), "");
  EXPECT_EQ(ReadFile(Path("empty")), "");
}

TEST_F(AtomicFile, WritesAndReadsManyMegabytes) {
  std::string content;
  content.resize(10'000'001, 'x');
  content.back() = 'y';
  WriteFileAtomically(Path("large"), content);
  EXPECT_TRUE(ReadFile(Path("large")) == content);
}

TEST_F(AtomicFile, GivesNewFilesThePermissionsOfTheUmask) {
  const mode_t old_mask = umask(027);
  WriteFileAtomically(Path("new"), "x");
  umask(old_mask);
  EXPECT_EQ(Permissions(Path("new")), 0640U);
}

TEST_F(AtomicFile, ReplacesAFileAndKeepsItsPermissions) {
  WriteFileAtomically(Path("file"), "a long old content");
  ASSERT_EQ(chmod(Path("file").c_str(), 0604), 0);
  WriteFileAtomically(Path("file"), "new");
  EXPECT_EQ(ReadFile(Path("file")), "new");
  EXPECT_EQ(Permissions(Path("file")), 0604U);
  EXPECT_EQ(NumEntries(), 1);
}

TEST_F(AtomicFile, ReplacesALinkAndLeavesWhatItLeadsTo) {
  WriteFileAtomically(Path("file"), "old");
  fs::create_symlink("file", Path("link"));
  fs::create_symlink("nowhere", Path("dangling"));
  for (const char* name : {"link", "dangling"}) {
    WriteFileAtomically(Path(name), "new");
    EXPECT_FALSE(fs::is_symlink(Path(name)));
    EXPECT_EQ(ReadFile(Path(name)), "new");
  }
  EXPECT_EQ(ReadFile(Path("file")), "old");
  EXPECT_FALSE(fs::exists(Path("nowhere")));
}

TEST_F(AtomicFile, WritesThroughALinkToADeviceAndNotIntoAFolder) {
  fs::create_symlink("/dev/null", Path("link"));
  WriteFileAtomically(Path("link"), "new");
  EXPECT_TRUE(fs::is_symlink(Path("link")));
  fs::create_symlink(".", Path("folder"));
  EXPECT_THROW(WriteFileAtomically(Path("folder"), "new"), std::system_error);
  EXPECT_TRUE(fs::is_symlink(Path("folder")));
}

// Only root can lay a folder into another's hands.
TEST_F(AtomicFile, RefusesALinkInTheFolderOfAnotherUser) {
  constexpr uid_t kNobody = 65534;
  fs::create_directory(Path("theirs"));
  const std::string link = Path("theirs/link");
  fs::create_symlink("../file", link);
  if (chown(Path("theirs").c_str(), kNobody, kNobody) != 0) {
    GTEST_SKIP() << "not root";
  }
  WriteFileAtomically(Path("file"), "old");
  EXPECT_THAT([&] { WriteFileAtomically(link, "new"); },
              ::testing::ThrowsMessage<std::system_error>(::testing::HasSubstr(
                  "a link in the folder of another user")));
  EXPECT_EQ(ReadFile(Path("file")), "old");
  WriteFileAtomically(Path("theirs/other"), "new");
  EXPECT_THROW(RemoveLink(link), std::system_error);
  RemoveLink(link, true);
  EXPECT_FALSE(IsLink(link));
}

TEST_F(AtomicFile, LeavesReadersOfTheOldFileUndisturbed) {
  WriteFileAtomically(Path("file"), "old");
  fs::create_hard_link(Path("file"), Path("reader"));
  WriteFileAtomically(Path("file"), "new");
  EXPECT_EQ(ReadFile(Path("reader")), "old");
}

TEST_F(AtomicFile, WritesANameAsLongAsAllowed) {
  const std::string name(255, 'n');
  WriteFileAtomically(Path(name), "x");
  EXPECT_EQ(ReadFile(Path(name)), "x");
}

TEST_F(AtomicFile, WritesRelativeToTheWorkingFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  WriteFileAtomically("relative", "x");
  fs::current_path(before);
  EXPECT_EQ(ReadFile(Path("relative")), "x");
}

TEST_F(AtomicFile, LeavesNothingOfAKilledProcessWhenTheFileIsWrittenAgain) {
  const std::string content(1'000'000, 'x');
  // The limit on the size of files kills a process half-way.
  EXPECT_EXIT(
      {
        struct rlimit limit {};
        limit.rlim_cur = limit.rlim_max = 4096;
        setrlimit(RLIMIT_FSIZE, &limit);
        WriteFileAtomically(Path("file"), content);
      },
      ::testing::KilledBySignal(SIGXFSZ),
      "");
  EXPECT_FALSE(fs::exists(Path("file")));
  EXPECT_EQ(NumEntries(), 1);
  WriteFileAtomically(Path("file"), content);
  EXPECT_EQ(ReadFile(Path("file")), content);
  EXPECT_EQ(NumEntries(), 1);
}

TEST_F(AtomicFile, IsWrittenByManyAtATime) {
  const std::string content(10'000, 'x');
  std::vector<std::thread> writers;
  for (int i = 0; i < 8; ++i) {
    writers.emplace_back([&] {
      for (int j = 0; j < 25; ++j) {
        WriteFileAtomically(Path("file"), content);
        RemoveAbandonedFiles(folder_);
      }
    });
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(ReadFile(Path("file")), content);
  EXPECT_EQ(NumEntries(), 1);
}

TEST_F(AtomicFile, LeavesNothingHalfWhereAProcessEndsBesideItsThreads) {
  for (int round = 0; round < 20; ++round) {
    EXPECT_EXIT(
        {
          for (const char* name : {"one", "two"}) {
            std::thread([this, name] {
              for (;;) WriteFileAtomically(Path(name), "x");
            }).detach();
          }
          while (NumEntries() < 2) std::this_thread::yield();
          EndWriting();
          std::_Exit(0);
        },
        ::testing::ExitedWithCode(0),
        "");
    for (const auto& entry : fs::directory_iterator(folder_)) {
      EXPECT_THAT(entry.path().filename(), AnyOf("one", "two"));
      fs::remove(entry.path());
    }
  }
}

TEST_F(AtomicFile, RemovesWhatAKilledProcessHadBegunAndNothingElse) {
  const std::string abandoned = Path(".errmap-0123456789abcdef.tmp");
  const std::string written = Path(".errmap-fedcba9876543210.tmp");
  std::ofstream(abandoned) << "half";
  std::ofstream(written) << "half";
  std::ofstream(Path(".errmap-notes.tmp")) << "a user's";
  std::ofstream(Path("results.json")) << "whole";
  const int other = open(written.c_str(), O_RDONLY);
  ASSERT_EQ(flock(other, LOCK_EX | LOCK_NB), 0);
  RemoveAbandonedFiles(folder_);
  close(other);
  EXPECT_FALSE(fs::exists(abandoned));
  EXPECT_TRUE(fs::exists(written));
  EXPECT_TRUE(fs::exists(Path(".errmap-notes.tmp")));
  EXPECT_TRUE(fs::exists(Path("results.json")));
  RemoveAbandonedFiles(folder_);
  EXPECT_FALSE(fs::exists(written));
}

TEST_F(AtomicFile, HasNothingToRemoveFromAFolderThatIsMissing) {
  EXPECT_NO_THROW(RemoveAbandonedFiles(Path("missing")));
}

TEST_F(AtomicFile, NamesThePathWhereTheFolderIsMissing) {
  const std::string path = Path("absent/file");
  EXPECT_THAT([&] { WriteFileAtomically(path, "x"); },
              ThrowsMessage<std::system_error>(
                  AllOf(HasSubstr(path), HasSubstr("No such file"))));
}

TEST_F(AtomicFile, RefusesAFolderAndLeavesNothingBehind) {
  fs::create_directory(Path("folder"));
  EXPECT_THAT([&] { WriteFileAtomically(Path("folder"), "x"); },
              ThrowsMessage<std::system_error>(AllOf(
                  HasSubstr(Path("folder")), HasSubstr("Is a directory"))));
  EXPECT_EQ(NumEntries(), 1);
  EXPECT_TRUE(fs::is_empty(Path("folder")));
}

TEST_F(AtomicFile, RemovesTheTemporaryFileWhenWritingFails) {
  // The limit on the size of files makes write() fail half-way; in a child
  // process, since it cannot be raised again.
  WriteFileAtomically(Path("file"), "old");
  EXPECT_EXIT(
      {
        struct rlimit limit {};
        limit.rlim_cur = limit.rlim_max = 4096;
        setrlimit(RLIMIT_FSIZE, &limit);
        std::signal(SIGXFSZ, SIG_IGN);
        try {
          WriteFileAtomically(Path("file"), std::string(1'000'000, 'x'));
        } catch (const std::system_error&) {
          std::_Exit(7);
        }
        std::_Exit(0);
      },
      ::testing::ExitedWithCode(7),
      "");
  EXPECT_EQ(ReadFile(Path("file")), "old");
  EXPECT_EQ(NumEntries(), 1);
}

TEST_F(AtomicFile, WritesToADeviceDirectly) {
  WriteFileAtomically("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFile, WritesToAPipeDirectly) {
  ASSERT_EQ(mkfifo(Path("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] {
    std::ifstream stream(Path("pipe"));
    std::getline(stream, received, '\0');
  });
  WriteFileAtomically(Path("pipe"), "through the pipe");
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(Path("pipe")));
}

TEST_F(AtomicFile, ReadsNoMoreThanItMay) {
  WriteFileAtomically(Path("file"), "12345");
  EXPECT_EQ(ReadFile(Path("file"), 5), "12345");
  EXPECT_THAT([&] { ReadFile(Path("file"), 4); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr("file"), HasSubstr("is longer than"))));
}

TEST_F(AtomicFile, ReadsNoPipeAndNoDevice) {
  ASSERT_EQ(mkfifo(Path("pipe").c_str(), 0600), 0);
  EXPECT_THAT([&] { ReadFile(Path("pipe")); },
              ThrowsMessage<InputError>(HasSubstr("is a named pipe")));
  EXPECT_THAT([] { ReadFile("/dev/zero"); },
              ThrowsMessage<InputError>(HasSubstr("/dev/zero: is a device")));
  EXPECT_EQ(ReadFile("/dev/null"), "");
}

TEST_F(AtomicFile, AddsToARedirectedStandardOutput) {
  // As in `errmap predict -o /dev/stdout > file`: what stands in the file
  // stays, and the file is not replaced.
  WriteFileAtomically(Path("file"), "before\n");
  EXPECT_EXIT(
      {
        if (freopen(Path("file").c_str(), "a", stdout) == nullptr) {
          std::_Exit(1);
        }
        WriteFileAtomically("/dev/stdout", "after\n");
        std::_Exit(0);
      },
      ::testing::ExitedWithCode(0),
      "");
  EXPECT_EQ(ReadFile(Path("file")), "before\nafter\n");
}

TEST_F(AtomicFile, ReadFileTellsWhyAFileCannotBeRead) {
  EXPECT_THAT(
      [&] { ReadFile(Path("absent.csv")); },
      ThrowsMessage<InputError>(Path("absent.csv") +
                                ": cannot be read: No such file or directory; "
                                "check the path and its permissions"));
  EXPECT_THAT([&] { ReadFile(folder_); },
              ThrowsMessage<InputError>(
                  AllOf(HasSubstr(folder_), HasSubstr("Is a directory"))));
}

TEST_F(AtomicFile, ReadFileRefusesAnUnreadableFile) {
  if (geteuid() == 0) GTEST_SKIP() << "root reads everything";
  WriteFileAtomically(Path("secret"), "x");
  ASSERT_EQ(chmod(Path("secret").c_str(), 0), 0);
  EXPECT_THAT([&] { ReadFile(Path("secret")); },
              ThrowsMessage<InputError>(HasSubstr("Permission denied")));
}

TEST_F(AtomicFile, ReadFileReadsFilesThatTellNoSize) {
  EXPECT_THAT(ReadFile("/proc/self/status"), HasSubstr("Pid:"));
}

TEST_F(AtomicFile, KeepsMessagesOnOneLineWhateverThePath) {
  EXPECT_THAT([&] { ReadFile("two\nlines"); },
              ThrowsMessage<InputError>(HasSubstr("two\\nlines")));
}

}  // namespace
}  // namespace errmap::data
