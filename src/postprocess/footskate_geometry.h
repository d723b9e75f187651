// SPDX-License-Identifier: MIT
// Small geometry that the parts of footskate cleanup share.
#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace strut::postprocess::detail {

inline std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

inline Eigen::Vector3d horizontal(const Eigen::Vector3d& vector) {
  return {vector.x(), 0.0, vector.z()};
}

/// Of the straight leg [m].
inline double leg_length(const Eigen::Vector3d& hip, const Eigen::Vector3d& knee, const Eigen::Vector3d& ankle) {
  return (knee - hip).norm() + (ankle - knee).norm();
}

}  // namespace strut::postprocess::detail
