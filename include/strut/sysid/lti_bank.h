// SPDX-License-Identifier: MIT
// Many small linear systems stepped together, lane by lane: systems that know nothing of each other are worth an order
// of magnitude over one dense system of the same size, if their numbers stand beside each other in memory.
#pragma once

#include <vector>

#include <strut/math/aligned.h>
#include <strut/sysid/lti_system.h>

namespace strut::sysid {

/// A linear system and where its inputs and outputs are found in the signals of a bank.
struct BankedSystem {
  const LtiSystem* system;
  std::vector<int> inputs;   ///< indices into the bank's input, one per input of the system
  std::vector<int> outputs;  ///< indices into its output, none given by two systems
};

/// The matrices of a bank; the states are the caller's, so that one bank serves any number of streams. Immutable.
template <typename Scalar>
class LtiBank {
 public:
  /// Copies the systems. `input_size`, `output_size`: numbers of the signals. Throws InvalidArgument if a count of
  /// indices is not the system's or an index is outside its signal.
  LtiBank(const std::vector<BankedSystem>& systems, int input_size, int output_size);

  /// Numbers of a state, zero at rest. Filled-up lanes included.
  [[nodiscard]] int state_size() const noexcept { return state_size_; }
  /// Numbers of the scratch memory that `step` works in; it holds nothing from one step to the next.
  [[nodiscard]] int scratch_size() const noexcept { return scratch_size_; }

  /// One step of every system: reads `input`, replaces `state` (state_size), writes the systems' elements of `output`,
  /// and zero to some that no system gives. No allocation. Cost: the sizes of all A, B, C, D, filled up to whole lanes.
  void step(const Scalar* input, Scalar* state, Scalar* scratch, Scalar* output) const;

  /// Where state `index` of system `system` stands within a bank's state.
  [[nodiscard]] int place_of_state(int system, int index) const;

 private:
  /// kLanes systems of like shape, filled up to the largest.
  struct Group {
    int states = 0, inputs = 0, outputs = 0;
    int first_state = 0;                 // in a bank's state
    math::AlignedVector<Scalar> matrix;  // as math/vector_kernels.h wants it
    std::vector<int> gather, scatter;    // per input or output and lane: index into the signal; -1 where there is none
    bool gathers = false,
         scatters = false;  // whether lanes do not stand side by side in the signal, so that they must be
    std::vector<int> input_at, output_at;  // per input or output: where its lanes begin, in the signal or gathered
  };
  struct Place {
    int group, lane;
  };

  /// `given`: per output of the bank, whether a system gives it.
  [[nodiscard]] Group make_group(const std::vector<BankedSystem>& systems, const std::vector<int>& members,
                                 int input_size, const std::vector<bool>& given) const;

  std::vector<Group> groups_;
  std::vector<Place> places_;  // per system
  int state_size_ = 0, scratch_size_ = 0;
};

}  // namespace strut::sysid
