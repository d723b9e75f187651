// SPDX-License-Identifier: MIT
// strut translate --stream: a row of BVH in, a row of BVH out.
#pragma once

#include "style_options.h"

#include <optional>
#include <string>

#include <strut/io/bvh.h>

namespace strut::cli {

struct StreamArguments {
  std::string input = "-";     ///< a file, or "-" for standard input
  std::string output = "-";    ///< a file, or "-" for standard output
  bool is_followed = false;    ///< the input goes on where it ends
  std::optional<double> idle;  ///< a followed input has ended when it did not grow for so long [s]
  BvhReadOptions read;         ///< how the input is to be read
  bool clean_feet = false;     ///< hold planted feet, at the cost of latency
  bool keep_layout = false, force = false;
};

/// Translates until the input ends, or is interrupted, or nobody wants the output any more. All rows that came before
/// an error have been written when it is thrown.
void translate_stream(const StyleArguments& style, const StreamArguments& stream);

}  // namespace strut::cli
