// SPDX-License-Identifier: MIT
// One frame through a radial map: the output style where the body is in its movement, and the input's own detail on it.
#pragma once

#include <vector>

#include <Eigen/Core>

#include <strut/model/style_model.h>

namespace strut {

/// Steps the radial map of a model. Holds the contexts of the last frames and the filters' states.
///
/// A joint whose detail stands out, for half a second or so, from what the examples show and from what the other joints
/// do now is the performer's own: its detail is kept whole, and kept out of the context, so that it cannot pass for
/// another place in the movement. Of ordinary detail the examples' share is kept (RadialMap::share).
class RadialStep {
 public:
  /// `model` must outlive it and have a radial map.
  explicit RadialStep(const StyleModel& model);

  /// One frame. `input` (num_dofs) in the input representation's units, `context` the model's context of it; writes
  /// `output` (num_dofs + 1) in the output representation's units. No allocation.
  /// Cost centres x features + centres in reach x degrees of freedom, twice.
  void step(const Eigen::Ref<const Eigen::RowVectorXd>& input, const Eigen::Ref<const Eigen::VectorXd>& context,
            Eigen::Ref<Eigen::RowVectorXd> output);

  /// Forgets every frame: the next one is taken to have lasted forever.
  void reset() { started_ = false; }

 private:
  void look_up(const Eigen::VectorXd& context);
  void measure_details(const Eigen::Ref<const Eigen::RowVectorXd>& input);
  void compare_details();
  void take_details_out();
  void filter();
  void add_details(Eigen::Ref<Eigen::RowVectorXd> output);

  const StyleModel* model_;
  std::vector<DetailPart> parts_;
  double smoothing_gain_, level_gain_, slow_gain_;  // of one-pole filters, per frame
  bool started_ = false;
  Eigen::Index newest_ = 0;
  Eigen::MatrixXd history_;                                  // contexts x frames, a ring
  Eigen::VectorXd context_, features_, activations_;         // seen by the basis
  Eigen::VectorXd input_style_, output_style_;               // normalized, at this frame
  Eigen::VectorXd smoothed_, smoothed_twice_;                // of the output style
  Eigen::Matrix3Xd details_, slow_details_;                  // a column per part, in the units of the dofs
  Eigen::VectorXd energy_, next_energy_, unusual_, sorted_;  // parts: mean square in deviations, filtered; 0 to 1
};

}  // namespace strut
