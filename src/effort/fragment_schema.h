// SPDX-License-Identifier: MIT
// The tables of a fragment database. docs/formats.md describes them; a change of meaning raises kFormatVersion.
#pragma once

namespace strut::effort {

inline constexpr int kFormatVersion = 1;                ///< SQLite's user_version
inline constexpr unsigned kApplicationId = 0x53746546;  ///< "SteF", SQLite's application_id

inline constexpr const char* kSchema = R"sql(
PRAGMA page_size = 8192;
PRAGMA application_id = 1400137030;
PRAGMA user_version = 1;
CREATE TABLE meta(key TEXT PRIMARY KEY, value NOT NULL) WITHOUT ROWID;
CREATE TABLE joints(joint INTEGER PRIMARY KEY, name TEXT NOT NULL, parent INTEGER NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, z REAL NOT NULL, end_x REAL, end_y REAL, end_z REAL);
CREATE TABLE clips(id INTEGER PRIMARY KEY AUTOINCREMENT, name TEXT NOT NULL UNIQUE CHECK(name <> ''),
  performer TEXT NOT NULL, action TEXT NOT NULL, frames INTEGER NOT NULL CHECK(frames > 0),
  rest BLOB NOT NULL, moving BLOB NOT NULL);
CREATE TABLE chunks(clip INTEGER NOT NULL REFERENCES clips ON DELETE CASCADE, chunk INTEGER NOT NULL,
  frames BLOB NOT NULL, UNIQUE(clip, chunk));
CREATE TABLE fragments(id INTEGER PRIMARY KEY AUTOINCREMENT, clip INTEGER NOT NULL REFERENCES clips ON DELETE CASCADE,
  begin_frame INTEGER NOT NULL CHECK(begin_frame >= 0), end_frame INTEGER NOT NULL CHECK(end_frame > begin_frame),
  cut_by TEXT NOT NULL CHECK(cut_by IN ('suggestion', 'person')), content INTEGER CHECK(content >= 0),
  UNIQUE(clip, begin_frame, end_frame));
CREATE TABLE pairs(first INTEGER NOT NULL REFERENCES fragments ON DELETE CASCADE,
  second INTEGER NOT NULL REFERENCES fragments ON DELETE CASCADE, cost REAL, share_at_limit REAL,
  accepted INTEGER NOT NULL CHECK(accepted IN (0, 1)), PRIMARY KEY(first, second), CHECK(first < second)) WITHOUT ROWID;
CREATE INDEX pairs_by_second ON pairs(second);
CREATE TABLE decisions(first INTEGER NOT NULL REFERENCES fragments ON DELETE CASCADE,
  second INTEGER NOT NULL REFERENCES fragments ON DELETE CASCADE,
  accepted INTEGER NOT NULL CHECK(accepted IN (0, 1)), PRIMARY KEY(first, second), CHECK(first < second)) WITHOUT ROWID;
CREATE INDEX decisions_by_second ON decisions(second);
CREATE TABLE blends(id INTEGER PRIMARY KEY AUTOINCREMENT,
  first INTEGER NOT NULL REFERENCES fragments ON DELETE CASCADE,
  second INTEGER NOT NULL REFERENCES fragments ON DELETE CASCADE,
  alpha REAL NOT NULL, UNIQUE(first, second, alpha), CHECK(first <> second));
CREATE INDEX blends_by_second ON blends(second);
CREATE TABLE labels(id INTEGER PRIMARY KEY AUTOINCREMENT, fragment INTEGER REFERENCES fragments ON DELETE CASCADE,
  blend INTEGER REFERENCES blends ON DELETE CASCADE, rater TEXT NOT NULL CHECK(rater <> ''),
  labelled_at TEXT NOT NULL, source TEXT NOT NULL CHECK(source IN ('person', 'synthetic')),
  flow REAL CHECK(flow BETWEEN -1 AND 1), weight REAL CHECK(weight BETWEEN -1 AND 1),
  time REAL CHECK(time BETWEEN -1 AND 1), space REAL CHECK(space BETWEEN -1 AND 1),
  not_present INTEGER NOT NULL CHECK(not_present BETWEEN 0 AND 15), repeat INTEGER NOT NULL CHECK(repeat IN (0, 1)),
  comment TEXT NOT NULL, CHECK((fragment IS NULL) <> (blend IS NULL)),
  UNIQUE(fragment, rater, labelled_at), UNIQUE(blend, rater, labelled_at));
CREATE TABLE estimates(fragment INTEGER PRIMARY KEY REFERENCES fragments ON DELETE CASCADE,
  flow REAL CHECK(flow BETWEEN -1 AND 1), weight REAL CHECK(weight BETWEEN -1 AND 1),
  time REAL CHECK(time BETWEEN -1 AND 1),
  flow_confidence REAL NOT NULL, weight_confidence REAL NOT NULL, time_confidence REAL NOT NULL);
)sql";

}  // namespace strut::effort
