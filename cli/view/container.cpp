// SPDX-License-Identifier: MIT
#include "view/container.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace strut::cli {

static_assert(std::endian::native == std::endian::little, "arrays are sent as they lie in memory");

namespace {

constexpr std::uint16_t kNoNumber = 0xffff;
constexpr double kLargestStored = kNoNumber - 1;
constexpr std::size_t kAlignment = 4;  // every array may be read in place [bytes]

struct Range {
  double low = 0.0, high = 0.0;
  [[nodiscard]] double step() const { return (high - low) / kLargestStored; }
};

/// Of those that are numbers.
Range range_of(const std::vector<float>& values) {
  Range range{INFINITY, -INFINITY};
  for (const double value : values) {
    if (std::isnan(value)) continue;
    range = {std::min(range.low, value), std::max(range.high, value)};
  }
  return range.low > range.high ? Range{} : range;
}

}  // namespace

std::vector<float> as_floats(const Eigen::VectorXd& values) {
  const Eigen::VectorXf floats = values.cast<float>();
  return {floats.begin(), floats.end()};
}

void Container::add(std::string_view name, const std::vector<float>& values) {
  header_["arrays"].push_back({{"name", name}, {"type", "f32"}, {"start", arrays_.size()}, {"count", values.size()}});
  arrays_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

void Container::add_rounded(std::string_view name, const std::vector<float>& values) {
  const Range range = range_of(values);
  const double step = range.step();
  std::vector<std::uint16_t> stored;
  stored.reserve(values.size());
  for (const double value : values) {
    stored.push_back(std::isnan(value) ? kNoNumber
                     : step == 0.0     ? std::uint16_t{0}
                                       : static_cast<std::uint16_t>(std::lround((value - range.low) / step)));
  }
  header_["arrays"].push_back({{"name", name},
                               {"type", "u16"},
                               {"start", arrays_.size()},
                               {"count", values.size()},
                               {"scale", step},
                               {"offset", range.low}});
  arrays_.append(reinterpret_cast<const char*>(stored.data()), stored.size() * sizeof(std::uint16_t));
  arrays_.resize((arrays_.size() + kAlignment - 1) / kAlignment * kAlignment, '\0');
}

double Container::rounding_error(const std::vector<float>& values) {
  return range_of(values).step() / 2.0;
}

std::string Container::bytes() const {
  std::string header = header_.dump(-1, ' ', false, Json::error_handler_t::replace);
  header.resize((header.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
  const auto length = static_cast<std::uint32_t>(header.size());
  std::string all(sizeof(length), '\0');
  std::memcpy(all.data(), &length, sizeof(length));
  return all + header + arrays_;
}

}  // namespace strut::cli
