// SPDX-License-Identifier: MIT
// A style model's numbers as the runtime steps them: in float or double, in slots (representation/row_layout.h),
// matrices in tiles. Made once per model and shared by everything that steps it.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <strut/math/aligned.h>
#include <strut/math/tiled_matrix.h>
#include <strut/model/radial_map.h>
#include <strut/representation/normalization.h>
#include <strut/representation/row_layout.h>
#include <strut/sysid/lti_bank.h>

namespace strut {

struct StyleModelParts;

/// RadialMap, packed. Details are measured by the parts of detail_parts: the root's three stand in the first lanes of
/// an array of parts, then, from kLanes on, the joints.
template <typename Scalar>
struct PackedRadialMap {
  PackedRadialMap(const StyleModelParts& parts, const representation::RowLayout& layout);

  std::vector<int> lags;                       ///< [frames] (lags)
  Scalar squared_width, widening;              ///< of RadialBasis
  math::TiledMatrix<Scalar> now, before;       ///< the centres' features: of the newest context, of the older ones
  math::TiledMatrix<Scalar> styles;            ///< (slots of the input style, then of the output style) x centres
  Scalar fast;                                 ///< RadialMap::fast
  Scalar smoothing_gain;                       ///< of each low-pass filter behind the output, per frame
  math::AlignedVector<Scalar> inverse_spread;  ///< per slot, 0 where there is no degree of freedom
  math::AlignedVector<Scalar> share;           ///< per part
  math::AlignedVector<Scalar> turns;           ///< from the input style's axes to the output's: 9 planes, a joint each
};

/// StyleModel, packed.
template <typename Scalar>
struct PackedModel {
  explicit PackedModel(const StyleModelParts& parts);

  representation::RowLayout layout;
  math::AlignedVector<Scalar> input_mean, input_scale;  ///< per slot; scale 0: dropped
  math::AlignedVector<Scalar> input_inverse;            ///< 1 / scale, 0 where dropped
  math::AlignedVector<Scalar> familiar_inverse;  ///< per slot: 1 / what counts as one deviation from the examples
  math::AlignedVector<Scalar> output_mean, output_scale;  ///< per slot
  math::TiledMatrix<Scalar> context;                      ///< contexts x slots
  sysid::LtiBank<Scalar> blocks;                          ///< from slots, then contexts, to slots
  std::vector<int> state_places;                          ///< where the blocks' states, in order, stand in their bank's
  std::optional<PackedRadialMap<Scalar>> radial_map;      ///< in place of blocks
};

}  // namespace strut
