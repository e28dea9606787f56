#include "models/study/split_file.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "data/formula_text.h"
#include "models/study/row_table.h"

namespace errmap::models {
namespace {

// Lines of one hold-out, by fold.
struct RawHoldout {
  std::string name;
  std::map<Index, stats::Fold> folds;
  std::set<std::pair<Index, Index>> seen;  // (fold, index)
};

Holdout FinishHoldout(RawHoldout raw,
                      const data::Dataset& dataset,
                      const std::string& path) {
  Holdout holdout;
  holdout.name = raw.name;
  for (auto& [number, fold] : raw.folds) {
    if (number != std::ssize(holdout.folds)) {
      throw data::InputError(
          fmt::format("{}: hold-out '{}' has a fold {} but no fold {}; number "
                      "them 0, 1, ...",
                      path,
                      raw.name,
                      number,
                      holdout.folds.size()));
    }
    if (fold.train.empty() || fold.test.empty()) {
      throw data::InputError(
          fmt::format("{}: fold {} of hold-out '{}' has no {} rows",
                      path,
                      number,
                      raw.name,
                      fold.train.empty() ? "train" : "test"));
    }
    std::ranges::sort(fold.train);
    std::ranges::sort(fold.test);
    holdout.folds.push_back(std::move(fold));
  }
  holdout.whole_groups =
      dataset.has_groups() &&
      stats::KeepsWhole(holdout.folds, dataset.groups().codes);
  holdout.whole_sessions =
      dataset.has_sessions() &&
      stats::KeepsWhole(holdout.folds, dataset.session_codes());
  holdout.among_neighbours = !holdout.whole_groups && !holdout.whole_sessions;
  holdout.inner = IsOfSessions(holdout, dataset) ? InnerHoldout::kWholeSessions
                  : holdout.whole_groups         ? InnerHoldout::kWholeGroups
                                                 : InnerHoldout::kRows;
  return holdout;
}

}  // namespace

std::vector<Holdout> ReadSplitFile(const data::CsvTable& file,
                                   const data::Dataset& dataset) {
  const RowTable table(file);
  table.Require({"row", "holdout", "fold", "role"});
  const auto index_by_row = IndexByRow(dataset);
  std::vector<RawHoldout> raw;
  std::map<std::string, std::size_t> place;
  for (std::size_t line = 0; line < table.num_lines(); ++line) {
    const Index row = table.Whole(line, "row");
    const Index fold = table.Whole(line, "fold");
    const std::string name = table.Text(line, "holdout");
    const std::string role = table.Text(line, "role");
    const auto found = index_by_row.find(row);
    if (found == index_by_row.end()) {
      table.Refuse(
          line,
          "row",
          fmt::format(
              "{} has no data row {} in use (0-based)", dataset.source(), row));
    }
    const auto [at, added] = place.emplace(name, raw.size());
    if (added) raw.push_back({name, {}, {}});
    RawHoldout& holdout = raw[at->second];
    if (!holdout.seen.emplace(fold, found->second).second) {
      table.Refuse(
          line,
          "row",
          fmt::format(
              "data row {} stands twice in fold {} of '{}'", row, fold, name));
    }
    stats::Fold& rows = holdout.folds[fold];
    if (role == "train") {
      rows.train.push_back(found->second);
    } else if (role == "test") {
      rows.test.push_back(found->second);
    } else if (role != "unused") {
      table.Refuse(line,
                   "role",
                   fmt::format("'{}' is none of train, test, unused", role));
    }
  }
  std::vector<Holdout> holdouts;
  for (RawHoldout& holdout : raw) {
    holdouts.push_back(FinishHoldout(std::move(holdout), dataset, file.file));
  }
  return holdouts;
}

std::string SplitFileText(const std::vector<Holdout>& holdouts,
                          const data::Dataset& dataset) {
  std::string text = "row,holdout,fold,role\n";
  for (const Holdout& holdout : holdouts) {
    if (holdout.test_data != nullptr) continue;
    for (std::size_t fold = 0; fold < holdout.folds.size(); ++fold) {
      std::vector<const char*> roles(dataset.rows().size(), "unused");
      for (const Index row : holdout.folds[fold].train) {
        roles[static_cast<std::size_t>(row)] = "train";
      }
      for (const Index row : holdout.folds[fold].test) {
        roles[static_cast<std::size_t>(row)] = "test";
      }
      for (std::size_t i = 0; i < roles.size(); ++i) {
        text += fmt::format("{},{},{},{}\n",
                            dataset.rows()[i],
                            data::CsvField(holdout.name),
                            fold,
                            roles[i]);
      }
    }
  }
  return data::MarkedCsv(std::move(text));
}

}  // namespace errmap::models
