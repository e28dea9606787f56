#include "data/files/sqlite.h"

#include <cmath>
#include <fcntl.h>
#include <limits>
#include <new>
#include <sqlite3.h>

#include "data/files/file_descriptor.h"
#include "data/text.h"

namespace errmap::data {
namespace {

constexpr int kPrimary = 0xff;  // of codes, without their extensions

bool LacksMemory(sqlite3* database) {
  if (database == nullptr) return true;
  const int code = sqlite3_extended_errcode(database);
  return code == SQLITE_NOMEM || code == SQLITE_IOERR_NOMEM;
}

// Want of memory is not a fault of the file.
[[noreturn]] void Throw(sqlite3* database) {
  if (LacksMemory(database)) throw std::bad_alloc();
  const int code = sqlite3_errcode(database) & kPrimary;
  if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
    const char* const file = sqlite3_db_filename(database, "main");
    throw DamagedDatabase(file == nullptr ? "" : file,
                          sqlite3_errmsg(database));
  }
  throw SqliteError(sqlite3_errmsg(database),
                    sqlite3_extended_errcode(database),
                    sqlite3_system_errno(database));
}

// A path as it stands in a URI.
std::string Escaped(const std::string& path) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const char c : path) {
    if (c == '%' || c == '?' || c == '#') {
      const auto byte = static_cast<unsigned char>(c);
      text += '%';
      text += kDigits[byte >> 4U];
      text += kDigits[byte & 15U];
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

DamagedDatabase::DamagedDatabase(const std::string& file,
                                 const std::string& why)
    : InputError(PrintablePath(file) + " is damaged (" + why +
                 "); errmap merge STORE rewrites it, and deployed maps are in "
                 "its folder maps") {}

bool SqliteError::is_busy() const { return (code_ & kPrimary) == SQLITE_BUSY; }

bool KnowsLocks(const std::string& path) {
  constexpr mode_t kMode = 0666;  // less the umask
  const FileDescriptor file(
      open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kMode));
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  // As SQLite asks: tests answer in the system's place.
  sqlite3_vfs* const system = sqlite3_vfs_find(nullptr);
  const auto ask = reinterpret_cast<int (*)(int, int, ...)>(
      system->xGetSystemCall(system, "fcntl"));
  return !file.is_open() || ask(file.get(), F_GETLK, &lock) == 0;
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

Statement::Statement(sqlite3* database, std::string_view sql)
    : database_(database) {
  sqlite3_stmt* statement = nullptr;
  Check(sqlite3_prepare_v2(
      database, sql.data(), static_cast<int>(sql.size()), &statement, nullptr));
  statement_.reset(statement);
}

void Statement::Check(int code) const {
  if (code != SQLITE_OK) Throw(database_);
}

void Statement::Reset() {
  sqlite3_reset(statement_.get());
  Check(sqlite3_clear_bindings(statement_.get()));
}

void Statement::Bind(int index, std::int64_t value) {
  Check(sqlite3_bind_int64(statement_.get(), index, value));
}

void Statement::Bind(int index, double value) {
  if (std::isnan(value)) return;
  Check(sqlite3_bind_double(statement_.get(), index, value));
}

void Statement::Bind(int index, std::string_view value) {
  Check(sqlite3_bind_text(statement_.get(),
                          index,
                          value.data(),
                          static_cast<int>(value.size()),
                          SQLITE_TRANSIENT));
}

void Statement::Bind(int index, Blob value) {
  Check(sqlite3_bind_blob(statement_.get(),
                          index,
                          value.bytes.data(),
                          static_cast<int>(value.bytes.size()),
                          SQLITE_TRANSIENT));
}

bool Statement::Next() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) Throw(database_);
  return false;
}

void Statement::Run() {
  while (Next()) {
  }
}

std::string Statement::Text(int column) const {
  const void* const text = sqlite3_column_text(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  if (text == nullptr) {
    if (LacksMemory(database_)) throw std::bad_alloc();
    return "";
  }
  return {static_cast<const char*>(text), static_cast<std::size_t>(size)};
}

double Statement::Number(int column) const {
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return sqlite3_column_double(statement_.get(), column);
}

std::int64_t Statement::Whole(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

void Database::Close::operator()(sqlite3* database) const {
  sqlite3_close(database);
}

Database::Database(const std::string& path, Access access) {
  sqlite3* handle = nullptr;
  const bool only_read = access == Access::kRead;
  const std::string name =
      only_read ? "file:" + Escaped(path) + "?immutable=1" : path;
  const int flags = only_read ? SQLITE_OPEN_READONLY | SQLITE_OPEN_URI
                              : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code = sqlite3_open_v2(name.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) Throw(handle);
  sqlite3_extended_result_codes(handle, 1);
  if (only_read) {
    WholeOf("SELECT count(*) FROM sqlite_schema");  // is it a database?
    return;
  }
  if (access == Access::kShared) {
    constexpr int kPatience = 500;  // ms
    sqlite3_busy_timeout(handle, kPatience);
    return;
  }
  Execute(
      "PRAGMA foreign_keys = ON; PRAGMA journal_mode = MEMORY;"
      "PRAGMA synchronous = OFF; PRAGMA temp_store = MEMORY");
}

void Database::Execute(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) !=
      SQLITE_OK) {
    Throw(handle_.get());
  }
}

std::int64_t Database::WholeOf(std::string_view sql) {
  Statement statement = Prepare(sql);
  return statement.Next() ? statement.Whole(0) : 0;
}

void Database::RequireSound(const std::string& file) {
  Statement check = Prepare("PRAGMA quick_check(1)");
  if (!check.Next() || check.Text(0) == "ok") return;
  throw DamagedDatabase(file, check.Text(0));
}

void Database::CopyFrom(Database* from) {
  sqlite3_backup* const backup =
      sqlite3_backup_init(handle_.get(), "main", from->handle_.get(), "main");
  if (backup == nullptr) Throw(handle_.get());
  sqlite3_backup_step(backup, -1);
  if (sqlite3_backup_finish(backup) != SQLITE_OK) Throw(handle_.get());
}

}  // namespace errmap::data
