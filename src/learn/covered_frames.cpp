// SPDX-License-Identifier: MIT
#include "learn/covered_frames.h"

#include <algorithm>
#include <map>

namespace strut::learn {
namespace {

/// From the first to the last frame of every input clip that a pair covers.
std::map<int, FrameRange> covered_ranges(const std::vector<AlignedPair>& aligned) {
  std::map<int, FrameRange> ranges;
  for (const AlignedPair& pair : aligned) {
    FrameRange& range = ranges.try_emplace(pair.input_clip, pair.input_frames).first->second;
    range.begin = std::min(range.begin, pair.input_frames.begin);
    range.end = std::max(range.end, pair.input_frames.end);
  }
  return ranges;
}

/// `contexts` (contexts x lead-in and frames) end with those of the last of `features` (lags x contexts x frames).
void fill_features(const Eigen::MatrixXd& contexts, const std::vector<int>& lags,
                   Eigen::Ref<Eigen::MatrixXd> features) {
  const Eigen::Index lead_in = contexts.cols() - features.cols();
  for (std::size_t l = 0; l < lags.size(); ++l) {
    for (Eigen::Index t = 0; t < features.cols(); ++t) {
      features.col(t).segment(static_cast<Eigen::Index>(l) * contexts.rows(), contexts.rows()) =
          contexts.col(std::max<Eigen::Index>(0, lead_in + t - lags[l]));
    }
  }
}

}  // namespace

CoveredFrames cover_frames(const Examples& examples, const std::vector<AlignedPair>& aligned, const Scalings& scalings,
                           const Eigen::MatrixXd& context, const std::vector<int>& lags) {
  const std::map<int, FrameRange> ranges = covered_ranges(aligned);
  std::map<int, Eigen::Index> begins;
  Eigen::Index frames = 0;
  for (const auto& [clip, range] : ranges) {
    begins[clip] = frames;
    frames += range.num_frames();
  }
  CoveredFrames covered{
      {static_cast<Eigen::Index>(lags.size()) * context.rows(), frames}, {context.cols(), frames}, {}};
  for (const auto& [clip, range] : ranges) {
    const FrameMatrix& signal = examples.input.clips[static_cast<std::size_t>(clip)];
    // Continued backward by more than its length, a clip stands still.
    const int lead_in = std::min(lags.back(), range.begin + static_cast<int>(signal.rows()));
    const Eigen::MatrixXd rows = scalings.input.normalize(with_lead_in(signal, range, lead_in)).transpose();
    covered.input.middleCols(begins[clip], range.num_frames()) = rows.rightCols(range.num_frames());
    fill_features(context * rows, lags, covered.features.middleCols(begins[clip], range.num_frames()));
  }
  for (const AlignedPair& pair : aligned) {
    covered.of_pair.push_back({begins[pair.input_clip] + pair.input_frames.begin - ranges.at(pair.input_clip).begin,
                               pair.input_frames.num_frames()});
  }
  return covered;
}

}  // namespace strut::learn
