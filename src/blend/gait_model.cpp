// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <strut/blend/gait_model.h>
#include <strut/core/error.h>

namespace strut::blend {
namespace {

constexpr double kShortestCycle = 0.2, kLongestCycle = 4.0;  // [s]
constexpr double kLeastWeight = -2.0, kMostWeight = 3.0;
constexpr double kShortestPlant = 0.02, kLongestPlant = 0.98;  // [cycles]
constexpr int kMostFunctions = 6;
constexpr int kPoses = 32;           // of a cycle looked at
constexpr double kLeastRatio = 0.5;  // farther than twice beyond the examples is no extrapolation
constexpr int kSpeedSteps = 6;
constexpr double kLeastTravel = 0.2;  // of the velocities of a cycle, which are shares of its speed

std::string shown(double number) {
  std::string text = std::to_string(number);
  return text.substr(0, text.find('.') + 3);
}

int num_signals(const representation::Representation& representation) {
  return representation.num_dofs() + 1;
}

[[noreturn]] void refuse_speed(double speed, const std::string& why) {
  throw InvalidArgument("speed", "a speed at which these styles still walk", shown(speed) + " m/s, where " + why,
                        "stay nearer to the speeds and styles of the examples");
}

void check_style(const GaitStyle& style, const GaitModelParts& parts) {
  const auto refuse = [&](const std::string& expected, const std::string& got) {
    throw InvalidArgument("styles", expected, got + " in style '" + style.name + "'");
  };
  if (style.name.empty()) refuse("names", "an empty name");
  const Eigen::Index least = num_signals(*parts.representation) * 3 + 4;
  if (style.coefficients.rows() != parts.styles.front().coefficients.rows() || style.coefficients.rows() < least ||
      style.coefficients.cols() != parts.basis.size()) {
    refuse("coefficients of one size",
           std::to_string(style.coefficients.rows()) + " x " + std::to_string(style.coefficients.cols()));
  }
  if (!style.coefficients.allFinite()) refuse("finite numbers", "one that is not");
  if (!(style.typical > 0.0 && std::isfinite(style.typical))) refuse("a typical speed", shown(style.typical) + " m/s");
  if (!(style.slowest > 0.0 && style.fastest >= style.slowest && std::isfinite(style.fastest)) ||
      style.num_cycles < 0) {
    refuse("speeds in order", shown(style.slowest) + " to " + shown(style.fastest) + " m/s");
  }
}

/// What is wrong with a cycle that was made far from the examples; empty if nothing is.
std::string breakdown(const GaitLoop& loop) {
  const double duration = loop.duration();
  if (!(duration >= kShortestCycle && duration <= kLongestCycle)) {
    return "a cycle would take " + shown(duration) + " s";
  }
  for (int k = 0; k < kPoses; ++k) {
    const Eigen::VectorXd row = loop.at(static_cast<double>(k) / kPoses);
    for (Eigen::Index d = representation::kNumRootDofs; d + 3 < row.size(); d += 3) {
      if (row.segment<3>(d).norm() > std::numbers::pi) return "a joint would turn by more than half a turn";
    }
  }
  return {};
}

}  // namespace

SpeedBasis::SpeedBasis(double slowest, double fastest, int size) : slowest_(slowest), fastest_(fastest), size_(size) {
  if (!(slowest > 0.0 && fastest >= slowest && std::isfinite(fastest))) {
    throw InvalidArgument("speeds", "positive ratios in order", shown(slowest) + " to " + shown(fastest));
  }
  const int most = fastest > slowest ? kMostFunctions : 1;
  if (size < 1 || size > most) {
    throw InvalidArgument("size", "1 to " + std::to_string(most) + " functions of the speed", std::to_string(size));
  }
}

Eigen::VectorXd SpeedBasis::at(double ratio) const {
  Eigen::VectorXd functions(size_);
  functions[0] = 1.0;
  if (size_ == 1) return functions;
  const double low = std::log(slowest_), high = std::log(fastest_);
  const double x = (2.0 * std::log(ratio) - low - high) / (high - low);
  const double inside = std::clamp(x, -1.0, 1.0);
  double power = 1.0;
  for (int k = 1; k < size_; ++k) {
    functions[k] = power * inside + k * power * (x - inside);  // the tangent beyond the examples
    power *= inside;
  }
  return functions;
}

GaitModel::GaitModel(GaitModelParts parts) : parts_(std::move(parts)) {
  if (!parts_.representation) throw InvalidArgument("representation", "a representation", "null");
  if (!(parts_.frame_rate > 0.0 && std::isfinite(parts_.frame_rate))) {
    throw InvalidArgument("frame_rate", "a positive number", shown(parts_.frame_rate));
  }
  if (parts_.styles.empty()) throw InvalidArgument("styles", "at least one", "none");
  std::set<std::string> names;
  lowest_pelvis_ = std::numeric_limits<double>::infinity();
  for (const GaitStyle& style : parts_.styles) {
    check_style(style, parts_);
    if (!names.insert(style.name).second)
      throw InvalidArgument("styles", "different names", "'" + style.name + "' twice");
    for (const double speed : {style.slowest, style.fastest}) {
      const GaitLoop loop =
          GaitLoop::unpacked(style.coefficients * parts_.basis.at(speed), num_signals(*parts_.representation));
      const double height = loop.series()(representation::kHeight, 0);
      lowest_pelvis_ = std::min(lowest_pelvis_, height);
      highest_pelvis_ = std::max(highest_pelvis_, height);
    }
  }
}

int GaitModel::find_style(const std::string& name) const noexcept {
  const auto found = std::find_if(parts_.styles.begin(), parts_.styles.end(),
                                  [&](const GaitStyle& style) { return style.name == name; });
  return found == parts_.styles.end() ? -1 : static_cast<int>(found - parts_.styles.begin());
}

void GaitModel::check_weights(const Eigen::Ref<const Eigen::VectorXd>& weights) const {
  const auto count = static_cast<Eigen::Index>(parts_.styles.size());
  if (weights.size() != count) {
    throw InvalidArgument("weights", std::to_string(count) + " weights", std::to_string(weights.size()));
  }
  for (const double weight : weights) {
    if (!(weight >= kLeastWeight && weight <= kMostWeight)) {
      throw InvalidArgument("weights", "weights from -2 to 3", std::to_string(weight));
    }
  }
  if (std::abs(weights.sum() - 1.0) > 1e-6) {
    throw InvalidArgument("weights", "weights that sum to 1", "a sum of " + std::to_string(weights.sum()));
  }
}

GaitLoop GaitModel::at_ratio(const Eigen::MatrixXd& coefficients, double ratio) const {
  return GaitLoop::unpacked(coefficients * parts_.basis.at(ratio), num_signals(*parts_.representation));
}

GaitLoop GaitModel::loop(const Eigen::Ref<const Eigen::VectorXd>& weights, double speed) const {
  check_weights(weights);
  if (!(speed > 0.0 && std::isfinite(speed))) {
    throw InvalidArgument("speed", "a positive speed [m/s]", std::to_string(speed));
  }
  Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(parts_.styles.front().coefficients.rows(), parts_.basis.size());
  double log_typical = 0.0;
  for (std::size_t s = 0; s < parts_.styles.size(); ++s) {
    const double weight = weights[static_cast<Eigen::Index>(s)];
    if (weight == 0.0) continue;
    coefficients += weight * parts_.styles[s].coefficients;
    log_typical += weight * std::log(parts_.styles[s].typical);
  }
  double ratio = speed / std::exp(log_typical);
  for (int step = 0; step < kSpeedSteps && (weights.array() != 0.0).count() > 1; ++step) {
    ratio *= std::clamp(speed / mixed_speed(weights, coefficients, ratio), 0.5, 2.0);
  }
  if (!(ratio > kLeastRatio * parts_.basis.slowest() && ratio < parts_.basis.fastest() / kLeastRatio)) {
    refuse_speed(speed, "no example is anywhere near");
  }
  const GaitLoop loop = at_ratio(coefficients, ratio);
  const double travels = loop.velocity().norm();
  if (!(travels > kLeastTravel)) refuse_speed(speed, "the body would hardly travel");
  FrameMatrix series = loop.series();
  series.topRows<2>() *= speed / travels;
  // Each example walked straight over its cycle; their mixture is made to.
  series(representation::kTurningRate, 0) -= loop.mean(representation::kTurningRate);
  return checked(GaitLoop(std::move(series), loop.plants()), speed);
}

double GaitModel::mixed_speed(const Eigen::Ref<const Eigen::VectorXd>& weights, const Eigen::MatrixXd& coefficients,
                              double ratio) const {
  double travelled = 0.0;
  for (std::size_t s = 0; s < parts_.styles.size(); ++s) {
    const double weight = weights[static_cast<Eigen::Index>(s)];
    if (weight == 0.0) continue;
    const GaitStyle& style = parts_.styles[s];
    travelled += weight * ratio * style.typical * at_ratio(style.coefficients, ratio).duration();
  }
  return std::max(travelled / at_ratio(coefficients, ratio).duration(), 1e-3);
}

GaitLoop GaitModel::checked(const GaitLoop& loop, double speed) const {
  const std::string wrong = breakdown(loop);
  if (!wrong.empty()) refuse_speed(speed, wrong);
  const double height = loop.series()(representation::kHeight, 0);
  if (!(height > 0.5 * lowest_pelvis_ && height < 2.0 * highest_pelvis_)) {
    refuse_speed(speed, "the pelvis would be at " + shown(height) + " m");
  }
  std::array<PlantPhase, 2> plants = loop.plants();
  for (PlantPhase& plant : plants) {
    plant.end = plant.begin + std::clamp(plant.end - plant.begin, kShortestPlant, kLongestPlant);
  }
  return {loop.series(), plants};
}

SpeedRange GaitModel::speeds(const Eigen::Ref<const Eigen::VectorXd>& weights) const {
  check_weights(weights);
  SpeedRange range{0.0, 0.0};
  for (std::size_t s = 0; s < parts_.styles.size(); ++s) {
    const GaitStyle& style = parts_.styles[s];
    const double weight = weights[static_cast<Eigen::Index>(s)];
    range.slowest += weight * std::log(weight >= 0.0 ? style.slowest : style.fastest);
    range.fastest += weight * std::log(weight >= 0.0 ? style.fastest : style.slowest);
  }
  return {std::exp(range.slowest), std::exp(range.fastest)};
}

}  // namespace strut::blend
