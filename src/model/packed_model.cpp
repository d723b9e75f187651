// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <strut/math/low_pass.h>
#include <strut/model/packed_model.h>
#include <strut/model/style_model.h>

namespace strut {
namespace {

using math::AlignedVector;
using representation::RowLayout;

// Far from everything a basis may see, and its square is still a number in single precision.
constexpr double kNowhere = 1e9;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// `values` (dofs, or one more) as a row of slots.
template <typename Scalar>
AlignedVector<Scalar> slots_of(const RowLayout& layout, const Eigen::VectorXd& values) {
  return layout.packed<Scalar>(values.transpose());
}

/// 1 / value, 0 of 0.
Eigen::VectorXd inverse(const Eigen::VectorXd& values) {
  return (values.array() > 0.0).select(values.cwiseMax(1e-300).cwiseInverse(), 0.0);
}

/// What counts as a deviation when input is held against the examples: theirs, or another performer's where that is
/// larger. Degrees of freedom that hardly move in the examples, dropped ones too, would otherwise make a stranger of
/// everybody.
Eigen::VectorXd familiar_deviations(const representation::Normalization& scaling) {
  Eigen::VectorXd deviations = scaling.scale();
  for (Eigen::Index dof = 0; dof < deviations.size(); ++dof) {
    deviations[dof] = std::max(deviations[dof], representation::performer_deviation(dof));
  }
  return deviations;
}

/// Columns (or rows) by degree of freedom to slots.
Eigen::MatrixXd columns_in_slots(const RowLayout& layout, const Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd packed = Eigen::MatrixXd::Zero(matrix.rows(), layout.num_slots());
  for (int dof = 0; dof < matrix.cols(); ++dof) packed.col(layout.slot(dof)) = matrix.col(dof);
  return packed;
}

template <typename Scalar>
sysid::LtiBank<Scalar> bank_of(const StyleModelParts& parts, const RowLayout& layout) {
  std::vector<sysid::BankedSystem> systems;
  const int dofs = layout.num_dofs();
  for (const StyleBlock& block : parts.blocks) {
    sysid::BankedSystem banked{&block.system, {}, {}};
    for (const int input : block.input_dofs) {
      banked.inputs.push_back(input < dofs ? layout.slot(input) : layout.num_slots() + input - dofs);
    }
    for (const int output : block.output_dofs) banked.outputs.push_back(layout.slot(output));
    systems.push_back(std::move(banked));
  }
  const int contexts = math::padded(static_cast<int>(parts.context.rows()), math::kTileRows);
  return {systems, layout.num_slots() + contexts, layout.num_slots()};
}

/// The weights of both styles, one below the other.
Eigen::MatrixXd styles_of(const RadialMap& map, const RowLayout& layout) {
  const int slots = layout.num_slots();
  Eigen::MatrixXd styles(2 * slots, map.basis.num_centres());
  styles.topRows(slots) = columns_in_slots(layout, map.input.transpose()).transpose();
  styles.bottomRows(slots) = columns_in_slots(layout, map.output.transpose()).transpose();
  return styles;
}

}  // namespace

template <typename Scalar>
PackedRadialMap<Scalar>::PackedRadialMap(const StyleModelParts& parts, const RowLayout& layout)
    : lags(parts.radial_map->lags),
      squared_width(static_cast<Scalar>(parts.radial_map->basis.squared_width(0.0))),
      widening(static_cast<Scalar>(sysid::RadialBasis::kWidening)),
      styles(styles_of(*parts.radial_map, layout)),
      fast(static_cast<Scalar>(parts.radial_map->fast)),
      smoothing_gain(static_cast<Scalar>(math::low_pass_gain(parts.radial_map->smoothing))),
      inverse_spread(slots_of<Scalar>(layout, parts.radial_map->spread.cwiseInverse())),
      share(at(math::kLanes + layout.plane())),
      turns(at(9 * layout.plane())) {
  const Eigen::Index contexts = parts.context.rows();
  const Eigen::MatrixXd& centres = parts.radial_map->basis.centres();
  now = math::TiledMatrix<Scalar>(centres.topRows(contexts).transpose(), kNowhere);
  before = math::TiledMatrix<Scalar>(centres.bottomRows(centres.rows() - contexts).transpose(), kNowhere);
  const std::vector<DetailPart> details = detail_parts(parts.input, parts.output);
  for (int part = 0; part < static_cast<int>(details.size()); ++part) {
    const DetailPart& detail = details[at(part)];
    const int joint = part - kRootDetailParts;
    share[at(joint < 0 ? part : math::kLanes + joint)] = static_cast<Scalar>(parts.radial_map->share[detail.first]);
    for (int i = 0; joint >= 0 && i < 9; ++i) {
      turns[at(i * layout.plane() + joint)] = static_cast<Scalar>(detail.turn(i / 3, i % 3));
    }
  }
}

template <typename Scalar>
PackedModel<Scalar>::PackedModel(const StyleModelParts& parts)
    : layout(parts.input.num_dofs()),
      input_mean(slots_of<Scalar>(layout, parts.input_scaling.mean())),
      input_scale(slots_of<Scalar>(layout, parts.input_scaling.scale())),
      input_inverse(slots_of<Scalar>(layout, inverse(parts.input_scaling.scale()))),
      familiar_inverse(slots_of<Scalar>(layout, inverse(familiar_deviations(parts.input_scaling)))),
      output_mean(slots_of<Scalar>(layout, parts.output_scaling.mean())),
      output_scale(slots_of<Scalar>(layout, parts.output_scaling.scale())),
      context(columns_in_slots(layout, parts.context)),
      blocks(bank_of<Scalar>(parts, layout)) {
  for (int block = 0; block < static_cast<int>(parts.blocks.size()); ++block) {
    const int states = parts.blocks[at(block)].system.num_states();
    for (int i = 0; i < states; ++i) state_places.push_back(blocks.place_of_state(block, i));
  }
  if (parts.radial_map) radial_map.emplace(parts, layout);
}

template struct PackedRadialMap<float>;
template struct PackedRadialMap<double>;
template struct PackedModel<float>;
template struct PackedModel<double>;

}  // namespace strut
