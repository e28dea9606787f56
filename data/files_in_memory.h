#pragma once

#include <map>
#include <memory>
#include <string>

#include "data/csv.h"

namespace errmap::data {

/// Tables and texts that stand for the files of their names in this thread,
/// while it lives: whoever has measurements in memory reads them as if they
/// were in a file. ReadCsv knows the tables, ReadFile the texts.
class FilesInMemory {
 public:
  using Tables = std::map<std::string, std::shared_ptr<const CsvTable>>;
  using Texts = std::map<std::string, std::string>;

  FilesInMemory(Tables tables, Texts texts);
  ~FilesInMemory();
  FilesInMemory(const FilesInMemory&) = delete;
  FilesInMemory& operator=(const FilesInMemory&) = delete;

  /// Null where no such file is in memory.
  static const CsvTable* FindTable(const std::string& name);
  static const std::string* FindText(const std::string& name);

 private:
  Tables tables_;
  Texts texts_;
  const FilesInMemory* outer_;
};

/// SHA-256 of the file: of its bytes, or of a table in memory its names and
/// cells. Throws InputError where it cannot be read.
std::string Sha256OfFile(const std::string& path);

}  // namespace errmap::data
