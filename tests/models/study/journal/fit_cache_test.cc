#include "models/study/journal/fit_cache.h"

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/model_test_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

namespace fs = std::filesystem;
using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using errmap::testing::QuadraticData;

constexpr std::int64_t kRoomy = 1 << 20;

// The study of a mean on the first rows, as a program of this name knows it.
struct KnownStudy {
  explicit KnownStudy(Eigen::Index rows,
                      const std::string& program = "errmap 1")
      : dataset(QuadraticData(rows)),
        holdouts(MakeHoldouts(dataset, {"every:3"})),
        labels("x", dataset, holdouts, MakeRecipes({"mean"}), {}, program) {}

  data::Dataset dataset;
  std::vector<Holdout> holdouts;
  FitLabels labels;
};

class FitCache : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern =
        (fs::temp_directory_path() / "fit_cache_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    scratch_ = pattern;
    folder_ = scratch_ / "deep" / "errmap";
  }
  void TearDown() override { fs::remove_all(scratch_); }

  // Keeps a number of fits, with as many predictions each.
  void Keep(const KnownStudy& study,
            int fits,
            Eigen::Index predictions,
            std::int64_t most_bytes = kRoomy) const {
    const auto file = OpenKeptFits(folder_, study.labels, most_bytes);
    ASSERT_NE(file, nullptr);
    FitOutcome outcome;
    outcome.fitted = MakeRecipes({"mean"}).front()->Fit(study.dataset, {});
    outcome.test_predictions = Eigen::VectorXd::Zero(predictions);
    for (int i = 0; i < fits; ++i) {
      FitLabel label = study.labels.All().front();
      label.model = "model " + std::to_string(i);
      file->Record(label, outcome);
    }
  }

  std::size_t NumKept(const KnownStudy& study,
                      std::int64_t most_bytes = kRoomy) const {
    const auto file = OpenKeptFits(folder_, study.labels, most_bytes);
    return file == nullptr ? 0 : file->num_found();
  }

  fs::path JournalOf(const KnownStudy& study) const {
    return folder_ / study.labels.DataKey() / JournalFile::kName;
  }

  fs::path scratch_;
  fs::path folder_;
};

TEST_F(FitCache, GivesFitsBackToTheSameRowsAndProgramAlone) {
  Keep(KnownStudy(40), 3, 5);
  EXPECT_EQ(NumKept(KnownStudy(40)), 3U);
  EXPECT_EQ(NumKept(KnownStudy(41)), 0U);
  EXPECT_EQ(NumKept(KnownStudy(40, "errmap 2")), 0U);
}

TEST_F(FitCache, IsNobodyElsesBusiness) {
  Keep(KnownStudy(40), 1, 5);
  const fs::path own = JournalOf(KnownStudy(40)).parent_path();
  for (const fs::path& path : {folder_, own}) {
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_all) << path;
  }
}

TEST_F(FitCache, LeavesOutFitsThatFailed) {
  const KnownStudy study(40);
  {
    const auto file = OpenKeptFits(folder_, study.labels, kRoomy);
    ASSERT_NE(file, nullptr);
    FitOutcome failed;
    failed.why_failed = "for a reason that may be mended";
    file->Record(study.labels.All().front(), failed);
  }
  EXPECT_EQ(NumKept(study), 0U);
}

TEST_F(FitCache, LetsThoseGoThatWereUsedLongestAgo) {
  constexpr std::int64_t kMost = 100'000;
  constexpr Eigen::Index kPredictions = 1'500;  // 16 kB as text
  for (Eigen::Index rows = 40; rows < 50; ++rows) {
    Keep(KnownStudy(rows), 1, kPredictions, kMost);
    const auto then =
        fs::file_time_type::clock::now() - std::chrono::hours(60 - rows);
    fs::last_write_time(JournalOf(KnownStudy(rows)), then);
  }
  EXPECT_EQ(NumKept(KnownStudy(49), kMost), 1U);
  EXPECT_EQ(NumKept(KnownStudy(40), kMost), 0U);
  std::int64_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    if (entry.is_regular_file())
      bytes += static_cast<std::int64_t>(entry.file_size());
  }
  EXPECT_LE(bytes, kMost);
  EXPECT_GT(bytes, kMost / 2);
}

TEST_F(FitCache, KeepsWhatIsInUseHoweverOld) {
  constexpr std::int64_t kMost = 100'000;
  Keep(KnownStudy(40), 1, 1'500, kMost);
  fs::last_write_time(JournalOf(KnownStudy(40)), fs::file_time_type());
  const KnownStudy first(40);
  EXPECT_EQ(NumKept(first, kMost), 1U);
  for (Eigen::Index rows = 41; rows < 43; ++rows) {
    Keep(KnownStudy(rows), 1, 1'500, kMost);
  }
  EXPECT_EQ(NumKept(first, kMost), 1U);
}

TEST_F(FitCache, OneStudyHasNoMoreThanItsShare) {
  constexpr std::int64_t kMost = 100'000;
  Keep(KnownStudy(40), 20, 500, kMost);
  const auto size =
      static_cast<std::int64_t>(fs::file_size(JournalOf(KnownStudy(40))));
  EXPECT_LE(size, kMost / 4);
  EXPECT_GT(size, kMost / 8);
  // With a smaller bound it begins anew.
  EXPECT_EQ(NumKept(KnownStudy(40), kMost / 8), 0U);
}

TEST_F(FitCache, TakesNothingFromAnotherProcess) {
  const KnownStudy study(40);
  const auto first = OpenKeptFits(folder_, study.labels, kRoomy);
  EXPECT_NE(first, nullptr);
  EXPECT_EQ(OpenKeptFits(folder_, study.labels, kRoomy), nullptr);
}

TEST_F(FitCache, IsDoneWithoutWhereItCannotBe) {
  const KnownStudy study(40);
  EXPECT_EQ(OpenKeptFits("", study.labels, kRoomy), nullptr);
  EXPECT_EQ(OpenKeptFits("/dev/null/errmap", study.labels, kRoomy), nullptr);
  fs::create_directories(JournalOf(study));  // no file, but a folder
  EXPECT_EQ(OpenKeptFits(folder_, study.labels, kRoomy), nullptr);
}

TEST_F(FitCache, PassesOverWhatIsDamaged) {
  const KnownStudy study(40);
  Keep(study, 3, 5);
  std::fstream file(JournalOf(study),
                    std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(200);
  file.put('#');
  file.close();
  EXPECT_EQ(NumKept(study), 2U);
  std::ofstream(JournalOf(study), std::ios::binary) << "something else\nat all";
  EXPECT_EQ(NumKept(study), 0U);
  Keep(study, 1, 5);
  EXPECT_EQ(NumKept(study), 1U);
}

TEST_F(FitCache, LeavesAloneWhatIsNotItsOwn) {
  fs::create_directories(folder_ / "notes");
  std::ofstream(folder_ / "notes" / JournalFile::kName)
      << std::string(5'000, 'x');
  Keep(KnownStudy(40), 1, 5, 4'000);
  EXPECT_EQ(NumKept(KnownStudy(41), 4'000), 0U);
  EXPECT_TRUE(fs::exists(folder_ / "notes" / JournalFile::kName));
}

TEST(DefaultCacheFolder, FollowsTheVariables) {
  const auto set = [](const char* cache, const char* home) {
    setenv("XDG_CACHE_HOME", cache, 1);
    setenv("HOME", home, 1);
  };
  const std::string home =
      std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
  set("/var/cache/me", "/home/me");
  EXPECT_EQ(DefaultCacheFolder(), "/var/cache/me/errmap");
  set("", "/home/me");
  EXPECT_EQ(DefaultCacheFolder(), "/home/me/.cache/errmap");
  set("below/the/present", "/home/me");
  EXPECT_EQ(DefaultCacheFolder(), "/home/me/.cache/errmap");
  set("", "");
  EXPECT_EQ(DefaultCacheFolder(), "");
  set("/dev/null", home.c_str());
}

}  // namespace
}  // namespace errmap::models
