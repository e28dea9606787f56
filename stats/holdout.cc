#include "stats/holdout.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "stats/indices.h"
#include "stats/random.h"

namespace errmap::stats {
namespace {

[[noreturn]] void Refuse(std::string_view text, const std::string& why) {
  throw std::invalid_argument("hold-out '" + std::string(text) + "': " + why);
}

// Returns false unless the whole text is a number.
template <typename Number>
bool Parse(std::string_view text, Number* number) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, *number);
  return result.ec == std::errc() && result.ptr == end;
}

Index ParseCount(std::string_view spec,
                 std::string_view name,
                 std::string_view value,
                 Index least) {
  constexpr Index kMost = 1'000'000'000;
  Index count = 0;
  if (!Parse(value, &count) || count < least || count > kMost) {
    Refuse(spec,
           std::string(name) + " must be a whole number of at least " +
               std::to_string(least) + ", found '" + std::string(value) + "'");
  }
  return count;
}

double ParseShare(std::string_view spec, std::string_view value) {
  double share = 0.0;
  if (!Parse(value, &share) || !(share > 0.0 && share < 1.0)) {
    Refuse(spec,
           "the test share must be above 0 and below 1, found '" +
               std::string(value) + "'");
  }
  return share;
}

// Cuts `items` into `parts` runs as equal as can be, longer runs first.
std::vector<std::vector<Index>> CutIntoRuns(const std::vector<Index>& items,
                                            Index parts) {
  const Index size = std::ssize(items);
  std::vector<std::vector<Index>> runs;
  auto begin = items.begin();
  for (Index part = 0; part < parts; ++part) {
    const Index length = size / parts + (part < size % parts ? 1 : 0);
    runs.emplace_back(begin, begin + length);
    begin += length;
  }
  return runs;
}

// Splits rows by a flag per row: true = test.
Fold FoldOf(const std::vector<bool>& is_test) {
  Fold fold;
  for (std::size_t row = 0; row < is_test.size(); ++row) {
    (is_test[row] ? fold.test : fold.train).push_back(static_cast<Index>(row));
  }
  return fold;
}

// The rows and the units (groups, or single rows) they are held out by.
class Units {
 public:
  Units(Index num_rows, const std::vector<Index>& group_codes)
      : num_rows_(num_rows),
        codes_(group_codes.empty() ? AllIndices(num_rows) : group_codes) {
    // Groups whose rows were all dropped do not count.
    count_ = Renumber(&codes_);
  }

  Index count() const { return count_; }

  std::vector<bool> RowsOf(const std::vector<Index>& units) const {
    std::vector<bool> chosen(static_cast<std::size_t>(count_), false);
    for (const Index unit : units) {
      chosen[static_cast<std::size_t>(unit)] = true;
    }
    std::vector<bool> rows(static_cast<std::size_t>(num_rows_));
    for (std::size_t row = 0; row < rows.size(); ++row) {
      rows[row] = chosen[static_cast<std::size_t>(codes_[row])];
    }
    return rows;
  }

 private:
  Index num_rows_;
  std::vector<Index> codes_;
  Index count_ = 0;
};

std::vector<Fold> HoldOutRuns(const Units& units,
                              const std::vector<Index>& order,
                              Index parts) {
  std::vector<Fold> folds;
  for (const auto& run : CutIntoRuns(order, parts)) {
    folds.push_back(FoldOf(units.RowsOf(run)));
  }
  return folds;
}

std::vector<Fold> ForwardFolds(const HoldoutSpec& spec, const Units& units) {
  const auto blocks = CutIntoRuns(AllIndices(units.count()), spec.k + 1);
  std::vector<Fold> folds;
  std::vector<Index> earlier;
  for (std::size_t block = 1; block < blocks.size(); ++block) {
    earlier.insert(
        earlier.end(), blocks[block - 1].begin(), blocks[block - 1].end());
    const Index kept = std::ssize(earlier) - spec.gap;
    if (kept < 1) {
      Refuse(spec.text,
             "fold " + std::to_string(block) + " has " +
                 std::to_string(earlier.size()) +
                 " groups or rows before it and a gap of " +
                 std::to_string(spec.gap) +
                 " leaves none to train on; use a smaller gap or fewer blocks");
    }
    const std::vector<Index> train(earlier.begin(), earlier.begin() + kept);
    Fold fold;
    fold.train = FoldOf(units.RowsOf(train)).test;
    fold.test = FoldOf(units.RowsOf(blocks[block])).test;
    folds.push_back(std::move(fold));
  }
  return folds;
}

// In order, or `repeats` times shuffled.
std::vector<Fold> RunsOf(const Units& units,
                         Index parts,
                         Index repeats,
                         std::uint64_t seed) {
  if (repeats == 0) return HoldOutRuns(units, AllIndices(units.count()), parts);
  Random random(seed);
  std::vector<Fold> folds;
  for (Index repeat = 0; repeat < repeats; ++repeat) {
    std::vector<Index> order = AllIndices(units.count());
    random.Shuffle(order);
    for (auto& fold : HoldOutRuns(units, order, parts)) {
      folds.push_back(std::move(fold));
    }
  }
  return folds;
}

Fold RandomFold(const HoldoutSpec& spec, Index num_rows, std::uint64_t seed) {
  std::vector<Index> order = AllIndices(num_rows);
  Random random(seed);
  random.Shuffle(order);
  order.resize(static_cast<std::size_t>(
      std::lround(spec.share * static_cast<double>(num_rows))));
  return FoldOf(Units(num_rows, {}).RowsOf(order));
}

Fold EveryFold(const HoldoutSpec& spec, Index num_rows) {
  std::vector<bool> is_test(static_cast<std::size_t>(num_rows));
  for (Index row = 0; row < num_rows; ++row) {
    is_test[static_cast<std::size_t>(row)] = row % spec.k == spec.k - 1;
  }
  return FoldOf(is_test);
}

// The folds of one hold-out, or why these rows do not allow it.
class FoldMaker {
 public:
  FoldMaker(const HoldoutSpec& spec,
            Index num_rows,
            const std::vector<Index>& group_codes,
            std::uint64_t seed)
      : spec_(spec),
        num_rows_(num_rows),
        has_groups_(!group_codes.empty()),
        groups_(num_rows, group_codes),
        seed_(seed) {}

  std::vector<Fold> Make() const {
    switch (spec_.kind) {
      case HoldoutKind::kEvery:
        RequireRows();
        return {EveryFold(spec_, num_rows_)};
      case HoldoutKind::kGroups:
        RequireGroups(spec_.k);
        return RunsOf(groups_, spec_.k, spec_.repeats, seed_);
      case HoldoutKind::kSessions:
        RequireSessions();
        return RunsOf(groups_, spec_.k, spec_.repeats, seed_);
      case HoldoutKind::kBlocks:
        RequireRows();
        return RunsOf(Units(num_rows_, {}), spec_.k, 0, seed_);
      case HoldoutKind::kLeaveOneGroupOut:
        RequireGroups(2);
        return RunsOf(groups_, groups_.count(), 0, seed_);
      case HoldoutKind::kKFold:
        RequireRows();
        return RunsOf(Units(num_rows_, {}), spec_.k, 1, seed_);
      case HoldoutKind::kForward:
        Require(groups_.count(),
                spec_.k + 1,
                has_groups_ ? "groups" : "rows",
                kFewerParts);
        return ForwardFolds(spec_, groups_);
      case HoldoutKind::kRandom:
        return {RandomFold(spec_, num_rows_, seed_)};
      case HoldoutKind::kFile:
        return {{AllIndices(num_rows_), {}}};
    }
    throw std::invalid_argument("MakeFolds: no such kind of hold-out");
  }

 private:
  static constexpr const char* kFewerParts = "measure more, or use a smaller K";

  void Require(Index found,
               Index needed,
               const std::string& what,
               const std::string& instead) const {
    if (found >= needed) return;
    Refuse(spec_.text,
           "needs at least " + std::to_string(needed) + " " + what +
               ", found " + std::to_string(found) + "; " + instead);
  }

  void RequireRows() const { Require(num_rows_, spec_.k, "rows", kFewerParts); }

  void RequireGroups(Index needed) const {
    if (!has_groups_) {
      Refuse(spec_.text,
             "there are no groups; give the code of each row's, or hold out "
             "rows (every:3, kfold:5)");
    }
    Require(groups_.count(),
            needed,
            "groups",
            groups_.count() >= 2
                ? "groups:" + std::to_string(groups_.count()) +
                      " or leave-one-group-out is possible"
                : "with one group only rows can be held out (every:3, "
                  "kfold:5), which says nothing about another day");
  }

  void RequireSessions() const {
    Require(has_groups_ ? groups_.count() : 0,
            spec_.k,
            "sessions",
            !has_groups_
                ? "give the code of each row's, or hold out rows (blocks:5)"
            : groups_.count() >= 2
                ? "sessions:" + std::to_string(groups_.count()) + " is possible"
                : "of one run only groups or rows can be held out "
                  "(groups:5, blocks:5), which says nothing about "
                  "another day");
  }

  const HoldoutSpec& spec_;
  Index num_rows_;
  bool has_groups_;
  Units groups_;
  std::uint64_t seed_;
};

// Kinds that are written NAME:K or NAME:K:OPTION=N.
struct CountedKind {
  std::string_view name;
  HoldoutKind kind;
  Index least;  // of K
  std::string_view option = "";
  Index HoldoutSpec::*of_option = nullptr;
  Index least_of_option = 0;
};

constexpr auto kCountedKinds = std::to_array<CountedKind>({
    {"every", HoldoutKind::kEvery, 2},
    {"groups", HoldoutKind::kGroups, 2, "repeats", &HoldoutSpec::repeats, 1},
    {"sessions",
     HoldoutKind::kSessions,
     2,
     "repeats",
     &HoldoutSpec::repeats,
     1},
    {"blocks", HoldoutKind::kBlocks, 2},
    {"kfold", HoldoutKind::kKFold, 2},
    {"forward", HoldoutKind::kForward, 1, "gap", &HoldoutSpec::gap, 0},
});

// "forward:4:gap=1" taken apart at its colons.
struct SpecParts {
  std::string_view kind;
  std::string_view rest;  // all behind the first colon
  std::string_view value;
  std::string_view option;
  bool has_rest = false;
  bool has_option = false;
};

SpecParts PartsOf(std::string_view text) {
  SpecParts parts;
  const std::size_t colon = text.find(':');
  parts.kind = text.substr(0, colon);
  if (colon == text.npos) return parts;
  parts.has_rest = true;
  parts.rest = text.substr(colon + 1);
  const std::size_t second = parts.rest.find(':');
  parts.value = parts.rest.substr(0, second);
  if (second == text.npos) return parts;
  parts.has_option = true;
  parts.option = parts.rest.substr(second + 1);
  return parts;
}

void RefuseOption(std::string_view text, const SpecParts& parts) {
  if (!parts.has_option) return;
  Refuse(text, "takes no option '" + std::string(parts.option) + "'");
}

void TakeCounts(const CountedKind& counted,
                const SpecParts& parts,
                HoldoutSpec* spec) {
  spec->kind = counted.kind;
  spec->k = ParseCount(spec->text, "K", parts.value, counted.least);
  if (counted.of_option == nullptr) RefuseOption(spec->text, parts);
  if (!parts.has_option) return;
  const std::string prefix = std::string(counted.option) + "=";
  if (!parts.option.starts_with(prefix)) {
    Refuse(spec->text,
           "the only option is " + prefix + "N, found '" +
               std::string(parts.option) + "'");
  }
  spec->*counted.of_option = ParseCount(spec->text,
                                        counted.option,
                                        parts.option.substr(prefix.size()),
                                        counted.least_of_option);
  // Every fold has its rows in memory, and adds little to what is known.
  constexpr Index kMostRepeats = 1000;
  if (spec->repeats > kMostRepeats) {
    Refuse(spec->text,
           "repeats must be at most " + std::to_string(kMostRepeats) +
               ", found " + std::to_string(spec->repeats));
  }
}

}  // namespace

const std::vector<HoldoutForm>& HoldoutForms() {
  static const std::vector<HoldoutForm> forms{
      {"every:K",
       "every K-th row is held out; its neighbours of the same group are in "
       "the training rows",
       {"every:3"}},
      {"groups:K[:repeats=R]",
       "whole groups are held out in turn, K runs of them",
       {"groups:5", "groups:5:repeats=20"}},
      {"sessions:K[:repeats=R]",
       "whole sessions are held out in turn, K runs of them",
       {"sessions:5"}},
      {"blocks:K", "K runs of rows are held out in turn", {"blocks:5"}},
      {"leave-one-group-out",
       "each group is held out in turn",
       {"leave-one-group-out"}},
      {"kfold:K",
       "rows are shuffled and held out in K parts; their neighbours are in the "
       "training rows",
       {"kfold:10"}},
      {"forward:K[:gap=G]",
       "earlier groups predict the next ones",
       {"forward:4", "forward:4:gap=1"}},
      {"random:F", "a random share of the rows is held out", {"random:0.3"}},
      {"file:TEST.csv", "all rows train, the rows of a file test", {"file:"}}};
  return forms;
}

std::string HoldoutFormsText() {
  std::string text;
  for (const HoldoutForm& form : HoldoutForms()) {
    text += (text.empty() ? "" : ", ") + std::string(form.form);
  }
  return text;
}

std::string_view HoldoutMeaning(std::string_view name) {
  const auto kind = [](std::string_view text) {
    return text.substr(0, text.find(':'));
  };
  for (const HoldoutForm& form : HoldoutForms()) {
    if (kind(form.form) == kind(name)) return form.meaning;
  }
  return "";
}

HoldoutSpec ParseHoldout(std::string_view text) {
  HoldoutSpec spec;
  spec.text = std::string(text);
  const SpecParts parts = PartsOf(text);
  const auto counted =
      std::ranges::find(kCountedKinds, parts.kind, &CountedKind::name);
  if (counted != kCountedKinds.end()) {
    TakeCounts(*counted, parts, &spec);
  } else if (parts.kind == "leave-one-group-out") {
    spec.kind = HoldoutKind::kLeaveOneGroupOut;
    if (parts.has_rest) Refuse(text, "takes no options");
  } else if (parts.kind == "random") {
    spec.kind = HoldoutKind::kRandom;
    spec.share = ParseShare(text, parts.value);
    RefuseOption(text, parts);
  } else if (parts.kind == "file") {
    spec.kind = HoldoutKind::kFile;
    spec.file = std::string(parts.rest);  // which may hold colons
    if (spec.file.empty()) Refuse(text, "names no file; use file:TEST.csv");
  } else {
    Refuse(text, "unknown; use " + HoldoutFormsText());
  }
  return spec;
}

std::vector<Fold> MakeFolds(const HoldoutSpec& spec,
                            Index num_rows,
                            const std::vector<Index>& group_codes,
                            std::uint64_t seed) {
  if (!group_codes.empty() && std::ssize(group_codes) != num_rows) {
    throw std::invalid_argument(
        "MakeFolds: " + std::to_string(group_codes.size()) +
        " group codes for " + std::to_string(num_rows) + " rows");
  }
  std::vector<Fold> folds = FoldMaker(spec, num_rows, group_codes, seed).Make();
  for (const Fold& fold : folds) {
    const bool tests_here = spec.kind != HoldoutKind::kFile;
    if (fold.train.empty() || (tests_here && fold.test.empty())) {
      Refuse(spec.text,
             "leaves no rows to " +
                 std::string(fold.train.empty() ? "train on" : "test") +
                 " out of " + std::to_string(num_rows) +
                 "; use another hold-out or more data");
    }
  }
  return folds;
}

bool KeepsWhole(const std::vector<Fold>& folds,
                const std::vector<Index>& codes) {
  for (const Fold& fold : folds) {
    std::set<Index> trained;
    for (const Index row : fold.train) {
      trained.insert(codes[static_cast<std::size_t>(row)]);
    }
    for (const Index row : fold.test) {
      if (trained.contains(codes[static_cast<std::size_t>(row)])) return false;
    }
  }
  return true;
}

}  // namespace errmap::stats
