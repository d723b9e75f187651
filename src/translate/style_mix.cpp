// SPDX-License-Identifier: MIT
#include "translate/style_mix.h"

#include <strut/math/rotation.h>
#include <strut/math/rotation_arrays.h>
#include <strut/math/rotation_planes.h>

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
  for (Array* array : {&input_means_, &rotations_, &turned_}) array->resize(at(4 * plane_));
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
    for (int joint = 0; joint < plane_; ++joint) {
      const auto i = at(axis * plane_ + joint);
      from_[i] += share * weights.movement[at(joint)] * (to_[i] - from_[i]);
      to_[i] = share * weights.pose[at(joint)] * mean_step_[i];
    }
  }
  math::exp_maps(plane_, plane_, to_.data(), turned_.data());
  math::multiply_rotations(plane_, plane_, turned_.data(), input_means_.data(), turned_.data());
  math::exp_maps(plane_, plane_, from_.data(), rotations_.data());
  math::multiply_rotations(plane_, plane_, rotations_.data(), turned_.data(), rotations_.data());
}

template class StyleMix<float>;
template class StyleMix<double>;

}  // namespace strut::translate
