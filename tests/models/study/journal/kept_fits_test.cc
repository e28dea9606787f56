#include "models/study/journal/kept_fits.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <random>
#include <sqlite3.h>
#include <string>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "models/study/journal/fit_record.h"
#include "tests/models/model_test_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

namespace fs = std::filesystem;
using errmap::testing::CountingRecipe;
using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using errmap::testing::QuadraticData;
using errmap::testing::Recipes;
using errmap::testing::ShippedMeasurements;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;
using Opening = KeptFits::Opening;

std::string KeyOfFit(std::size_t i) { return "fit " + std::to_string(i); }

FitOutcome OutcomeOf(double value, Eigen::Index size = 3) {
  FitOutcome outcome;
  outcome.seconds = value;
  outcome.test_predictions = Eigen::VectorXd::Constant(size, value);
  return outcome;
}

// Of a fit that can be predicted with, as a cache keeps them alone.
FitOutcome FittedOutcome(Eigen::Index size) {
  FitOutcome outcome = OutcomeOf(1.0, size);
  outcome.fitted = MakeRecipes({"mean"}).front()->Fit(QuadraticData(40), {});
  return outcome;
}

// An empty folder of its own for each test.
class KeptFitsFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern =
        (fs::temp_directory_path() / "kept_fits_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }

  void TearDown() override { fs::remove_all(folder_); }

  std::string Path() const { return folder_ / KeptFits::kName; }

  // `count` fits; fit i has the value i + 1.
  void WriteFits(std::size_t count) const {
    KeptFits fits(folder_, Opening::kAnew);
    for (std::size_t i = 0; i < count; ++i) {
      fits.Record(KeyOfFit(i), OutcomeOf(static_cast<double>(i) + 1.0));
    }
  }

  static double ValueOf(KeptFits* fits, std::size_t i) {
    const std::optional<FitOutcome> outcome = fits->Find(KeyOfFit(i));
    return outcome ? outcome->test_predictions[2] : 0.0;
  }

  fs::path folder_;
};

TEST_F(KeptFitsFile, GivesBackWhatItWasGiven) {
  WriteFits(3);
  KeptFits fits(folder_, Opening::kResume);
  EXPECT_EQ(ValueOf(&fits, 0), 1.0);
  EXPECT_EQ(ValueOf(&fits, 2), 3.0);
  EXPECT_TRUE(fits.Has(KeyOfFit(2)));
  EXPECT_FALSE(fits.Has(KeyOfFit(3)));
  EXPECT_FALSE(fits.Find(KeyOfFit(3)).has_value());
  EXPECT_THAT(fits.Remarks(), IsEmpty());
}

TEST_F(KeptFitsFile, GoesOnWithWhatThereIsOrBeginsAnew) {
  WriteFits(1);
  KeptFits(folder_, Opening::kResume).Record(KeyOfFit(1), OutcomeOf(2.0));
  {
    KeptFits fits(folder_, Opening::kResume);
    EXPECT_EQ(ValueOf(&fits, 0), 1.0);
    EXPECT_EQ(ValueOf(&fits, 1), 2.0);
  }
  KeptFits fits(folder_, Opening::kAnew);
  EXPECT_FALSE(fits.Has(KeyOfFit(0)));
}

TEST_F(KeptFitsFile, RefusesADamagedRecordAndLosesNoOther) {
  WriteFits(3);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(Path().c_str(), &database), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(database,
                         "UPDATE fit SET outcome = CAST(substr(outcome, 1, 60) "
                         "|| x'5a' || substr(outcome, 62) AS BLOB) WHERE key "
                         "= 'fit 1'",
                         nullptr,
                         nullptr,
                         nullptr),
            SQLITE_OK);
  sqlite3_close(database);
  KeptFits fits(folder_, Opening::kResume);
  EXPECT_EQ(ValueOf(&fits, 0), 1.0);
  EXPECT_EQ(ValueOf(&fits, 1), 0.0);
  EXPECT_EQ(ValueOf(&fits, 2), 3.0);
  EXPECT_THAT(fits.Remarks(),
              ElementsAre(HasSubstr("1 fit whose records are not of them")));
}

TEST_F(KeptFitsFile, OfADatabaseThatIsNoneNothingIsLostButTime) {
  WriteFits(3);
  fs::resize_file(Path(), 700);
  {
    KeptFits fits(folder_, Opening::kResume);
    fits.Record(KeyOfFit(0), OutcomeOf(4.0));
  }
  KeptFits fits(folder_, Opening::kResume);
  EXPECT_EQ(ValueOf(&fits, 0), 4.0);
}

TEST_F(KeptFitsFile, LeavesAnotherProgramsFileAlone) {
  for (const std::string& text :
       {std::string("one\n"), "SQLite format 3" + std::string(100, '\0')}) {
    std::ofstream(Path(), std::ios::binary) << text;
    EXPECT_THAT([&] { KeptFits::RequireNoOther(folder_, false); },
                ThrowsMessage<data::InputError>(
                    HasSubstr("fits.sqlite: holds no fits of errmap")));
    EXPECT_NO_THROW(KeptFits::RequireNoOther(folder_, true));
  }
  std::ofstream(Path(), std::ios::binary) << "";
  EXPECT_NO_THROW(KeptFits::RequireNoOther(folder_, false));
  WriteFits(1);
  EXPECT_NO_THROW(KeptFits::RequireNoOther(folder_, false));
}

TEST_F(KeptFitsFile, RefusesASecondProcess) {
  const KeptFits fits(folder_, Opening::kAnew);
  for (const Opening opening : {Opening::kAnew, Opening::kResume}) {
    EXPECT_THAT([&] { KeptFits(folder_, opening); },
                ThrowsMessage<std::runtime_error>(
                    HasSubstr("fits.sqlite: another errmap is using")));
  }
}

TEST_F(KeptFitsFile, IsFreeAgainWhenItsProcessIsKilled) {
  const pid_t child = fork();
  if (child == 0) {
    KeptFits fits(folder_, Opening::kAnew);
    fits.Record(KeyOfFit(0), OutcomeOf(1.0));
    raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
  KeptFits fits(folder_, Opening::kResume);
  EXPECT_EQ(ValueOf(&fits, 0), 1.0);
}

// As fcntl answers on a network file system without a lock server.
int NoLocks(int file, int command, void* argument) {
  if (command == F_SETLK || command == F_GETLK) {
    errno = ENOLCK;
    return -1;
  }
  return fcntl(file, command, argument);
}

TEST_F(KeptFitsFile, WithoutLocksItKeepsNothingAndSaysSo) {
  sqlite3_vfs* const system = sqlite3_vfs_find(nullptr);
  system->xSetSystemCall(
      system, "fcntl", reinterpret_cast<sqlite3_syscall_ptr>(NoLocks));
  {
    KeptFits fits(folder_, Opening::kAnew);
    fits.Record(KeyOfFit(0), OutcomeOf(1.0));
    EXPECT_FALSE(fits.Find(KeyOfFit(0)).has_value());
    EXPECT_THAT(fits.Remarks(),
                ElementsAre(AllOf(HasSubstr("knows no locks"),
                                  HasSubstr("1 fit not kept"))));
  }
  system->xSetSystemCall(system, "fcntl", nullptr);
}

TEST_F(KeptFitsFile, NamesAFolderThatCannotBeWritten) {
  EXPECT_THAT(
      [&] { KeptFits(folder_ / "missing", Opening::kResume); },
      ThrowsMessage<std::system_error>(HasSubstr(
          "cannot write " + (folder_ / "missing" / KeptFits::kName).string())));
}

TEST_F(KeptFitsFile, KeepsWhatWentInWhereTheDiskIsFull) {
  const pid_t child = fork();
  if (child == 0) {
    constexpr rlim_t kLimit = 60'000;
    const rlimit limit{kLimit, kLimit};
    std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    KeptFits fits(folder_, Opening::kAnew);
    constexpr Eigen::Index kLarge = 20'000;
    fits.Record(KeyOfFit(0), OutcomeOf(1.0));
    fits.Record(KeyOfFit(1), OutcomeOf(2.0, kLarge));
    fits.Record(KeyOfFit(2), OutcomeOf(3.0));
    const auto remarks = fits.Remarks();
    _exit(remarks.size() == 1 &&
                  remarks[0].find("1 fit not kept") != std::string::npos
              ? 0
              : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  KeptFits fits(folder_, Opening::kResume);
  EXPECT_EQ(ValueOf(&fits, 0), 1.0);
  EXPECT_EQ(ValueOf(&fits, 1), 0.0);
  EXPECT_EQ(ValueOf(&fits, 2), 3.0);
}

TEST_F(KeptFitsFile, LeavesOutRecordsThatAreTooLong) {
  KeptFits fits(folder_, Opening::kAnew);
  constexpr Eigen::Index kTooMany = 8'500'000;
  fits.Record(KeyOfFit(0), OutcomeOf(1.0, kTooMany));
  fits.Record(KeyOfFit(1), OutcomeOf(2.0));
  EXPECT_THAT(fits.Remarks(), ElementsAre(HasSubstr("1 fit not kept")));
  EXPECT_FALSE(fits.Has(KeyOfFit(0)));
  EXPECT_TRUE(fits.Has(KeyOfFit(1)));
}

// ---- The cache

TEST_F(KeptFitsFile, ACacheIsNobodyElsesBusinessAndSharedByProcesses) {
  const fs::path folder = folder_ / "deep" / "errmap";
  const auto first = KeptFits::OpenCache(folder);
  const auto second = KeptFits::OpenCache(folder);
  ASSERT_NE(first, nullptr);
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(fs::status(folder).permissions(), fs::perms::owner_all);
  first->Record("a", FittedOutcome(3));
  EXPECT_TRUE(second->Find("a").has_value());
  FitOutcome failed;
  failed.why_failed = "for a reason that may be mended";
  first->Record("b", failed);
  EXPECT_FALSE(first->Has("b"));
}

TEST_F(KeptFitsFile, ACacheLetsThoseGoThatWereUsedLongestAgo) {
  constexpr std::int64_t kMost = 400'000;
  constexpr Eigen::Index kPredictions = 10'000;  // 80 kB
  const auto keep = [&](std::size_t i) {
    KeptFits::OpenCache(folder_, kMost)
        ->Record(KeyOfFit(i), FittedOutcome(kPredictions));
    usleep(2000);  // the next is later
  };
  for (std::size_t i = 0; i < 4; ++i) keep(i);
  // Used again, it stays.
  EXPECT_TRUE(KeptFits::OpenCache(folder_, kMost)->Find(KeyOfFit(0)));
  usleep(2000);
  for (std::size_t i = 4; i < 7; ++i) keep(i);
  const auto cache = KeptFits::OpenCache(folder_, kMost);
  EXPECT_TRUE(cache->Has(KeyOfFit(0)));
  EXPECT_FALSE(cache->Has(KeyOfFit(1)));
  EXPECT_FALSE(cache->Has(KeyOfFit(2)));
  EXPECT_TRUE(cache->Has(KeyOfFit(6)));
  EXPECT_LT(fs::file_size(Path()), 1.2 * kMost);
}

TEST_F(KeptFitsFile, OneProcessAddsNoMoreThanItsShareToACache) {
  constexpr std::int64_t kMost = 400'000;
  const auto cache = KeptFits::OpenCache(folder_, kMost);
  for (std::size_t i = 0; i < 4; ++i) {
    cache->Record(KeyOfFit(i), FittedOutcome(10'000));
  }
  EXPECT_TRUE(cache->Has(KeyOfFit(0)));
  EXPECT_FALSE(cache->Has(KeyOfFit(1)));
}

TEST_F(KeptFitsFile, ACacheIsDoneWithoutWhereItCannotBe) {
  EXPECT_EQ(KeptFits::OpenCache(""), nullptr);
  EXPECT_EQ(KeptFits::OpenCache("/dev/null/errmap"), nullptr);
  fs::create_directories(Path());  // no file, but a folder
  EXPECT_EQ(KeptFits::OpenCache(folder_), nullptr);
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

std::string WithoutTimes(FittedModel fitted) {
  fitted.summary.seconds = 0.0;
  fitted.summary.mean_iteration_seconds = 0.0;
  fitted.summary.sd_iteration_seconds = 0.0;
  FitOutcome outcome;
  outcome.fitted = std::move(fitted);
  return FitToBytes("", outcome);
}

// Everything in a result but measured times.
std::string TextOf(const StudyResult& study) {
  std::string text;
  const auto add_fit = [&](FittedModel fitted) {
    text += WithoutTimes(std::move(fitted)) + "\n";
  };
  for (const ModelResult& model : study.models) {
    text += model.name + model.why() + model.final_why_failed + "\n";
    if (model.final_fit) add_fit(*model.final_fit);
    for (const HoldoutResult& holdout : model.holdouts) {
      text += holdout.holdout + "\n";
      for (const FoldResult& fold : holdout.folds) {
        FittedModel carrier;
        carrier.summary = fold.summary;
        carrier.remarks = fold.remarks;
        carrier.choices = fold.choices;
        carrier.starts = fold.starts;
        add_fit(carrier);
        FitOutcome outcome;
        outcome.seconds = holdout.train.rmse;
        outcome.train_predictions =
            Eigen::VectorXd::Constant(1, fold.test_rmse);
        outcome.test_predictions = fold.test_predictions;
        text += FitToBytes("", outcome) + "\n";
      }
    }
  }
  return text;
}

class JournalledStudy : public KeptFitsFile {
 protected:
  // A study whose fits are counted; it is interrupted after `most_fits`.
  StudyResult Run(const std::vector<std::string>& specs,
                  Opening opening,
                  int most_fits,
                  StudyOptions options = {.jobs = 2}) {
    fits_ = 0;
    stop_ = false;
    Recipes recipes;
    for (const std::string& spec : specs) {
      recipes.push_back(
          std::make_unique<CountingRecipe>(spec, [this, most_fits] {
            if (++fits_ >= most_fits) stop_ = true;
          }));
    }
    options.stop = &stop_;
    KeptFits file(folder_, opening);
    const FitLabels labels(
        "x", dataset_, holdouts_, recipes, options, program_);
    line_ = DescribeResume(&file, labels);
    ComponentJournal journal({&file}, &labels, &dataset_, &holdouts_);
    options.journal = &journal;
    const StudyResult study = RunStudy(dataset_, holdouts_, recipes, options);
    remarks_ = file.Remarks();
    return study;
  }

  // The file with each outcome changed, and the sums that go with that.
  template <typename Change>
  void Forge(Change&& change) const {
    data::Database database(Path(), data::Database::Access::kShared);
    std::vector<std::pair<std::string, FitOutcome>> all;
    data::Statement query = database.Prepare("SELECT key, outcome FROM fit");
    while (query.Next()) {
      all.emplace_back(query.Text(0),
                       FitFromBytes(query.Text(0), query.Text(1)));
    }
    for (auto& [key, outcome] : all) {
      change(&outcome);
      database.Prepare("UPDATE fit SET outcome = ? WHERE key = ?")
          .With(data::Blob{FitToBytes(key, outcome)}, key)
          .Run();
    }
  }

  static constexpr int kAll = 1 << 20;
  data::Dataset dataset_ = ShippedMeasurements();
  std::vector<Holdout> holdouts_ =
      MakeHoldouts(dataset_, {"every:3", "groups:5"});
  std::string program_ = "errmap 1";
  std::atomic<int> fits_ = 0;
  std::atomic<bool> stop_ = false;
  std::string line_;
  std::vector<std::string> remarks_;
};

TEST_F(JournalledStudy, MakesFitsAnewWhoseRecordsAreForged) {
  const std::vector<std::string> specs = {"mean", "poly:eq8"};
  const std::string whole =
      TextOf(RunStudy(dataset_, holdouts_, MakeRecipes(specs), {.jobs = 2}));
  constexpr int kFits = 2 * 7;
  const std::vector<std::function<void(FitOutcome*)>> changes = {
      [](FitOutcome* fit) {
        (fit->test_predictions.size() > 0 ? fit->test_predictions
                                          : fit->train_predictions)[0] = 0.0;
      },
      [](FitOutcome* fit) { fit->train_predictions.conservativeResize(3); },
      [](FitOutcome* fit) { fit->test_predictions.resize(0); },
      [](FitOutcome* fit) { fit->fitted->model = nullptr; },
      [](FitOutcome* fit) { fit->fitted->inputs.clear(); },
      [](FitOutcome* fit) { fit->fitted.reset(); },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    SCOPED_TRACE(i);
    Run(specs, Opening::kAnew, kAll);
    Forge(changes[i]);
    EXPECT_EQ(TextOf(Run(specs, Opening::kResume, kAll)), whole);
    // What says nothing wrong: no test rows of all rows, no inputs of a mean.
    EXPECT_GE(fits_, kFits / 2 - 1);
    ASSERT_EQ(remarks_.size(), 1U);
    EXPECT_THAT(remarks_[0],
                AllOf(HasSubstr("fits.sqlite: "),
                      HasSubstr(" whose records are not of them")));
    EXPECT_EQ(TextOf(Run(specs, Opening::kResume, kAll)), whole);
    EXPECT_EQ(fits_, 0);
  }
}

TEST_F(JournalledStudy, EndsAsAnUnbrokenOneWithoutRepeatingAFit) {
  // The last one fails on purpose: failures are kept, too.
  const std::vector<std::string> specs = {"mean",
                                          "poly:stepwise",
                                          "net:scg:hidden=4:iterations=30",
                                          "poly:formula=no_such_mm"};
  constexpr int kFits = 3 * 7;  // those of the last throw before they count
  const std::string whole =
      TextOf(RunStudy(dataset_, holdouts_, MakeRecipes(specs), {.jobs = 2}));
  std::mt19937_64 random(3);
  for (int round = 0; round < 5; ++round) {
    Opening opening = Opening::kAnew;
    int fits = 0;
    int interruptions = 0;
    for (bool interrupted = true; interrupted;) {
      const int most = 1 + static_cast<int>(random() % 6);
      const StudyResult study = Run(specs, opening, most);
      interrupted = study.interrupted;
      fits += fits_;
      opening = Opening::kResume;
      if (interrupted) {
        ++interruptions;
      } else {
        EXPECT_EQ(TextOf(study), whole);
      }
    }
    // Fits under way at an interruption are not kept: one per job at most. The
    // net's fit to all rows counts twice: once more to shuffled targets.
    constexpr int kJobs = 2;
    EXPECT_GE(fits, kFits);
    EXPECT_LE(fits, kFits + 1 + (kJobs + 1) * interruptions);
    Run(specs, Opening::kResume, kAll);
    EXPECT_EQ(fits_, 0);
  }
}

TEST_F(JournalledStudy, SaysWhatIsAtHand) {
  Run({"mean"}, Opening::kAnew, kAll);
  EXPECT_EQ(fits_, 7);
  Run({"mean", "poly:eq8"}, Opening::kResume, kAll);
  EXPECT_EQ(fits_, 7);
  EXPECT_EQ(line_, "x: 7 of 14 fits are at hand, 7 to be made");
}

TEST_F(JournalledStudy, MakesAnewWhatAnotherProgramMade) {
  Run({"mean"}, Opening::kAnew, kAll);
  program_ = "errmap 2";
  Run({"mean"}, Opening::kResume, kAll);
  EXPECT_EQ(fits_, 7);
  EXPECT_EQ(line_, "x: 0 of 7 fits are at hand, 7 to be made");
}

TEST_F(JournalledStudy, MakesAnewWhatAnotherSeedOrOtherRowsMade) {
  Run({"mean"}, Opening::kAnew, kAll);
  Run({"mean"}, Opening::kResume, kAll, {.seed = 2});
  EXPECT_EQ(fits_, 7);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 1; row < dataset_.num_rows(); ++row) {
    rows.push_back(row);
  }
  dataset_ = dataset_.SelectRows(rows);
  holdouts_ = MakeHoldouts(dataset_, {"every:3", "groups:5"});
  Run({"mean"}, Opening::kResume, kAll, {.seed = 2});
  EXPECT_EQ(fits_, 7);
}

TEST_F(JournalledStudy, FindsOldFitsWhenTheDataAreAsBefore) {
  Run({"mean"}, Opening::kAnew, kAll);
  Run({"mean"}, Opening::kResume, kAll, {.seed = 2});
  Run({"mean"}, Opening::kResume, kAll);
  EXPECT_EQ(fits_, 0);
}

TEST_F(JournalledStudy, DoesNotKeepAFitThatLackedMemory) {
  class Hungry final : public FitJournal {
   public:
    std::optional<FitOutcome> Find(const StudyTask&) override { return {}; }
    void Record(const StudyTask&, const FitOutcome&) override { ++recorded; }
    std::atomic<int> recorded = 0;
  };
  Recipes recipes;
  recipes.push_back(
      std::make_unique<CountingRecipe>("mean", [] { throw std::bad_alloc(); }));
  Hungry journal;
  const StudyResult study =
      RunStudy(dataset_, holdouts_, recipes, {.journal = &journal});
  EXPECT_THAT(study.models[0].why(), HasSubstr("not enough memory"));
  EXPECT_EQ(study.short_of_memory, 7);
  EXPECT_EQ(journal.recorded, 0);
  // A net that is there, and whose fit to shuffled targets is not.
  int fits = 0;
  Recipes nets;
  nets.push_back(std::make_unique<CountingRecipe>(
      "net:scg:hidden=2:iterations=5", [&fits] {
        if (++fits == 2) throw std::bad_alloc();
      }));
  EXPECT_EQ(RunStudy(dataset_, holdouts_, nets, {.journal = &journal})
                .short_of_memory,
            1);
  EXPECT_EQ(journal.recorded, 6);  // of seven
}

}  // namespace
}  // namespace errmap::models
