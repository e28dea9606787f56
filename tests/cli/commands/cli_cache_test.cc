// Fits that are kept in the user's cache.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/kept_fits_count.h"

namespace errmap {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Cache : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    UseCache(scratch_ / "cache");
  }
  void TearDown() override {
    UseCache("/dev/null");
    Cli::TearDown();
  }

  static void UseCache(const std::string& folder) {
    setenv("XDG_CACHE_HOME", folder.c_str(), 1);
  }

  static std::vector<std::string> Command(
      const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"compare",
                                      kDown,
                                      "--models",
                                      "poly:eq8,poly:ridge,"
                                      "net:scg:hidden=4:iterations=60",
                                      "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  std::string Answer(const std::vector<std::string>& more = {}) const {
    const Outcome outcome = Run(Command(more));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
  }

  fs::path Kept() const { return scratch_ / "cache/errmap/fits.sqlite"; }
  std::ptrdiff_t NumKept() const { return NumRowsOf(Kept()); }
};

TEST_F(Cache, AnswersOtherQuestionsFromTheSameFits) {
  Answer();
  const std::ptrdiff_t kept = NumKept();
  EXPECT_GT(kept, 20);
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--goal", "1um"},
        {"--details"},
        {"--all"},
        {"--choose", "best"}}) {
    const std::string from_cache = Answer(more);
    EXPECT_EQ(NumKept(), kept) << more.front();
    std::vector<std::string> anew = more;
    anew.emplace_back("--no-cache");
    if (more.front() == "--details") continue;  // measured times
    EXPECT_EQ(Answer(anew), from_cache) << more.front();
  }
}

TEST_F(Cache, FilesAreTheSameWithAndWithout) {
  Answer();
  Answer({"--out", "kept"});
  Answer({"--out", "anew", "--no-cache"});
  for (const char* file : {"residuals.csv", "models/blend.json"}) {
    if (!Exists(std::string("kept/") + file)) continue;
    EXPECT_EQ(Read(std::string("kept/") + file),
              Read(std::string("anew/") + file));
  }
  Json kept = Json::parse(Read("kept/results.json"));
  Json anew = Json::parse(Read("anew/results.json"));
  DropTimes(&kept);
  DropTimes(&anew);
  EXPECT_EQ(kept.dump(), anew.dump());
  // The folder is complete by itself.
  UseCache("/dev/null");
  const Outcome again = Run({"compare",
                             kDown,
                             "--models",
                             "poly:eq8,poly:ridge,"
                             "net:scg:hidden=4:iterations=60",
                             "--out",
                             "kept",
                             "--resume"});
  EXPECT_THAT(again.err, HasSubstr(" fits are at hand, 0 to be made"));
}

TEST_F(Cache, WritesNothingWhereItIsNotWanted) {
  Answer({"--no-cache"});
  EXPECT_FALSE(fs::exists(scratch_ / "cache"));
}

TEST_F(Cache, OtherSeedsAndValuesAreOtherFits) {
  Answer();
  const std::string other = Answer({"--seed", "2"});
  EXPECT_EQ(other, Answer({"--seed", "2", "--no-cache"}));
  const std::ptrdiff_t kept = NumKept();
  std::string text = Read(kDown);
  text.insert(text.rfind('.') + 1, "1");  // of the last error
  Write("other.csv", text);
  const Outcome of_other =
      Run({"compare", "other.csv", "--models", "poly:eq8"});
  EXPECT_EQ(of_other.status, 0) << of_other.err;
  EXPECT_GT(NumKept(), kept);
}

TEST_F(Cache, WhatAnInterruptedRunFittedIsThereForTheNext) {
  Process process(scratch_.path(),
                  {"compare", kDown, "--models", "poly:eq8," + kEndlessNet});
  ASSERT_TRUE(process.WaitUntilInterruptible());
  const fs::path folder = scratch_ / "cache/errmap";
  for (int poll = 0; poll < 3000; ++poll) {
    if (fs::exists(folder) && NumKept() > 5) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  process.Kill();
  process.Wait();
  EXPECT_GT(NumKept(), 5);
  const Outcome next =
      Run({"compare", kDown, "--models", "poly:eq8", "--quiet"});
  EXPECT_EQ(next.status, 0) << next.err;
}

TEST_F(Cache, TwoAtOnceGiveTheSameAnswer) {
  const std::string alone = Answer({"--no-cache"});
  fs::create_directories(scratch_ / "other");
  Process first(scratch_.path(), Command());
  Process second((scratch_ / "other").string(), Command());
  const Outcome of_first = first.Wait();
  const Outcome of_second = second.Wait();
  EXPECT_EQ(of_first.out, alone);
  EXPECT_EQ(of_second.out, alone);
  EXPECT_EQ(of_first.err + of_second.err, "");
  EXPECT_EQ(Answer(), alone);
}

TEST_F(Cache, IsOfNoConsequenceWhereItIsDamagedOrCannotBe) {
  const std::string answer = Answer();
  {
    std::fstream file(Kept(), std::ios::in | std::ios::out | std::ios::binary);
    for (const int at : {100, 5'000, 40'000}) {
      file.seekp(at);
      file.put('#');
    }
  }
  EXPECT_EQ(Answer(), answer);
  fs::resize_file(Kept(), 12'345);
  EXPECT_EQ(Answer(), answer);
  EXPECT_EQ(Answer(), answer);
  for (const char* folder : {"/dev/null", "/proc/self", "relative"}) {
    UseCache(folder);
    EXPECT_EQ(Answer(), answer) << folder;
  }
}

TEST_F(Cache, AFullDiskCostsNothingButTheCache) {
  const std::string answer = Answer({"--no-cache"});
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  constexpr rlim_t kBytes = 20'000;
  const rlimit limit{kBytes, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  const Outcome full = Run(Command());
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(full.status, 0) << full.err;
  EXPECT_EQ(full.err, "");
  EXPECT_EQ(full.out, answer);
  EXPECT_EQ(Answer(), answer);
}

TEST_F(Cache, LearningIsKeptToo) {
  const std::vector<std::string> words = {
      "learn", kDown, "--by", "cycles", "--models", "poly:eq8", "--quiet"};
  const Outcome first = Run(words);
  EXPECT_EQ(first.status, 0) << first.err;
  const std::ptrdiff_t kept = NumKept();
  EXPECT_GT(kept, 3);
  EXPECT_EQ(Run(words).out, first.out);
  EXPECT_EQ(NumKept(), kept);
}

}  // namespace
}  // namespace errmap
