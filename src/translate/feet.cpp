// SPDX-License-Identifier: MIT
#include "translate/feet.h"

#include <strut/core/error.h>
#include <strut/representation/representation.h>

namespace strut::translate {
namespace {

using postprocess::FootskateCleaner;
using postprocess::FootskateOptions;

FootskateCleaner cleaner_of(const StyleModel& model, const FootskateOptions& options) {
  const auto& skeleton = model.output().shared_skeleton();
  const auto legs = motion::find_legs(Motion(skeleton, 1.0, {representation::mean_pose(model.output())}));
  if (!legs) throw InvalidArgument("clean_feet", "a body with two legs", "one in which none are found");
  return {skeleton, *legs, model.frame_rate(), options};
}

}  // namespace

Feet::Feet(const std::vector<std::shared_ptr<const StyleModel>>& models, const FootskateOptions& options)
    : models_(models), cleaner_(cleaner_of(*models.front(), options)), pose_(rest_pose(models.front()->skeleton())) {
  cleaned_ = pose_;
  for (const auto& model : models) {
    states_.emplace_back(Eigen::VectorXd::Zero(model->state_size()));
    if (model->footplants()) continue;
    throw InvalidArgument("clean_feet", "models that tell footplants", "one that does not",
                          "learn it again from clips of a body with two legs");
  }
}

void Feet::vote(std::size_t model, double weight) {
  for (int foot = 0; foot < 2; ++foot) {
    if (models_[model]->footplants()->is_planted(foot, states_[model]))
      votes_[static_cast<std::size_t>(foot)] += weight;
  }
}

template <typename Scalar>
bool Feet::push(const PoseView<const Scalar>& pose, const PoseView<Scalar>& output) {
  copy_pose(pose, view(pose_));
  constexpr double kHalf = 0.5;
  if (!cleaner_.push(pose_, {votes_[0] > kHalf, votes_[1] > kHalf}, cleaned_)) return false;
  copy_pose(view(cleaned_), output);
  return true;
}

template <typename Scalar>
bool Feet::flush(const PoseView<Scalar>& output) {
  if (!cleaner_.flush(cleaned_)) return false;
  copy_pose(view(cleaned_), output);
  return true;
}

template bool Feet::push(const PoseView<const float>&, const PoseView<float>&);
template bool Feet::push(const PoseView<const double>&, const PoseView<double>&);
template bool Feet::flush(const PoseView<float>&);
template bool Feet::flush(const PoseView<double>&);

}  // namespace strut::translate
