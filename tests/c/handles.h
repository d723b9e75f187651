// SPDX-License-Identifier: MIT
// The C interface's handles as owners, and frames as it takes them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <strut/c/strut.h>
#include <strut/model/style_model.h>
#include <strut/motion/motion.h>

namespace strut::test {

struct Release {
  void operator()(const strut_model* model) const { strut_model_release(model); }
  void operator()(strut_translator* translator) const { strut_translator_free(translator); }
  void operator()(strut_snapshot* snapshot) const { strut_snapshot_free(snapshot); }
};

using ModelHandle = std::unique_ptr<const strut_model, Release>;
using TranslatorHandle = std::unique_ptr<strut_translator, Release>;
using SnapshotHandle = std::unique_ptr<strut_snapshot, Release>;

/// `model`, by way of the bytes of its file. Throws std::runtime_error with the last error if it is refused.
ModelHandle handle_of(const StyleModel& model);

TranslatorHandle translator_of(const std::vector<const strut_model*>& models,
                               const strut_translator_options* options = nullptr);

strut_axes axes_of(int convention);

/// A pose in single precision.
struct Frame {
  explicit Frame(int num_joints)
      : rotations(static_cast<std::size_t>(4 * num_joints)), translations(static_cast<std::size_t>(3 * num_joints)) {}
  explicit Frame(const Pose& pose);

  [[nodiscard]] int num_joints() const { return static_cast<int>(rotations.size() / 4); }
  [[nodiscard]] strut_const_pose in() const { return {rotations.data(), translations.data(), 0, 0, num_joints()}; }
  [[nodiscard]] strut_pose out() { return {rotations.data(), translations.data(), 0, 0, num_joints()}; }
  friend bool operator==(const Frame&, const Frame&) = default;

  std::vector<float> rotations, translations;
};

/// The largest difference of a number of a rotation, and of a translation [its unit].
struct FrameDifference {
  float rotation = 0.0F, translation = 0.0F;
};
FrameDifference largest_difference(const Frame& a, const Frame& b);

}  // namespace strut::test
