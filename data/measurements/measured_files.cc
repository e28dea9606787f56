#include "data/measurements/measured_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string_view>

#include "data/argument_name.h"
#include "data/counted_labels.h"
#include "data/files/sheet_path.h"
#include "data/files_in_memory.h"
#include "data/input_error.h"
#include "data/measurements/column_checks.h"
#include "data/text.h"

namespace errmap::data {
namespace {

namespace fs = std::filesystem;

constexpr const char* kResults = "results.json";

std::string NameWithoutEndings(const std::string& path) {
  if (std::string sheet = SplitSheetPath(path).sheet; !sheet.empty()) {
    return sheet;
  }
  const fs::path name = fs::path(path).filename();
  return (name.extension() == ".gz" ? name.stem() : name).stem().string();
}

// Of eight digits in groups of 4, 2, 2 with one separator or none between.
std::optional<std::string> DateIn(const std::string& name) {
  static const std::regex kDate(
      "(?:^|[^0-9])((?:19|20)[0-9]{2})[-_]?(0[1-9]|1[0-2])"
      "[-_]?(0[1-9]|[12][0-9]|3[01])(?![0-9])");
  std::smatch found;
  if (!std::regex_search(name, found, kDate)) return std::nullopt;
  return found.str(1) + "-" + found.str(2) + "-" + found.str(3);
}

// By the numbers where both have digits, else by the characters.
bool ComesBefore(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  const auto number = [](const std::string& text, std::size_t* at) {
    const std::size_t from = text.find_first_not_of('0', *at);
    while (*at < text.size() && IsDigit(text[*at])) ++*at;
    return from < *at ? text.substr(from, *at - from) : std::string();
  };
  while (i < a.size() && j < b.size()) {
    if (IsDigit(a[i]) && IsDigit(b[j])) {
      const std::string first = number(a, &i);
      const std::string second = number(b, &j);
      if (first == second) continue;
      return first.size() == second.size() ? first < second
                                           : first.size() < second.size();
    }
    if (a[i] != b[j]) return a[i] < b[j];
    ++i;
    ++j;
  }
  return a.size() - i < b.size() - j;
}

void PutInOrder(std::vector<std::string>* paths) {
  std::map<std::string, std::string> by_date;
  for (const std::string& path : *paths) {
    if (const auto date = DateIn(NameWithoutEndings(path))) {
      by_date.emplace(*date, path);
    }
  }
  if (by_date.size() == paths->size()) {
    std::ranges::transform(by_date, paths->begin(), [](const auto& dated) {
      return dated.second;
    });
  } else if (std::ranges::is_sorted(*paths)) {
    // As a shell has them from *.csv; any other order is somebody's own.
    std::ranges::stable_sort(*paths, ComesBefore);
  }
}

bool IsTable(const fs::path& path) {
  constexpr auto kEndings = std::to_array<std::string_view>(
      {".csv", ".tsv", ".csv.gz", ".tsv.gz", ".xlsx", ".xlsm", ".lvm"});
  const std::string name = path.filename().string();
  return std::ranges::any_of(kEndings, [&](std::string_view ending) {
    return name.size() > ending.size() && EndsWithIgnoringCase(name, ending);
  });
}

// What a name says besides dates and numbers: days differ in those only.
std::string KindOf(const std::string& path) {
  constexpr std::string_view kDays =
      "monday tuesday wednesday thursday friday saturday sunday montag "
      "dienstag mittwoch donnerstag freitag samstag sonntag mon tue wed thu "
      "fri sat sun jan feb mar apr may jun jul aug sep oct nov dec";
  std::string kind;
  std::string word;
  for (const char c : NameWithoutEndings(path) + "_") {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      continue;
    }
    if (!word.empty() && !IsOneOf(word, kDays)) {
      kind += word + " ";
    }
    word.clear();
  }
  return kind;
}

std::vector<std::string> TablesOf(const std::string& folder,
                                  std::vector<std::string>* remarks) {
  const std::string shown = PrintablePath(folder);
  std::error_code error;
  std::vector<std::string> tables;
  std::vector<std::string> others;
  std::set<std::string> kinds;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& path = entry->path();
    std::error_code ignored;
    if (path.filename().string().starts_with('.') ||
        !entry->is_regular_file(ignored)) {
      continue;
    }
    if (!IsTable(path) || IsOfComparison(path.string())) {
      others.push_back(path.filename().string());
      continue;
    }
    tables.push_back(path.string());
    kinds.insert(KindOf(path.string()));
  }
  if (error) {
    throw InputError(shown + ": cannot be read: " + error.message());
  }
  const std::string init = "errmap init " + shown;
  if (tables.empty()) {
    if (fs::exists(fs::path(folder) / kResults, error)) {
      throw InputError(shown +
                       ": holds a comparison's results, not measurements; "
                       "errmap report " +
                       shown + " draws its report");
    }
    throw InputError(
        shown +
        ": is a folder without CSV files or spreadsheets; for the files "
        "in folders below it: " +
        init);
  }
  std::ranges::sort(tables);
  if (kinds.size() > 1) {
    throw InputError(
        shown + ": is a folder of several components, by the names of its " +
        std::to_string(tables.size()) + " files; map each: " + init +
        " writes a study of them. If they are days of one: errmap compare " +
        shown + "/*");
  }
  if (!others.empty()) {
    std::ranges::sort(others);
    remarks->push_back(shown + ": left out, since they are not measurements: " +
                       ListOfNames(others));
  }
  return tables;
}

}  // namespace

bool IsOfComparison(const std::string& table) {
  fs::path folder = fs::path(table).parent_path();
  if (folder.filename() == "residuals") {
    folder = folder.parent_path();
  } else if (fs::path(table).filename() != "residuals.csv") {
    return false;
  }
  std::error_code ignored;
  return fs::exists(folder / kResults, ignored);
}

MeasuredFiles FindFiles(const std::vector<std::string>& given) {
  MeasuredFiles found;
  for (const std::string& path : given) {
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) {
      // A word of a list that was parted by a blank.
      if (given.size() > 1 && path.find_first_of("./") == path.npos &&
          !fs::exists(path, ignored) &&
          FilesInMemory::FindTable(path) == nullptr) {
        throw InputError(PrintablePath(path) +
                         ": cannot be read: there is no such file; write "
                         "lists (A,B) and numbers with a unit (2um) without "
                         "blanks");
      }
      if (path.ends_with(".toml")) {
        throw InputError(PrintablePath(path) +
                         ": is not a table; errmap compare takes a study file "
                         "with " +
                         ArgumentName("config") + ", a machine with " +
                         ArgumentName("machine"));
      }
      if (IsOfComparison(path)) {
        throw InputError(
            PrintablePath(path) +
            ": holds the residuals of a comparison's maps, not measurements");
      }
      found.paths.push_back(path);
      continue;
    }
    const std::vector<std::string> tables = TablesOf(path, &found.remarks);
    found.paths.insert(found.paths.end(), tables.begin(), tables.end());
  }
  std::set<std::string> seen;
  for (const std::string& path : found.paths) {
    // Packed by gzip it holds the same rows.
    fs::path unpacked = fs::path(path).lexically_normal();
    if (unpacked.extension() == ".gz") unpacked.replace_extension();
    if (seen.insert(unpacked.string()).second) continue;
    throw InputError(PrintablePath(path) +
                     ": is named twice; its rows would count twice");
  }
  if (found.paths.size() > 1) PutInOrder(&found.paths);
  return found;
}

std::string FileLabel(const std::string& path) {
  const std::string name = NameWithoutEndings(path);
  return DateIn(name).value_or(name);
}

std::vector<std::string> SessionsOfFiles(
    const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  std::vector<std::string> labels;
  bool alike = true;
  bool by_date = true;
  for (const std::string& path : paths) {
    names.push_back(NameWithoutEndings(path));
    labels.push_back(FileLabel(path));
    alike = alike && LessNumbers(names.back()) == LessNumbers(names.front());
    by_date = by_date && alike && DateIn(names.back());
  }
  if (by_date || !alike) return labels;
  const std::vector<std::string> prefixes = SessionsOfCounted(names);
  return prefixes.empty() ? labels : prefixes;
}

std::string NamesOfFiles(const std::vector<std::string>& paths) {
  constexpr std::size_t kMostNamed = 3;
  const std::size_t named = paths.size() > kMostNamed ? 1 : paths.size();
  return ShortList(paths, named);
}

}  // namespace errmap::data
