// SPDX-License-Identifier: MIT
// SQLite as the fragment database uses it: one connection, statements that end with their scope, nested transactions,
// and SQLite's complaints turned into strut's errors about the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace strut::effort {

/// A prepared statement. Columns and parameters count from 0.
class Statement {
 public:
  Statement(sqlite3* connection, const std::string& path, std::string_view sql);
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement();

  Statement& bind(int parameter, std::int64_t number);
  Statement& bind(int parameter, int number) { return bind(parameter, std::int64_t{number}); }
  Statement& bind(int parameter, double number);  ///< NaN becomes NULL
  Statement& bind(int parameter, std::string_view text);
  Statement& bind(int parameter, const char* text) { return bind(parameter, std::string_view(text)); }
  Statement& bind(int parameter, const std::string& text) { return bind(parameter, std::string_view(text)); }
  Statement& bind_blob(int parameter, std::span<const std::byte> bytes);
  Statement& bind_null(int parameter);

  /// The next row; false at the end.
  bool next();
  /// Runs it to its end and makes it ready for other parameters.
  void run();
  /// Makes it ready to be run again.
  void reset();

  [[nodiscard]] std::int64_t integer(int column) const;
  [[nodiscard]] double number(int column) const;  ///< NULL becomes NaN
  [[nodiscard]] std::string text(int column) const;
  [[nodiscard]] std::span<const std::byte> blob(int column) const;  ///< valid until the next row
  [[nodiscard]] bool is_null(int column) const;

 private:
  void check(int code) const;

  sqlite3* connection_;
  const std::string& path_;
  sqlite3_stmt* statement_ = nullptr;
};

/// An open database file.
class Connection {
 public:
  /// Throws FileError if the file cannot be opened so. ":memory:" is one without a file.
  Connection(const std::string& path, bool writable);
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  ~Connection();

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] Statement prepare(std::string_view sql) const { return {connection_, path_, sql}; }
  /// Whether it can be read: not if a crash left a journal that a connection for reading may not play back.
  [[nodiscard]] bool is_readable() const;
  void execute(const std::string& sql) const;
  [[nodiscard]] std::int64_t last_id() const;
  /// Rows that the last statement changed.
  [[nodiscard]] int changes() const;

  /// The whole database as the bytes of its file.
  [[nodiscard]] std::string bytes() const;

  /// A transaction, or a savepoint inside another; returns its depth, from 1.
  int begin();
  void commit();
  void roll_back() noexcept;

 private:
  std::string path_;
  sqlite3* connection_ = nullptr;
  int depth_ = 0;
};

/// A change that is undone unless it is committed.
class Change {
 public:
  explicit Change(Connection& connection) : connection_(connection) { connection_.begin(); }
  Change(const Change&) = delete;
  Change& operator=(const Change&) = delete;
  ~Change() {
    if (!committed_) connection_.roll_back();
  }
  void commit() {
    connection_.commit();
    committed_ = true;
  }

 private:
  Connection& connection_;
  bool committed_ = false;
};

}  // namespace strut::effort
