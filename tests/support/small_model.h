// SPDX-License-Identifier: MIT
// A body of six joints, a motion of it, and a style model made by hand: small enough to reason about.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <strut/model/style_model.h>
#include <strut/motion/motion.h>

namespace strut::test {

/// root -> pelvis -> {left, right, spine -> head}: a chain above the pelvis, as real files have.
std::shared_ptr<const Skeleton> small_body();

/// The small body walking along +Z while it turns, its joints resting far from identity.
Motion turning_motion(double frame_rate, double duration);

/// A model whose blocks copy every input degree of freedom: both styles alike, log time warp `log_time_warp`
/// throughout.
StyleModelParts copying_parts(const Motion& clip, double log_time_warp = 0.0);

inline std::shared_ptr<const StyleModel> copying_model(const Motion& clip, double log_time_warp = 0.0) {
  return std::make_shared<const StyleModel>(copying_parts(clip, log_time_warp));
}

/// A model that turns every joint below the pelvis by `pose` [rad] about its parent's X axis on average, and makes its
/// movement about that `movement` times as large; the root is left alone.
StyleModelParts exaggerating_parts(const Motion& clip, double pose, double movement);

/// A map of `centres` centres over two contexts, now and three frames ago, its numbers of no meaning but all different.
RadialMap some_radial_map(int num_dofs, int centres);

/// The copying model's parts with two contexts and a radial map in place of its blocks.
StyleModelParts radial_parts(const Motion& clip, int centres = 5);

/// A model of each kind, linear and radial, that remembers what went before.
std::vector<std::shared_ptr<const StyleModel>> remembering_models(const Motion& clip);

/// The largest distance between joints [m] and between joint rotations (sine of half the angle) of two motions.
double largest_difference(const Motion& a, const Motion& b);

}  // namespace strut::test
