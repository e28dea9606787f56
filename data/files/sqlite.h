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

/// SQLite says that something cannot be done; what() says what, in its words.
class SqliteError : public std::runtime_error {
 public:
  SqliteError(const std::string& what, int code, int system_error)
      : std::runtime_error(what), code_(code), system_error_(system_error) {}

  int system_error() const { return system_error_; }  // errno, or 0
  /// Another process has it.
  bool is_busy() const;

 private:
  int code_;
  int system_error_;
};

/// Whether the file system of `path` knows locks; not so some that are mounted
/// over a network. Gives up what locks this process has on the file.
bool KnowsLocks(const std::string& path);

/// Bytes that are no text, for a parameter.
struct Blob {
  std::string_view bytes;
};

/// The file is damaged, or no database at all: what to do stands in what().
class DamagedDatabase : public InputError {
 public:
  DamagedDatabase(const std::string& file, const std::string& why);
};

/// A prepared statement, run once or again and again.
class Statement {
 public:
  Statement(sqlite3* database, std::string_view sql);

  /// Values of the parameters, in order; NaN and empty optionals are NULL.
  template <typename... T>
  Statement& With(const T&... values) {
    Reset();
    int index = 0;
    (Bind(++index, values), ...);
    return *this;
  }

  /// Goes to the next row; false at the end. Throws SqliteError.
  bool Next();
  /// Runs to the end.
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
    /// A file that nobody writes into any more: no locks are taken, and the
    /// right to read it is all that is needed.
    kRead,
    /// A file that nobody else knows of: what is written is not flushed, and of
    /// a write that fails the whole file is worth nothing.
    kPrivate,
    /// A file that other processes may write into at the same time, each change
    /// by a transaction.
    kShared,
  };
  /// Throws SqliteError where it cannot be opened or is no database.
  Database(const std::string& path, Access access);

  void Execute(const std::string& sql);
  Statement Prepare(std::string_view sql) { return {handle_.get(), sql}; }
  /// The first value of the first row.
  std::int64_t WholeOf(std::string_view sql);

  /// Throws DamagedDatabase, of `file`, where a page does not fit the others.
  void RequireSound(const std::string& file);

  /// Copies all of `from` here (backup API).
  void CopyFrom(Database* from);

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> handle_;
};

}  // namespace errmap::data
