// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <strut/core/error.h>
#include <strut/model/radial_map.h>

namespace strut {
namespace {

constexpr int kLongestLag = 10000;  // [frames] beyond any movement: a damaged file must not ask for memory

void check_shape(const char* name, Eigen::Index rows, Eigen::Index cols, const Eigen::MatrixXd& matrix) {
  if (matrix.rows() != rows || matrix.cols() != cols) {
    throw InvalidArgument(name, std::to_string(rows) + " x " + std::to_string(cols),
                          std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()));
  }
  if (!matrix.allFinite()) throw InvalidArgument(name, "finite numbers", "NaN or infinity");
}

void check_lags(const std::vector<int>& lags) {
  if (lags.empty() || lags.front() != 0) throw InvalidArgument("lags", "a first lag of 0", "none");
  if (std::adjacent_find(lags.begin(), lags.end(), std::greater_equal<>()) != lags.end()) {
    throw InvalidArgument("lags", "rising numbers", "one that does not rise");
  }
  if (lags.back() > kLongestLag) {
    throw InvalidArgument("lags", "at most " + std::to_string(kLongestLag) + " frames", std::to_string(lags.back()));
  }
}

}  // namespace

std::vector<DetailPart> detail_parts(const representation::Representation& input,
                                     const representation::Representation& output) {
  using namespace representation;
  std::vector<DetailPart> parts{{0, kHeight, true}, {kHeight, 1}, {kTiltX, kNumRootDofs - kTiltX}};
  Eigen::Index column = kNumRootDofs;
  for (const int joint : input.joints()) {
    const auto j = static_cast<std::size_t>(joint);
    const Eigen::Quaterniond turn = output.mean_rotations()[j].conjugate() * input.mean_rotations()[j];
    parts.push_back({column, 3, false, turn.toRotationMatrix()});
    column += 3;
  }
  return parts;
}

void check_radial_map(const RadialMap& map, int num_dofs, int num_contexts) {
  check_lags(map.lags);
  const auto features = static_cast<Eigen::Index>(map.lags.size()) * num_contexts;
  if (map.basis.num_features() != features) {
    throw InvalidArgument("basis", std::to_string(features) + " features", std::to_string(map.basis.num_features()));
  }
  check_shape("input", num_dofs, map.basis.num_centres(), map.input);
  check_shape("output", num_dofs + 1, map.basis.num_centres(), map.output);
  check_shape("spread", num_dofs, 1, map.spread);
  check_shape("share", num_dofs, 1, map.share);
  if ((map.spread.array() <= 0.0).any()) throw InvalidArgument("spread", "numbers above 0", "one that is not");
  if ((map.share.array() < 0.0).any() || (map.share.array() > 1.0).any()) {
    throw InvalidArgument("share", "numbers from 0 to 1", "one outside");
  }
  if (!(map.fast >= 0.0 && map.fast <= 2.0)) throw InvalidArgument("fast", "0 to 2", std::to_string(map.fast));
  if (!(map.smoothing >= 0.0 && std::isfinite(map.smoothing))) {
    throw InvalidArgument("smoothing", "0 or more frames", std::to_string(map.smoothing));
  }
}

}  // namespace strut
