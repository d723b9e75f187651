// SPDX-License-Identifier: MIT
// Draws an alignment as Figure 2 of Hsu et al. 2005: a degree of freedom of two motions, which moments belong together,
// and the first motion warped in time onto the second by two methods.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace strut::cli {

/// One degree of freedom of two aligned motions.
struct AlignPlot {
  /// A method's answer.
  struct Warp {
    std::string method;           ///< as it is shown, e.g. "IMW"
    Eigen::VectorXd output_time;  ///< of every input frame [output frames] (input frames)
  };
  std::string quantity;            ///< of both curves, with its unit, e.g. "hip x [degrees]"
  std::string input_name;          ///< whose curve is on top
  std::string output_name;         ///< whose curve is below
  double frame_rate = 30.0;        ///< of both [frames/s]
  Eigen::VectorXd input;           ///< values (input frames)
  Eigen::VectorXd output;          ///< values (output frames)
  Warp correspondence;             ///< the first panel: both curves as they are, tied where this says
  std::vector<Warp> warped_input;  ///< a panel each: the input's curve where this puts it in the output's time
};

/// The figure as SVG: white ground, no scripts, no outside fonts. Cost O(frames).
std::string draw_alignment(const AlignPlot& plot);

}  // namespace strut::cli
