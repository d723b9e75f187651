// SPDX-License-Identifier: MIT
// A rollback journal and full synchronization: the database is one file, and a crash of program or machine leaves every
// committed transaction and no part of another. (Write-ahead logging would write faster, but leave two more files
// beside the database that must not be lost when it is copied.)
#include "effort/sqlite_connection.h"

#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <sqlite3.h>

#include <strut/core/error.h>

namespace strut::effort {
namespace {

constexpr int kBusyMilliseconds = 5000;

[[noreturn]] void fail(sqlite3* connection, int code, const std::string& path) {
  const std::string said = connection != nullptr ? sqlite3_errmsg(connection) : sqlite3_errstr(code);
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw FileError(FileAction::kWrite, path, "another program is writing to it", "try again when that is done");
    case SQLITE_NOTADB:
    case SQLITE_CORRUPT:
    case SQLITE_ERROR:
    case SQLITE_MISMATCH:
      throw ParseError(path, 0, 0, "an intact fragment database", said, "take an earlier copy of it");
    case SQLITE_READONLY:
      throw FileError(FileAction::kWrite, path, "it may only be read");
    case SQLITE_FULL:
      throw FileError(FileAction::kWrite, path, "cannot write: the disk is full");
    case SQLITE_NOMEM:
      throw std::bad_alloc();
    default:
      throw FileError(FileAction::kRead, path, said);
  }
}

}  // namespace

Statement::Statement(sqlite3* connection, const std::string& path, std::string_view sql)
    : connection_(connection), path_(path) {
  check(sqlite3_prepare_v2(connection, sql.data(), static_cast<int>(sql.size()), &statement_, nullptr));
}
Statement::~Statement() {
  sqlite3_finalize(statement_);
}
void Statement::check(int code) const {
  if (code != SQLITE_OK) fail(connection_, code, path_);
}

Statement& Statement::bind(int parameter, std::int64_t number) {
  check(sqlite3_bind_int64(statement_, parameter + 1, number));
  return *this;
}
Statement& Statement::bind(int parameter, double number) {
  if (std::isnan(number)) return bind_null(parameter);
  check(sqlite3_bind_double(statement_, parameter + 1, number));
  return *this;
}
Statement& Statement::bind(int parameter, std::string_view text) {
  // A null pointer would be NULL, not an empty text.
  const char* data = text.data() == nullptr ? "" : text.data();
  check(sqlite3_bind_text(statement_, parameter + 1, data, static_cast<int>(text.size()), SQLITE_TRANSIENT));
  return *this;
}
Statement& Statement::bind_blob(int parameter, std::span<const std::byte> bytes) {
  check(sqlite3_bind_blob64(statement_, parameter + 1, bytes.empty() ? "" : static_cast<const void*>(bytes.data()),
                            bytes.size(), SQLITE_TRANSIENT));
  return *this;
}
Statement& Statement::bind_null(int parameter) {
  check(sqlite3_bind_null(statement_, parameter + 1));
  return *this;
}

bool Statement::next() {
  const int code = sqlite3_step(statement_);
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) fail(connection_, code, path_);
  return false;
}
void Statement::run() {
  while (next()) {
  }
  reset();
}
void Statement::reset() {
  check(sqlite3_reset(statement_));
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_, column);
}
double Statement::number(int column) const {
  return is_null(column) ? std::numeric_limits<double>::quiet_NaN() : sqlite3_column_double(statement_, column);
}
std::string Statement::text(int column) const {
  const auto* data = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
  return data == nullptr ? std::string()
                         : std::string(data, static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)));
}
std::span<const std::byte> Statement::blob(int column) const {
  const auto* data = static_cast<const std::byte*>(sqlite3_column_blob(statement_, column));
  return {data, data == nullptr ? 0 : static_cast<std::size_t>(sqlite3_column_bytes(statement_, column))};
}
bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_, column) == SQLITE_NULL;
}

Connection::Connection(const std::string& path, bool writable) : path_(path) {
  const int mode = (writable ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READONLY) | SQLITE_OPEN_FULLMUTEX;
  const int code = sqlite3_open_v2(path.c_str(), &connection_, mode, nullptr);
  if (code != SQLITE_OK) {
    const int reason = connection_ == nullptr ? 0 : sqlite3_system_errno(connection_);
    sqlite3_close(connection_);
    throw FileError(writable ? FileAction::kWrite : FileAction::kRead, path,
                    reason == 0 ? sqlite3_errstr(code) : std::strerror(reason));
  }
  sqlite3_busy_timeout(connection_, kBusyMilliseconds);
  // A file may come from anywhere: its schema is not to run anything.
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(connection_, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  if (!writable) return;
  try {
    execute("PRAGMA foreign_keys = ON");
    execute("PRAGMA synchronous = FULL");
  } catch (...) {
    sqlite3_close(connection_);
    throw;
  }
}

Connection::~Connection() {
  sqlite3_close(connection_);
}

bool Connection::is_readable() const {
  const int code = sqlite3_exec(connection_, "SELECT 1 FROM sqlite_schema", nullptr, nullptr, nullptr);
  // The journal may be seen as a lock or as a refusal to write, depending on the file system.
  return (code & 0xff) != SQLITE_READONLY && code != SQLITE_CANTOPEN;
}
void Connection::execute(const std::string& sql) const {
  const int code = sqlite3_exec(connection_, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(connection_, code, path_);
}
std::int64_t Connection::last_id() const {
  return sqlite3_last_insert_rowid(connection_);
}
int Connection::changes() const {
  return sqlite3_changes(connection_);
}

std::string Connection::bytes() const {
  sqlite3_int64 size = 0;
  const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> data(sqlite3_serialize(connection_, "main", &size, 0),
                                                                     &sqlite3_free);
  if (!data) throw std::bad_alloc();
  return {reinterpret_cast<const char*>(data.get()), static_cast<std::size_t>(size)};
}

int Connection::begin() {
  execute(depth_ == 0 ? "BEGIN IMMEDIATE" : "SAVEPOINT level" + std::to_string(depth_));
  return ++depth_;
}
void Connection::commit() {
  execute(depth_ == 1 ? "COMMIT" : "RELEASE level" + std::to_string(depth_ - 1));
  --depth_;
}
void Connection::roll_back() noexcept {
  --depth_;
  const std::string level = "level" + std::to_string(depth_);
  const std::string sql = depth_ == 0 ? "ROLLBACK" : "ROLLBACK TO " + level + "; RELEASE " + level;
  // It fails only where SQLite has rolled back by itself.
  sqlite3_exec(connection_, sql.c_str(), nullptr, nullptr, nullptr);
}

}  // namespace strut::effort
