#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "data/input_error.h"

struct sqlite3;
struct sqlite3_stmt;

namespace errmap::data {

/// An operation of SQLite failed; what() has SQLite's message.
class SqliteError : public std::runtime_error {
 public:
  SqliteError(const std::string& what, int code, int system_error)
      : std::runtime_error(what), code_(code), system_error_(system_error) {}

  int system_error() const { return system_error_; }  // errno, or 0
  /// Another process holds the lock.
  bool is_busy() const;

 private:
  int code_;
  int system_error_;
};

/// True if the file system of `path` supports locks; some network file systems
/// do not. Releases this process's locks on the file.
bool KnowsLocks(const std::string& path);

/// Bytes that are not text, for a parameter.
struct Blob {
  std::string_view bytes;
};

/// The file is damaged or is not a database; what() has the remedy.
class DamagedDatabase : public InputError {
 public:
  DamagedDatabase(const std::string& file, const std::string& why);
};

/// A prepared statement, run once or repeatedly.
class Statement {
 public:
  Statement(sqlite3* database, std::string_view sql);

  /// Sets the parameters, in order; NaN and empty optionals are NULL.
  template <typename... T>
  Statement& With(const T&... values) {
    Reset();
    int index = 0;
    (Bind(++index, values), ...);
    return *this;
  }

  /// Moves to the next row; false at the end. Throws SqliteError.
  bool Next();
  /// Runs the statement to its end.
  void Run();

  std::string Text(int column) const;
  double Number(int column) const;  // NaN where it is NULL
  std::int64_t Whole(int column) const;

 private:
  void Reset();
  void Bind(int index, std::int64_t value);
  void Bind(int index, int value) { Bind(index, std::int64_t{value}); }
  void Bind(int index, bool value) { Bind(index, std::int64_t{value}); }
  void Bind(int index, double value);
  void Bind(int index, std::string_view value);
  void Bind(int index, Blob value);
  void Bind(int index, const std::string& value) {
    Bind(index, std::string_view(value));
  }
  void Bind(int index, const char* value) {
    Bind(index, std::string_view(value));
  }
  template <typename T>
  void Bind(int index, const std::optional<T>& value) {
    if (value) Bind(index, *value);
  }
  void Check(int code) const;

  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// An open database.
class Database {
 public:
  enum class Access {
    /// For a file that is no longer written: takes no locks, and needs only
    /// read permission.
    kRead,
    /// For a private file: writes are not flushed, and after a failed write the
    /// file is useless.
    kPrivate,
    /// For a file that other processes may write at the same time, each change
    /// in a transaction.
    kShared,
  };
  /// Throws SqliteError if the file cannot be opened or is not a database.
  Database(const std::string& path, Access access);

  void Execute(const std::string& sql);
  Statement Prepare(std::string_view sql) { return {handle_.get(), sql}; }
  /// Returns the first value of the first row.
  std::int64_t WholeOf(std::string_view sql);

  /// Throws DamagedDatabase, naming `file`, if its pages are inconsistent.
  void RequireSound(const std::string& file);

  /// Copies all of `from` into this database (backup API).
  void CopyFrom(Database* from);

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> handle_;
};

}  // namespace errmap::data
