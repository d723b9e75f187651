// SPDX-License-Identifier: MIT
// The feet of a stream: which are planted, told from the models' states, and held in place.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <strut/model/style_model.h>
#include <strut/motion/pose_view.h>
#include <strut/postprocess/footskate.h>

namespace strut::translate {

/// Holds the feet of translated poses. Copies have the same state.
class Feet {
 public:
  /// Throws InvalidArgument if a model has no footplants, the body no legs, or an option is out of range.
  Feet(const std::vector<std::shared_ptr<const StyleModel>>& models, const postprocess::FootskateOptions& options);

  [[nodiscard]] int latency() const noexcept { return cleaner_.look_ahead(); }

  /// Begins a frame: nobody has said yet that a foot is planted.
  void begin() { votes_ = {}; }
  /// A model's state at this frame (StyleModel::state_size): write it here, then `vote`.
  [[nodiscard]] Eigen::VectorXd& state(std::size_t model) { return states_[model]; }
  /// The model says, with `weight`, which feet its state tells are planted; the weights of all models sum to at most 1,
  /// and a foot is planted if more than half of 1 say so: input that passes through has feet of its own.
  void vote(std::size_t model, double weight);

  /// Takes the translated pose and gives the cleaned one of latency() frames ago: false if there is none yet.
  template <typename Scalar>
  bool push(const PoseView<const Scalar>& pose, const PoseView<Scalar>& output);
  /// The next of the remaining ones: false if there are no more.
  template <typename Scalar>
  bool flush(const PoseView<Scalar>& output);

  void reset() { cleaner_.reset(); }

 private:
  std::vector<std::shared_ptr<const StyleModel>> models_;
  postprocess::FootskateCleaner cleaner_;
  std::vector<Eigen::VectorXd> states_;  // per model
  std::array<double, 2> votes_{};        // left, right
  Pose pose_, cleaned_;
};

}  // namespace strut::translate
