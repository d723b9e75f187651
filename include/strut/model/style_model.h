// SPDX-License-Identifier: MIT
// A learnt style: everything the runtime needs to put it on new motion, and where it came from. Immutable and shared.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <strut/model/packed_model.h>
#include <strut/model/radial_map.h>
#include <strut/postprocess/footplant_classifier.h>
#include <strut/representation/normalization.h>
#include <strut/representation/representation.h>
#include <strut/sysid/lti_system.h>

namespace strut {

/// One independent part of the translation model (Hsu et al. 2005, 4.2: each joint is independent of the others): a
/// linear system from some normalized degrees of freedom of the input to some of the output.
struct StyleBlock {
  std::string name;             ///< the joint's name, "root", or "timing"
  std::vector<int> input_dofs;  ///< columns of the input representation, then num_dofs() + k for context k (inputs)
  std::vector<int>
      output_dofs;          ///< columns of the output representation (outputs); StyleModel::time_warp_dof() included
  sysid::LtiSystem system;  ///< in normalized units
};

/// The parts of a style model, to be checked and kept by StyleModel.
struct StyleModelParts {
  double frame_rate = 0.0;                       ///< the examples' [frames/s]; what is translated must have it too
  representation::Representation input;          ///< of the input style
  representation::Representation output;         ///< of the output style; same hierarchy
  representation::Normalization input_scaling;   ///< (num_dofs)
  representation::Normalization output_scaling;  ///< (num_dofs + 1): the last is the log of the differential time warp
  Eigen::MatrixXd context;                       ///< what the whole body does: (contexts x num_dofs), of the
                                                 ///< normalized input; no rows where nothing asks for it
  std::vector<StyleBlock> blocks;                ///< no output degree of freedom in two of them
  std::optional<RadialMap> radial_map;           ///< in place of blocks
  std::string provenance;                        ///< JSON: files, hashes, options, figures on left-out clips
  std::optional<postprocess::FootplantClassifier> footplants{};  ///< of the output style, from the model's state; none
                                                                 ///< where a body has no legs, or in older models
};

/// A style model whose parts fit together.
class StyleModel {
 public:
  /// Throws InvalidArgument if sizes do not agree, a block names a degree of freedom that does not exist or that
  /// another block gives, a system is not stable (spectral radius 1 or more), there are blocks beside a radial map, or
  /// footplants are told from a state of another size than the model's.
  explicit StyleModel(StyleModelParts parts);

  [[nodiscard]] const Skeleton& skeleton() const noexcept { return parts_.input.skeleton(); }
  [[nodiscard]] double frame_rate() const noexcept { return parts_.frame_rate; }
  [[nodiscard]] const representation::Representation& input() const noexcept { return parts_.input; }
  [[nodiscard]] const representation::Representation& output() const noexcept { return parts_.output; }
  [[nodiscard]] const representation::Normalization& input_scaling() const noexcept { return parts_.input_scaling; }
  [[nodiscard]] const representation::Normalization& output_scaling() const noexcept { return parts_.output_scaling; }
  [[nodiscard]] const Eigen::MatrixXd& context() const noexcept { return parts_.context; }
  [[nodiscard]] const std::optional<RadialMap>& radial_map() const noexcept { return parts_.radial_map; }
  [[nodiscard]] const std::vector<StyleBlock>& blocks() const noexcept { return parts_.blocks; }
  [[nodiscard]] const std::string& provenance() const noexcept { return parts_.provenance; }

  [[nodiscard]] const std::optional<postprocess::FootplantClassifier>& footplants() const noexcept {
    return parts_.footplants;
  }

  /// Degrees of freedom of a pose.
  [[nodiscard]] int num_dofs() const noexcept { return parts_.input.num_dofs(); }
  /// The output column that holds the logarithm of the differential time warp.
  [[nodiscard]] int time_warp_dof() const noexcept { return num_dofs(); }
  /// States of all blocks together.
  [[nodiscard]] int num_states() const noexcept;
  /// Numbers in the model's state, from which footplants are told (ModelStep::state): the states of all blocks,
  /// one block after the other; of a radial map what its basis sees, the contexts at every lag, the newest first.
  [[nodiscard]] int state_size() const noexcept;

  /// The numbers that ModelStep steps, in float or double.
  template <typename Scalar>
  [[nodiscard]] const PackedModel<Scalar>& packed() const noexcept {
    if constexpr (std::is_same_v<Scalar, float>) {
      return *packed_float_;
    } else {
      return *packed_double_;
    }
  }

 private:
  StyleModelParts parts_;
  std::shared_ptr<const PackedModel<float>> packed_float_;
  std::shared_ptr<const PackedModel<double>> packed_double_;
};

}  // namespace strut
