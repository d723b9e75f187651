// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include <strut/core/error.h>
#include <strut/math/sampling.h>
#include <strut/representation/retime.h>

namespace strut::representation {
namespace {

/// Where the increasing piecewise linear curve `times` reaches 0, 1, 2, ...
Eigen::VectorXd invert(const Eigen::VectorXd& times) {
  constexpr double kRounding = 1e-9;  // a last frame missed by rounding alone still counts
  const auto count = static_cast<Eigen::Index>(std::floor(times[times.size() - 1] + kRounding)) + 1;
  Eigen::VectorXd positions(count);
  Eigen::Index i = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double time = static_cast<double>(k);
    while (i + 2 < times.size() && times[i + 1] <= time) ++i;
    const double span = times.size() > 1 ? times[i + 1] - times[i] : 1.0;
    positions[k] = static_cast<double>(i) + (time - times[i]) / span;
  }
  return positions;
}

}  // namespace

FrameMatrix retime(const Eigen::Ref<const FrameMatrix>& rows, const Eigen::Ref<const Eigen::VectorXd>& log_time_warp) {
  if (rows.rows() == 0) throw InvalidArgument("rows", "at least one frame", "none");
  if (rows.rows() != log_time_warp.size()) {
    throw InvalidArgument("log_time_warp", std::to_string(rows.rows()) + " elements",
                          std::to_string(log_time_warp.size()));
  }
  return math::sample_rows(rows, invert(retimed_moments(log_time_warp)));
}

Eigen::VectorXd retimed_moments(const Eigen::Ref<const Eigen::VectorXd>& log_time_warp) {
  if (!log_time_warp.allFinite()) throw InvalidArgument("log_time_warp", "finite numbers", "NaN or infinity");
  const Eigen::VectorXd warp = log_time_warp.cwiseMax(-kLargestLogTimeWarp).cwiseMin(kLargestLogTimeWarp).array().exp();
  Eigen::VectorXd moments = Eigen::VectorXd::Zero(warp.size());
  for (Eigen::Index i = 1; i < moments.size(); ++i) moments[i] = moments[i - 1] + 0.5 * (warp[i - 1] + warp[i]);
  return moments;
}

}  // namespace strut::representation
