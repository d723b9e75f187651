// SPDX-License-Identifier: MIT
// What a dynamic program must remember to find its way back: a small number for every cell it decided, row after row of
// any width, in as few bits as the largest needs.
#pragma once

#include "align/warp_kernels.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <strut/math/aligned.h>

namespace strut::align::detail {

class PackedRows {
 public:
  /// Room for `cells` numbers 0 ... largest in `rows` rows; largest < 2^16. Forgets what it held.
  void reset(int largest, std::size_t rows, std::int64_t cells) {
    bits_ = largest < 4 ? 2 : largest < 16 ? 4 : largest < 256 ? 8 : 16;
    begin_.clear();
    begin_.reserve(rows);
    bytes_.clear();
    // Every row is filled up to whole steps of the kernels.
    bytes_.reserve((static_cast<std::size_t>(cells) + rows * kSlotLanes) * static_cast<std::size_t>(bits_) / 8);
  }

  /// Appends a row; `numbers` is readable up to whole steps of kSlotLanes.
  void append(int width, const std::uint16_t* numbers) {
    begin_.push_back(bytes_.size());
    bytes_.resize(bytes_.size() + static_cast<std::size_t>(math::padded(width, kSlotLanes) * bits_ / 8));
    warp_kernels().pack(width, bits_, numbers, bytes_.data() + begin_.back());
  }

  [[nodiscard]] int at(std::size_t row, std::size_t column) const {
    const auto bit = column * static_cast<std::size_t>(bits_);
    const std::uint8_t* byte = bytes_.data() + begin_[row] + bit / 8;
    if (bits_ == 16) return byte[0] | byte[1] << 8;
    return byte[0] >> bit % 8 & ((1 << bits_) - 1);
  }

 private:
  int bits_ = 2;
  std::vector<std::size_t> begin_;  // the byte a row begins with
  std::vector<std::uint8_t> bytes_;
};

}  // namespace strut::align::detail
