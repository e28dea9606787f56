#pragma once

#include <map>
#include <memory>
#include <string>

#include "data/csv.h"

namespace errmap::data {

/// Tables and texts that this thread reads instead of files with their names,
/// during this object's lifetime. ReadCsv finds the tables, ReadFile the texts.
class FilesInMemory {
 public:
  using Tables = std::map<std::string, std::shared_ptr<const CsvTable>>;
  using Texts = std::map<std::string, std::string>;

  FilesInMemory(Tables tables, Texts texts);
  ~FilesInMemory();
  FilesInMemory(const FilesInMemory&) = delete;
  FilesInMemory& operator=(const FilesInMemory&) = delete;

  /// Returns null if there is no such file in memory.
  static const CsvTable* FindTable(const std::string& name);
  static const std::string* FindText(const std::string& name);

 private:
  Tables tables_;
  Texts texts_;
  const FilesInMemory* outer_;
};

/// SHA-256 of the file's bytes, or of the names and cells of a table in memory.
/// Throws InputError if it cannot be read.
std::string Sha256OfFile(const std::string& path);

}  // namespace errmap::data
