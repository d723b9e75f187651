// SPDX-License-Identifier: MIT
// What is made when it is first asked for, once, and kept: clips that were read, answers that took long.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace strut::cli {

/// Thread-safe: who asks for something that is being made waits for it; nobody else does.
template <typename Value>
class Kept {
 public:
  using Pointer = std::shared_ptr<const Value>;

  /// The value of `key`, which `make()` returns as a Pointer if it is not there yet. What `make` throws passes through,
  /// and nothing is kept: it is tried again when it is asked for again.
  template <typename Make>
  Pointer get(const std::string& key, Make make) {
    const std::shared_ptr<Place> place = place_of(key);
    const std::scoped_lock lock(place->mutex);
    if (!place->value) place->value = make();
    return place->value;
  }

 private:
  struct Place {
    std::mutex mutex;
    Pointer value;
  };

  std::shared_ptr<Place> place_of(const std::string& key) {
    const std::scoped_lock lock(mutex_);
    std::shared_ptr<Place>& place = places_[key];
    if (!place) place = std::make_shared<Place>();
    return place;
  }

  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Place>> places_;
};

}  // namespace strut::cli
