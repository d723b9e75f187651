// SPDX-License-Identifier: MIT
#include "math/vector_kernels.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include <strut/core/error.h>
#include <strut/sysid/lti_bank.h>

namespace strut::sysid {
namespace {

using math::kLanes;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

void check(const char* name, const std::vector<int>& indices, int expected, int size) {
  if (indices.size() != at(expected)) {
    throw InvalidArgument(name, std::to_string(expected) + " indices", std::to_string(indices.size()));
  }
  for (const int index : indices) {
    if (index < 0 || index >= size) {
      throw InvalidArgument(name, "indices from 0 to " + std::to_string(size - 1), std::to_string(index));
    }
  }
}

/// Systems of one shape beside each other, in their order: then lanes read and write what stands side by side.
std::vector<int> order_of(const std::vector<BankedSystem>& systems) {
  std::vector<int> order(systems.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    const LtiSystem& x = *systems[at(a)].system;
    const LtiSystem& y = *systems[at(b)].system;
    return std::pair(x.num_outputs(), x.num_inputs()) < std::pair(y.num_outputs(), y.num_inputs());
  });
  return order;
}

/// Where every row of lanes begins in its signal, if all of them count up by one from there; else nothing. A lane
/// without a system (-1) may be any index that is free.
template <typename IsFree>
std::vector<int> begins_of(const std::vector<int>& indices, IsFree is_free) {
  std::vector<int> begins;
  for (std::size_t row = 0; row < indices.size(); row += kLanes) {
    begins.push_back(indices[row]);
    for (int lane = 0; lane < kLanes; ++lane) {
      const int index = indices[row + at(lane)];
      const int next = begins.back() + lane;
      if (index != next && (index >= 0 || !is_free(next))) return {};
    }
  }
  return begins;
}

/// Rows of lanes one after the other.
std::vector<int> one_after_the_other(int rows) {
  std::vector<int> begins;
  for (int row = 0; row < rows; ++row) begins.push_back(row * kLanes);
  return begins;
}

template <typename Scalar>
void gather(const std::vector<int>& indices, const Scalar* from, Scalar* lanes) {
  for (std::size_t i = 0; i < indices.size(); ++i) lanes[i] = indices[i] >= 0 ? from[indices[i]] : Scalar(0);
}

template <typename Scalar>
void scatter(const std::vector<int>& indices, const Scalar* lanes, Scalar* to) {
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= 0) to[indices[i]] = lanes[i];
  }
}

}  // namespace

template <typename Scalar>
LtiBank<Scalar>::LtiBank(const std::vector<BankedSystem>& systems, int input_size, int output_size)
    : places_(systems.size()) {
  std::vector<bool> given(at(output_size));
  for (const BankedSystem& banked : systems) {
    check("inputs", banked.inputs, banked.system->num_inputs(), input_size);
    check("outputs", banked.outputs, banked.system->num_outputs(), output_size);
    for (const int output : banked.outputs) given[at(output)] = true;
  }
  const std::vector<int> order = order_of(systems);
  for (std::size_t first = 0; first < order.size(); first += kLanes) {
    const auto last = std::min(order.size(), first + kLanes);
    const std::vector<int> members(order.begin() + static_cast<std::ptrdiff_t>(first),
                                   order.begin() + static_cast<std::ptrdiff_t>(last));
    for (std::size_t lane = 0; lane < members.size(); ++lane) {
      places_[at(members[lane])] = {static_cast<int>(groups_.size()), static_cast<int>(lane)};
    }
    groups_.push_back(make_group(systems, members, input_size, given));
    const Group& group = groups_.back();
    state_size_ += group.states * kLanes;
    scratch_size_ = std::max(scratch_size_, (group.states + group.inputs + group.outputs) * kLanes);
  }
}

template <typename Scalar>
typename LtiBank<Scalar>::Group LtiBank<Scalar>::make_group(const std::vector<BankedSystem>& systems,
                                                            const std::vector<int>& members, int input_size,
                                                            const std::vector<bool>& given) const {
  Group group;
  group.first_state = state_size_;
  for (const int member : members) {
    const LtiSystem& system = *systems[at(member)].system;
    group.states = std::max(group.states, system.num_states());
    group.inputs = std::max(group.inputs, system.num_inputs());
    group.outputs = std::max(group.outputs, system.num_outputs());
  }
  const int cols = group.states + group.inputs;
  group.matrix.resize(at((group.states + group.outputs) * cols * kLanes));
  group.gather.assign(at(group.inputs * kLanes), -1);
  group.scatter.assign(at(group.outputs * kLanes), -1);
  for (int lane = 0; lane < static_cast<int>(members.size()); ++lane) {
    const BankedSystem& banked = systems[at(members[at(lane)])];
    const auto put = [&](int row, int col, const Eigen::MatrixXd& part) {
      for (int r = 0; r < part.rows(); ++r) {
        for (int c = 0; c < part.cols(); ++c) {
          group.matrix[at(((row + r) * cols + col + c) * kLanes + lane)] = static_cast<Scalar>(part(r, c));
        }
      }
    };
    put(0, 0, banked.system->a());
    put(0, group.states, banked.system->b());
    put(group.states, 0, banked.system->c());
    put(group.states, group.states, banked.system->d());
    for (std::size_t i = 0; i < banked.inputs.size(); ++i) group.gather[i * kLanes + at(lane)] = banked.inputs[i];
    for (std::size_t i = 0; i < banked.outputs.size(); ++i) group.scatter[i * kLanes + at(lane)] = banked.outputs[i];
  }
  group.input_at = begins_of(group.gather, [=](int index) { return index < input_size; });
  group.output_at =
      begins_of(group.scatter, [&given](int index) { return at(index) < given.size() && !given[at(index)]; });
  group.gathers = group.input_at.empty() && group.inputs > 0;
  group.scatters = group.output_at.empty();
  if (group.gathers) group.input_at = one_after_the_other(group.inputs);
  if (group.scatters) group.output_at = one_after_the_other(group.outputs);
  return group;
}

template <typename Scalar>
void LtiBank<Scalar>::step(const Scalar* input, Scalar* state, Scalar* scratch, Scalar* output) const {
  const auto& kernels = math::vector_kernels<Scalar>();
  for (const Group& group : groups_) {
    Scalar* next = scratch;
    Scalar* gathered = next + group.states * kLanes;
    Scalar* given = gathered + group.inputs * kLanes;
    if (group.gathers) gather(group.gather, input, gathered);
    Scalar* own = state + group.first_state;
    kernels.step_systems(group.states, group.inputs, group.outputs, group.matrix.data(),
                         group.gathers ? gathered : input, group.input_at.data(), own, next,
                         group.scatters ? given : output, group.output_at.data());
    std::copy(next, next + group.states * kLanes, own);
    if (group.scatters) scatter(group.scatter, given, output);
  }
}

template <typename Scalar>
int LtiBank<Scalar>::place_of_state(int system, int index) const {
  const Place place = places_[at(system)];
  return groups_[at(place.group)].first_state + index * kLanes + place.lane;
}

template class LtiBank<float>;
template class LtiBank<double>;

}  // namespace strut::sysid
