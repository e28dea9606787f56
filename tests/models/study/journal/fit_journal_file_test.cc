#include "models/study/journal/fit_journal_file.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "data/sha256.h"
#include "models/study/journal/fit_record.h"
#include "tests/models/model_test_data.h"
#include "tests/models/study/study_test_tools.h"

namespace errmap::models {
namespace {

namespace fs = std::filesystem;
using errmap::testing::CountingRecipe;
using errmap::testing::MakeHoldouts;
using errmap::testing::MakeRecipes;
using errmap::testing::Recipes;
using errmap::testing::ShippedMeasurements;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;
using Opening = JournalFile::Opening;

FitLabel LabelOf(std::size_t fold) {
  FitLabel label;
  label.component = "x";
  label.holdout = "kfold:9";
  label.fold = fold;
  label.model = "mean";
  label.rows = "rows of " + std::to_string(fold);
  return label;
}

FitOutcome OutcomeOf(double value, Eigen::Index size = 3) {
  FitOutcome outcome;
  outcome.seconds = value;
  outcome.test_predictions = Eigen::VectorXd::Constant(size, value);
  return outcome;
}

// An empty folder of its own for each test.
class FitJournalFile : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern =
        (fs::temp_directory_path() / "fit_journal_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }

  void TearDown() override { fs::remove_all(folder_); }

  std::string Path(const char* name = JournalFile::kName) const {
    return folder_ / name;
  }

  std::string Text() const {
    std::ostringstream text;
    text << std::ifstream(Path(), std::ios::binary).rdbuf();
    return text.str();
  }

  void SetText(const std::string& text) const {
    std::ofstream(Path(), std::ios::binary) << text;
  }

  // A journal of `count` fits; fold i has the value i + 1.
  void WriteFits(std::size_t count) const {
    JournalFile file(folder_, Opening::kAnew);
    for (std::size_t i = 0; i < count; ++i) {
      file.Record(LabelOf(i), OutcomeOf(static_cast<double>(i) + 1.0));
    }
  }

  static double ValueOf(const JournalFile& file, std::size_t fold) {
    const std::optional<FitOutcome> outcome = file.Find(LabelOf(fold));
    return outcome ? outcome->test_predictions[2] : 0.0;
  }

  fs::path folder_;
};

TEST_F(FitJournalFile, GivesBackWhatItWasGiven) {
  WriteFits(3);
  const JournalFile file(folder_, Opening::kResume);
  EXPECT_EQ(file.num_found(), 3U);
  EXPECT_EQ(ValueOf(file, 0), 1.0);
  EXPECT_EQ(ValueOf(file, 2), 3.0);
  EXPECT_FALSE(file.Find(LabelOf(3)).has_value());
  EXPECT_THAT(file.OpeningRemarks(), IsEmpty());
}

TEST_F(FitJournalFile, IsOneLinePerFit) {
  WriteFits(2);
  std::istringstream lines(Text());
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    EXPECT_TRUE(line.starts_with(R"({"sum":")"));
    EXPECT_TRUE(line.ends_with("}"));
  }
  EXPECT_EQ(count, 2);
}

TEST_F(FitJournalFile, GoesOnWithWhatThereIs) {
  WriteFits(1);
  {
    JournalFile file(folder_, Opening::kResume);
    file.Record(LabelOf(1), OutcomeOf(2.0));
  }
  const JournalFile file(folder_, Opening::kResume);
  EXPECT_EQ(ValueOf(file, 0), 1.0);
  EXPECT_EQ(ValueOf(file, 1), 2.0);
}

TEST_F(FitJournalFile, ResumesFromNothing) {
  const JournalFile file(folder_, Opening::kResume);
  EXPECT_EQ(file.num_found(), 0U);
  EXPECT_THAT(file.OpeningRemarks(), IsEmpty());
}

TEST_F(FitJournalFile, SetsAnEarlierOneAsideWhenStartedAnew) {
  WriteFits(2);
  const std::string before = Text();
  {
    const JournalFile file(folder_, Opening::kAnew);
    EXPECT_EQ(file.num_found(), 0U);
    EXPECT_THAT(file.OpeningRemarks(),
                ElementsAre(HasSubstr("journal.previous.jsonl")));
  }
  EXPECT_EQ(Text(), "");
  fs::rename(Path(JournalFile::kPreviousName), Path());
  EXPECT_EQ(Text(), before);
}

TEST_F(FitJournalFile, CutsOffATornLastLineWhereverItIsTorn) {
  WriteFits(2);
  const std::string whole = Text();
  const std::size_t first = whole.find('\n') + 1;
  for (std::size_t size = first; size < whole.size(); ++size) {
    SetText(whole.substr(0, size));
    JournalFile file(folder_, Opening::kResume);
    ASSERT_EQ(file.num_found(), 1U) << size;
    ASSERT_THAT(file.OpeningRemarks(), IsEmpty());
    file.Record(LabelOf(1), OutcomeOf(2.0));
    ASSERT_EQ(Text(), whole) << size;
  }
}

TEST_F(FitJournalFile, PassesOverADamagedLineAndSaysSo) {
  WriteFits(3);
  const std::string whole = Text();
  const std::size_t begin = whole.find('\n') + 1;
  const std::size_t end = whole.find('\n', begin);
  constexpr std::size_t kStep = 7;
  for (std::size_t at = begin; at < end; at += kStep) {
    std::string text = whole;
    text[at] = text[at] == 'x' ? 'y' : 'x';
    SetText(text);
    const JournalFile file(folder_, Opening::kResume);
    ASSERT_EQ(file.num_found(), 2U) << at;
    ASSERT_EQ(ValueOf(file, 1), 0.0);
    ASSERT_EQ(ValueOf(file, 2), 3.0);
    ASSERT_THAT(file.OpeningRemarks(),
                ElementsAre(HasSubstr("1 damaged line")));
  }
}

TEST_F(FitJournalFile, TakesNothingFromAFileThatIsNoJournal) {
  SetText("one\n\n{}\n" + std::string(500, 'x') + "\n");
  const JournalFile file(folder_, Opening::kResume);
  EXPECT_EQ(file.num_found(), 0U);
  EXPECT_THAT(file.OpeningRemarks(), ElementsAre(HasSubstr("4 damaged lines")));
}

TEST_F(FitJournalFile, SurvivesZerosAtItsEnd) {
  // As some file systems leave them after a loss of power.
  WriteFits(2);
  std::ofstream(Path(), std::ios::app) << std::string(4096, '\0');
  const JournalFile file(folder_, Opening::kResume);
  EXPECT_EQ(file.num_found(), 2U);
  EXPECT_EQ(Text().find('\0'), std::string::npos);
}

TEST_F(FitJournalFile, RefusesASecondProcess) {
  const JournalFile file(folder_, Opening::kAnew);
  for (const Opening opening : {Opening::kAnew, Opening::kResume}) {
    EXPECT_THAT([&] { JournalFile(folder_, opening); },
                ThrowsMessage<std::runtime_error>(
                    HasSubstr("journal.jsonl: another errmap is at work")));
  }
}

TEST_F(FitJournalFile, IsFreeAgainWhenItsProcessIsKilled) {
  const pid_t child = fork();
  if (child == 0) {
    JournalFile file(folder_, Opening::kAnew);
    file.Record(LabelOf(0), OutcomeOf(1.0));
    raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
  const JournalFile file(folder_, Opening::kResume);
  EXPECT_EQ(ValueOf(file, 0), 1.0);
}

TEST_F(FitJournalFile, NamesAFolderThatCannotBeWritten) {
  EXPECT_THAT([&] { JournalFile(folder_ / "missing", Opening::kResume); },
              ThrowsMessage<std::system_error>(
                  HasSubstr("cannot write " + Path("missing/journal.jsonl"))));
  if (geteuid() == 0) GTEST_SKIP() << "nothing is read-only for root";
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(JournalFile(folder_, Opening::kAnew), std::system_error);
  fs::permissions(folder_, fs::perms::owner_all);
}

TEST_F(FitJournalFile, KeepsItsGoodLinesWhereTheDiskIsFull) {
  const pid_t child = fork();
  if (child == 0) {
    // A limit in the middle of a line: the first fits go in, then none.
    constexpr rlim_t kLimit = 1500;
    const rlimit limit{kLimit, kLimit};
    std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    JournalFile file(folder_, Opening::kAnew);
    constexpr Eigen::Index kSmall = 3;
    constexpr Eigen::Index kLarge = 500;
    file.Record(LabelOf(0), OutcomeOf(1.0, kSmall));
    file.Record(LabelOf(1), OutcomeOf(2.0, kLarge));
    file.Record(LabelOf(2), OutcomeOf(3.0, kSmall));
    const auto remarks = file.WritingRemarks();
    const bool as_expected =
        remarks.size() == 1 &&
        remarks[0].find("File too large; 1 fit not kept") != std::string::npos;
    _exit(as_expected ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  const JournalFile file(folder_, Opening::kResume);
  EXPECT_THAT(file.OpeningRemarks(), IsEmpty());
  EXPECT_EQ(ValueOf(file, 0), 1.0);
  EXPECT_EQ(ValueOf(file, 1), 0.0);
  EXPECT_EQ(ValueOf(file, 2), 3.0);
}

TEST_F(FitJournalFile, LeavesOutRecordsThatAreTooLong) {
  {
    JournalFile file(folder_, Opening::kAnew);
    constexpr Eigen::Index kTooMany = 6'500'000;
    file.Record(LabelOf(0), OutcomeOf(1.0, kTooMany));
    file.Record(LabelOf(1), OutcomeOf(2.0));
    EXPECT_THAT(file.WritingRemarks(),
                ElementsAre(HasSubstr("1 fit not kept")));
  }
  const JournalFile file(folder_, Opening::kResume);
  EXPECT_EQ(file.num_found(), 1U);
}

std::string WithoutTimes(FittedModel fitted) {
  fitted.summary.seconds = 0.0;
  fitted.summary.mean_iteration_seconds = 0.0;
  fitted.summary.sd_iteration_seconds = 0.0;
  FitOutcome outcome;
  outcome.fitted = std::move(fitted);
  return FitToText(outcome);
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
        text += FitToText(outcome) + "\n";
      }
    }
  }
  return text;
}

class JournalledStudy : public FitJournalFile {
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
    JournalFile file(folder_, opening);
    const FitLabels labels(
        "x", dataset_, holdouts_, recipes, options, program_);
    lines_ = DescribeResume(file, labels);
    ComponentJournal journal({&file}, &labels, &dataset_, &holdouts_);
    options.journal = &journal;
    const StudyResult study = RunStudy(dataset_, holdouts_, recipes, options);
    remarks_ = file.WritingRemarks();
    return study;
  }

  // The journal with each outcome changed, and the sums that go with that.
  template <typename Change>
  void Forge(Change&& change) const {
    static const std::string begin = R"({"sum":")";
    static const std::string before = R"(,"outcome":)";
    std::istringstream lines(Text());
    std::string forged;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t at = line.find(before) + before.size();
      FitOutcome outcome =
          FitFromText(std::string_view(line).substr(at, line.size() - at - 1));
      change(&outcome);
      constexpr std::size_t kSum = 64;
      const std::string rest =
          line.substr(begin.size() + kSum, at - begin.size() - kSum) +
          FitToText(outcome) + "}";
      forged += begin + data::Sha256(rest) + rest + "\n";
    }
    SetText(forged);
  }

  static constexpr int kAll = 1 << 20;
  data::Dataset dataset_ = ShippedMeasurements();
  std::vector<Holdout> holdouts_ =
      MakeHoldouts(dataset_, {"every:3", "groups:5"});
  std::string program_ = "errmap 1";
  std::atomic<int> fits_ = 0;
  std::atomic<bool> stop_ = false;
  std::vector<std::string> lines_;
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
                AllOf(HasSubstr("journal.jsonl: "),
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
  EXPECT_THAT(lines_, ElementsAre("x: 7 of 14 fits are at hand, 7 to be made"));
}

TEST_F(JournalledStudy, MakesAnewWhatAnotherProgramMade) {
  Run({"mean"}, Opening::kAnew, kAll);
  program_ = "errmap 2";
  Run({"mean"}, Opening::kResume, kAll);
  EXPECT_EQ(fits_, 7);
  EXPECT_THAT(lines_,
              ElementsAre("x: 0 of 7 fits are at hand, 7 to be made",
                          "x: 7 fits made again: errmap 1 -> errmap 2"));
}

TEST_F(JournalledStudy, MakesAnewWhatAnotherSeedOrOtherRowsMade) {
  Run({"mean"}, Opening::kAnew, kAll);
  Run({"mean"}, Opening::kResume, kAll, {.seed = 2});
  EXPECT_EQ(fits_, 7);
  EXPECT_THAT(lines_[1], HasSubstr("7 fits made again: seed=1 -> seed=2"));
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 1; row < dataset_.num_rows(); ++row) {
    rows.push_back(row);
  }
  dataset_ = dataset_.SelectRows(rows);
  holdouts_ = MakeHoldouts(dataset_, {"every:3", "groups:5"});
  Run({"mean"}, Opening::kResume, kAll, {.seed = 2});
  EXPECT_EQ(fits_, 7);
  EXPECT_THAT(
      lines_[1],
      HasSubstr("7 fits made again: the data that they see have changed"));
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
