// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/effort/fragment_cuts.h>
#include <strut/effort/fragment_features.h>
#include <strut/motion/legs.h>

namespace strut::effort {
namespace {

using Eigen::Index;
using motion::FrameRange;

constexpr double kFastQuantile = 0.9;
constexpr double kLeastSpeed = 0.02;       // body sizes a second, of fast movement: below, a clip stands still
constexpr double kSmoothing = 1.0 / 30.0;  // [s] to either side: what motion capture at the usual rate resolves
constexpr double kReturn = 0.6;            // a posture has returned that is nearer by this share than the one between
constexpr double kStride = 0.015;          // how far a leg is at least forward that strides, as left_forward
constexpr int kLeastReturns = 3;           // on end: two whole cycles

void check(const CutOptions& options) {
  const auto fail = [](const char* name, const char* expected, double got) {
    throw InvalidArgument(name, expected, std::to_string(got));
  };
  const auto is_share = [](double number) { return number >= 0.0 && number < 1.0; };
  if (!(options.min_duration > 0.0) || !std::isfinite(options.min_duration)) {
    fail("min_duration", "a positive number", options.min_duration);
  }
  if (!(options.max_duration >= 2.0 * options.min_duration)) {
    fail("max_duration", "at least twice the least duration", options.max_duration);
  }
  if (!is_share(options.turn_depth) || options.turn_depth == 0.0) {
    fail("turn_depth", "a share between 0 and 1", options.turn_depth);
  }
  if (!is_share(options.pause_speed)) fail("pause_speed", "a share from 0 to below 1", options.pause_speed);
  if (!(options.min_pause >= 0.0)) fail("min_pause", "a number that is not negative", options.min_pause);
}

/// What cutting looks at: postures, how fast they change, and the options in frames.
struct Clip {
  FrameMatrix postures;
  Eigen::VectorXd speed;  // root mean square over joints [m/s]
  double frame_rate = 0.0;
  CutOptions options;

  [[nodiscard]] int frames(double seconds) const {
    return std::max(1, static_cast<int>(std::lround(std::min(seconds, 1e6) * frame_rate)));
  }
  [[nodiscard]] double distance(int a, int b) const { return (postures.row(a) - postures.row(b)).norm(); }
};

/// The root mean square of the joints' distances from their mean, in the mean over the clip [m].
double body_size(const FrameMatrix& postures) {
  const Index joints = postures.cols() / 3;
  double sum = 0.0;
  for (Index axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd along = postures.colwise().mean().reshaped(3, joints).row(axis).transpose();
    sum += (along.array() - along.mean()).square().sum();
  }
  return std::sqrt(sum / static_cast<double>(joints));
}

/// Central differences over `reach` frames, twice averaged over as many.
Eigen::VectorXd speeds(const FrameMatrix& postures, double frame_rate, int reach) {
  const auto frames = static_cast<int>(postures.rows());
  Eigen::VectorXd speed(frames);
  for (int t = 0; t < frames; ++t) {
    const int from = std::max(0, t - reach), to = std::min(frames - 1, t + reach);
    const double joints = static_cast<double>(postures.cols()) / 3.0;
    speed[t] = to == from ? 0.0
                          : (postures.row(to) - postures.row(from)).norm() / std::sqrt(joints) * frame_rate /
                                static_cast<double>(to - from);
  }
  Eigen::VectorXd smooth(frames);
  for (int t = 0; t < frames; ++t) {
    const int from = std::max(0, t - reach), to = std::min(frames - 1, t + reach);
    smooth[t] = speed.segment(from, to - from + 1).mean();
  }
  return smooth;
}

double quantile(Eigen::VectorXd numbers, double share) {
  auto* at = numbers.data() + static_cast<Index>(share * static_cast<double>(numbers.size() - 1));
  std::nth_element(numbers.data(), at, numbers.data() + numbers.size());
  return *at;
}

/// The stretches between pauses; none of a clip that hardly moves.
std::vector<FrameRange> movements(const Clip& clip) {
  const double fast = quantile(clip.speed, kFastQuantile);
  if (!(fast > kLeastSpeed * body_size(clip.postures))) return {};
  const double slow = clip.options.pause_speed * fast;
  const int longest = clip.frames(clip.options.min_pause);
  std::vector<FrameRange> found;
  const auto frames = static_cast<int>(clip.speed.size());
  for (int t = 0; t < frames; ++t) {
    if (clip.speed[t] < slow) continue;
    if (found.empty() || t - found.back().end >= longest) found.push_back({t, t});
    found.back().end = t + 1;
  }
  // A standstill at an end that is shorter than a pause belongs to the movement.
  if (!found.empty() && found.front().begin < longest) found.front().begin = 0;
  if (!found.empty() && frames - found.back().end < longest) found.back().end = frames;
  return found;
}

/// Turning points of a movement by frame, with what stands between them.
class TurningPoints {
 public:
  TurningPoints(const Clip& clip, const FrameRange& movement) : clip_(clip), movement_(movement) {
    for (int t = movement.begin + 1; t + 1 < movement.end; ++t) {
      if (clip.speed[t] < clip.speed[t - 1] && clip.speed[t] <= clip.speed[t + 1]) frames_.push_back(t);
    }
    drop_shallow();
    add_ends();
    drop_close();
  }

  [[nodiscard]] const std::vector<int>& frames() const noexcept { return frames_; }

 private:
  [[nodiscard]] double peak(int from, int to) const { return clip_.speed.segment(from, to - from).maxCoeff(); }
  [[nodiscard]] int before(std::size_t k) const { return k == 0 ? movement_.begin : frames_[k - 1]; }
  [[nodiscard]] int after(std::size_t k) const { return k + 1 == frames_.size() ? movement_.end : frames_[k + 1]; }

  /// Speed as a share of the lower of the two peaks beside: 0 a standstill.
  [[nodiscard]] double depth(std::size_t k) const {
    const int t = frames_[k];
    return clip_.speed[t] / std::max(std::min(peak(before(k), t + 1), peak(t, after(k))), 1e-300);
  }

  /// The shallowest first, for peaks grow together as minima between them go.
  void drop_shallow() {
    while (!frames_.empty()) {
      std::size_t shallowest = 0;
      for (std::size_t k = 1; k < frames_.size(); ++k) {
        if (depth(k) > depth(shallowest)) shallowest = k;
      }
      if (depth(shallowest) <= clip_.options.turn_depth) return;
      frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(shallowest));
    }
  }

  /// The movement's ends, if they are pauses' or as slow as a turning point.
  void add_ends() {
    const int first = movement_.begin, last = movement_.end - 1;
    const int next = frames_.empty() ? last : frames_.front(), previous = frames_.empty() ? first : frames_.back();
    const double limit = clip_.options.turn_depth;
    const bool begins = clip_.speed[first] <= limit * peak(first, next + 1);
    const bool ends = clip_.speed[last] <= limit * peak(previous, last + 1);
    if (begins) frames_.insert(frames_.begin(), first);
    if (ends) frames_.push_back(last);
  }

  /// Of two that are too close, the faster goes.
  void drop_close() {
    const int least = clip_.frames(clip_.options.min_duration);
    for (std::size_t k = 0; k + 1 < frames_.size();) {
      if (frames_[k + 1] - frames_[k] >= least) {
        ++k;
        continue;
      }
      const bool first_goes = clip_.speed[frames_[k]] > clip_.speed[frames_[k + 1]];
      frames_.erase(frames_.begin() + static_cast<std::ptrdiff_t>(k + (first_goes ? 0 : 1)));
      if (first_goes && k > 0) --k;
    }
  }

  const Clip& clip_;
  FrameRange movement_;
  std::vector<int> frames_;
};

/// What tells the two turning points of a cycle apart.
struct PostureMoments {
  double left_forward = 0.0;  ///< the left leg, and the right arm, which swings with it: above the pelvis the other way
  double width = 0.0, height = 0.0;
};

/// Of the joints, in squares of the pelvis's height.
PostureMoments posture_moments(const Eigen::Ref<const Eigen::RowVectorXd>& posture) {
  PostureMoments moments;
  const double pelvis = std::max(std::abs(posture[1]), 1e-9);
  for (Index j = 0; j + 2 < posture.size(); j += 3) {
    const double x = posture[j] / pelvis, y = posture[j + 1] / pelvis, z = posture[j + 2] / pelvis;
    moments.left_forward += x * z * (1.0 - y);
    moments.width += x * x;
    moments.height += y * y;
  }
  return moments;
}

/// Whether a cycle that goes from `a` to `b` and back should begin with `b` instead.
bool begins_with_other(const Clip& clip, int a, int b) {
  const PostureMoments of_a = posture_moments(clip.postures.row(a)), of_b = posture_moments(clip.postures.row(b));
  const bool mirrors = of_a.left_forward * of_b.left_forward < 0.0 &&
                       std::min(std::abs(of_a.left_forward), std::abs(of_b.left_forward)) > kStride;
  if (mirrors) return of_b.left_forward > 0.0;
  const double wider = of_b.width - of_a.width, higher = of_b.height - of_a.height;
  return (std::abs(wider) > std::abs(higher) ? wider : higher) > 0.0;
}

/// Whether the posture of turning point k is back at k + 2.
bool returns(const Clip& clip, const std::vector<int>& turns, std::size_t k) {
  const double back = clip.distance(turns[k], turns[k + 2]);
  const double away = std::min(clip.distance(turns[k], turns[k + 1]), clip.distance(turns[k + 1], turns[k + 2]));
  return back < kReturn * away;
}

/// Cuts a movement at its turning points: repeated there-and-back into whole cycles, all else from one to the next.
void cut_movement(const Clip& clip, const std::vector<int>& turns, std::vector<FrameRange>& fragments) {
  for (std::size_t k = 0; k + 1 < turns.size();) {
    std::size_t run = k;
    while (run + 2 < turns.size() && returns(clip, turns, run)) ++run;
    if (run - k < kLeastReturns) {
      fragments.push_back({turns[k], turns[k + 1]});
      ++k;
      continue;
    }
    const std::size_t last = run + 1;  // the last turning point of the repetition
    if (begins_with_other(clip, turns[k], turns[k + 1])) {
      fragments.push_back({turns[k], turns[k + 1]});
      ++k;
    }
    for (; k + 2 <= last; k += 2) fragments.push_back({turns[k], turns[k + 2]});
  }
}

/// Cuts what is too long where it is slowest, but not near its ends.
void cut_long(const Clip& clip, const FrameRange& fragment, std::vector<FrameRange>& fragments) {
  const int most = clip.frames(clip.options.max_duration), least = clip.frames(clip.options.min_duration);
  if (fragment.num_frames() <= most) {
    if (fragment.num_frames() >= least) fragments.push_back(fragment);
    return;
  }
  const int margin = std::max(least, fragment.num_frames() / 4);
  Index slowest = 0;
  clip.speed.segment(fragment.begin + margin, fragment.num_frames() - 2 * margin).minCoeff(&slowest);
  const int at = fragment.begin + margin + static_cast<int>(slowest);
  cut_long(clip, {fragment.begin, at}, fragments);
  cut_long(clip, {at, fragment.end}, fragments);
}

}  // namespace

std::vector<FrameRange> suggest_cuts(const Motion& motion, const CutOptions& options) {
  check(options);
  if (motion.num_frames() < 2) return {};
  Clip clip{joint_features(motion, motion::upright_reference(motion)), {}, motion.frame_rate(), options};
  clip.speed = speeds(clip.postures, clip.frame_rate, clip.frames(kSmoothing));
  std::vector<FrameRange> units, fragments;
  for (const FrameRange& movement : movements(clip)) {
    cut_movement(clip, TurningPoints(clip, movement).frames(), units);
  }
  for (const FrameRange& unit : units) cut_long(clip, unit, fragments);
  return fragments;
}

}  // namespace strut::effort
