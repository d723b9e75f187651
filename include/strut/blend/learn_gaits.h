// SPDX-License-Identifier: MIT
// From examples to a gait model: the bilinear model's dimensions are chosen by leaving out cells (a style at a speed)
// and predicting them, and what that found is reported beside what simpler predictions would have done.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <strut/blend/gait_examples.h>
#include <strut/blend/gait_model.h>
#include <strut/core/diagnostics.h>

namespace strut::blend {

/// The two models of Tenenbaum and Freeman.
enum class BilinearKind {
  kAsymmetric,  ///< a matrix per style
  kSymmetric,   ///< a vector per style on functions that all styles share
};

/// How a gait model is learnt. What is not given is chosen by left-out cells.
struct GaitLearnOptions {
  BilinearKind kind = BilinearKind::kAsymmetric;
  std::optional<int> style_dims{};       ///< of the symmetric model, 1 to the number of styles
  std::optional<int> content_dims{};     ///< 1 to the number of functions of the speed
  std::optional<int> speed_functions{};  ///< 1 to 6: constant, straight, parabola, ...
  std::optional<bool> relative_speed{};  ///< whether styles are alike at the same share of their mean speed, or at the
                                         ///< same speed
  std::optional<double> ridge{};         ///< towards the mean style, in cells, > 0
};

/// Errors of predictions of a cell: root mean square over the cycle and the joints of the difference in rotation [rad].
struct GaitErrors {
  double bilinear = 0.0;    ///< the model
  double style_only = 0.0;  ///< mean of the style's other cells, whatever their speed
  double speed_only = 0.0;  ///< fit of all other cells over speed, whatever their style
  double nearest = 0.0;     ///< the style's cell of nearest speed
  double additive = 0.0;    ///< an effect of the style plus an effect of the speed (two factors, for comparison)
};

/// A cell that was left out and predicted from the others.
struct LeftOutCell {
  int style = 0;
  double speed = 0.0;  ///< [m/s]
  GaitErrors errors;
};

/// What learning found.
struct GaitReport {
  int num_cells = 0, num_cycles = 0;
  int style_dims = 0;  ///< as chosen or given; the number of styles for the asymmetric model
  int content_dims = 0, speed_functions = 0;
  double ridge = 0.0;
  bool relative_speed = true;
  bool converged = true;                ///< alternating least squares of the final fit
  std::vector<LeftOutCell> left_out{};  ///< cells of styles with two or more; empty if there is none
  GaitErrors mean{};                    ///< over left_out
};

/// A model and how it came about.
struct LearntGaits {
  std::shared_ptr<const GaitModel> model;
  GaitReport report;
};

/// Learns a model. `provenance` makes what the model keeps of its origin from the report; may be empty.
/// A style with a single cell takes its change with speed from the mean style, and is reported as a warning; so is a
/// model of which no cell could be left out. Throws InvalidArgument if there is only one style or an option is out of
/// range. Cost: (cells x settings tried) small fits, about a second for thirty cells.
LearntGaits learn_gaits(const GaitExamples& examples, const GaitLearnOptions& options = {},
                        const std::function<std::string(const GaitReport&)>& provenance = {},
                        Diagnostics* diagnostics = nullptr);

}  // namespace strut::blend
