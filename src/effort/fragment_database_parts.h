// SPDX-License-Identifier: MIT
// What a FragmentDatabase is made of, and what its functions share in checking: fragment_database.cpp holds clips and
// fragments, fragment_database_labels.cpp what is said of them.
#pragma once

#include "effort/sqlite_connection.h"

#include <memory>
#include <set>
#include <string>

#include <strut/effort/fragment_database.h>

namespace strut::effort {

struct FragmentDatabase::Parts {
  Parts(const std::string& path, Access access) : connection(path, access == Access::kReadWrite) {}

  // Const functions of the database read through it.
  mutable Connection connection;
  std::shared_ptr<const Skeleton> skeleton;
  double frame_rate = 0.0;

  /// The ids in the table `fragments` or `blends`.
  [[nodiscard]] std::set<RecordId> ids_of(const char* table) const {
    std::set<RecordId> ids;
    Statement all = connection.prepare(std::string("SELECT id FROM ") + table);
    while (all.next()) ids.insert(ids.end(), all.integer(0));
    return ids;
  }
};

}  // namespace strut::effort
