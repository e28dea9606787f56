// A study that is killed and started again with --resume.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <sys/resource.h>

#include "tests/cli/cli_fixture.h"
#include "tests/cli/kept_fits_count.h"

namespace errmap {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kKilled = 128 + SIGKILL;

class Resume : public Cli {
 protected:
  static std::vector<std::string> Command(
      const std::string& folder, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {
        "compare",
        kDown,
        "--models",
        "mean,poly:eq8,poly:full:degree=4,poly:stepwise,"
        "net:scg:hidden=10:iterations=300,net:lm:hidden=4:iterations=60,"
        "poly:formula=no_such_mm",  // fails
        "--jobs",
        "2",
        "--out",
        folder};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  // Fits that were finished and kept.
  std::ptrdiff_t CountKept(const std::string& folder) const {
    return NumRowsOf(scratch_ / folder / "fits.sqlite");
  }

  // Until so many are kept, but for ten seconds at most.
  void WaitForFits(const std::string& folder, std::ptrdiff_t wanted) const {
    constexpr int kMostTries = 10'000;
    for (int i = 0; i < kMostTries; ++i) {
      if (CountKept(folder) >= std::min(wanted, kFits)) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  static constexpr std::ptrdiff_t kFits =
      10 * 7;  // of Command(), three baselines added

  std::set<std::string> FilesOf(const std::string& folder) const {
    std::set<std::string> names;
    const fs::path root = scratch_ / folder;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      if (entry.is_regular_file()) {
        names.insert(fs::relative(entry.path(), root).string());
      }
    }
    return names;
  }

  // Of errmap-files.json: the hashes are those of measured times too.
  static std::string NamesIn(const std::string& list) {
    std::string names;
    for (const Json& file : Json::parse(list)["files"]) {
      names += file["name"].get<std::string>() + "\n";
      EXPECT_TRUE(file["sha256"].is_string()) << file.dump();
    }
    return names;
  }

  // Every file of both folders but the kept fits, times apart.
  void ExpectSameOutputs(const std::string& a, const std::string& b) const {
    const std::set<std::string> files = FilesOf(a);
    ASSERT_EQ(files, FilesOf(b));
    // Nine maps, two tables, two reports, the list of these, the fits.
    EXPECT_EQ(files.size(), 15U);
    for (const std::string& file : files) {
      if (file == "fits.sqlite") continue;
      // Drawn from results.json, measured times and all.
      if (file.starts_with("report.")) continue;
      std::string text_a = Read(a + "/" + file);
      std::string text_b = Read(b + "/" + file);
      if (file == "errmap-files.json") {
        text_a = NamesIn(text_a);
        text_b = NamesIn(text_b);
      }
      if (file == "results.json") {
        Json document_a = Json::parse(text_a);
        Json document_b = Json::parse(text_b);
        DropTimes(&document_a);
        DropTimes(&document_b);
        text_a = document_a.dump();
        text_b = document_b.dump();
      }
      EXPECT_EQ(text_a, text_b) << file;
    }
  }
};

TEST_F(Resume, EndsInTheSameResultsAfterFiftyKillsAtRandomMoments) {
  constexpr int kKills = 50;
  constexpr int kMostRuns = 2000;
  const auto begin = Clock::now();
  ASSERT_EQ(Run(Command("whole")).status, 0);
  const double seconds =
      std::chrono::duration<double>(Clock::now() - begin).count();
  // Up to the length of an unbroken run, or after some more fits, since a busy
  // machine starts at leisure: several kills per study, some of them in the
  // start, some in the fits and some in the writing of the results.
  std::mt19937_64 random(1995);
  std::uniform_real_distribution<double> moment(0.0, seconds);
  std::uniform_int_distribution<std::ptrdiff_t> more_fits(1, kFits / 4);
  int kills = 0;
  int kills_in_fits = 0;
  int kills_in_writing = 0;
  int studies = 0;
  for (int run = 0; kills < kKills; ++studies) {
    const std::string folder = "broken" + std::to_string(studies);
    std::vector<std::string> words = Command(folder);
    for (int status = kKilled; status == kKilled;) {
      ASSERT_LT(++run, kMostRuns);
      Process process(scratch_.path(), words);
      if (run % 2 == 0 || CountKept(folder) == kFits) {
        std::this_thread::sleep_for(
            std::chrono::duration<double>(moment(random)));
      } else {
        WaitForFits(folder, CountKept(folder) + more_fits(random));
      }
      process.Kill();
      const Outcome outcome = process.Wait();
      status = outcome.status;
      if (status == kKilled) {
        ++kills;
        const std::ptrdiff_t kept = CountKept(folder);
        if (kept > 0 && kept < kFits) ++kills_in_fits;
        if (kept == kFits) ++kills_in_writing;
      } else {
        ASSERT_EQ(status, 0) << outcome.err;
      }
      words = Command(folder, {"--resume"});
    }
    ExpectSameOutputs("whole", folder);
  }
  EXPECT_GT(kills_in_fits, 0);
  RecordProperty("kills", kills);
  RecordProperty("kills_in_fits", kills_in_fits);
  RecordProperty("kills_in_writing", kills_in_writing);
  RecordProperty("studies", studies);
}

TEST_F(Resume, RepeatsNoFitOfAFinishedStudy) {
  ASSERT_EQ(Run(Command("study")).status, 0);
  EXPECT_EQ(CountKept("study"), kFits);
  const Outcome again = Run(Command("study", {"--resume"}));
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, HasSubstr("70 of 70 fits are at hand, 0 to be made"));
  EXPECT_EQ(CountKept("study"), kFits);
}

TEST_F(Resume, GoesOnAfterCtrlC) {
  ASSERT_EQ(Run(Command("whole")).status, 0);
  Process process(scratch_.path(), Command("study"));
  ASSERT_TRUE(process.WaitUntilInterruptible());
  process.Interrupt();
  process.Wait();  // interrupted, or done before it
  EXPECT_EQ(Run(Command("study", {"--resume"})).status, 0);
  ExpectSameOutputs("whole", "study");
}

TEST_F(Resume, SaysWhatAnotherSeedMakesAnew) {
  ASSERT_EQ(Run(Command("study")).status, 0);
  const Outcome other = Run(Command("study", {"--resume", "--seed", "2"}));
  EXPECT_EQ(other.status, 0);
  EXPECT_THAT(other.err, HasSubstr("0 of 70 fits are at hand, 70 to be made"));
  const Outcome both =
      Run({"compare", kDown, "--models", "mean", "--out", "study", "--resume"});
  EXPECT_THAT(both.err, HasSubstr("28 of 28 fits are at hand"));
}

TEST_F(Resume, MakesEveryFitAnewWithoutTheFlag) {
  ASSERT_EQ(Run(Command("study")).status, 0);
  ASSERT_EQ(
      Run({"compare", kDown, "--models", "mean", "--out", "study"}).status, 0);
  EXPECT_LT(CountKept("study"), kFits);
}

TEST_F(Resume, NeedsAFolder) {
  const std::string message =
      RefusalOf(Run({"compare", kDown, "--resume"}), kWrongCommandLine);
  EXPECT_THAT(message, HasSubstr("--out DIR"));
}

TEST_F(Resume, RefusesAFolderThatAnotherRunIsUsing) {
  Process first(scratch_.path(),
                {"compare", kDown, "--model", kEndlessNet, "--out", "study"});
  ASSERT_TRUE(first.WaitUntilInterruptible());
  for (int poll = 0; poll < 3000 && !Exists("study/fits.sqlite"); ++poll) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const std::string message =
      RefusalOf(Run(Command("study", {"--quiet"})), kFailure);
  EXPECT_THAT(message, HasSubstr("another errmap is using this folder"));
}

// Limits the length of files that the program may write, as a full disk would.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  FileLimit(const FileLimit&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;

 private:
  rlimit before_{};
};

TEST_F(Resume, LeavesAGoodReportAloneWhenTheDiskIsFull) {
  ASSERT_EQ(Run(Command("study")).status, 0);
  const std::string results = Read("study/results.json");
  const std::string residuals = Read("study/residuals.csv");
  const std::vector<std::string> other =
      Command("study", {"--seed", "2", "--quiet"});
  {
    constexpr rlim_t kBytes = 60'000;
    const FileLimit limit(kBytes);
    const Outcome full = Run(other);
    EXPECT_EQ(full.status, kFailure);
    EXPECT_THAT(full.out,
                HasSubstr("poly:stepwise"));  // the answer is not lost
    EXPECT_THAT(full.err, HasSubstr("cannot write study/results.json"));
    EXPECT_EQ(SplitLines(full.err).size(), 1U) << full.err;
  }
  EXPECT_EQ(Read("study/results.json"), results);
  EXPECT_EQ(Read("study/residuals.csv"), residuals);
  // With room again the fits that were kept are not repeated.
  std::vector<std::string> resumed = Command("study", {"--seed", "2"});
  resumed.push_back("--resume");
  const Outcome outcome = Run(resumed);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(" of 70 fits are at hand"));
  EXPECT_THAT(outcome.err, Not(HasSubstr(": 0 of 70")));
  ASSERT_EQ(Run(Command("whole", {"--seed", "2"})).status, 0);
  ExpectSameOutputs("whole", "study");
}

TEST_F(Resume, SaysWhatItCouldNotKeep) {
  constexpr rlim_t kBytes = 20'000;
  const FileLimit limit(kBytes);
  const Outcome outcome = Run(Command("study"));
  EXPECT_EQ(outcome.status, kFailure);
  EXPECT_THAT(outcome.err,
              HasSubstr("cannot keep fits in study/fits.sqlite: "));
}

}  // namespace
}  // namespace errmap
