// SPDX-License-Identifier: MIT
// The mean joint distance of every frame of one clip from every frame of the other is computed once and serves all
// windows of both directions. A window's warping path is found row by row: row i, which holds the cheapest way to end
// with frame i of the window on each frame of the clip, depends on rows i-1 and i-2 alone, so whole rows are computed
// at once. Single precision: positions are metres near zero, so its rounding is a tenth of a micrometre.
#include <algorithm>
#include <cmath>
#include <limits>

#include <strut/core/error.h>
#include <strut/metrics/clip_distance.h>

namespace strut::metrics {
namespace {

using Rows = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kWindowSeconds = 1.0;
constexpr double kSameRate = 1e-6;    // relative; rates come from printed frame times
constexpr Eigen::Index kPadding = 2;  // columns before the clip's first frame: how far back a step reaches
constexpr float kUnreachable = std::numeric_limits<float>::infinity();

/// A frame of the window and a frame of the clip that a path lays on each other, and its share of the window's cost.
struct Contact {
  Eigen::Index row;
  Eigen::Index column;
  double weight;
};

/// A window and where its best match ends.
struct Match {
  Eigen::Index start = 0;
  Eigen::Index end_column = 0;
  double distance = -1.0;
};

struct OneWay {
  double mean = 0.0;
  Match worst;
  Eigen::Index length = 0;  ///< of every window [frames]
};

/// Each joint's distance between two frames [m], summed over the joints and divided by their number. (Ta x Tb)
Rows frame_distances(const BodyTrack& a, const BodyTrack& b) {
  const Rows first = a.positions_heading.array().cast<float>();
  const Rows second = b.positions_heading.array().cast<float>().transpose();
  Rows distances = Rows::Zero(first.rows(), second.cols());
  for (Eigen::Index i = 0; i < first.rows(); ++i) {
    for (Eigen::Index c = 0; c < first.cols(); c += 3) {
      distances.row(i) += ((second.row(c) - first(i, c)).square() + (second.row(c + 1) - first(i, c + 1)).square() +
                           (second.row(c + 2) - first(i, c + 2)).square())
                              .sqrt();
    }
  }
  return distances / static_cast<float>(a.num_joints());
}

Rows padded(const Rows& distances) {
  Rows result(distances.rows(), distances.cols() + kPadding);
  result.leftCols(kPadding).setZero();
  result.rightCols(distances.cols()) = distances;
  return result;
}

/// Fills `total`, whose entry (i, kPadding + j) is the least cost of laying frames 0..i of the window that begins at
/// `start` on a stretch of the clip that ends with its frame j. A step of one window frame over two clip frames costs
/// their mean, so that every window frame counts once.
void accumulate(const Rows& cost, Eigen::Index start, Rows& total) {
  const Eigen::Index frames = cost.cols() - kPadding;
  total.leftCols(kPadding).setConstant(kUnreachable);
  total.row(0).tail(frames) = cost.row(start).tail(frames);
  for (Eigen::Index i = 1; i < total.rows(); ++i) {
    const auto here = cost.row(start + i);
    auto best = total.row(i).tail(frames);
    best = (total.row(i - 1).segment(1, frames) + here.tail(frames))
               .min(total.row(i - 1).head(frames) + 0.5F * (here.segment(1, frames) + here.tail(frames)));
    if (i > 1) {
      best = best.min(total.row(i - 2).segment(1, frames) + cost.row(start + i - 1).tail(frames) + here.tail(frames));
    }
  }
}

/// The path that ends at the window's last frame on column `end` of the filled `total`, last contact first.
std::vector<Contact> trace_back(const Rows& cost, Eigen::Index start, const Rows& total, Eigen::Index end) {
  std::vector<Contact> path;
  Eigen::Index i = total.rows() - 1;
  Eigen::Index j = end;
  while (i > 0) {
    const float here = cost(start + i, j);
    const float one_to_one = total(i - 1, j - 1) + here;
    const float one_to_two = total(i - 1, j - 2) + 0.5F * (cost(start + i, j - 1) + here);
    const float two_to_one = i > 1 ? total(i - 2, j - 1) + cost(start + i - 1, j) + here : kUnreachable;
    if (two_to_one < std::min(one_to_one, one_to_two)) {
      path.push_back({i, j - kPadding, 1.0});
      path.push_back({i - 1, j - kPadding, 1.0});
      i -= 2;
      j -= 1;
    } else if (one_to_two < one_to_one) {
      path.push_back({i, j - kPadding, 0.5});
      path.push_back({i, j - 1 - kPadding, 0.5});
      i -= 1;
      j -= 2;
    } else {
      path.push_back({i, j - kPadding, 1.0});
      i -= 1;
      j -= 1;
    }
  }
  path.push_back({0, j - kPadding, 1.0});
  return path;
}

/// One second, or what the clip has, or what slopes of at least 1/2 can lay on the other clip with room to spare.
Eigen::Index window_length(Eigen::Index frames, Eigen::Index other_frames, double rate) {
  return std::min({static_cast<Eigen::Index>(std::lround(kWindowSeconds * rate)), frames,
                   std::max<Eigen::Index>(1, 3 * other_frames / 2)});
}

OneWay match_windows(const Rows& cost, double rate) {
  OneWay result;
  result.length = window_length(cost.rows(), cost.cols() - kPadding, rate);
  const Eigen::Index hop = std::max<Eigen::Index>(1, result.length / 2);
  Rows total(result.length, cost.cols());
  int count = 0;
  for (Eigen::Index start = 0; start + result.length <= cost.rows(); start += hop, ++count) {
    accumulate(cost, start, total);
    Match match{start, 0, 0.0};
    match.distance = total.row(result.length - 1).minCoeff(&match.end_column) / static_cast<double>(result.length);
    result.mean += match.distance;
    if (match.distance > result.worst.distance) result.worst = match;
  }
  result.mean /= count;
  return result;
}

/// Each joint's mean distance along a path. (J)
Eigen::ArrayXd joint_distances(const BodyTrack& a, const BodyTrack& b, Eigen::Index start,
                               const std::vector<Contact>& path, Eigen::Index length) {
  Eigen::ArrayXd distances = Eigen::ArrayXd::Zero(a.num_joints());
  for (const Contact& contact : path) {
    for (Eigen::Index j = 0; j < distances.size(); ++j) {
      distances[j] += contact.weight * (a.positions_heading.block<1, 3>(start + contact.row, 3 * j) -
                                        b.positions_heading.block<1, 3>(contact.column, 3 * j))
                                           .norm();
    }
  }
  return distances / static_cast<double>(length);
}

WorstMatch describe(const BodyTrack& a, const BodyTrack& b, const Rows& cost, const OneWay& way) {
  Rows total(way.length, cost.cols());
  accumulate(cost, way.worst.start, total);
  const auto path = trace_back(cost, way.worst.start, total, way.worst.end_column);
  WorstMatch worst;
  worst.distance = way.worst.distance;
  Eigen::Index joint = 0;
  worst.joint_distance = joint_distances(a, b, way.worst.start, path, way.length).maxCoeff(&joint);
  const int index = a.joints[static_cast<std::size_t>(joint)];
  worst.begin = a.place(index, static_cast<double>(way.worst.start));
  worst.match_begin = b.place(index, static_cast<double>(path.back().column));
  return worst;
}

void check_comparable(const BodyTrack& first, const BodyTrack& second) {
  const std::string mismatch = describe_mismatch(*first.skeleton, *second.skeleton);
  if (!mismatch.empty()) throw SkeletonMismatch("the clips have different skeletons: " + mismatch);
  if (std::abs(first.rate - second.rate) > kSameRate * first.rate) {
    throw InvalidArgument("second", std::to_string(first.rate) + " frames/s", std::to_string(second.rate));
  }
}

}  // namespace

ClipDistance clip_distance(const BodyTrack& first, const BodyTrack& second) {
  check_comparable(first, second);
  const Rows distances = frame_distances(first, second);
  const Rows cost = padded(distances);
  const Rows cost_back = padded(distances.transpose());
  const OneWay there = match_windows(cost, first.rate);
  const OneWay back = match_windows(cost_back, first.rate);
  ClipDistance result{0.5 * (there.mean + back.mean), there.mean, back.mean, {}};
  const bool in_first = there.worst.distance >= back.worst.distance;
  result.worst = in_first ? describe(first, second, cost, there) : describe(second, first, cost_back, back);
  result.worst.in_first = in_first;
  return result;
}

ClipDistance clip_distance(const Motion& first, const Motion& second) {
  return clip_distance(body_track(first, kComparisonRate), body_track(second, kComparisonRate));
}

}  // namespace strut::metrics
