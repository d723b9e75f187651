// SPDX-License-Identifier: MIT
#include "view/container.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace strut::cli {

static_assert(std::endian::native == std::endian::little, "arrays are sent as they lie in memory");

void Container::add(std::string_view name, const std::vector<float>& values) {
  header_["arrays"].push_back({{"name", name}, {"type", "f32"}, {"start", arrays_.size()}, {"count", values.size()}});
  arrays_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
}

std::string Container::bytes() const {
  std::string header = header_.dump(-1, ' ', false, Json::error_handler_t::replace);
  header.resize((header.size() + 3) / 4 * 4, ' ');
  const auto length = static_cast<std::uint32_t>(header.size());
  std::string all(sizeof(length), '\0');
  std::memcpy(all.data(), &length, sizeof(length));
  return all + header + arrays_;
}

}  // namespace strut::cli
