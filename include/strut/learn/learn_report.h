// SPDX-License-Identifier: MIT
// What was learnt and from what, and what that says of further examples.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace strut {

/// How well one part of the body is predicted. Fits are those of predicted to real output [%]: 100 is perfect, 0 no
/// better than the mean (sysid::FitSum).
struct BlockReport {
  std::string name;           ///< joint, "root" or "timing"
  int states = 0;             ///< order chosen; 0 in a radial map
  double left_out_fit = 0.0;  ///< on pairs left out; means nothing where LearnReport::num_left_out is 0
  double fit = 0.0;           ///< on the pairs learnt from
};

/// How often the footplant classifier judges a foot as it is labelled: shares of the frames of both feet.
struct FootplantReport {
  double left_out_agreement = 0.0;  ///< on pairs left out; means nothing where LearnReport::num_left_out is 0
  double agreement = 0.0;           ///< on the pairs learnt from
};

/// The least and greatest of something.
struct Range {
  double least = 0.0, greatest = 0.0;
};

/// What was learnt and from what.
struct LearnReport {
  int num_pairs = 0;                            ///< pairs learnt from
  int num_refused = 0;                          ///< pairs whose alignment was refused
  int num_left_out = 0;                         ///< pairs that were also predicted from pairs of other recordings alone
  int num_input_clips = 0;                      ///< recordings that the pairs learnt from are of, input style
  int num_output_clips = 0;                     ///< the same, output style
  double seconds = 0.0;                         ///< of input that is in a pair, counted once [s]
  Range speed;                                  ///< mean over a pair, input style [m/s]
  Range turning_rate;                           ///< mean over a pair, input style [rad/s], positive to the left
  Range input_duration;                         ///< of a pair, input style [s]
  Range output_duration;                        ///< of a pair, output style [s]
  double duration_ratio = 1.0;                  ///< output over input, mean over pairs
  int num_centres = 0;                          ///< of a radial map; 0: linear systems
  std::vector<BlockReport> blocks;              ///< in the model's order; of a radial map, in the body's
  std::optional<FootplantReport> footplants{};  ///< none where a body has no legs
  std::vector<std::string> untranslated;        ///< joints that move in the output style but hardly in the input style
};

namespace learn {

constexpr double kPoorFit = 20.0;  ///< on pairs left out, below which a part is predicted poorly [%]
constexpr double kFitLostToNews =
    10.0;  ///< from pairs learnt from to pairs left out, above which takes are few [points]

/// The parts predicted poorly on pairs left out, worst first: what they do in the output style does not follow from
/// what the input does, or the examples are too few to tell. Empty where nothing was left out.
std::vector<BlockReport> poorly_predicted(const LearnReport& report);

/// The parts that another take would help, most first: clearly worse on pairs left out than on those learnt from, so
/// what was learnt is still about these recordings. Empty where nothing was left out.
std::vector<BlockReport> short_of_takes(const LearnReport& report);

}  // namespace learn
}  // namespace strut
