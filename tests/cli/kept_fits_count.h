#pragma once

#include <cstddef>
#include <filesystem>
#include <sqlite3.h>
#include <string>

namespace errmap {

// Fits in a file of kept fits, which another process may be writing: 0 where it
// cannot be read.
inline std::ptrdiff_t NumRowsOf(const std::filesystem::path& file) {
  const std::string name = "file:" + file.string() + "?immutable=1";
  sqlite3* database = nullptr;
  sqlite3_stmt* query = nullptr;
  std::ptrdiff_t count = 0;
  if (sqlite3_open_v2(name.c_str(),
                      &database,
                      SQLITE_OPEN_READONLY | SQLITE_OPEN_URI,
                      nullptr) == SQLITE_OK &&
      sqlite3_prepare_v2(
          database, "SELECT count(*) FROM fit", -1, &query, nullptr) ==
          SQLITE_OK &&
      sqlite3_step(query) == SQLITE_ROW) {
    count = sqlite3_column_int64(query, 0);
  }
  sqlite3_finalize(query);
  sqlite3_close(database);
  return count;
}

}  // namespace errmap
