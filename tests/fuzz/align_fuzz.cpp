// SPDX-License-Identifier: MIT
// Any bytes as two signals and options: they are aligned or refused with one of strut's errors, nothing else. What
// comes out must cover the output exactly, within the slope limit, and the objective must never rise.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include <strut/align/dynamic_time_warping.h>
#include <strut/align/iterative_motion_warping.h>
#include <strut/core/error.h>

namespace {

using namespace strut;

constexpr double kRounding = 1e-9;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Reads numbers off the front of the bytes; zeros after their end.
class Bytes {
 public:
  Bytes(const std::uint8_t* begin, std::size_t size) : at_(begin), left_(size) {}

  int small() { return left_ == 0 ? 0 : (--left_, *at_++); }

  template <typename T>
  T raw() {
    T value{};
    if (left_ < sizeof(T)) return value;
    std::memcpy(&value, at_, sizeof(T));
    at_ += sizeof(T);
    left_ -= sizeof(T);
    return value;
  }

  /// Most are small; some are anything a number can be.
  double number() {
    const int first = small();
    return first == 255 ? raw<double>() : (first - 127) / 32.0;
  }

  FrameMatrix signal(int frames, int dofs) {
    return FrameMatrix::NullaryExpr(frames, dofs, [&] { return number(); });
  }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
};

align::IterativeMotionWarpingOptions options_of(Bytes& bytes, int dofs) {
  align::IterativeMotionWarpingOptions options;
  const int choice = bytes.small();
  options.slope_limit = choice % 4 == 0 ? bytes.raw<double>() : 1.0 + choice / 64.0;
  options.resolution = choice % 8 == 1 ? bytes.raw<int>() : choice % 8;
  options.ends = static_cast<align::Ends>(bytes.small() % 4);
  options.space = {std::abs(bytes.number()), bytes.number()};
  if (choice % 16 == 3) options.weights = bytes.signal(1, dofs).row(0);
  options.max_rounds = bytes.small() % 8;
  options.tolerance = 0.0;
  options.exact_steps = choice % 2 == 0 ? 1 : std::int64_t{1} << 28;
  options.band_radius = bytes.small() % 16;
  return options;
}

void check(const align::IterativeMotionWarpingResult& result, const align::IterativeMotionWarpingOptions& options,
           const FrameMatrix& output) {
  const align::Correspondence& found = result.correspondence;
  const auto frames = static_cast<double>(output.rows());
  require(std::abs(found.output_end() + found.output_rest - frames) < kRounding * (1.0 + frames));
  require(found.differential_warp.maxCoeff() <= options.slope_limit * (1.0 + kRounding));
  require(found.differential_warp.minCoeff() >= 1.0 / options.slope_limit - kRounding);
  for (std::size_t k = 1; k < result.objective.size(); ++k) require(result.objective[k] < result.objective[k - 1]);
  require(align::warp_to_input(output, found).rows() == found.differential_warp.size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const int m = bytes.small(), n = bytes.small(), dofs = bytes.small() % 5;
  const align::IterativeMotionWarpingOptions options = options_of(bytes, dofs);
  const FrameMatrix input = bytes.signal(m, dofs), output = bytes.signal(n, dofs);
  try {
    check(align::iterative_motion_warping(input, output, options), options, output);
  } catch (const InvalidArgument&) {
  } catch (const NumericalError&) {
  }
  for (const auto constraint : {align::LocalConstraint::kTypeI, align::LocalConstraint::kTypeIII}) {
    try {
      const auto found = align::dynamic_time_warping(
          input, output, constraint,
          {.weights = options.weights, .exact_cells = options.exact_steps, .band_radius = options.band_radius});
      require(found.path.front() == align::FramePair{0, 0} && found.path.back() == align::FramePair{m - 1, n - 1});
    } catch (const InvalidArgument&) {
    }
  }
  return 0;
}
