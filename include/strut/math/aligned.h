// SPDX-License-Identifier: MIT
// Memory for numbers that are stepped several at once: aligned to a cache line, lengths rounded up so that loops need
// no remainder. What fills up a length is zero unless said otherwise.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace strut::math {

/// Loops over arrays run in steps of so many numbers.
inline constexpr int kLanes = 8;

/// Rows of a tile (tiled_matrix.h).
inline constexpr int kTileRows = 32;

/// `count` rounded up to whole steps of `step`.
constexpr int padded(int count, int step = kLanes) {
  return (count + step - 1) / step * step;
}

/// An allocator of memory that begins at a cache line.
template <typename T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kAlignment{64};

  CacheLineAllocator() = default;
  template <typename U>
  explicit CacheLineAllocator(const CacheLineAllocator<U>& /*other*/) noexcept {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kAlignment)); }
  void deallocate(T* memory, std::size_t /*count*/) noexcept { ::operator delete(memory, kAlignment); }

  template <typename U>
  bool operator==(const CacheLineAllocator<U>& /*other*/) const noexcept {
    return true;
  }
};

template <typename T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

}  // namespace strut::math
