// SPDX-License-Identifier: MIT
// Motion to text. A header kept from a source is written to the letter; rotations that are still the source's get the
// source's angles, the others the angles nearest to those of the frame before.
#include "bvh_angles.h"
#include "bvh_header.h"
#include "bvh_motion.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

#include <strut/core/error.h>
#include <strut/io/bvh.h>
#include <strut/io/bvh_stream.h>

namespace strut {
namespace {

using io::detail::JointColumns;
using Angles = std::array<double, 3>;

constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
constexpr int kDecimals = 6;  // half a unit of the last place is 5e-7 degrees
constexpr int kFrameTimeDecimals = 8;
constexpr double kSameRotation = 1e-7;     // [rad] = 6e-6 degrees, below the 1e-5 that a kept number may differ by
constexpr double kLostTranslation = 1e-4;  // [m]: files print rigid bones with rounding well below this
constexpr double kLostRotation = 1e-3;     // [rad]
constexpr std::size_t kDeepestIndent = 64;
constexpr std::size_t kMostNames = 5;

void append_number(std::string& text, double value) {
  char buffer[400];  // the largest double has 309 digits before the point
  if (std::abs(value) < 5e-7) value = 0.0;
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, kDecimals).ptr);
}

/// Joints as they follow each other in a file: every joint's descendants right behind it.
std::vector<int> depth_first_order(const Skeleton& skeleton) {
  std::vector<int> order, waiting = {0};
  while (!waiting.empty()) {
    const int joint = waiting.back();
    waiting.pop_back();
    order.push_back(joint);
    const auto& children = skeleton.children(joint);
    waiting.insert(waiting.end(), children.rbegin(), children.rend());
  }
  return order;
}

bool has_all_positions(const JointColumns& columns) {
  return std::all_of(columns.position.begin(), columns.position.end(), [](int column) { return column >= 0; });
}

/// Whether a kept header describes the skeleton that is written.
bool same_bones(const Skeleton* a, const Skeleton& b) {
  if (a == &b) return true;
  if (a == nullptr || a->num_joints() != b.num_joints()) return false;
  for (int j = 0; j < b.num_joints(); ++j) {
    const Joint &x = a->joint(j), &y = b.joint(j);
    if (x.name != y.name || x.parent != y.parent || x.offset != y.offset || x.end_site != y.end_site) return false;
  }
  return true;
}

class HeaderText {
 public:
  HeaderText(const Skeleton& skeleton, const BvhLayout& layout, const std::vector<Eigen::Vector3d>& offsets)
      : skeleton_(skeleton), layout_(layout), offsets_(offsets) {}

  std::string make(const std::vector<int>& order) {
    line(0, "HIERARCHY");
    for (const int joint : order) {
      while (!open_.empty() && open_.back() != skeleton_.joint(joint).parent) close();
      open(joint);
    }
    while (!open_.empty()) close();
    line(0, "MOTION");
    return text_ + "Frames: ";
  }

 private:
  void line(std::size_t depth, const std::string& content) {
    text_.append(std::min(depth, kDeepestIndent), '\t');
    text_ += content + layout_.line_end;
  }

  void offset_line(std::size_t depth, const Eigen::Vector3d& offset) {
    std::string content = "OFFSET";
    const double scale = 1.0 / metres_per(layout_.unit);
    for (const double value : Eigen::Vector3d(scale * io::detail::from_y_up(offset, layout_.up))) {
      content += ' ';
      append_number(content, value);
    }
    line(depth, content);
  }

  void open(int index) {
    const Joint& joint = skeleton_.joint(index);
    if (joint.name.find_first_of("{}\r\n") != std::string::npos) {
      throw InvalidArgument("joint name", "one line without braces", "'" + joint.name + "'");
    }
    line(open_.size(), (index == 0 ? "ROOT " : "JOINT ") + joint.name);
    line(open_.size(), "{");
    open_.push_back(index);
    offset_line(open_.size(), offsets_[static_cast<std::size_t>(index)]);
    const auto& channels = layout_.channels[static_cast<std::size_t>(index)];
    std::string content = "CHANNELS " + std::to_string(channels.size());
    for (const BvhChannel channel : channels) content += std::string(" ") + io::detail::channel_name(channel);
    if (!channels.empty()) line(open_.size(), content);
    if (joint.has_end_site || skeleton_.children(index).empty()) end_site(joint);
  }

  void end_site(const Joint& joint) {
    line(open_.size(), "End Site");
    line(open_.size(), "{");
    offset_line(open_.size() + 1, joint.end_site);
    line(open_.size(), "}");
  }

  void close() {
    open_.pop_back();
    line(open_.size(), "}");
  }

  const Skeleton& skeleton_;
  const BvhLayout& layout_;
  const std::vector<Eigen::Vector3d>& offsets_;
  std::vector<int> open_;
  std::string text_;
};

/// As short as most files have it if that reads back as the same rate, else with every digit.
std::string frame_time_text(double frame_rate) {
  char buffer[400];
  char* const last = buffer + sizeof buffer;
  const double frame_time = 1.0 / frame_rate;
  char* end = std::to_chars(buffer, last, frame_time, std::chars_format::fixed, kFrameTimeDecimals).ptr;
  double printed = 0.0;
  std::from_chars(buffer, end, printed);
  if (io::detail::snapped_frame_rate(printed) != frame_rate) end = std::to_chars(buffer, last, frame_time).ptr;
  return {buffer, end};
}

/// Turns poses into rows of the layout, and remembers what the channels could not hold.
class RowMaker {
 public:
  RowMaker(const Skeleton& skeleton, const BvhLayout& layout, const std::vector<Eigen::Vector3d>& offsets)
      : skeleton_(skeleton),
        layout_(layout),
        offsets_(offsets),
        columns_(io::detail::columns_of(layout.channels)),
        num_joints_(columns_.size()),
        row_(static_cast<std::size_t>(layout.num_channels())),
        angles_(num_joints_),
        lost_translation_(num_joints_),
        lost_rotation_(num_joints_) {
    for (int j = skeleton_.pelvis(); j > 0; j = skeleton_.joint(j).parent) chain_.insert(chain_.begin(), j);
  }

  /// `source`: the row that the pose came from, or null.
  const std::vector<double>& make(const Pose& pose, const double* source) {
    if (std::exchange(is_first_, false)) use_source_angles(source);
    const Eigen::Vector3d shift = root_shift(pose);
    for (std::size_t j = 0; j < num_joints_; ++j) {
      put_position(j, j == 0 ? Eigen::Vector3d(pose.translations[0] + shift) : pose.translations[j]);
      put_rotation(j, io::detail::from_y_up(pose.rotations[j], layout_.up), source);
    }
    return row_;
  }

  void report(Diagnostics& diagnostics) const {
    const std::string moved = names_above(lost_translation_, kLostTranslation);
    if (!moved.empty()) {
      diagnostics.warn("", "the layout has no channels for the movement of " + moved + " against the parent joint",
                       "keep the source's layout to keep it");
    }
    const std::string turned = names_above(lost_rotation_, kLostRotation);
    if (!turned.empty()) {
      diagnostics.warn("", "the layout has too few channels for the rotation of " + turned,
                       "write with three rotations per joint to keep it");
    }
  }

 private:
  void use_source_angles(const double* source) {
    for (std::size_t j = 0; source != nullptr && j < num_joints_; ++j) {
      angles_[j] = io::detail::angles_in(source, columns_[j]);
    }
  }

  /// `translation` as far as joint `j` has channels for it; elsewhere its OFFSET.
  [[nodiscard]] Eigen::Vector3d expressible(std::size_t j, const Eigen::Vector3d& translation) const {
    if (has_all_positions(columns_[j])) return translation;
    Eigen::Vector3d in_file = io::detail::from_y_up(offsets_[j], layout_.up);
    const Eigen::Vector3d wanted = io::detail::from_y_up(translation, layout_.up);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      if (columns_[j].position[axis] >= 0) in_file[i] = wanted[i];
    }
    return io::detail::to_y_up(in_file, layout_.up);
  }

  /// How far the root must move so that the pelvis is where it was although joints above it stand still.
  [[nodiscard]] Eigen::Vector3d root_shift(const Pose& pose) const {
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    if (!has_all_positions(columns_[0])) return shift;
    Eigen::Quaterniond parent = pose.rotations[0];
    for (const int joint : chain_) {
      const auto j = static_cast<std::size_t>(joint);
      shift += parent * (pose.translations[j] - expressible(j, pose.translations[j]));
      parent = parent * pose.rotations[j];
    }
    return shift;
  }

  [[nodiscard]] bool is_carried_by_root(std::size_t j) const {
    return has_all_positions(columns_[0]) &&
           std::find(chain_.begin(), chain_.end(), static_cast<int>(j)) != chain_.end();
  }

  void put_position(std::size_t j, const Eigen::Vector3d& translation) {
    const double scale = 1.0 / metres_per(layout_.unit);
    const bool adds = layout_.positions == PositionChannels::kAddToOffset;
    const Eigen::Vector3d relative = adds ? Eigen::Vector3d(translation - offsets_[j]) : translation;
    const Eigen::Vector3d in_file = scale * io::detail::from_y_up(relative, layout_.up);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int column = columns_[j].position[axis];
      if (column >= 0) row_[static_cast<std::size_t>(column)] = in_file[static_cast<Eigen::Index>(axis)];
    }
    if (is_carried_by_root(j)) return;
    lost_translation_[j] = std::max(lost_translation_[j], (translation - expressible(j, translation)).norm());
  }

  void put_rotation(std::size_t j, const Eigen::Quaterniond& rotation, const double* source) {
    const JointColumns& columns = columns_[j];
    const Angles from_source = source != nullptr ? io::detail::angles_in(source, columns) : Angles{};
    if (source != nullptr && difference(rotation, from_source, columns) < kSameRotation) {
      angles_[j] = from_source;
    } else {
      angles_[j] = io::detail::angles_near(rotation, columns.axis, angles_[j]);
      for (auto i = static_cast<std::size_t>(columns.num_rotations); i < 3; ++i) angles_[j][i] = 0.0;
      if (columns.num_rotations < 3) {
        lost_rotation_[j] = std::max(lost_rotation_[j], difference(rotation, angles_[j], columns));
      }
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(columns.num_rotations); ++i) {
      row_[static_cast<std::size_t>(columns.rotation[i])] = angles_[j][i] * kDegreesPerRadian;
    }
  }

  /// The angle [rad] between a rotation and the one that `angles` make.
  static double difference(const Eigen::Quaterniond& rotation, const Angles& angles, const JointColumns& columns) {
    const Eigen::Quaterniond made = io::detail::rotation_from_angles(angles, columns.axis);
    return 2.0 * (made.conjugate() * rotation).vec().norm();
  }

  [[nodiscard]] std::string names_above(const std::vector<double>& lost, double bound) const {
    std::string names;
    std::size_t count = 0;
    for (std::size_t j = 0; j < num_joints_; ++j) {
      if (lost[j] <= bound || ++count > kMostNames) continue;
      names += (names.empty() ? "'" : ", '") + skeleton_.joints()[j].name + "'";
    }
    return count > kMostNames ? names + " and " + std::to_string(count - kMostNames) + " more" : names;
  }

  const Skeleton& skeleton_;
  const BvhLayout& layout_;
  const std::vector<Eigen::Vector3d>& offsets_;
  std::vector<JointColumns> columns_;
  std::size_t num_joints_;
  std::vector<int> chain_;  // below the root, down to the pelvis
  std::vector<double> row_;
  std::vector<Angles> angles_;  // of the frame before [rad]
  std::vector<double> lost_translation_, lost_rotation_;
  bool is_first_ = true;
};

/// Columns in the order in which the file names the joints.
std::vector<std::size_t> file_columns(const BvhLayout& layout, const std::vector<int>& order) {
  std::vector<std::size_t> first(layout.channels.size() + 1, 0);
  for (std::size_t j = 0; j < layout.channels.size(); ++j) first[j + 1] = first[j] + layout.channels[j].size();
  std::vector<std::size_t> result;
  for (const int joint : order) {
    const auto j = static_cast<std::size_t>(joint);
    for (std::size_t column = first[j]; column < first[j + 1]; ++column) result.push_back(column);
  }
  return result;
}

/// OFFSETs as they stand in the file [m, Y up]: a header made anew gives a root that has position channels none, so
/// that programs that replace it and programs that add to it agree.
std::vector<Eigen::Vector3d> written_offsets(const Skeleton& skeleton, const BvhLayout& layout, bool keeps_header) {
  std::vector<Eigen::Vector3d> offsets;
  for (const Joint& joint : skeleton.joints()) offsets.push_back(joint.offset);
  if (!keeps_header && has_all_positions(io::detail::columns_of(layout.channels)[0])) offsets[0].setZero();
  return offsets;
}

/// The source's row that belongs to `frame` of a motion; none where the layout does not keep it.
std::span<const double> source_row(const BvhLayout& layout, int frame) {
  if (!layout.source_values || layout.first_source_row < 0) return {};
  const auto width = static_cast<std::size_t>(layout.num_channels());
  const std::size_t begin =
      (static_cast<std::size_t>(layout.first_source_row) + static_cast<std::size_t>(frame)) * width;
  if (begin + width > layout.source_values->size()) return {};
  return {layout.source_values->data() + begin, width};
}

}  // namespace

struct BvhRowWriter::Text {
  Text(std::shared_ptr<const Skeleton> given_skeleton, double given_frame_rate, BvhLayout given_layout)
      : skeleton(std::move(given_skeleton)),
        frame_rate(given_frame_rate),
        layout(std::move(given_layout)),
        keeps_header(!layout.header.empty() && same_bones(layout.skeleton.get(), *skeleton)),
        offsets(written_offsets(*skeleton, layout, keeps_header)),
        order(depth_first_order(*skeleton)),
        columns(file_columns(layout, order)),
        rows(*skeleton, layout, offsets) {}

  std::shared_ptr<const Skeleton> skeleton;
  double frame_rate;
  BvhLayout layout;
  bool keeps_header;
  std::vector<Eigen::Vector3d> offsets;
  std::vector<int> order;
  std::vector<std::size_t> columns;
  RowMaker rows;
  std::string line;
};

BvhRowWriter::BvhRowWriter(std::shared_ptr<const Skeleton> skeleton, double frame_rate, BvhLayout layout) {
  if (!skeleton) throw InvalidArgument("skeleton", "a skeleton", "null");
  if (!(std::isfinite(frame_rate) && frame_rate > 0.0)) {
    throw InvalidArgument("frame_rate", "a positive number of frames per second", std::to_string(frame_rate));
  }
  if (static_cast<int>(layout.channels.size()) != skeleton->num_joints()) {
    throw InvalidArgument("layout", "channels for " + std::to_string(skeleton->num_joints()) + " joints",
                          "channels for " + std::to_string(layout.channels.size()));
  }
  text_ = std::make_unique<Text>(std::move(skeleton), frame_rate, std::move(layout));
}

BvhRowWriter::BvhRowWriter(BvhRowWriter&&) noexcept = default;
BvhRowWriter& BvhRowWriter::operator=(BvhRowWriter&&) noexcept = default;
BvhRowWriter::~BvhRowWriter() = default;

std::string BvhRowWriter::header(long long num_frames) const {
  const BvhLayout& layout = text_->layout;
  std::string header =
      text_->keeps_header ? layout.header : HeaderText(*text_->skeleton, layout, text_->offsets).make(text_->order);
  header += std::to_string(num_frames);
  header += text_->keeps_header ? layout.frame_time_lead : layout.line_end + "Frame Time: ";
  const bool keeps_time = !layout.frame_time.empty() && layout.frame_rate == text_->frame_rate;
  return header + (keeps_time ? layout.frame_time : frame_time_text(text_->frame_rate)) + layout.line_end;
}

const std::string& BvhRowWriter::row(const Pose& pose, std::span<const double> source) {
  const auto joints = static_cast<std::size_t>(text_->skeleton->num_joints());
  if (pose.rotations.size() != joints || pose.translations.size() != joints) {
    throw InvalidArgument("pose", std::to_string(joints) + " joints", std::to_string(pose.rotations.size()));
  }
  if (!source.empty() && source.size() != text_->columns.size()) {
    throw InvalidArgument("source", std::to_string(text_->columns.size()) + " numbers", std::to_string(source.size()));
  }
  const std::vector<double>& values = text_->rows.make(pose, source.empty() ? nullptr : source.data());
  std::string& line = text_->line;
  line.clear();
  for (const std::size_t column : text_->columns) {
    if (!line.empty()) line += ' ';
    append_number(line, values[column]);
  }
  return line += text_->layout.line_end;
}

void BvhRowWriter::report(Diagnostics& diagnostics) const {
  text_->rows.report(diagnostics);
}

std::string format_bvh(const Motion& motion, const BvhLayout& layout, Diagnostics* diagnostics) {
  BvhRowWriter writer(motion.shared_skeleton(), motion.frame_rate(), layout);
  std::string text = writer.header(motion.num_frames());
  for (int frame = 0; frame < motion.num_frames(); ++frame) {
    text += writer.row(motion.frame(frame), source_row(layout, frame));
  }
  if (diagnostics != nullptr) writer.report(*diagnostics);
  return text;
}

void write_bvh(const std::string& path, const Motion& motion, const BvhLayout& layout, Overwrite overwrite,
               Diagnostics* diagnostics) {
  check_writable(path, overwrite);
  write_file(path, format_bvh(motion, layout, diagnostics), overwrite);
}

}  // namespace strut
