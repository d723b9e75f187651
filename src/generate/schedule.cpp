// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <strut/core/error.h>
#include <strut/generate/schedule.h>

namespace strut::generate {

Schedule::Schedule(std::vector<ScheduleKey> keys) : keys_(std::move(keys)) {
  if (keys_.empty()) throw InvalidArgument("keys", "at least one key", "none");
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (!std::isfinite(keys_[i].time) || !std::isfinite(keys_[i].value)) {
      throw InvalidArgument("keys[" + std::to_string(i) + "]", "finite numbers", "NaN or infinity");
    }
    if (i > 0 && !(keys_[i].time > keys_[i - 1].time)) {
      throw InvalidArgument("keys[" + std::to_string(i) + "].time",
                            "a time after " + std::to_string(keys_[i - 1].time) + " s", std::to_string(keys_[i].time));
    }
  }
}

double Schedule::at(double time) const {
  if (time <= keys_.front().time) return keys_.front().value;
  if (time >= keys_.back().time) return keys_.back().value;
  const auto after =
      std::upper_bound(keys_.begin(), keys_.end(), time, [](double t, const ScheduleKey& key) { return t < key.time; });
  const ScheduleKey& a = *(after - 1);
  return a.value + (after->value - a.value) * (time - a.time) / (after->time - a.time);
}

double Schedule::mean(double begin, double end) const {
  if (!(end > begin)) return at(begin);
  double integral = 0.0;
  double from = begin;
  const auto add = [&](double to) {
    integral += (to - from) * (at(from) + at(to)) / 2.0;
    from = to;
  };
  for (const ScheduleKey& key : keys_) {
    if (key.time > from && key.time < end) add(key.time);
  }
  add(end);
  return integral / (end - begin);
}

}  // namespace strut::generate
