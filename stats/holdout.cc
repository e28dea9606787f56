#include "stats/holdout.h"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

#include "stats/random.h"

namespace errmap::stats {
namespace {

using Eigen::Index;

[[noreturn]] void Refuse(std::string_view text, const std::string& why) {
  throw std::invalid_argument("hold-out '" + std::string(text) + "': " + why);
}

Index ParseCount(std::string_view spec,
                 std::string_view name,
                 std::string_view value,
                 Index least) {
  constexpr Index kMost = 1'000'000'000;
  Index count = 0;
  const auto [end, error] =
      std::from_chars(value.data(), value.data() + value.size(), count);
  if (error != std::errc() || end != value.data() + value.size() ||
      count < least || count > kMost) {
    Refuse(spec,
           std::string(name) + " must be a whole number of at least " +
               std::to_string(least) + ", found '" + std::string(value) + "'");
  }
  return count;
}

double ParseShare(std::string_view spec, std::string_view value) {
  double share = 0.0;
  const auto [end, error] =
      std::from_chars(value.data(), value.data() + value.size(), share);
  if (error != std::errc() || end != value.data() + value.size() ||
      !(share > 0.0 && share < 1.0)) {
    Refuse(spec,
           "the test share must be above 0 and below 1, found '" +
               std::string(value) + "'");
  }
  return share;
}

// Cuts `items` into `parts` runs as equal as can be, longer runs first.
std::vector<std::vector<Index>> CutIntoRuns(const std::vector<Index>& items,
                                            Index parts) {
  const Index size = static_cast<Index>(items.size());
  std::vector<std::vector<Index>> runs;
  auto begin = items.begin();
  for (Index part = 0; part < parts; ++part) {
    const Index length = size / parts + (part < size % parts ? 1 : 0);
    runs.emplace_back(begin, begin + length);
    begin += length;
  }
  return runs;
}

std::vector<Index> Range(Index size) {
  std::vector<Index> indices(static_cast<std::size_t>(size));
  std::iota(indices.begin(), indices.end(), Index{0});
  return indices;
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
        codes_(group_codes.empty() ? Range(num_rows) : group_codes) {
    // Groups whose rows were all dropped do not count: renumber those present.
    std::vector<Index> present = codes_;
    std::sort(present.begin(), present.end());
    present.erase(std::unique(present.begin(), present.end()), present.end());
    for (Index& code : codes_) {
      code = std::lower_bound(present.begin(), present.end(), code) -
             present.begin();
    }
    count_ = static_cast<Index>(present.size());
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
  const auto blocks = CutIntoRuns(Range(units.count()), spec.k + 1);
  std::vector<Fold> folds;
  std::vector<Index> earlier;
  for (std::size_t block = 1; block < blocks.size(); ++block) {
    earlier.insert(
        earlier.end(), blocks[block - 1].begin(), blocks[block - 1].end());
    const Index kept = static_cast<Index>(earlier.size()) - spec.gap;
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

std::vector<Fold> GroupFolds(const HoldoutSpec& spec,
                             const Units& units,
                             std::uint64_t seed) {
  if (spec.repeats == 0) {
    return HoldOutRuns(units, Range(units.count()), spec.k);
  }
  Random random(seed);
  std::vector<Fold> folds;
  for (Index repeat = 0; repeat < spec.repeats; ++repeat) {
    std::vector<Index> order = Range(units.count());
    random.Shuffle(order);
    for (auto& fold : HoldOutRuns(units, order, spec.k)) {
      folds.push_back(std::move(fold));
    }
  }
  return folds;
}

Fold RandomFold(const HoldoutSpec& spec, Index num_rows, std::uint64_t seed) {
  std::vector<Index> order = Range(num_rows);
  Random random(seed);
  random.Shuffle(order);
  const auto num_test = static_cast<std::size_t>(
      spec.share * static_cast<double>(num_rows) + 0.5);
  std::vector<bool> is_test(order.size(), false);
  for (std::size_t i = 0; i < std::min(num_test, order.size()); ++i) {
    is_test[static_cast<std::size_t>(order[i])] = true;
  }
  return FoldOf(is_test);
}

void RequireUnits(const HoldoutSpec& spec,
                  Index found,
                  Index needed,
                  const std::string& what,
                  const std::string& instead) {
  if (found >= needed) return;
  Refuse(spec.text,
         "needs at least " + std::to_string(needed) + " " + what + ", found " +
             std::to_string(found) + "; " + instead);
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
  const std::size_t colon = text.find(':');
  const std::string_view kind = text.substr(0, colon);
  std::string_view rest =
      colon == std::string_view::npos ? "" : text.substr(colon + 1);
  if (kind == "file") {  // the path may hold colons
    if (rest.empty()) Refuse(text, "names no file; use file:TEST.csv");
    spec.kind = HoldoutKind::kFile;
    spec.file = std::string(rest);
    return spec;
  }
  const std::size_t second = rest.find(':');
  const std::string_view value = rest.substr(0, second);
  std::string_view option =
      second == std::string_view::npos ? "" : rest.substr(second + 1);
  const bool has_option = second != std::string_view::npos;
  const auto take_option = [&](std::string_view key, Index least) -> Index {
    if (!has_option) return 0;
    const std::string prefix = std::string(key) + "=";
    if (!option.starts_with(prefix)) {
      Refuse(text,
             "the only option is " + prefix + "N, found '" +
                 std::string(option) + "'");
    }
    option.remove_prefix(prefix.size());
    return ParseCount(text, key, option, least);
  };
  const auto refuse_option = [&] {
    if (has_option) {
      Refuse(text, "takes no option '" + std::string(option) + "'");
    }
  };
  if (kind == "every") {
    spec.kind = HoldoutKind::kEvery;
    spec.k = ParseCount(text, "K", value, 2);
    refuse_option();
  } else if (kind == "groups" || kind == "sessions") {
    spec.kind =
        kind == "groups" ? HoldoutKind::kGroups : HoldoutKind::kSessions;
    spec.k = ParseCount(text, "K", value, 2);
    spec.repeats = take_option("repeats", 1);
    // Every fold has its rows in memory, and adds little to what is known.
    constexpr Index kMostRepeats = 1000;
    if (spec.repeats > kMostRepeats) {
      Refuse(text,
             "repeats must be at most " + std::to_string(kMostRepeats) +
                 ", found " + std::to_string(spec.repeats));
    }
  } else if (kind == "blocks") {
    spec.kind = HoldoutKind::kBlocks;
    spec.k = ParseCount(text, "K", value, 2);
    refuse_option();
  } else if (kind == "leave-one-group-out") {
    spec.kind = HoldoutKind::kLeaveOneGroupOut;
    if (colon != std::string_view::npos) Refuse(text, "takes no options");
  } else if (kind == "kfold") {
    spec.kind = HoldoutKind::kKFold;
    spec.k = ParseCount(text, "K", value, 2);
    refuse_option();
  } else if (kind == "forward") {
    spec.kind = HoldoutKind::kForward;
    spec.k = ParseCount(text, "K", value, 1);
    spec.gap = take_option("gap", 0);
  } else if (kind == "random") {
    spec.kind = HoldoutKind::kRandom;
    spec.share = ParseShare(text, value);
    refuse_option();
  } else {
    Refuse(text, "unknown; use " + HoldoutFormsText());
  }
  return spec;
}

std::vector<Fold> MakeFolds(const HoldoutSpec& spec,
                            Index num_rows,
                            const std::vector<Index>& group_codes,
                            std::uint64_t seed) {
  if (!group_codes.empty() &&
      static_cast<Index>(group_codes.size()) != num_rows) {
    throw std::invalid_argument(
        "MakeFolds: " + std::to_string(group_codes.size()) +
        " group codes for " + std::to_string(num_rows) + " rows");
  }
  const Units groups(num_rows, group_codes);
  const auto require_groups = [&](Index needed) {
    if (group_codes.empty()) {
      Refuse(spec.text,
             "there are no groups; give the code of each row's, or hold out "
             "rows (every:3, kfold:5)");
    }
    RequireUnits(spec,
                 groups.count(),
                 needed,
                 "groups",
                 groups.count() >= 2
                     ? "groups:" + std::to_string(groups.count()) +
                           " or leave-one-group-out is possible"
                     : "with one group only rows can be held out (every:3, "
                       "kfold:5), which says nothing about another day");
  };
  std::vector<Fold> folds;
  switch (spec.kind) {
    case HoldoutKind::kEvery: {
      RequireUnits(
          spec, num_rows, spec.k, "rows", "measure more, or use a smaller K");
      std::vector<bool> is_test(static_cast<std::size_t>(num_rows));
      for (Index row = 0; row < num_rows; ++row) {
        is_test[static_cast<std::size_t>(row)] = row % spec.k == spec.k - 1;
      }
      folds.push_back(FoldOf(is_test));
      break;
    }
    case HoldoutKind::kGroups:
      require_groups(spec.k);
      folds = GroupFolds(spec, groups, seed);
      break;
    case HoldoutKind::kSessions:
      RequireUnits(
          spec,
          group_codes.empty() ? 0 : groups.count(),
          spec.k,
          "sessions",
          group_codes.empty()
              ? "give the code of each row's, or hold out rows (blocks:5)"
          : groups.count() >= 2
              ? "sessions:" + std::to_string(groups.count()) + " is possible"
              : "of one run only groups or rows can be held out "
                "(groups:5, blocks:5), which says nothing about "
                "another day");
      folds = GroupFolds(spec, groups, seed);
      break;
    case HoldoutKind::kBlocks:
      RequireUnits(
          spec, num_rows, spec.k, "rows", "measure more, or use a smaller K");
      folds = HoldOutRuns(Units(num_rows, {}), Range(num_rows), spec.k);
      break;
    case HoldoutKind::kLeaveOneGroupOut:
      require_groups(2);
      folds = HoldOutRuns(groups, Range(groups.count()), groups.count());
      break;
    case HoldoutKind::kKFold: {
      RequireUnits(
          spec, num_rows, spec.k, "rows", "measure more, or use a smaller K");
      std::vector<Index> order = Range(num_rows);
      Random random(seed);
      random.Shuffle(order);
      folds = HoldOutRuns(Units(num_rows, {}), order, spec.k);
      break;
    }
    case HoldoutKind::kForward:
      RequireUnits(spec,
                   groups.count(),
                   spec.k + 1,
                   group_codes.empty() ? "rows" : "groups",
                   "measure more, or use a smaller K");
      folds = ForwardFolds(spec, groups);
      break;
    case HoldoutKind::kRandom:
      folds.push_back(RandomFold(spec, num_rows, seed));
      break;
    case HoldoutKind::kFile:
      folds.push_back({Range(num_rows), {}});
      break;
  }
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
