// SPDX-License-Identifier: MIT
// Every number is read once, straight into the caller's array.
#include "bvh_motion.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <system_error>

namespace strut::io::detail {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

JointColumns columns_of_joint(const std::vector<BvhChannel>& channels, int first_column) {
  JointColumns columns;
  std::array<bool, 3> is_used = {};
  for (const BvhChannel channel : channels) {
    const auto axis = static_cast<std::size_t>(channel) % 3;
    if (channel < BvhChannel::kXRotation) {
      columns.position[axis] = first_column++;
      continue;
    }
    const auto place = static_cast<std::size_t>(columns.num_rotations++);
    columns.rotation[place] = first_column++;
    columns.axis[place] = static_cast<int>(axis);
    is_used[axis] = true;
  }
  auto place = static_cast<std::size_t>(columns.num_rotations);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!is_used[axis]) columns.axis[place++] = static_cast<int>(axis);
  }
  return columns;
}

}  // namespace

std::vector<JointColumns> columns_of(const std::vector<std::vector<BvhChannel>>& channels) {
  std::vector<JointColumns> columns;
  int first_column = 0;
  for (const auto& joint_channels : channels) {
    columns.push_back(columns_of_joint(joint_channels, first_column));
    first_column += static_cast<int>(joint_channels.size());
  }
  return columns;
}

Eigen::Quaterniond rotation_from_angles(const std::array<double, 3>& angles, const std::array<int, 3>& axes) {
  const double s0 = std::sin(0.5 * angles[0]), c0 = std::cos(0.5 * angles[0]);
  const double s1 = std::sin(0.5 * angles[1]), c1 = std::cos(0.5 * angles[1]);
  const double s2 = std::sin(0.5 * angles[2]), c2 = std::cos(0.5 * angles[2]);
  const double parity = (axes[1] - axes[0] + 3) % 3 == 1 ? 1.0 : -1.0;
  Eigen::Quaterniond q;
  q.w() = c0 * c1 * c2 - parity * s0 * s1 * s2;
  q.coeffs()[axes[0]] = s0 * c1 * c2 + parity * c0 * s1 * s2;
  q.coeffs()[axes[1]] = c0 * s1 * c2 - parity * s0 * c1 * s2;
  q.coeffs()[axes[2]] = c0 * c1 * s2 + parity * s0 * s1 * c2;
  return q;
}

std::array<double, 3> angles_in(const double* row, const JointColumns& columns) {
  std::array<double, 3> angles = {};
  for (std::size_t i = 0; i < 3; ++i) {
    if (columns.rotation[i] >= 0) angles[i] = row[columns.rotation[i]] * kRadiansPerDegree;
  }
  return angles;
}

BvhRows::BvhRows(BvhCursor& cursor, const BvhHeader& header, Diagnostics* diagnostics)
    : cursor_(cursor),
      header_(header),
      diagnostics_(diagnostics),
      num_channels_(static_cast<std::size_t>(header.num_channels)) {}

bool BvhRows::next(std::vector<double>& values) {
  if (at_end_) return false;
  skip_to_row();
  at_end_ = cursor_.at_end() || !parse_row(values);
  if (at_end_) {
    report_count();
  } else {
    ++num_rows_;
  }
  return !at_end_;
}

void BvhRows::skip_to_row() {
  for (cursor_.skip_blanks(); !cursor_.at_end() && cursor_.at_line_end(); cursor_.skip_blanks()) {
    cursor_.set_position(cursor_.position() + 1);
    cursor_.forget_lines();
  }
}

/// False if the file ends within the row, which is then dropped.
bool BvhRows::parse_row(std::vector<double>& values) {
  const std::size_t row_begin = cursor_.position(), first_value = values.size();
  const char* text = cursor_.text().data();
  const char* last = text + cursor_.text().size();
  const char* at = text + row_begin;
  for (std::size_t column = 0; column < num_channels_; ++column) {
    while (at != last && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
    double value = 0.0;
    const auto [end, error] = std::from_chars(at, last, value);
    const bool is_plain = error == std::errc() && std::abs(value) <= kLargestNumber && end != last &&
                          (*end == ' ' || *end == '\n' || *end == '\t' || *end == '\r');
    if (is_plain) {
      at = end;
    } else {
      cursor_.set_position(static_cast<std::size_t>(at - text));
      if (is_cut_off(column)) {
        values.resize(first_value);
        report_cut_row(row_begin, column);
        return false;
      }
      value = parse_unusual(column);
      text = cursor_.text().data();  // looking for the end may have moved it
      last = text + cursor_.text().size();
      at = text + cursor_.position();
    }
    values.push_back(value);
  }
  cursor_.set_position(static_cast<std::size_t>(at - text));
  cursor_.skip_blanks();
  if (!cursor_.at_line_end()) {
    cursor_.fail(cursor_.position(), "end of line after " + std::to_string(num_channels_) + " numbers");
  }
  return true;
}

/// Whether nothing but white space, or a piece of a number that the end of the file cuts, is left of the file.
bool BvhRows::is_cut_off(std::size_t column) {
  const std::size_t position = cursor_.position();
  cursor_.skip_space();
  const bool nothing_is_left = cursor_.at_end();
  cursor_.set_position(position);
  if (nothing_is_left) return true;
  const std::string_view rest = cursor_.text().substr(position);
  const bool is_piece = rest.find_first_not_of("+-.eE0123456789") == rest.npos;
  if (!is_piece) return false;
  const bool is_whole = rest.back() >= '0' && rest.back() <= '9';
  return !is_whole || column + 1 < num_channels_;
}

void BvhRows::report_cut_row(std::size_t row_begin, std::size_t column) {
  if (num_rows_ == 0) fail_short(column);
  if (diagnostics_ == nullptr) return;
  diagnostics_->warn(cursor_.line_label(row_begin), "the last row is cut off after " + std::to_string(column) + " of " +
                                                        std::to_string(num_channels_) + " numbers and is left out");
}

void BvhRows::fail_short(std::size_t column) {
  const std::string expected =
      std::to_string(num_channels_) + " numbers in the row (" + std::to_string(column) + " are there)";
  cursor_.fail(cursor_.at_line_end() ? cursor_.position() : cursor_.text().size(), expected);
}

double BvhRows::parse_unusual(std::size_t column) {
  if (cursor_.at_line_end()) fail_short(column);
  return cursor_.expect_number();
}

/// A claim of no frames is how a stream says that it does not know.
void BvhRows::report_count() {
  if (diagnostics_ == nullptr || num_rows_ == header_.num_frames || header_.num_frames == 0) return;
  diagnostics_->warn(header_.num_frames_line, "the header says " + std::to_string(header_.num_frames) +
                                                  " frames, the file holds " + std::to_string(num_rows_) +
                                                  "; all of them are read");
}

void pose_from_row(const double* row, const std::vector<JointColumns>& columns, const std::vector<Joint>& joints,
                   PositionChannels positions, Pose& pose) {
  pose.rotations.resize(joints.size());
  pose.translations.resize(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointColumns& joint_columns = columns[j];
    Eigen::Vector3d translation = joints[j].offset;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int column = joint_columns.position[axis];
      if (column < 0) continue;
      double& value = translation[static_cast<Eigen::Index>(axis)];
      value = positions == PositionChannels::kReplaceOffset ? row[column] : value + row[column];
    }
    pose.translations[j] = translation;
    pose.rotations[j] = joint_columns.num_rotations == 0
                            ? Eigen::Quaterniond::Identity()
                            : rotation_from_angles(angles_in(row, joint_columns), joint_columns.axis);
  }
}

}  // namespace strut::io::detail
