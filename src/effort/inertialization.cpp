// SPDX-License-Identifier: MIT
// Symbols: D and V are what the motion so far is ahead of the next piece in the middle of the step between them, and
// how fast that grows; tau runs from 0 there to 1 at the end of the decay.
#include "effort/merged_plants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/effort/inertialization.h>
#include <strut/math/rotation.h>
#include <strut/motion/legs.h>
#include <strut/representation/pose_encoder.h>

namespace strut::effort {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using representation::kHeight;
using representation::kNumRootDofs;
using representation::kTiltX;
using representation::kTiltZ;

constexpr double kPi = std::numbers::pi;
constexpr double kLongestDecay = 2.0;
// A difference that closes at rate V and is to be zero after this many times D / V does not pass zero on the way.
constexpr double kNoOvershoot = 2.5;

// How far from a join a side's own changes of velocity are looked at [s], and how many times the largest may come over
// the join for it to be left as it is.
constexpr double kNear = 0.4;
constexpr double kTimesOwnChange = 2.0;

using RootDofs = std::array<double, kNumRootDofs>;

std::size_t place(int number) {
  return static_cast<std::size_t>(number);
}

/// A frame without where it is: joints below the pelvis only.
struct Frame {
  RootDofs root;
  std::vector<Quaterniond> rotations;
  std::vector<Vector3d> translations;
};

/// In the frame of the joint's parent, in which what a joint moves by itself goes on.
Vector3d turn(const Quaterniond& from, const Quaterniond& to) {
  return math::log_map(to * from.conjugate());
}

/// Share of the offset D that is left.
double of_offset(double tau) {
  const double rest = 1.0 - tau;
  return tau >= 1.0 ? 0.0 : rest * rest * rest * (1.0 + tau * (3.0 + 6.0 * tau));
}

/// What the rate V, times the decay, has come to.
double of_rate(double tau) {
  const double rest = 1.0 - tau;
  return tau >= 1.0 ? 0.0 : rest * rest * rest * tau * (1.0 + 3.0 * tau);
}

/// Share of a velocity that is left.
double of_velocity(double tau) {
  return tau >= 1.0 ? 0.0 : 1.0 - tau * tau * (3.0 - 2.0 * tau);
}

/// What dies away of a difference on one side of a join.
struct Fading {
  Vector3d offset, rate;  // D, V [per s], with time running away from the join
  double decay;
  double share = 1.0;

  Fading(Vector3d difference, Vector3d growth, double longest, const JoinOptions& options)
      : offset(std::move(difference)), rate(std::move(growth)), decay(longest) {
    const double closing = -rate.dot(offset);
    if (closing <= 0.0) return;
    const double wanted = std::max(kNoOvershoot * offset.squaredNorm() / closing, options.shortest_decay);
    decay = std::min(wanted, longest);
  }

  [[nodiscard]] Vector3d at(double time) const {
    const double tau = time / decay;
    return share * (of_offset(tau) * offset + of_rate(tau) * decay * rate);
  }
};

/// Both sides of a join.
struct Fadings {
  Fading before, after;

  /// `apart[0]`, `apart[1]`: the difference one frame before the next piece's first, and there. The sides share it so
  /// that they accelerate alike, with the square of the time they have.
  Fadings(const std::array<Vector3d, 2>& apart, double frame_time, double time_before, const JoinOptions& options)
      : before(-0.5 * (apart[0] + apart[1]), (apart[1] - apart[0]) / frame_time, time_before, options),
        after(0.5 * (apart[0] + apart[1]), (apart[1] - apart[0]) / frame_time, options.longest_decay, options) {
    const double a = std::pow(before.decay, 2), b = std::pow(after.decay, 2);
    before.share = a / (a + b);
    after.share = b / (a + b);
  }
};

/// How a quantity steps from frame to frame around a join.
struct Steps {
  Vector3d onward;              // of the motion so far, with which it would go on after its last frame
  Vector3d onto;                // of the next piece, with which it would have come to its first
  double largest_change = 0.0;  // from one step to the next, near the join on either side

  /// Whether a step over the join asks for no more than either side does by itself.
  [[nodiscard]] bool take(const Vector3d& over) const {
    return (over - onward).norm() <= kTimesOwnChange * largest_change &&
           (onto - over).norm() <= kTimesOwnChange * largest_change;
  }
};

/// `step(a, b)`: from a frame to the next. A side of a single frame moves as the other does. `near`: frames looked at.
template <typename Step>
Steps steps_at_join(const std::vector<Frame>& before, const std::vector<Frame>& after, std::size_t near,
                    const Step& step) {
  Steps steps{Vector3d::Zero(), Vector3d::Zero()};
  const bool has_onward = before.size() > 1, has_onto = after.size() > 1;
  const auto last = before.rbegin();
  if (has_onward) steps.onward = step(last[1], last[0]);
  if (has_onto) steps.onto = step(after[0], after[1]);
  if (!has_onward) steps.onward = steps.onto;
  if (!has_onto) steps.onto = steps.onward;
  const auto see = [&](const Frame& a, const Frame& b, const Frame& c) {
    steps.largest_change = std::max(steps.largest_change, (step(b, c) - step(a, b)).norm());
  };
  for (std::size_t i = 2; i < std::min(near, before.size()); ++i) see(last[i], last[i - 1], last[i - 2]);
  for (std::size_t i = 2; i < std::min(near, after.size()); ++i) see(after[i - 2], after[i - 1], after[i]);
  return steps;
}

/// Puts pieces one after the other.
class Joiner {
 public:
  Joiner(const Motion& first, const Quaterniond& upright, const JoinOptions& options)
      : first_(first),
        representation_(representation::fit_representation({first}, upright)),
        options_(options),
        pelvis_(first.skeleton().pelvis()) {}

  void append(const Motion& piece) {
    std::vector<Frame> next = read(piece);
    if (!frames_.empty() && fits(next)) {
      continue_root(next);
    } else if (!frames_.empty()) {
      join_root(next);
      join_vector(next, [](auto& frame) { return frame.root.data() + kHeight; });  // and the tilt
      for (std::size_t i = 0; i < next.front().rotations.size(); ++i) join_rotation(next, i);
      for (std::size_t i = 0; i < next.front().translations.size(); ++i) {
        join_vector(next, [i](auto& frame) { return frame.translations[i].data(); });
      }
    }
    for (Frame& frame : next) frames_.push_back(std::move(frame));
  }

  [[nodiscard]] Motion motion() const;

 private:
  [[nodiscard]] std::vector<Frame> read(const Motion& piece) const;
  [[nodiscard]] bool fits(const std::vector<Frame>& next) const;
  void continue_root(std::vector<Frame>& next) const;
  void join_root(std::vector<Frame>& next);
  void join_rotation(std::vector<Frame>& next, std::size_t joint);
  template <typename Read>
  void join_vector(std::vector<Frame>& next, const Read& numbers);
  /// What is near a join [frames].
  [[nodiscard]] std::size_t near() const {
    return static_cast<std::size_t>(std::lround(kNear * first_.frame_rate())) + 1;
  }

  /// How long what is there already can take up a part of a difference [s].
  [[nodiscard]] double time_before() const {
    const double time = static_cast<double>(frames_.size()) * first_.frame_time();
    return options_.looks_ahead ? std::min(options_.longest_decay, time) : 0.0;
  }

  /// `put(frame, offset)` of every frame on either side in which a difference is felt.
  template <typename Put>
  void fade(std::vector<Frame>& next, const std::array<Vector3d, 2>& apart, const Put& put) {
    const double frame_time = first_.frame_time();
    const Fadings fadings(apart, frame_time, time_before(), options_);
    double time = 0.5 * frame_time;
    for (std::size_t i = 0; i < next.size() && time < fadings.after.decay; ++i, time += frame_time) {
      put(next[i], fadings.after.at(time));
    }
    time = 0.5 * frame_time;
    for (std::size_t i = frames_.size(); i > 0 && time < fadings.before.decay; --i, time += frame_time) {
      put(frames_[i - 1], fadings.before.at(time));
    }
  }

  const Motion& first_;
  representation::Representation representation_;
  JoinOptions options_;
  int pelvis_;
  std::vector<Frame> frames_;
};

std::vector<Frame> Joiner::read(const Motion& piece) const {
  std::vector<Frame> frames;
  representation::RootPlacement at;
  for (const Pose& pose : piece.frames()) {
    const auto root = representation::pelvis_world(piece.skeleton(), pose);
    frames.push_back({representation::encode_root(root, at, representation_.upright(), first_.frame_time()),
                      {pose.rotations.begin() + pelvis_ + 1, pose.rotations.end()},
                      {pose.translations.begin() + pelvis_ + 1, pose.translations.end()}});
    for (int j = pelvis_ + 1; j < piece.skeleton().num_joints(); ++j) {
      frames.back().translations[place(j - pelvis_ - 1)] +=
          first_.skeleton().joint(j).offset - piece.skeleton().joint(j).offset;
    }
  }
  return frames;
}

/// Whether no joint, nor the height and tilt of the body, would change its velocity over the join by much more than it
/// does near it: then there is nothing to hide, and what follows in its recording stays as it is.
bool Joiner::fits(const std::vector<Frame>& next) const {
  const auto takes = [&](const auto& step) {
    return steps_at_join(frames_, next, near(), step).take(step(frames_.back(), next.front()));
  };
  if (frames_.size() < 3 || next.size() < 3) return false;
  if (!takes([](const Frame& a, const Frame& b) {
        return Vector3d(b.root[kHeight] - a.root[kHeight], b.root[kTiltX] - a.root[kTiltX],
                        b.root[kTiltZ] - a.root[kTiltZ]);
      })) {
    return false;
  }
  for (std::size_t i = 0; i < next.front().rotations.size(); ++i) {
    if (!takes([i](const Frame& a, const Frame& b) { return turn(a.rotations[i], b.rotations[i]); })) return false;
  }
  return true;
}

/// The step over a join that is left as it is: between those on either side.
void Joiner::continue_root(std::vector<Frame>& next) const {
  for (int d = 0; d < 3; ++d) {
    next.front().root[place(d)] = 0.5 * (frames_.back().root[place(d)] + next[1].root[place(d)]);
  }
}

/// The steps over the ground and the turns: the difference of velocities fades.
void Joiner::join_root(std::vector<Frame>& next) {
  // A frame's velocities are those of the step that leads to it.
  const Steps steps = steps_at_join(
      frames_, next, near(), [](const Frame&, const Frame& b) { return Vector3d(b.root[0], b.root[1], b.root[2]); });
  const Vector3d onward = steps.onward, onto = steps.onto;
  for (int d = 0; d < 3; ++d) next.front().root[place(d)] = onto[d];
  const double frame_time = first_.frame_time(), before = time_before(), after = options_.longest_decay;
  const Vector3d ahead = (onward - onto) / (before + after);
  for (std::size_t i = 0; i < next.size(); ++i) {
    const double left = of_velocity(static_cast<double>(i) * frame_time / after);
    for (int d = 0; d < 3; ++d) next[i].root[place(d)] += left * after * ahead[d];
  }
  for (std::size_t i = 1; i < frames_.size() && before > 0.0; ++i) {
    const double left = of_velocity(static_cast<double>(i) * frame_time / before);
    for (int d = 0; d < 3; ++d) frames_[frames_.size() - i].root[place(d)] -= left * before * ahead[d];
  }
}

/// Three numbers that `numbers(frame)` points to.
template <typename Read>
void Joiner::join_vector(std::vector<Frame>& next, const Read& numbers) {
  const auto value = [&](const Frame& frame) { return Vector3d(Eigen::Map<const Vector3d>(numbers(frame))); };
  const Steps steps = steps_at_join(frames_, next, near(),
                                    [&](const Frame& a, const Frame& b) { return Vector3d(value(b) - value(a)); });
  const Vector3d apart = value(frames_.back()) - value(next.front());
  fade(next, {Vector3d(apart + steps.onto), Vector3d(apart + steps.onward)},
       [&](Frame& frame, const Vector3d& offset) { Eigen::Map<Vector3d>(numbers(frame)) += offset; });
}

void Joiner::join_rotation(std::vector<Frame>& next, std::size_t joint) {
  const Steps steps = steps_at_join(frames_, next, near(), [&](const Frame& a, const Frame& b) {
    return turn(a.rotations[joint], b.rotations[joint]);
  });
  const Quaterniond end = frames_.back().rotations[joint], begin = next.front().rotations[joint];
  const Vector3d before = turn(math::exp_map(-steps.onto) * begin, end);
  Vector3d after = turn(begin, math::exp_map(steps.onward) * end);
  // Near a half turn both ways round are as good, but it must be the same one.
  if (after.dot(before) < 0.0 && after.norm() > 0.5 * kPi) after *= 1.0 - 2.0 * kPi / after.norm();
  fade(next, {before, after}, [&](Frame& frame, const Vector3d& offset) {
    frame.rotations[joint] = (math::exp_map(offset) * frame.rotations[joint]).normalized();
  });
}

Motion Joiner::motion() const {
  const auto start = representation::placement(representation::pelvis_world(first_.skeleton(), first_.frame(0)),
                                               representation_.upright());
  representation::PoseDecoder<double> decoder(representation_, first_.frame_rate(), start);
  const int plane = representation::RowLayout(representation_.num_dofs()).plane();
  math::AlignedVector<double> rotations(place(4 * plane));
  std::vector<Pose> poses(frames_.size(), first_.frame(0));
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    const Frame& frame = frames_[k];
    for (std::size_t i = 0; i < frame.rotations.size(); ++i) {
      for (int c = 0; c < 4; ++c) rotations[place(c * plane) + i] = frame.rotations[i].coeffs()[c];
    }
    Pose& pose = poses[k];
    std::copy(frame.translations.begin(), frame.translations.end(), pose.translations.begin() + pelvis_ + 1);
    decoder.decode(frame.root.data(), rotations.data(), representation_.upright(), view(std::as_const(pose)),
                   view(pose));
  }
  return {first_.shared_skeleton(), first_.frame_rate(), std::move(poses)};
}

void check(const std::vector<Piece>& pieces, const JoinOptions& options) {
  if (!(options.shortest_decay > 0.0 && options.longest_decay >= options.shortest_decay &&
        options.longest_decay <= kLongestDecay)) {
    throw InvalidArgument("decay", "0 < shortest <= longest <= 2 s",
                          std::to_string(options.shortest_decay) + " and " + std::to_string(options.longest_decay));
  }
  if (pieces.empty()) throw InvalidArgument("pieces", "at least one", "none");
  const Motion& first = pieces.front().motion;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Motion& motion = pieces[k].motion;
    std::string where = "piece ";
    where += std::to_string(k);
    const std::string mismatch = describe_mismatch(first.skeleton(), motion.skeleton());
    if (!mismatch.empty()) throw SkeletonMismatch(where.append(" does not fit the first: ").append(mismatch));
    if (motion.num_frames() == 0) throw InvalidArgument(where, "at least one frame", "none");
    if (motion.frame_rate() != first.frame_rate()) {
      throw InvalidArgument(where, std::to_string(first.frame_rate()) + " frames/s, as the first",
                            std::to_string(motion.frame_rate()));
    }
  }
}

/// Whether `b` goes on in the recording where `a` ends.
bool is_continued(const Piece& a, const Piece& b) {
  return a.source >= 0 && a.source == b.source && a.source_begin + a.motion.num_frames() == b.source_begin;
}

}  // namespace

JoinedMotion join(const std::vector<Piece>& pieces, const JoinOptions& options) {
  check(pieces, options);
  std::vector<Motion> motions, stretches;
  std::vector<int> begins;
  int num_frames = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Motion& motion = pieces[k].motion;
    motions.push_back(motion);
    begins.push_back(num_frames);
    num_frames += motion.num_frames();
    if (k == 0 || !is_continued(pieces[k - 1], pieces[k])) {
      stretches.push_back(motion);
      continue;
    }
    std::vector<Pose> frames = stretches.back().frames();
    frames.insert(frames.end(), motion.frames().begin(), motion.frames().end());
    stretches.back() = {stretches.back().shared_skeleton(), motion.frame_rate(), std::move(frames)};
  }
  Joiner joiner(stretches.front(), motion::upright_reference(motions), options);
  for (const Motion& stretch : stretches) joiner.append(stretch);
  return {joiner.motion(), std::move(begins)};
}

JoinedMotion join(const std::vector<Motion>& pieces, const JoinOptions& options) {
  std::vector<Piece> all;
  for (const Motion& motion : pieces) all.push_back({motion});
  return join(all, options);
}

std::vector<motion::Footplant> joined_plants(const JoinedMotion& joined,
                                             const std::vector<std::vector<motion::Footplant>>& plants) {
  if (plants.size() != joined.begins.size()) {
    throw InvalidArgument("plants", std::to_string(joined.begins.size()) + " lists, one for each piece",
                          std::to_string(plants.size()));
  }
  std::vector<motion::Footplant> all;
  for (std::size_t k = 0; k < plants.size(); ++k) {
    for (const motion::Footplant& plant : plants[k]) {
      all.push_back({plant.foot, plant.begin + joined.begins[k], plant.end + joined.begins[k]});
    }
  }
  return merged_plants(std::move(all));
}

}  // namespace strut::effort
