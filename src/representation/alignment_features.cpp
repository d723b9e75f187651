// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <strut/core/error.h>
#include <strut/motion/kinematics.h>
#include <strut/motion/legs.h>
#include <strut/representation/alignment_features.h>
#include <strut/representation/representation.h>

namespace strut::representation {
namespace {

using Eigen::Index;

// Changes are taken over twice this time [s]: one frame either way at 30 frames/s, the same at any other rate.
constexpr double kHalfWindow = 1.0 / 30.0;
// A foot that swings is as fast as this share of the clip's frames are at most.
constexpr double kFastQuantile = 0.95;
// The speed at which a foot counts as half still: of its fast speed, and at least this many leg lengths a second.
constexpr double kStillShare = 0.2;
constexpr double kLeastSpeed = 0.15;
// Changes of posture (in its deviations) and of stillness that are no more than noise: per second, and as such.
constexpr double kLeastMovement = 0.05;
constexpr double kLeastStillness = 0.01;

int half_window(double frame_rate) {
  return std::max(1, static_cast<int>(std::lround(kHalfWindow * frame_rate)));
}

/// Rates of change per second, centred, one-sided at the ends.
FrameMatrix rates_of(const FrameMatrix& signal, double frame_rate) {
  const Index last = signal.rows() - 1, half = half_window(frame_rate);
  FrameMatrix rates = FrameMatrix::Zero(signal.rows(), signal.cols());
  for (Index t = 0; t <= last && last > 0; ++t) {
    const Index before = std::max<Index>(0, t - half), after = std::min(last, t + half);
    rates.row(t) = (signal.row(after) - signal.row(before)) * (frame_rate / static_cast<double>(after - before));
  }
  return rates;
}

double quantile(std::vector<double> values, double share) {
  const auto index = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

/// Mean and deviation of every column over all `clips`.
struct Spread {
  Eigen::RowVectorXd mean, deviation;

  explicit Spread(const std::vector<FrameMatrix>& clips) {
    double frames = 0.0;
    mean = deviation = Eigen::RowVectorXd::Zero(clips.front().cols());
    for (const FrameMatrix& clip : clips) {
      mean += clip.colwise().sum();
      frames += static_cast<double>(clip.rows());
    }
    mean /= frames;
    for (const FrameMatrix& clip : clips) deviation += (clip.rowwise() - mean).colwise().squaredNorm();
    deviation = (deviation / frames).cwiseSqrt();
  }
};

using Clips = std::vector<FrameMatrix>;

/// One group of signals of all clips of all styles, and which of its columns count.
struct Group {
  std::vector<Clips> styles;
  std::vector<bool> counts;
  double share;

  [[nodiscard]] double weight() const {
    const auto kept = std::count(counts.begin(), counts.end(), true);
    return kept == 0 ? 0.0 : share / static_cast<double>(kept);
  }
};

/// A group that counts nothing: of no columns.
Group nothing(const std::vector<StyleClips>& styles) {
  Group group{std::vector<Clips>(styles.size()), {}, 0.0};
  for (std::size_t s = 0; s < styles.size(); ++s) {
    for (const FrameMatrix& rows : styles[s].rows) group.styles[s].emplace_back(rows.rows(), 0);
  }
  return group;
}

/// Divides every style by its deviations, or by those of all; columns that hardly change in one become zero.
void scale(Group& group, double least, StyleUnits units) {
  std::vector<Eigen::RowVectorXd> deviations;
  for (const Clips& clips : group.styles) deviations.push_back(Spread(clips).deviation);
  Eigen::ArrayXd pooled = Eigen::ArrayXd::Zero(deviations.front().size());
  for (const Eigen::RowVectorXd& own : deviations) pooled += own.transpose().array().square();
  pooled = (pooled / static_cast<double>(deviations.size())).sqrt();
  for (Index d = 0; d < pooled.size(); ++d) {
    const bool moves =
        std::all_of(deviations.begin(), deviations.end(), [&](const auto& own) { return own[d] > least; });
    group.counts.push_back(moves);
    for (Eigen::RowVectorXd& own : deviations) {
      own[d] = moves ? 1.0 / (units == StyleUnits::kShared ? pooled[d] : own[d]) : 0.0;
    }
  }
  for (std::size_t s = 0; s < deviations.size(); ++s) {
    for (FrameMatrix& clip : group.styles[s]) clip *= deviations[s].asDiagonal();
  }
}

Group posture_of(const std::vector<StyleClips>& styles, double share) {
  Group group{std::vector<Clips>(styles.size()), {}, share};
  std::vector<Normalization> scalings;
  for (const StyleClips& style : styles) scalings.push_back(fit_normalization(style.rows));
  for (int dof = kHeight; dof < scalings.front().num_dofs(); ++dof) {
    group.counts.push_back(
        std::all_of(scalings.begin(), scalings.end(), [&](const Normalization& own) { return own.is_kept(dof); }));
  }
  for (std::size_t s = 0; s < styles.size(); ++s) {
    for (const FrameMatrix& rows : styles[s].rows) {
      FrameMatrix posture = scalings[s].normalize(rows).rightCols(rows.cols() - kHeight);
      for (Index dof = 0; dof < posture.cols(); ++dof) {
        if (!group.counts[static_cast<std::size_t>(dof)]) posture.col(dof).setZero();
      }
      group.styles[s].push_back(std::move(posture));
    }
  }
  return group;
}

Group movement_of(const Group& posture, double frame_rate, double share) {
  Group group{std::vector<Clips>(posture.styles.size()), {}, share};
  for (std::size_t s = 0; s < posture.styles.size(); ++s) {
    for (const FrameMatrix& clip : posture.styles[s]) group.styles[s].push_back(rates_of(clip, frame_rate));
  }
  scale(group, kLeastMovement, StyleUnits::kOwn);
  return group;
}

Group feet_of(const std::vector<StyleClips>& styles, double share) {
  Group group{{}, {}, share};
  for (const StyleClips& style : styles) {
    if (style.stillness.empty()) return nothing(styles);
    group.styles.push_back(style.stillness);
  }
  scale(group, kLeastStillness, StyleUnits::kShared);
  return group;
}

FrameMatrix beside(const FrameMatrix& a, const FrameMatrix& b, const FrameMatrix& c) {
  FrameMatrix all(a.rows(), a.cols() + b.cols() + c.cols());
  all << a, b, c;
  return all;
}

void check(const StyleClips& style, const char* name) {
  const bool has_feet = !style.stillness.empty();
  bool fits = !has_feet || style.stillness.size() == style.rows.size();
  for (std::size_t k = 0; fits && has_feet && k < style.rows.size(); ++k) {
    fits = style.stillness[k].rows() == style.rows[k].rows() && style.stillness[k].cols() == 2;
  }
  if (!fits)
    throw InvalidArgument(name, "stillness of both feet in every frame of every clip, or none", "another size");
}

void check(double frame_rate, const FeatureShares& shares) {
  if (!(frame_rate > 0.0) || !std::isfinite(frame_rate)) {
    throw InvalidArgument("frame_rate", "a positive number", std::to_string(frame_rate));
  }
  for (const double share : {shares.posture, shares.movement, shares.feet}) {
    if (share >= 0.0 && std::isfinite(share)) continue;
    throw InvalidArgument("shares", "numbers that are not negative", std::to_string(share));
  }
}

/// What alignment looks at in every clip of some styles.
struct StyleFeatures {
  std::vector<Clips> styles;
  Eigen::VectorXd weights;
};

StyleFeatures features_of(const std::vector<StyleClips>& styles, double frame_rate, const FeatureShares& shares) {
  const Group posture = posture_of(styles, shares.posture);
  const Group movement = shares.movement > 0.0 ? movement_of(posture, frame_rate, shares.movement) : nothing(styles);
  const Group feet = shares.feet > 0.0 ? feet_of(styles, shares.feet) : nothing(styles);
  StyleFeatures features{std::vector<Clips>(styles.size()), {}};
  for (std::size_t s = 0; s < styles.size(); ++s) {
    for (std::size_t k = 0; k < styles[s].rows.size(); ++k) {
      features.styles[s].push_back(beside(posture.styles[s][k], movement.styles[s][k], feet.styles[s][k]));
    }
  }
  std::vector<double> weights;
  for (const Group* group : {&posture, &movement, &feet}) {
    for (const bool counts : group->counts) weights.push_back(counts ? group->weight() : 0.0);
  }
  features.weights = Eigen::Map<const Eigen::VectorXd>(weights.data(), static_cast<Index>(weights.size()));
  return features;
}

}  // namespace

FrameMatrix alignment_features(const FrameMatrix& rows, const Normalization& own, const Normalization& other) {
  FrameMatrix features = own.normalize(rows).rightCols(rows.cols() - kHeight);
  for (Eigen::Index dof = 0; dof < features.cols(); ++dof) {
    if (!other.is_kept(static_cast<int>(dof) + kHeight)) features.col(dof).setZero();
  }
  return features;
}

AlignmentPair alignment_features(const Motion& input, const Motion& output, StyleUnits units) {
  const bool shared = units == StyleUnits::kShared;
  const std::vector<Motion> both{input, output};
  const Eigen::Quaterniond upright = motion::upright_reference(input);
  const auto of_input = fit_representation(shared ? both : std::vector{input}, upright);
  const auto of_output = shared ? of_input : fit_representation({output}, upright);
  check_skeleton(of_input, output.skeleton());
  const FrameMatrix u = encode(of_input, input), y = encode(of_output, output);
  const auto scaling_of_input = fit_normalization(shared ? std::vector{u, y} : std::vector{u});
  const auto scaling_of_output = shared ? scaling_of_input : fit_normalization({y});
  return {alignment_features(u, scaling_of_input, scaling_of_output),
          alignment_features(y, scaling_of_output, scaling_of_input)};
}

FrameMatrix foot_stillness(const Motion& motion, const motion::Legs& legs) {
  if (motion.num_frames() == 0) throw InvalidArgument("motion", "at least one frame", "none");
  FrameMatrix toes(motion.num_frames(), 6);
  Eigen::Vector2d leg_length = Eigen::Vector2d::Zero();
  motion::WorldPose world;
  for (int t = 0; t < motion.num_frames(); ++t) {
    const Pose& pose = motion.frame(t);
    motion::forward_kinematics(motion.skeleton(), pose, world);
    for (int foot = 0; foot < 2; ++foot) {
      const motion::Leg& leg = legs.foot(foot);
      toes.row(t).segment<3>(3 * foot) = motion::toe_position(leg, world).transpose();
      leg_length[foot] += (pose.translations[static_cast<std::size_t>(leg.knee)].norm() +
                           pose.translations[static_cast<std::size_t>(leg.ankle)].norm()) /
                          motion.num_frames();
    }
  }
  const FrameMatrix velocities = rates_of(toes, motion.frame_rate());
  FrameMatrix stillness(toes.rows(), 2);
  for (int foot = 0; foot < 2; ++foot) {
    const Eigen::VectorXd speed = velocities.middleCols<3>(3 * foot).rowwise().norm();
    const double fast = quantile({speed.data(), speed.data() + speed.size()}, kFastQuantile);
    const double half = std::max(kStillShare * fast, kLeastSpeed * leg_length[foot]);
    stillness.col(foot) = 1.0 / (1.0 + (speed.array() / half).square());
  }
  return stillness;
}

TimingFeatures timing_features(const StyleClips& input, const StyleClips& output, double frame_rate,
                               const FeatureShares& shares) {
  check(frame_rate, shares);
  check(input, "input");
  check(output, "output");
  StyleFeatures features = features_of({input, output}, frame_rate, shares);
  return {std::move(features.styles.front()), std::move(features.styles.back()), std::move(features.weights)};
}

TimingPair timing_features(const Motion& input, const Motion& output, const FeatureShares& shares) {
  TimingGroup group = timing_features(std::vector{input, output}, motion::find_legs(input), shares);
  return {std::move(group.clips.front()), std::move(group.clips.back()), std::move(group.weights)};
}

TimingGroup timing_features(const std::vector<Motion>& motions, const std::optional<motion::Legs>& legs,
                            const FeatureShares& shares) {
  if (motions.empty()) throw InvalidArgument("motions", "at least one", "none");
  const Motion& first = motions.front();
  check(first.frame_rate(), shares);
  const Eigen::Quaterniond upright = motion::upright_reference(first);
  const auto of_first = fit_representation({first}, upright);
  std::vector<StyleClips> styles;
  for (const Motion& motion : motions) {
    check_skeleton(of_first, motion.skeleton());
    const auto own = fit_representation({motion}, upright);
    styles.push_back({{encode(own, motion)}, {}});
    if (legs) styles.back().stillness.push_back(foot_stillness(motion, *legs));
  }
  StyleFeatures features = features_of(styles, first.frame_rate(), shares);
  TimingGroup group{{}, std::move(features.weights)};
  for (Clips& clips : features.styles) group.clips.push_back(std::move(clips.front()));
  return group;
}

}  // namespace strut::representation
