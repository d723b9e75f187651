// SPDX-License-Identifier: MIT
// One frame through a radial map: the output style where the body is in its movement, and the input's own detail on it.
#pragma once

#include <vector>

#include <strut/model/packed_model.h>

namespace strut {

/// Steps the radial map of a model. Holds the contexts of the last frames and the filters' states; copies have the
/// same.
///
/// A joint whose detail stands out, for half a second or so, from what the examples show and from what the other joints
/// do now is the performer's own: its detail is kept whole, and, a frame later, kept out of the context, so that it
/// cannot pass for another place in the movement. Of ordinary detail the examples' share is kept (RadialMap::share).
template <typename Scalar>
class RadialStep {
 public:
  /// `model` must outlive it and have a radial map.
  RadialStep(const PackedModel<Scalar>& model, double frame_rate);

  /// One frame. `input`: slots in the input representation's units; `context`: the model's contexts of it (whole
  /// tiles); writes `output`, slots in the output representation's units. No allocation.
  /// Cost: centres x (features + slots of both styles).
  void step(const Scalar* input, const Scalar* context, Scalar* output);

  /// Forgets every frame: the next one is taken to have lasted forever.
  void reset() { started_ = false; }

  /// Calls `visit(first, count)` for every array of plain numbers that frames leave behind, always in the same order.
  template <typename Visit>
  void visit_state(Visit&& visit) {
    visit(&started_, 1);
    visit(&newest_, 1);
    for (Array* array : {&history_, &taken_, &smoothed_, &smoothed_twice_, &slow_details_, &energy_}) {
      visit(array->data(), array->size());
    }
  }

  /// What the basis sees at the latest frame: the contexts at every lag, the newest first (num_features() numbers).
  [[nodiscard]] const Scalar* features() const noexcept { return features_.data(); }
  [[nodiscard]] int num_features() const noexcept { return static_cast<int>(features_.size()); }

 private:
  using Array = math::AlignedVector<Scalar>;

  void see(const Scalar* context);
  /// The context of so many frames ago.
  [[nodiscard]] auto context_of(int age) {
    return history_.begin() + (newest_ + num_frames_ - age) % num_frames_ * num_contexts_;
  }
  void look_up();
  void measure_details(const Scalar* input);
  void compare_details();
  void measure_what_stands_out();
  void filter();
  void add_details(Scalar* output);

  const PackedModel<Scalar>* model_;
  const PackedRadialMap<Scalar>* map_;
  Scalar level_gain_, slow_gain_;  // of one-pole filters, per frame
  int num_contexts_, num_frames_;
  bool started_ = false;
  int newest_ = 0;
  Array history_;                                // frames x contexts, a ring
  Array features_, activations_, styles_;        // of the basis; both styles, normalized, at this frame
  Array taken_;                                  // from the context, as detail that stood out a frame ago
  Array smoothed_, smoothed_twice_;              // of the output style
  Array details_, slow_details_, standing_out_;  // per slot, in its units
  Array turned_;                                 // details of joints, in the output style's axes
  Array energy_, unusual_, sorted_;              // per part: mean square in deviations, filtered; 0 to 1
};

}  // namespace strut
