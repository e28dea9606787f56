#include "cli/fleet/store/store_folder.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "cli/study_setup/plan/component_names.h"
#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/tables/text/gzip.h"
#include "data/text.h"
#include "data/throwing_as.h"
#include "models/record_json.h"

namespace errmap::fleet {

namespace fs = std::filesystem;

namespace {

// The rows of a data set that are not among `held_out`.
std::vector<std::int64_t> Others(const std::vector<std::int64_t>& all,
                                 const std::vector<std::int64_t>& held_out) {
  std::vector<std::int64_t> sorted = held_out;
  std::ranges::sort(sorted);
  std::vector<std::int64_t> others;
  std::ranges::set_difference(all, sorted, std::back_inserter(others));
  return others;
}

// All rows of a hold-out that is no other file's: those held out in some fold,
// or trained on in the first.
std::vector<std::int64_t> RowsOf(const models::HoldoutRecord& holdout) {
  std::vector<std::int64_t> rows;
  for (const models::RowsOfFolds* lists :
       {&holdout.test_rows, &holdout.train_rows}) {
    for (const auto& list : *lists) {
      rows.insert(rows.end(), list.begin(), list.end());
    }
  }
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

}  // namespace

std::string StorePaths::In(const std::string& name) const {
  return (fs::path(store) / name).string();
}

std::string StorePaths::FolderOf(const std::string& component) const {
  std::string flat = "components/" + study_setup::PlainOrHashedName(component);
  const std::size_t slash = component.find('/');
  const std::string machine = component.substr(0, slash);
  std::error_code ignored;
  if (slash == component.npos ||
      study_setup::PlainOrHashedName(machine) != machine ||
      fs::exists(fs::path(store) / flat, ignored)) {
    return flat;
  }
  return "components/" + machine + "/" +
         study_setup::HashedName(component.substr(slash + 1), component);
}

bool IsStore(const std::string& folder) {
  std::error_code ignored;
  return fs::is_regular_file(StorePaths{folder}.Fleet(), ignored);
}

FleetRecord ReadFleet(const StorePaths& paths) {
  std::error_code ignored;
  if (!IsStore(paths.store)) {
    throw data::InputError(
        fmt::format("{} is not a store; errmap compare --config STUDY --out "
                    "STORE makes one",
                    data::PrintablePath(paths.store)));
  }
  const std::string text =
      data::ReadFile(paths.Fleet(), data::kMostTextOfPrograms);
  return data::ThrowingAs<data::InputError, data::InputError>(
      data::PrintablePath(paths.Fleet()) + ": ", [&] {
        return models::RecordFromText<FleetRecord>(
            text,
            FleetRecord().schema,
            "errmap compare with the same study and store rewrites it");
      });
}

void WriteFleet(const StorePaths& paths, const FleetRecord& fleet) {
  constexpr int kIndent = 1;
  const std::string text = models::JsonText(fleet, kIndent) + "\n";
  if (IsStore(paths.store) && data::ReadFile(paths.Fleet()) == text) return;
  data::WriteFileAtomically(paths.Fleet(), text);
}

std::string WhyNoMap(const std::string& component, const std::string& why) {
  return fmt::format("{} has no results and no map, since it failed: {}",
                     data::QuotedName(component),
                     why);
}

std::optional<ComponentSummary> FindSummary(const StorePaths& paths,
                                            const std::string& component) {
  const std::string path = paths.InFolder(component, kSummaryFile);
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return std::nullopt;
  try {
    return SummaryFromJsonText(data::ReadFile(path, data::kMostTextOfPeople));
  } catch (const data::InputError&) {
    return std::nullopt;  // torn by somebody else
  }
}

models::StudyRecord ReadResultsOf(const StorePaths& paths,
                                  const std::string& component) {
  const auto summary = FindSummary(paths, component);
  if (summary && summary->why) {
    throw data::InputError(WhyNoMap(component, *summary->why));
  }
  if (summary && summary->ways) {
    throw data::InputError(
        fmt::format("{} was measured in both directions; its components are {}",
                    data::QuotedName(component),
                    data::ListOfNames(*summary->ways)));
  }
  const std::string path = paths.InFolder(component, kResultsFile);
  const std::string compressed = data::ReadFile(path);
  try {
    models::StudyRecord record = models::FromStoredJsonText(
        data::Gunzip(compressed, data::kMostTextOfPrograms));
    for (models::ComponentRecord& of : record.components) {
      for (models::HoldoutRecord& holdout : of.holdouts) {
        if (holdout.another_file || !holdout.train_rows.empty()) continue;
        const std::vector<std::int64_t> all = RowsOf(holdout);
        for (const auto& held_out : holdout.test_rows) {
          holdout.train_rows.push_back(Others(all, held_out));
        }
      }
    }
    return record;
  } catch (const data::InputError& error) {
    throw data::InputError(data::PrintablePath(path) + ": " + error.what());
  }
}

}  // namespace errmap::fleet
