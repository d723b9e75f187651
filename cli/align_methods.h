// SPDX-License-Identifier: MIT
// The alignment methods the program offers. To offer another one, add a row to the table in align_methods.cpp: help,
// completion, reports and figures take it from there.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <strut/align/correspondence.h>
#include <strut/math/frame_matrix.h>
#include <strut/representation/alignment_features.h>

namespace strut::cli {

/// What a person may set of an alignment; each method takes what it knows.
struct AlignSettings {
  int slope_limit = 2;
  double smoothness = 100.0;  ///< of the spatial warp
  int rounds = 10;
  Eigen::VectorXd weights{};  ///< of every degree of freedom, >= 0; empty: 1
};

/// A method's answer.
struct AlignAnswer {
  align::Correspondence correspondence;
  std::vector<double> objective{};  ///< what it minimizes, after each round; empty where there are no rounds
  FrameMatrix seen_input{};         ///< the input as it was compared in the end; empty: as it is
};

/// One method.
struct AlignMethod {
  const char* name;           ///< on the command line
  const char* title;          ///< to a person
  const char* description;    ///< in the help
  const char* compared_with;  ///< the name of the method drawn beside it
  /// The largest output frames per input frame; 0: any.
  double (*slope_limit)(const AlignSettings&);
  /// Throws InvalidArgument as the library does.
  AlignAnswer (*solve)(const representation::AlignmentPair&, const AlignSettings&);
};

/// All of them, the default first.
const std::vector<AlignMethod>& align_methods();

/// The one called `name`, which must be there.
const AlignMethod& align_method(const std::string& name);

}  // namespace strut::cli
