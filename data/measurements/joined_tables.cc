#include "data/measurements/joined_tables.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "data/argument_name.h"
#include "data/column_header.h"
#include "data/column_words.h"
#include "data/columns.h"
#include "data/measurements/column_checks.h"
#include "data/measurements/measured_files.h"
#include "data/measurements/merged_log.h"
#include "data/measurements/sessions.h"
#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

// Each file has its own way of writing decimals: a mixture in one is a doubt.
void AppendFile(const CsvColumn& more, CsvColumn* column) {
  const std::ptrdiff_t comma = column->first_decimal_comma;
  const std::ptrdiff_t point = column->first_decimal_point;
  AppendCells(more, column);
  if (more.first_decimal_comma >= 0 && more.first_decimal_point >= 0) return;
  column->first_decimal_comma = comma;
  column->first_decimal_point = point;
}

// The rows of `later` below those of `table`, but for the columns.
void AppendRows(const CsvTable& later, CsvTable* table) {
  for (const auto& [row, line] : later.line_runs) {
    table->line_runs.emplace_back(table->num_rows + row, line);
  }
  table->parts.emplace_back(table->num_rows, later.file);
  table->remarks.insert(
      table->remarks.end(), later.remarks.begin(), later.remarks.end());
  table->titles.insert(
      table->titles.end(), later.titles.begin(), later.titles.end());
  table->num_rows += later.num_rows;
}

CsvTable Begun(const CsvTable& first) {
  CsvTable table;
  table.file = first.file;
  AppendRows(first, &table);
  return table;
}

bool HoldTheSame(const CsvTable& a, const CsvTable& b) {
  if (a.num_rows != b.num_rows || a.columns.size() != b.columns.size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    const CsvColumn& of_a = a.columns[i];
    const CsvColumn& of_b = b.columns[i];
    if (of_a.name != of_b.name || of_a.exceptions != of_b.exceptions ||
        of_a.texts != of_b.texts) {
      return false;
    }
    for (std::size_t row = 0; row < a.num_rows; ++row) {
      // NaN stands where the exceptions are, which are the same.
      if (of_a.values[row] != of_b.values[row] &&
          !std::isnan(of_a.values[row])) {
        return false;
      }
    }
  }
  return true;
}

class Joiner {
 public:
  Joiner(std::vector<CsvTable> tables, const DatasetSelection& selection)
      : tables_(std::move(tables)),
        selection_(selection),
        by_file_(selection.session == kFileColumn) {}

  JoinedTable Join() {
    for (CsvTable& table : tables_) LeaveOutFileColumn(&table);
    for (std::size_t i = 1; i < tables_.size(); ++i) {
      for (const CsvColumn& column : tables_[0].columns) {
        NameLike(column.name, &tables_[i]);
      }
    }
    LeaveOutWhatIsNotInAll();
    FindSessionsOfFiles();
    NameSessions();
    Append();
    return std::move(joined_);
  }

 private:
  const std::string& FileOf(std::size_t i) const { return tables_[i].file; }

  void Note(const std::string& line) {
    if (std::ranges::find(joined_.remarks, line) == joined_.remarks.end()) {
      joined_.remarks.push_back(line);
    }
  }

  // The name is ours to give.
  void LeaveOutFileColumn(CsvTable* table) {
    if (table->Find(kFileColumn) < 0) return;
    std::erase_if(table->columns, [](const CsvColumn& column) {
      return column.name == kFileColumn;
    });
    Note(PrintablePath(table->file) + ": the column " +
         QuotedName(kFileColumn) +
         " is left out, since it distinguishes the files");
  }

  // Gives the column of `table` that is called `name` in other letters or in
  // another unit that name and unit.
  void NameLike(const std::string& name, CsvTable* table) {
    if (table->Find(name) >= 0) return;
    const std::string base = ReadHeader(name).base;
    CsvColumn* found = nullptr;
    for (CsvColumn& column : table->columns) {
      if (!EqualsIgnoringCase(ReadHeader(column.name).base, base)) continue;
      if (tables_[0].Find(column.name) >= 0) continue;  // it is another's
      if (found != nullptr) return;
      found = &column;
    }
    if (found == nullptr) return;
    const Unit from = UnitOfColumn(found->name);
    const Unit to = UnitOfColumn(name);
    if (!AreConvertible(from, to)) {
      throw InputError(PrintablePath(table->file) + ": column " +
                       QuotedName(found->name) + " is not in the unit of " +
                       QuotedName(name) + " in " + PrintablePath(FileOf(0)) +
                       ", nor to be converted; name both with their units");
    }
    const bool converts = from.symbol != to.symbol;
    Note(PrintablePath(table->file) + ": " + QuotedName(found->name) +
         " is read as " + QuotedName(name) +
         (converts ? ", from " + from.symbol + " to " + to.symbol : ""));
    found->name = name;
    if (!converts) return;
    for (double& value : found->values.Own())
      value = Converted(value, from, to);
  }

  bool MayBeLeftOut(const std::string& name) const {
    const auto named = [&](const std::vector<std::string>& names) {
      return std::ranges::find(names, name) != names.end();
    };
    return !StartsWithIgnoringCase(name, "error") &&
           name != selection_.target && name != selection_.weight &&
           name != selection_.group && name != selection_.session &&
           name != selection_.time && !named(selection_.inputs);
  }

  void LeaveOutWhatIsNotInAll() {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < tables_.size(); ++i) {
      for (const CsvColumn& column : tables_[i].columns) {
        const auto lacking = std::ranges::find_if(
            tables_,
            [&](const CsvTable& table) { return table.Find(column.name) < 0; });
        if (lacking == tables_.end()) {
          if (i == 0) names_.push_back(column.name);
          continue;
        }
        if (!MayBeLeftOut(column.name)) {
          throw InputError(
              PrintablePath(lacking->file) + ": no column " +
              QuotedName(column.name) + ", which " + PrintablePath(FileOf(i)) +
              " has; files that are joined measure the same error");
        }
        const std::string line = QuotedName(column.name) + " (not in " +
                                 PrintablePath(lacking->file) + ")";
        if (std::ranges::find(lines, line) == lines.end()) {
          lines.push_back(line);
        }
      }
    }
    if (names_.empty()) {
      throw InputError(PrintablePath(FileOf(1)) + ": no column of it is in " +
                       PrintablePath(FileOf(0)) +
                       ", so the files cannot be joined");
    }
    if (lines.empty()) return;
    constexpr std::size_t kMost = 5;
    Note("columns that not all files have are left out: " +
         ShortList(lines, kMost));
  }

  // A column says where sessions are. A leap of time is a guess, and the file
  // is what somebody calls a day.
  void FindSessionsOfFiles() {
    for (const CsvTable& table : tables_) {
      const std::vector<Index> rows = AllRows(table.num_rows);
      Grouping found;
      if (!by_file_) found = FindSessions(table, selection_, rows).sessions;
      if (found.column.empty()) {
        found.labels = {""};
        found.codes.assign(rows.size(), 0);
      }
      sessions_.push_back(std::move(found));
    }
  }

  // A column that FindSessions would take by its name.
  bool IsTaken(const std::string& column) const {
    if (column.empty()) return false;
    return column == selection_.session || IsCalled(column, Word::kSession) ||
           IsCalled(column, Word::kRun);
  }

  // Whether the session that ends file `i` goes on in the next one: a clock
  // shows no night between, or the cycles count on.
  bool GoesOn(std::size_t i) const {
    const CsvTable& before = tables_[i];
    const CsvTable& after = tables_[i + 1];
    const auto clock_of = [&](const CsvTable& table) {
      return FindClock(table, selection_, AllRows(table.num_rows));
    };
    const Clock ends = clock_of(before);
    const Clock begins = clock_of(after);
    if (ends.is_found() && begins.is_found()) {
      const double pause = begins.time.minCoeff() - ends.time.maxCoeff();
      return pause > 0.0 && pause < kShortestNight;
    }
    for (const std::string& name : names_) {
      if (!IsCalled(name, Word::kCycle)) continue;
      const CsvColumn& last = before.At(before.Find(name));
      const CsvColumn& first = after.At(after.Find(name));
      return last.exceptions.empty() && first.exceptions.empty() &&
             std::ranges::min(std::vector<double>(first.values)) >
                 std::ranges::max(std::vector<double>(last.values));
    }
    return false;
  }

  // Whether one column names all sessions, none of them twice.
  bool AreTold() const {
    const std::string& column = sessions_[0].column;
    std::set<std::string> seen;
    for (std::size_t i = 0; i < sessions_.size(); ++i) {
      const Grouping& sessions = sessions_[i];
      if (sessions.column.empty() || sessions.column != column) return false;
      for (const std::string& label : sessions.labels) {
        if (seen.insert(label).second) continue;
        const bool goes_on = i > 0 && label == sessions.labels.front() &&
                             label == sessions_[i - 1].labels.back() &&
                             GoesOn(i - 1);
        if (!goes_on) return false;
      }
    }
    return true;
  }

  // Files that are counted within a day are of one session.
  std::vector<std::string> Labels() {
    std::vector<std::string> files;
    for (const CsvTable& table : tables_) files.push_back(table.file);
    const bool of_one = std::ranges::all_of(
        sessions_,
        [](const Grouping& sessions) { return sessions.labels.size() == 1; });
    std::vector<std::string> labels = SessionsOfFiles(files);
    const std::set<std::string> distinct(labels.begin(), labels.end());
    if (of_one && distinct.size() > 1 && distinct.size() < labels.size()) {
      Note("the files are read as " + std::to_string(distinct.size()) +
           " sessions, by their names without the last number: " +
           ListOfNames({distinct.begin(), distinct.end()}));
      return labels;
    }
    std::ranges::transform(files, labels.begin(), FileLabel);
    if (std::set(labels.begin(), labels.end()).size() < labels.size()) {
      std::ranges::transform(files, labels.begin(), PrintablePath);
    }
    return labels;
  }

  void NameSessions() {
    if (AreTold()) return;
    const std::vector<std::string> files = Labels();
    std::string column = sessions_[0].column;
    for (const Grouping& sessions : sessions_) {
      if (sessions.column != column) column.clear();
    }
    if (!IsTaken(column)) {
      column = kFileColumn;
      names_.emplace_back(kFileColumn);
    }
    for (std::size_t i = 0; i < tables_.size(); ++i) {
      std::vector<std::string> labels;
      for (const std::string& label : sessions_[i].labels) {
        labels.push_back(sessions_[i].labels.size() == 1
                             ? files[i]
                             : files[i] + ", " + label);
      }
      std::erase_if(tables_[i].columns,
                    [&](const CsvColumn& old) { return old.name == column; });
      tables_[i].columns.push_back(
          WordColumn(column, sessions_[i].codes, labels));
    }
  }

  void Append() {
    joined_.table = Begun(tables_[0]);
    for (std::size_t i = 1; i < tables_.size(); ++i) {
      AppendRows(tables_[i], &joined_.table);
    }
    std::vector<std::string> files;
    for (const CsvTable& table : tables_) files.push_back(table.file);
    joined_.table.file = NamesOfFiles(files);
    for (const std::string& name : names_) {
      CsvColumn column = tables_[0].At(tables_[0].Find(name));
      for (std::size_t i = 1; i < tables_.size(); ++i) {
        AppendFile(tables_[i].At(tables_[i].Find(name)), &column);
      }
      joined_.table.columns.push_back(std::move(column));
    }
  }

  std::vector<CsvTable> tables_;
  const DatasetSelection& selection_;
  bool by_file_;                    // whatever else tells sessions
  std::vector<std::string> names_;  // of the columns that all have
  std::vector<Grouping> sessions_;  // of each file
  JoinedTable joined_;
};

// A file that was saved twice is measured once.
std::vector<std::string> LeaveOutCopies(std::vector<CsvTable>* tables) {
  std::vector<std::string> remarks;
  for (std::size_t i = 1; i < tables->size();) {
    const CsvTable& table = (*tables)[i];
    const auto original = std::ranges::find_if(
        tables->begin(),
        tables->begin() + static_cast<std::ptrdiff_t>(i),
        [&](const CsvTable& before) { return HoldTheSame(before, table); });
    if (original - tables->begin() == static_cast<std::ptrdiff_t>(i)) {
      ++i;
      continue;
    }
    remarks.push_back(PrintablePath(table.file) + ": holds the rows of " +
                      PrintablePath(original->file) +
                      " once more and is left out");
    tables->erase(tables->begin() + static_cast<std::ptrdiff_t>(i));
  }
  return remarks;
}

}  // namespace

JoinedTable JoinTables(std::vector<CsvTable> tables,
                       const DatasetSelection& selection) {
  std::vector<std::string> remarks = LeaveOutCopies(&tables);
  if (tables.size() == 1) {
    return {.table = std::move(tables[0]), .remarks = std::move(remarks)};
  }
  JoinedTable joined = Joiner(std::move(tables), selection).Join();
  joined.remarks.insert(joined.remarks.begin(), remarks.begin(), remarks.end());
  return joined;
}

JoinedTable ReadTables(const std::vector<std::string>& given,
                       const DatasetSelection& selection) {
  const MeasuredFiles files = FindFiles(given);
  std::vector<CsvTable> tables;
  for (const std::string& path : files.paths) {
    tables.push_back(ReadCsv(path, OddRowsFor(selection)));
  }
  JoinedTable joined = JoinTables(std::move(tables), selection);
  if (!selection.with.empty()) {
    MergeLog(ReadCsv(selection.with), selection, &joined.table);
  }
  joined.remarks.insert(
      joined.remarks.begin(), files.remarks.begin(), files.remarks.end());
  return joined;
}

OddRows OddRowsFor(const DatasetSelection& selection) {
  return selection.missing == MissingPolicy::kDropRows ? OddRows::kLeaveOut
                                                       : OddRows::kOffer;
}

void AddFileColumn(const std::string& label, CsvTable* table) {
  std::erase_if(table->columns, [](const CsvColumn& column) {
    return column.name == kFileColumn;
  });
  table->columns.push_back(
      WordColumn(kFileColumn, std::vector<Index>(table->num_rows, 0), {label}));
}

}  // namespace errmap::data
