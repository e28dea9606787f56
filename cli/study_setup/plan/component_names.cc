#include "cli/study_setup/plan/component_names.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "data/input_error.h"
#include "data/sha256.h"
#include "data/text.h"

namespace errmap::study_setup {
namespace {

// The file of the one part of the table that holds all these rows, else "".
std::string FileOfRows(const data::CsvTable& table,
                       const std::vector<Index>& rows) {
  const auto part_of = [&](Index row) {
    return std::prev(
        std::ranges::upper_bound(table.parts,
                                 static_cast<std::size_t>(row),
                                 {},
                                 &std::pair<std::size_t, std::string>::first));
  };
  const auto [first, last] = std::ranges::minmax(rows);
  const auto part = part_of(first);
  return part == part_of(last) ? part->second : "";
}

std::string DefaultName(const ComponentConfig& component) {
  std::string name = std::filesystem::path(component.data).stem().string();
  for (const data::ColumnFilter& filter : component.selection.where) {
    name += ", " + ValueText(filter);
  }
  return name;
}

// Not hidden.
std::string Visible(std::string name) {
  if (name.starts_with('.')) name.front() = '_';
  return name;
}

}  // namespace

std::vector<std::string> NamesByFile(
    const data::CsvTable& table,
    const std::vector<data::DatasetSelection>& parts) {
  if (table.parts.size() < 2) return {};
  std::vector<std::string> names;
  for (const data::DatasetSelection& part : parts) {
    const std::string file =
        FileOfRows(table, data::MakeDataset(table, part).dataset.rows());
    if (file.empty()) return {};
    names.push_back(std::filesystem::path(file).stem().string());
  }
  const std::set<std::string> different(names.begin(), names.end());
  return different.size() == names.size() ? names : std::vector<std::string>{};
}

std::string SafeName(const std::string& name) {
  constexpr std::size_t kMostLength = 100;
  std::string safe;
  for (const char c : name.substr(0, kMostLength)) {
    const bool is_safe = std::isalnum(static_cast<unsigned char>(c)) != 0 ||
                         c == '.' || c == '=' || c == '+' || c == '-' ||
                         c == '_';
    safe += is_safe ? c : '_';
  }
  return safe;
}

std::string HashedName(const std::string& part, const std::string& name) {
  constexpr std::size_t kHashDigits = 12;
  return Visible(SafeName(part)) + "-" +
         data::Sha256(name).substr(0, kHashDigits);
}

std::string PlainOrHashedName(const std::string& name) {
  const bool is_plain = !name.empty() && Visible(SafeName(name)) == name;
  return is_plain ? name : HashedName(name, name);
}

void NameComponents(StudyConfig* config) {
  std::set<std::string> taken;
  for (ComponentConfig& component : config->components) {
    if (component.name.empty()) component.name = DefaultName(component);
    if (taken.insert(component.name).second) continue;
    throw data::InputError(
        fmt::format("two components are named {}; give each a name of its own",
                    data::QuotedName(component.name)));
  }
}

}  // namespace errmap::study_setup
