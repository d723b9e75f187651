// SPDX-License-Identifier: MIT
// A hierarchy is read with a stack of open joints instead of recursion, so that no depth of nesting can exhaust it.
#include "bvh_header.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace strut::io::detail {
namespace {

constexpr std::array<const char*, 6> kChannelNames = {"Xposition", "Yposition", "Zposition",
                                                      "Xrotation", "Yrotation", "Zrotation"};
constexpr std::array<double, 11> kUsualRates = {24, 25, 30, 48, 50, 60, 72, 90, 100, 120, 240};
constexpr double kSnapTolerance = 1e-3;      // printed with as few as three digits, e.g. 0.033
constexpr double kShortestFrameTime = 1e-6;  // a million frames per second
constexpr double kLongestFrameTime = 1e6;

struct OpenJoint {
  int index;
  bool has_offset = false, has_channels = false, has_children = false;
};

class HierarchyParser {
 public:
  HierarchyParser(BvhCursor& cursor, BvhHeader& header) : cursor_(cursor), header_(header) {}

  void parse() {
    cursor_.expect_word("HIERARCHY");
    cursor_.expect_word("ROOT");
    open_joint(-1);
    while (!open_.empty()) parse_item();
    if (cursor_.peek_word().size() == 4 && cursor_.accept_word("ROOT")) {
      cursor_.fail_with(cursor_.position() - 4, "'MOTION'", "'ROOT'", "a file holds one skeleton; split it in two");
    }
  }

 private:
  void open_joint(int parent) {
    Joint joint;
    joint.name = cursor_.rest_of_line();
    joint.parent = parent;
    cursor_.expect_mark('{');
    open_.push_back({static_cast<int>(header_.joints.size())});
    header_.joints.push_back(std::move(joint));
    header_.channels.emplace_back();
  }

  void parse_item() {
    OpenJoint& joint = open_.back();
    cursor_.skip_space();
    const std::size_t at = cursor_.position();
    if (!joint.has_offset && cursor_.accept_word("OFFSET")) {
      joint.has_offset = true;
      header_.joints[static_cast<std::size_t>(joint.index)].offset = parse_vector();
    } else if (!joint.has_channels && !joint.has_children && cursor_.accept_word("CHANNELS")) {
      joint.has_channels = true;
      parse_channels(header_.channels[static_cast<std::size_t>(joint.index)]);
    } else if (cursor_.accept_word("JOINT")) {
      joint.has_children = true;
      open_joint(joint.index);
    } else if (cursor_.accept_word("End")) {
      joint.has_children = true;
      parse_end_site(header_.joints[static_cast<std::size_t>(joint.index)]);
    } else if (!cursor_.at_end() && cursor_.text()[at] == '}') {
      close_joint(joint);
    } else {
      cursor_.fail(at, wanted(joint));
    }
  }

  static std::string wanted(const OpenJoint& joint) {
    std::string text = joint.has_offset ? "" : "'OFFSET', ";
    if (!joint.has_channels && !joint.has_children) text += "'CHANNELS', ";
    return text + "'JOINT', 'End Site' or '}'";
  }

  void close_joint(const OpenJoint& joint) {
    if (!joint.has_offset) cursor_.fail(cursor_.position(), "'OFFSET'");
    cursor_.expect_mark('}');
    open_.pop_back();
  }

  Eigen::Vector3d parse_vector() {
    Eigen::Vector3d vector;
    for (double& value : vector) value = cursor_.expect_number();
    return vector;
  }

  void parse_channels(std::vector<BvhChannel>& channels) {
    const long long count = cursor_.expect_count("a number of channels", 6);
    for (long long i = 0; i < count; ++i) {
      cursor_.skip_blanks();
      const std::size_t at = cursor_.position();
      const BvhChannel channel = parse_channel();
      if (std::find(channels.begin(), channels.end(), channel) != channels.end()) {
        cursor_.fail(at, "a channel that is not listed yet");
      }
      channels.push_back(channel);
      ++header_.num_channels;
    }
  }

  BvhChannel parse_channel() {
    for (std::size_t i = 0; !cursor_.at_line_end() && i < kChannelNames.size(); ++i) {
      if (cursor_.accept_word(kChannelNames[i])) return static_cast<BvhChannel>(i);
    }
    cursor_.fail(cursor_.position(), "a channel such as 'Xposition' or 'Zrotation'");
  }

  void parse_end_site(Joint& joint) {
    cursor_.rest_of_line();  // "Site", a name, or both
    cursor_.expect_mark('{');
    cursor_.expect_word("OFFSET");
    const Eigen::Vector3d tip = parse_vector();
    if (cursor_.accept_word("CHANNELS")) cursor_.expect_count("a number of channels", 0);
    cursor_.expect_mark('}');
    // A joint with several tips keeps its first.
    if (!joint.has_end_site) joint.end_site = tip;
    joint.has_end_site = true;
  }

  BvhCursor& cursor_;
  BvhHeader& header_;
  std::vector<OpenJoint> open_;
};

void parse_frame_time(BvhCursor& cursor, BvhHeader& header) {
  cursor.skip_space();
  const std::size_t line_begin = cursor.position();
  if (!cursor.accept_word("Frame") || !cursor.accept_word("Time")) cursor.fail(line_begin, "'Frame Time:'");
  cursor.expect_mark(':');
  cursor.skip_blanks();
  const std::size_t begin = cursor.position();
  const double frame_time = cursor.expect_number();
  if (!(frame_time >= kShortestFrameTime && frame_time <= kLongestFrameTime)) {
    cursor.fail(begin, "a frame time in seconds above zero");
  }
  header.frame_time = cursor.text().substr(begin, cursor.position() - begin);
  header.frame_rate = snapped_frame_rate(frame_time);
  cursor.skip_blanks();
  if (!cursor.at_line_end()) cursor.fail(cursor.position(), "end of line");
}

}  // namespace

BvhHeader parse_header(BvhCursor& cursor) {
  BvhHeader header;
  HierarchyParser(cursor, header).parse();
  cursor.expect_word("MOTION");
  if (header.num_channels == 0) {
    cursor.fail_with(cursor.position(), "a skeleton with channels", "none", "a motion needs CHANNELS on some joint");
  }
  if (!cursor.accept_word("Frames")) cursor.fail(cursor.position(), "'Frames:'");
  cursor.expect_mark(':');
  cursor.skip_blanks();
  const std::size_t num_frames_begin = cursor.position();
  header.num_frames_line = cursor.line_label(num_frames_begin);
  header.num_frames = cursor.expect_count("a number of frames", kMostFrames);
  header.text = cursor.text().substr(0, num_frames_begin);
  const std::size_t lead_begin = cursor.position();
  parse_frame_time(cursor, header);
  const std::size_t frame_time_begin = cursor.text().find(header.frame_time, lead_begin);
  header.frame_time_lead = cursor.text().substr(lead_begin, frame_time_begin - lead_begin);
  return header;
}

double snapped_frame_rate(double frame_time) {
  for (const double rate : kUsualRates) {
    if (std::abs(frame_time * rate - 1.0) <= kSnapTolerance) return rate;
  }
  return 1.0 / frame_time;
}

const char* channel_name(BvhChannel channel) {
  return kChannelNames[static_cast<std::size_t>(channel)];
}

}  // namespace strut::io::detail
