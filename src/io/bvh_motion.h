// SPDX-License-Identifier: MIT
// The numbers of a BVH file: rows of text to values, and values to poses.
#pragma once

#include "bvh_header.h"
#include "bvh_text.h"

#include <array>
#include <cstddef>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/io/bvh.h>
#include <strut/motion/motion.h>

namespace strut::io::detail {

/// Where a joint's values stand in a row, and what they turn about.
struct JointColumns {
  std::array<int, 3> position = {-1, -1, -1};  ///< columns of X, Y and Z position; -1 where there is none
  std::array<int, 3> rotation = {-1, -1, -1};  ///< columns of the rotations in their order; -1 from num_rotations on
  std::array<int, 3> axis = {0, 1, 2};         ///< the axis (0 X, 1 Y, 2 Z) of each; without channels, the axes left
  int num_rotations = 0;

  [[nodiscard]] bool has_position() const { return position[0] >= 0 || position[1] >= 0 || position[2] >= 0; }
};

/// The columns of every joint.
std::vector<JointColumns> columns_of(const std::vector<std::vector<BvhChannel>>& channels);

/// The rotation of intrinsic turns by `angles` [rad] about `axes`, a permutation of the three.
Eigen::Quaterniond rotation_from_angles(const std::array<double, 3>& angles, const std::array<int, 3>& axes);

/// The angles [rad] of one joint in a row of values.
std::array<double, 3> angles_in(const double* row, const JointColumns& columns);

/// Reads one row after another from behind the header on. What it is given must outlive it.
class BvhRows {
 public:
  BvhRows(BvhCursor& cursor, const BvhHeader& header, Diagnostics* diagnostics);

  /// Appends the next whole row's header.num_channels values; false at the end, where a wrong count and a cut row are
  /// reported. Throws ParseError. Where text comes line by line, those behind the row are not waited for.
  bool next(std::vector<double>& values);
  [[nodiscard]] long long num_rows() const noexcept { return num_rows_; }

 private:
  void skip_to_row();
  bool parse_row(std::vector<double>& values);
  [[nodiscard]] bool is_cut_off(std::size_t column);
  void report_cut_row(std::size_t row_begin, std::size_t column);
  [[noreturn]] void fail_short(std::size_t column);
  double parse_unusual(std::size_t column);
  void report_count();

  BvhCursor& cursor_;
  const BvhHeader& header_;
  Diagnostics* diagnostics_;
  std::size_t num_channels_;
  long long num_rows_ = 0;
  bool at_end_ = false;
};

/// Writes one row to `pose`, in the file's unit and axes. `joints`: with OFFSETs in the same.
void pose_from_row(const double* row, const std::vector<JointColumns>& columns, const std::vector<Joint>& joints,
                   PositionChannels positions, Pose& pose);

/// A vector in the file's axes turned so that Y is up, and back.
inline Eigen::Vector3d to_y_up(const Eigen::Vector3d& v, UpAxis up) {
  return up == UpAxis::kY ? v : Eigen::Vector3d(v.x(), v.z(), -v.y());
}
inline Eigen::Vector3d from_y_up(const Eigen::Vector3d& v, UpAxis up) {
  return up == UpAxis::kY ? v : Eigen::Vector3d(v.x(), -v.z(), v.y());
}
/// The same for a rotation, seen from the turned axes.
inline Eigen::Quaterniond to_y_up(const Eigen::Quaterniond& q, UpAxis up) {
  return up == UpAxis::kY ? q : Eigen::Quaterniond(q.w(), q.x(), q.z(), -q.y());
}
inline Eigen::Quaterniond from_y_up(const Eigen::Quaterniond& q, UpAxis up) {
  return up == UpAxis::kY ? q : Eigen::Quaterniond(q.w(), q.x(), -q.z(), q.y());
}

}  // namespace strut::io::detail
