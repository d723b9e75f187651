// SPDX-License-Identifier: MIT
// What a gait looks like in any mixture of the learnt styles at any speed: from style weights and a speed to a closed
// gait cycle. Bilinear in style and speed (Tenenbaum, Freeman 2000). The content of that paper is here the speed
// relative to what is typical of the style (an old man's hurry is a soldier's stroll), and continuous: smooth functions
// of it take the place of the content vectors.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <strut/blend/gait_loop.h>
#include <strut/representation/representation.h>

namespace strut::blend {

/// Functions of the speed relative to what is typical of a style: powers of its logarithm, scaled to -1 ... 1 over the
/// examples. Beyond the examples they go on straight.
class SpeedBasis {
 public:
  /// `slowest`, `fastest`: speeds of all examples over their styles' typical speeds; `size` functions. Throws
  /// InvalidArgument if the ratios are not positive, finite and in order, size is outside 1 ... 6, or there are several
  /// functions of a single speed.
  SpeedBasis(double slowest, double fastest, int size);

  [[nodiscard]] double slowest() const noexcept { return slowest_; }
  [[nodiscard]] double fastest() const noexcept { return fastest_; }
  [[nodiscard]] int size() const noexcept { return size_; }
  /// The functions at `ratio` > 0 of the typical speed. The first is 1. (size)
  [[nodiscard]] Eigen::VectorXd at(double ratio) const;

 private:
  double slowest_, fastest_;
  int size_;
};

/// One learnt style.
struct GaitStyle {
  std::string name;
  Eigen::MatrixXd coefficients;         ///< of GaitLoop::packed, its velocities as shares of the speed, over the
                                        ///< functions of the speed (numbers x functions)
  double typical = 0.0;                 ///< to which its speeds are relative: the mean of its examples, or of all [m/s]
  double slowest = 0.0, fastest = 0.0;  ///< of its examples [m/s]
  int num_cycles = 0;                   ///< that it was learnt from
};

/// What a model is made of.
struct GaitModelParts {
  std::shared_ptr<const representation::Representation> representation;
  double frame_rate = 0.0;  ///< of the examples [frames/s]
  SpeedBasis basis;
  std::vector<GaitStyle> styles;
  std::string provenance;  ///< JSON: files, options, figures on left-out cells; may be empty
};

/// Speeds that examples show [m/s].
struct SpeedRange {
  double slowest = 0.0, fastest = 0.0;
};

/// A learnt model. Immutable.
class GaitModel {
 public:
  /// Throws InvalidArgument if a part is missing, sizes do not fit each other, a number is not finite, a style's name
  /// is empty or there twice, or a style's speeds are not positive and in order.
  explicit GaitModel(GaitModelParts parts);

  [[nodiscard]] const representation::Representation& representation() const noexcept { return *parts_.representation; }
  [[nodiscard]] double frame_rate() const noexcept { return parts_.frame_rate; }
  [[nodiscard]] const SpeedBasis& basis() const noexcept { return parts_.basis; }
  [[nodiscard]] const std::vector<GaitStyle>& styles() const noexcept { return parts_.styles; }
  [[nodiscard]] const std::string& provenance() const noexcept { return parts_.provenance; }
  /// Index of a style, or -1.
  [[nodiscard]] int find_style(const std::string& name) const noexcept;

  /// The cycle of a mixture of styles that travels at `speed` [m/s]: all styles at one relative speed, at which the
  /// strides of the mixture make that speed. `weights` (one per
  /// style) sum to 1 and may be negative or above 1: that exaggerates. Throws InvalidArgument if they do not sum to 1
  /// (within 1e-6), are beyond -2 ... 3, the speed is not positive or twice beyond the examples, or what comes out is
  /// no gait any more: a cycle shorter than 0.2 s or longer than 4 s, a joint turned by more than half a turn from its
  /// mean orientation, a pelvis at less than half or more than twice the height of the examples. Cost O(numbers x
  /// styles), some 20 microseconds.
  [[nodiscard]] GaitLoop loop(const Eigen::Ref<const Eigen::VectorXd>& weights, double speed) const;

  /// The speeds that the examples of a mixture show: the weighted geometric mean of its styles' ranges. Weights as for
  /// loop.
  [[nodiscard]] SpeedRange speeds(const Eigen::Ref<const Eigen::VectorXd>& weights) const;

 private:
  void check_weights(const Eigen::Ref<const Eigen::VectorXd>& weights) const;
  [[nodiscard]] GaitLoop at_ratio(const Eigen::MatrixXd& coefficients, double ratio) const;
  /// At which speed legs carry the mixture when all styles are at `ratio`: a mixture's stride is the mean of the
  /// styles' strides, as its poses are, and takes as long as the mixture's cycle.
  [[nodiscard]] double mixed_speed(const Eigen::Ref<const Eigen::VectorXd>& weights,
                                   const Eigen::MatrixXd& coefficients, double ratio) const;
  [[nodiscard]] GaitLoop checked(const GaitLoop& loop, double speed) const;

  GaitModelParts parts_;
  double lowest_pelvis_ = 0.0, highest_pelvis_ = 0.0;  // of the styles' mean heights at their own speeds [m]
};

}  // namespace strut::blend
