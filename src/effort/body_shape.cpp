// SPDX-License-Identifier: MIT
// Arms are the two longest limbs of like length that are no legs; masses are a table by part of the body.
#include "body_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <strut/motion/body_parts.h>
#include <strut/motion/legs.h>

namespace strut::effort::detail {
namespace {

using motion::BodyPart;

// Shares of the body's mass (Winter 2009, Biomechanics and Motor Control of Human Movement, table 4.1), in the order of
// BodyPart: trunk, head and neck, whole arms, whole legs.
constexpr std::array<double, motion::kNumBodyParts> kMasses = {0.497, 0.081, 0.050, 0.050, 0.161, 0.161};
constexpr double kMirrorTolerance = 0.15;  // limbs whose lengths differ by more than this share are no pair
constexpr double kShortest = 0.05;         // a length that others are told by is at least this [m]

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

double bone_length(const Motion& motion, int joint) {
  return motion.frame(0).translations[at(joint)].norm();
}

/// The joints from `joint` up to the root, itself first.
std::vector<int> line_up(const Skeleton& skeleton, int joint) {
  std::vector<int> line;
  for (; joint >= 0; joint = skeleton.joint(joint).parent) line.push_back(joint);
  return line;
}

void assign(const Skeleton& skeleton, int joint, BodyPart part, std::vector<BodyPart>& parts) {
  parts[at(joint)] = part;
  for (const int child : skeleton.children(joint)) assign(skeleton, child, part, parts);
}

/// Two limbs that leave the body at one joint.
struct LimbPair {
  int parting = -1;
  int left = -1, right = -1;  // the first joints after the parting; which is left is not known
  int left_end = -1, right_end = -1;
  double length = 0.0;  // of the shorter
};

LimbPair limbs_between(const Motion& motion, int a, int b) {
  std::vector<int> up_a = line_up(motion.skeleton(), a), up_b = line_up(motion.skeleton(), b);
  LimbPair pair{-1, -1, -1, a, b, 0.0};
  while (!up_a.empty() && !up_b.empty() && up_a.back() == up_b.back()) {
    pair.parting = up_a.back();
    up_a.pop_back();
    up_b.pop_back();
  }
  double length_a = 0.0, length_b = 0.0;
  for (const int joint : up_a) length_a += bone_length(motion, joint);
  for (const int joint : up_b) length_b += bone_length(motion, joint);
  const bool alike = std::abs(length_a - length_b) < kMirrorTolerance * std::max(length_a, length_b);
  if (!alike || up_a.empty() || up_b.empty()) return {};
  pair.left = up_a.back();
  pair.right = up_b.back();
  pair.length = std::min(length_a, length_b);
  return pair;
}

LimbPair find_arms(const Motion& motion, const std::vector<int>& ends) {
  LimbPair best;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t k = i + 1; k < ends.size(); ++k) {
      const LimbPair pair = limbs_between(motion, ends[i], ends[k]);
      if (pair.length > best.length) best = pair;
    }
  }
  return best;
}

/// A bone's mass is shared by its ends; a file's end site weighs on its joint.
Eigen::VectorXd masses(const Motion& motion, const std::vector<BodyPart>& parts, int pelvis) {
  const Skeleton& skeleton = motion.skeleton();
  Eigen::MatrixXd by_part = Eigen::MatrixXd::Zero(skeleton.num_joints(), motion::kNumBodyParts);
  for (int j = pelvis; j < skeleton.num_joints(); ++j) {
    const std::vector<int> line = line_up(skeleton, j);
    if (std::find(line.begin(), line.end(), pelvis) == line.end()) continue;
    const Joint& joint = skeleton.joint(j);
    if (joint.has_end_site) by_part(j, static_cast<int>(parts[at(j)])) += joint.end_site.norm();
    if (j == pelvis) continue;
    const int part = static_cast<int>(parts[at(joint.parent)]);
    by_part(j, part) += 0.5 * bone_length(motion, j);
    by_part(joint.parent, part) += 0.5 * bone_length(motion, j);
  }
  Eigen::VectorXd mass = Eigen::VectorXd::Zero(skeleton.num_joints());
  for (int part = 0; part < motion::kNumBodyParts; ++part) {
    const double length = by_part.col(part).sum();
    if (length > 0.0) mass += kMasses[at(part)] / length * by_part.col(part);
  }
  if (!(mass.sum() > 0.0)) mass[pelvis] = 1.0;
  return mass / mass.sum();
}

/// What the arms make known: hands, arm length, and which part of the body every joint is of.
void take_arms(const Motion& motion, const LimbPair& arms, BodyShape& body, std::vector<BodyPart>& parts) {
  const Skeleton& skeleton = motion.skeleton();
  for (const int child : skeleton.children(arms.parting)) {
    if (parts[at(child)] == BodyPart::kTrunk) assign(skeleton, child, BodyPart::kHead, parts);
  }
  assign(skeleton, arms.left, BodyPart::kLeftArm, parts);
  assign(skeleton, arms.right, BodyPart::kRightArm, parts);
  body.hands = {arms.left_end, arms.right_end};
  body.shoulders = arms.parting;
  body.arm_length = std::max(arms.length, kShortest);
}

}  // namespace

BodyShape body_shape(const Motion& motion) {
  const Skeleton& skeleton = motion.skeleton();
  BodyShape body;
  body.pelvis = body.shoulders = skeleton.pelvis();
  std::vector<BodyPart> parts(at(skeleton.num_joints()), BodyPart::kTrunk);
  if (const auto legs = motion::find_legs(motion)) {
    assign(skeleton, legs->left.hip, BodyPart::kLeftLeg, parts);
    assign(skeleton, legs->right.hip, BodyPart::kRightLeg, parts);
    const double leg = bone_length(motion, legs->left.knee) + bone_length(motion, legs->left.ankle);
    body.leg_length = std::max(leg, kShortest);
  }
  for (int j = body.pelvis + 1; j < skeleton.num_joints(); ++j) {
    if (skeleton.children(j).empty() && parts[at(j)] == BodyPart::kTrunk) body.hands.push_back(j);
  }
  const LimbPair arms = find_arms(motion, body.hands);
  if (arms.parting >= 0) take_arms(motion, arms, body, parts);
  if (body.hands.empty()) body.hands = {skeleton.num_joints() - 1};
  body.mass = masses(motion, parts, body.pelvis);
  return body;
}

}  // namespace strut::effort::detail
