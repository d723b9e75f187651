// SPDX-License-Identifier: MIT
#include "translate/style_mix.h"

#include <strut/math/rotation.h>
#include <strut/math/rotation_arrays.h>

namespace strut::translate {
namespace {

using representation::RowLayout;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// Writes a joint's numbers into its lane of planes.
template <typename Scalar, typename Numbers>
void put(math::AlignedVector<Scalar>& planes, int plane, int joint, const Numbers& numbers) {
  for (int i = 0; i < numbers.size(); ++i) planes[at(i * plane + joint)] = static_cast<Scalar>(numbers(i));
}

Eigen::Matrix<double, 9, 1> row_by_row(const Eigen::Quaterniond& rotation) {
  const Eigen::Matrix3d matrix = rotation.toRotationMatrix();
  return Eigen::Map<const Eigen::Matrix<double, 9, 1>>(Eigen::Matrix3d(matrix.transpose()).data());
}

}  // namespace

template <typename Scalar>
StyleMix<Scalar>::StyleMix(const StyleModel& model) : plane_(RowLayout(model.num_dofs()).plane()) {
  for (Array* array : {&input_turns_, &output_turns_}) array->resize(at(9 * plane_));
  for (Array* array : {&mean_step_, &from_, &to_}) array->resize(at(3 * plane_));
  for (Array* array : {&input_means_, &means_, &step_, &rotations_}) array->resize(at(4 * plane_));
  std::fill(input_means_.begin() + 3 * plane_, input_means_.end(), Scalar(1));
  int lane = 0;
  for (const int joint : model.input().joints()) {
    const Eigen::Quaterniond& from = model.input().mean_rotations()[at(joint)];
    const Eigen::Quaterniond& to = model.output().mean_rotations()[at(joint)];
    put(input_turns_, plane_, lane, row_by_row(from));
    put(output_turns_, plane_, lane, row_by_row(to));
    put(mean_step_, plane_, lane, math::log_map(to * from.conjugate()));
    put(input_means_, plane_, lane, from.coeffs());
    ++lane;
  }
  for (int dof = representation::kHeight; dof < representation::kNumRootDofs; ++dof) {
    static_[at(dof)] = static_cast<Scalar>(model.output_scaling().mean()[dof] - model.input_scaling().mean()[dof]);
  }
}

template <typename Scalar>
void StyleMix<Scalar>::mix(const Scalar* input, const Scalar* output, const MixWeights<Scalar>& weights, Scalar share) {
  for (int slot = 0; slot < kRoot; ++slot) {
    const Scalar moving = output[slot] - input[slot] - static_[at(slot)];
    root_[at(slot)] = input[slot] + share * (weights.root_movement * moving + weights.root_pose * static_[at(slot)]);
  }
  math::turn_vectors(plane_, plane_, input_turns_.data(), input + kRoot, from_.data());
  math::turn_vectors(plane_, plane_, output_turns_.data(), output + kRoot, to_.data());
  for (int axis = 0; axis < 3; ++axis) {
    Scalar* from = from_.data() + axis * plane_;
    Scalar* to = to_.data() + axis * plane_;
    const Scalar* step = mean_step_.data() + axis * plane_;
    for (int joint = 0; joint < plane_; ++joint) {
      from[joint] += share * weights.movement[at(joint)] * (to[joint] - from[joint]);
      to[joint] = share * weights.pose[at(joint)] * step[joint];
    }
  }
  math::exp_maps(plane_, plane_, to_.data(), step_.data());
  math::multiply_rotations(plane_, plane_, step_.data(), input_means_.data(), means_.data());
  math::exp_maps(plane_, plane_, from_.data(), step_.data());
  math::multiply_rotations(plane_, plane_, step_.data(), means_.data(), rotations_.data());
}

template class StyleMix<float>;
template class StyleMix<double>;

}  // namespace strut::translate
