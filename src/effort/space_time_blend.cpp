// SPDX-License-Identifier: MIT
// Symbols of the design: u the fragments' common time, p and q their frames, t the blend's, all in frames but u.
#include "effort/blend_source.h"
#include "effort/blended_plants.h"
#include "effort/merged_plants.h"
#include "effort/pair_timing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/effort/effort.h>
#include <strut/effort/space_time_blend.h>
#include <strut/math/rotation.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/representation/pose_encoder.h>

namespace strut::effort {
namespace {

using Eigen::Index;
using Eigen::Quaterniond;
using Eigen::VectorXd;

constexpr int kLeastFrames = 4;
constexpr double kLargestSlope = 16.0;
// A body that leans farther than this from upright has no heading to speak of.
constexpr double kLargestTilt = 150.0 * std::numbers::pi / 180.0;
// A bone that moves by less keeps its length [m].
constexpr double kRigid = 1e-9;

std::size_t place(int number) {
  return static_cast<std::size_t>(number);
}

std::string degrees(double angle) {
  return std::to_string(std::lround(angle * 180.0 / std::numbers::pi)) + " degrees";
}

void check(const Motion& first, const Motion& second, const SpaceTimeBlendOptions& options) {
  if (!(options.slope_limit > 1.0 && options.slope_limit <= kLargestSlope)) {
    throw InvalidArgument("slope_limit", "a number above 1, at most 16", std::to_string(options.slope_limit));
  }
  if (!(options.largest_angle > 0.0 && options.largest_angle < std::numbers::pi)) {
    throw InvalidArgument("largest_angle", "an angle above 0 and below pi", std::to_string(options.largest_angle));
  }
  const std::string mismatch = describe_mismatch(first.skeleton(), second.skeleton());
  if (!mismatch.empty()) throw SkeletonMismatch("the fragments have different skeletons: " + mismatch);
  if (first.frame_rate() != second.frame_rate()) {
    throw InvalidArgument("second", std::to_string(first.frame_rate()) + " frames/s, as the first",
                          std::to_string(second.frame_rate()), "resample one of them");
  }
  for (const auto& [name, motion] : {std::pair{"first", &first}, std::pair{"second", &second}}) {
    if (motion->num_frames() >= kLeastFrames) continue;
    throw InvalidArgument(name, "at least 4 frames", std::to_string(motion->num_frames()));
  }
}

VectorXd mapped(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

/// Footplants of a fragment in the common time, of which `frames` are its frames.
std::vector<TimedPlant> timed_plants(const Motion& motion, const motion::Legs& legs, const math::SmoothCurve& frames) {
  std::vector<TimedPlant> timed;
  for (const motion::Footplant& plant : postprocess::detect_footplants(motion, legs)) {
    timed.push_back({plant.foot, frames.inverse(plant.begin), frames.inverse(plant.end - 1)});
  }
  return timed;
}

/// Of a blend that lasts `last` [frames] from its first to its last; halves go down whatever their rounding.
int frames_for(double last) {
  constexpr double kRounding = 1e-6;
  return std::max(2, static_cast<int>(std::floor(last + 0.5 - kRounding)) + 1);
}

/// `plants` in frames of a blend of `num_frames`, whose time is `time`, by foot, then begin; those that touch are one.
std::vector<motion::Footplant> in_frames(const std::vector<TimedPlant>& plants, const math::SmoothCurve& time,
                                         int num_frames) {
  const double per_frame = (num_frames - 1) / time.y().back();
  std::vector<motion::Footplant> found;
  for (const TimedPlant& plant : plants) {
    const auto frame = [&](double u) { return static_cast<int>(std::lround(time.at(u) * per_frame)); };
    found.push_back({plant.foot, frame(plant.begin), frame(plant.end) + 1});
  }
  return merged_plants(std::move(found));
}

}  // namespace

struct SpaceTimeBlend::Parts {
  std::shared_ptr<const Skeleton> skeleton;
  double frame_rate;
  representation::Representation representation;
  representation::RootPlacement start;  // of the first fragment
  std::optional<motion::Legs> legs;
  PairTiming timing;
  math::SmoothCurve p, q;  // over u
  BlendSource first, second;
  Pose bones;               // of the first fragment
  std::vector<int> moving;  // joints whose bones change, from 0 below the pelvis
  std::vector<PlantPair> plants;

  Parts(const Motion& a, const Motion& b, const SpaceTimeBlendOptions& options);
  void check_angles(double largest) const;
  [[nodiscard]] std::pair<VectorXd, VectorXd> moments(const math::SmoothCurve& time, int num_frames) const;
  [[nodiscard]] std::vector<Pose> poses(const VectorXd& of_first, const VectorXd& of_second, double alpha) const;

 private:
  void find_moving_bones();
};

SpaceTimeBlend::Parts::Parts(const Motion& a, const Motion& b, const SpaceTimeBlendOptions& options)
    : skeleton(a.shared_skeleton()),
      frame_rate(a.frame_rate()),
      representation(representation::fit_representation({a}, motion::upright_reference({a, b}))),
      start(
          representation::placement(representation::pelvis_world(a.skeleton(), a.frame(0)), representation.upright())),
      legs(motion::find_legs(a)),
      timing(align_fragments(a, b, options.slope_limit)),
      p(timing.u, timing.first),
      q(timing.u, timing.second),
      first(a, a.skeleton(), 1.0),
      second(b, a.skeleton(), length_scale(b, a)),
      bones(a.frame(0)) {
  if (!legs) legs = motion::find_legs(b);
  check_angles(options.largest_angle);
  find_moving_bones();
  if (legs) plants = match_plants(timed_plants(a, *legs, p), timed_plants(b, *legs, q));
}

void SpaceTimeBlend::Parts::find_moving_bones() {
  for (int i = 0; i < first.num_joints(); ++i) {
    const double reach = first.reach_of_bone(i).extend(second.reach_of_bone(i)).diagonal().norm();
    if (reach > kRigid) moving.push_back(i);
  }
}

/// Refuses fragments of which some joint turns too far from the other's, followed over time so that an angle past a
/// half turn counts as that, or of which one turns upside down.
void SpaceTimeBlend::Parts::check_angles(double largest) const {
  const FrameMatrix a = first.sample(mapped(timing.first)), b = second.sample(mapped(timing.second));
  std::string joint;
  double most = 0.0;
  Index where = 0;
  const auto see = [&](double angle, Index row, int index) {
    if (angle <= most) return;
    most = angle;
    where = row;
    joint = skeleton->joint(index).name;
  };
  const auto refuse = [&](const std::string& expected, const std::string& got) {
    const long frame = std::lround(timing.first[static_cast<std::size_t>(where)]);
    throw InvalidArgument("second", expected, got + " at frame " + std::to_string(frame) + " of the first",
                          "blend movements of like content, cut alike");
  };
  for (int i = 0; i < first.num_joints(); ++i) {
    Quaterniond before = Quaterniond::Identity();
    for (Index row = 0; row < a.rows(); ++row) {
      Quaterniond apart = first.rotation(a, row, i).conjugate() * second.rotation(b, row, i);
      if (apart.dot(before) < 0.0) apart.coeffs() = -apart.coeffs();
      before = apart;
      see(2.0 * std::atan2(apart.vec().norm(), apart.w()), row, skeleton->pelvis() + 1 + i);
    }
  }
  if (most > largest) {
    refuse("joints turned at most " + degrees(largest) + " from the first's", joint + ", " + degrees(most));
  }
  const auto tilt = [&](const BlendSource& source, const FrameMatrix& rows, Index row) {
    const Quaterniond body = source.pelvis(rows, row).rotation * representation.upright().conjugate();
    return std::acos(std::clamp((body * Eigen::Vector3d::UnitY()).y(), -1.0, 1.0));
  };
  most = 0.0;
  for (Index row = 0; row < a.rows(); ++row) {
    see(std::max(tilt(first, a, row), tilt(second, b, row)), row, skeleton->pelvis());
  }
  if (most > kLargestTilt) {
    refuse("bodies that lean at most " + degrees(kLargestTilt) + ", which tells where they face", degrees(most));
  }
}

/// The fragments' frames that belong to a blend's frames.
std::pair<VectorXd, VectorXd> SpaceTimeBlend::Parts::moments(const math::SmoothCurve& time, int num_frames) const {
  VectorXd of_first(num_frames), of_second(num_frames);
  for (int k = 0; k < num_frames; ++k) {
    const bool is_end = k == num_frames - 1;
    const double u = k == 0 ? 0.0 : is_end ? 1.0 : time.inverse(time.y().back() * k / (num_frames - 1));
    of_first[k] = p.at(u);
    of_second[k] = q.at(u);
  }
  return {std::move(of_first), std::move(of_second)};
}

std::vector<Pose> SpaceTimeBlend::Parts::poses(const VectorXd& of_first, const VectorXd& of_second,
                                               double alpha) const {
  const FrameMatrix a = first.sample(of_first), b = second.sample(of_second);
  const double frame_time = 1.0 / frame_rate;
  representation::PoseDecoder<double> decoder(representation, frame_rate, start);
  const int plane = representation::RowLayout(representation.num_dofs()).plane();
  math::AlignedVector<double> rotations(place(4 * plane));
  representation::RootPlacement at_first, at_second;
  std::vector<Pose> frames(place(static_cast<int>(a.rows())), bones);
  for (Index k = 0; k < a.rows(); ++k) {
    const auto& upright = representation.upright();
    auto root = representation::encode_root(first.pelvis(a, k), at_first, upright, frame_time);
    const auto other = representation::encode_root(second.pelvis(b, k), at_second, upright, frame_time);
    for (std::size_t dof = 0; dof < root.size(); ++dof) root[dof] = (1.0 - alpha) * root[dof] + alpha * other[dof];
    for (int i = 0; i < first.num_joints(); ++i) {
      const Quaterniond from = first.rotation(a, k, i), to = second.rotation(b, k, i);
      const Quaterniond blend = from * math::exp_map(alpha * math::log_map(from.conjugate() * to));
      for (int c = 0; c < 4; ++c) rotations[place(c * plane + i)] = blend.coeffs()[c];
    }
    Pose& pose = frames[static_cast<std::size_t>(k)];
    for (const int i : moving) {
      pose.translations[place(skeleton->pelvis() + 1 + i)] =
          (1.0 - alpha) * first.translation(a, k, i) + alpha * second.translation(b, k, i);
    }
    decoder.decode(root.data(), rotations.data(), upright, view(std::as_const(pose)), view(pose));
  }
  return frames;
}

SpaceTimeBlend::SpaceTimeBlend(const Motion& first, const Motion& second, const SpaceTimeBlendOptions& options) {
  check(first, second, options);
  parts_ = std::make_unique<const Parts>(first, second, options);
}

SpaceTimeBlend::~SpaceTimeBlend() = default;
SpaceTimeBlend::SpaceTimeBlend(SpaceTimeBlend&&) noexcept = default;
SpaceTimeBlend& SpaceTimeBlend::operator=(SpaceTimeBlend&&) noexcept = default;

const std::optional<motion::Legs>& SpaceTimeBlend::legs() const {
  return parts_->legs;
}

double SpaceTimeBlend::least_linear_alpha() const noexcept {
  return parts_->timing.least_alpha;
}

double SpaceTimeBlend::greatest_linear_alpha() const noexcept {
  return parts_->timing.greatest_alpha;
}

Blend SpaceTimeBlend::at(double alpha) const {
  if (!(alpha >= kLeastAlpha && alpha <= kLargestAlpha)) {
    throw InvalidArgument("alpha", "a number from -2 to 3", std::to_string(alpha));
  }
  const math::SmoothCurve time = blended_time(parts_->timing, alpha);
  const int num_frames = frames_for(time.y().back());
  auto [of_first, of_second] = parts_->moments(time, num_frames);
  Motion motion(parts_->skeleton, parts_->frame_rate, parts_->poses(of_first, of_second, alpha));
  return {std::move(motion), in_frames(blended_plants(parts_->plants, alpha), time, num_frames), std::move(of_first),
          std::move(of_second)};
}

}  // namespace strut::effort
