// SPDX-License-Identifier: MIT
// Every number is read once, straight into one array of rows; nothing is allocated for a claim of the header that the
// text behind it is too short to keep.
#include "bvh_motion.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <system_error>

namespace strut::io::detail {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

class RowParser {
 public:
  RowParser(BvhCursor& cursor, const BvhHeader& header)
      : cursor_(cursor), header_(header), num_channels_(static_cast<std::size_t>(header.num_channels)) {}

  std::vector<double> parse(Diagnostics* diagnostics) {
    reserve();
    for (cursor_.skip_space(); !cursor_.at_end() && parse_row(diagnostics); cursor_.skip_space()) ++num_rows_;
    report_count(diagnostics);
    return std::move(values_);
  }

 private:
  /// A number takes at least two characters, so the text bounds what the header may claim.
  void reserve() {
    const std::size_t room = (cursor_.text().size() - cursor_.position()) / (2 * num_channels_) + 1;
    values_.reserve(std::min(room, static_cast<std::size_t>(header_.num_frames)) * num_channels_);
  }

  /// False if the file ends within the row, which is then dropped.
  bool parse_row(Diagnostics* diagnostics) {
    const std::size_t row_begin = cursor_.position();
    const std::string_view text = cursor_.text();
    const char* const last = text.data() + text.size();
    const char* at = text.data() + row_begin;
    for (std::size_t column = 0; column < num_channels_; ++column) {
      while (at != last && (*at == ' ' || *at == '\t' || *at == '\r')) ++at;
      double value = 0.0;
      const auto [end, error] = std::from_chars(at, last, value);
      const bool is_plain = error == std::errc() && std::abs(value) <= kLargestNumber && end != last &&
                            (*end == ' ' || *end == '\n' || *end == '\t' || *end == '\r');
      if (is_plain) {
        at = end;
      } else {
        cursor_.set_position(static_cast<std::size_t>(at - text.data()));
        if (is_cut_off(column)) return drop_row(row_begin, column, diagnostics);
        value = parse_unusual(column);
        at = text.data() + cursor_.position();
      }
      values_.push_back(value);
    }
    cursor_.set_position(static_cast<std::size_t>(at - text.data()));
    cursor_.skip_blanks();
    if (!cursor_.at_line_end()) {
      cursor_.fail(cursor_.position(), "end of line after " + std::to_string(num_channels_) + " numbers");
    }
    return true;
  }

  /// Whether nothing but white space, or a piece of a number that the end of the file cuts, is left of the file.
  [[nodiscard]] bool is_cut_off(std::size_t column) const {
    const std::string_view rest = cursor_.text().substr(cursor_.position());
    if (rest.find_first_not_of(" \t\r\n") == rest.npos) return true;
    const bool is_piece = rest.find_first_not_of("+-.eE0123456789") == rest.npos;
    if (!is_piece) return false;
    const bool is_whole = rest.back() >= '0' && rest.back() <= '9';
    return !is_whole || column + 1 < num_channels_;
  }

  bool drop_row(std::size_t row_begin, std::size_t column, Diagnostics* diagnostics) {
    if (num_rows_ == 0) fail_short(column);
    if (diagnostics != nullptr) {
      diagnostics->warn(cursor_.line_label(row_begin), "the last row is cut off after " + std::to_string(column) +
                                                           " of " + std::to_string(num_channels_) +
                                                           " numbers and is left out");
    }
    values_.resize(num_rows_ * num_channels_);
    cursor_.set_position(cursor_.text().size());
    return false;
  }

  [[noreturn]] void fail_short(std::size_t column) const {
    const std::string expected =
        std::to_string(num_channels_) + " numbers in the row (" + std::to_string(column) + " are there)";
    cursor_.fail(cursor_.at_line_end() ? cursor_.position() : cursor_.text().size(), expected);
  }

  double parse_unusual(std::size_t column) {
    if (cursor_.at_line_end()) fail_short(column);
    return cursor_.expect_number();
  }

  void report_count(Diagnostics* diagnostics) const {
    if (diagnostics == nullptr || num_rows_ == static_cast<std::size_t>(header_.num_frames)) return;
    diagnostics->warn(cursor_.line_label(header_.num_frames_begin),
                      "the header says " + std::to_string(header_.num_frames) + " frames, the file holds " +
                          std::to_string(num_rows_) + "; all of them are read");
  }

  BvhCursor& cursor_;
  const BvhHeader& header_;
  std::size_t num_channels_;
  std::size_t num_rows_ = 0;
  std::vector<double> values_;
};

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

std::vector<double> parse_rows(BvhCursor& cursor, const BvhHeader& header, Diagnostics* diagnostics) {
  return RowParser(cursor, header).parse(diagnostics);
}

Pose pose_from_row(const double* row, const std::vector<JointColumns>& columns, const std::vector<Joint>& joints,
                   PositionChannels positions) {
  Pose pose;
  pose.rotations.reserve(joints.size());
  pose.translations.reserve(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const JointColumns& joint_columns = columns[j];
    Eigen::Vector3d translation = joints[j].offset;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int column = joint_columns.position[axis];
      if (column < 0) continue;
      double& value = translation[static_cast<Eigen::Index>(axis)];
      value = positions == PositionChannels::kReplaceOffset ? row[column] : value + row[column];
    }
    pose.translations.push_back(translation);
    pose.rotations.push_back(joint_columns.num_rotations == 0
                                 ? Eigen::Quaterniond::Identity()
                                 : rotation_from_angles(angles_in(row, joint_columns), joint_columns.axis));
  }
  return pose;
}

}  // namespace strut::io::detail
