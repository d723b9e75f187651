// SPDX-License-Identifier: MIT
#include "align_drawing.h"

#include "align_signals.h"
#include "input_files.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <strut/core/error.h>
#include <strut/motion/legs.h>
#include <strut/representation/representation.h>

namespace strut::cli {
namespace {

constexpr Eigen::Index kMapCells[] = {300, 240, 190, 150, 120};  // across a map, at most
constexpr std::size_t kMostRuns = 32'000;                        // of all maps: 300 KB
constexpr double kScaledShare = 0.95;                            // of the distances that the shades tell apart
constexpr double kLongestClose = 20.0;  // [s] of longer clips all but the warp is drawn of a beginning only,
constexpr double kCloseLength = 12.0;   // this much of it [s]
constexpr double kTurn = 180.0 / std::numbers::pi;

std::string file_name(const std::string& path) {
  return path.substr(path.find_last_of('/') + 1);
}

bool is_angle(int dof) {
  return dof >= representation::kTiltX || dof == representation::kTurningRate;
}

std::string unit(int dof) {
  if (dof == representation::kTurningRate) return "degrees/s";
  if (is_angle(dof)) return "degrees";
  return dof == representation::kHeight ? "m" : "m/s";
}

/// Means over blocks of frames, and the means of the frames' squared norms.
struct Blocks {
  FrameMatrix means;
  Eigen::VectorXd squares;
  Blocks(const Eigen::Ref<const FrameMatrix>& rows, Eigen::Index most)
      : means(std::min(rows.rows(), most), rows.cols()), squares(means.rows()) {
    for (Eigen::Index block = 0; block < means.rows(); ++block) {
      const Eigen::Index begin = block * rows.rows() / means.rows(), end = (block + 1) * rows.rows() / means.rows();
      const auto part = rows.middleRows(begin, end - begin);
      means.row(block) = part.colwise().mean();
      squares[block] = part.rowwise().squaredNorm().mean();
    }
  }
};

// ---- what is drawn --------------------------------------------------------------------------------------------------

/// The curves are drawn about mean orientations that both clips share: that of each its own would hide a difference.
void add_curves(AlignFigure& figure, const Alignment& a, const std::string& wanted) {
  const auto shared = representation::fit_representation({a.input->motion, a.output.motion},
                                                         motion::upright_reference(a.input->motion));
  const FrameMatrix input = representation::encode(shared, a.input->motion),
                    output = representation::encode(shared, a.output.motion);
  const Eigen::RowVectorXd mean = input.colwise().mean();
  const Eigen::VectorXd movement = (input.rowwise() - mean).colwise().squaredNorm().transpose();
  // Of a body that is all pelvis, its tilt.
  const int first = shared.joints().empty() ? representation::kTiltX : representation::kNumRootDofs;
  Eigen::Index most = 0;
  movement.tail(movement.size() - first).maxCoeff(&most);
  const int dof = wanted.empty() ? static_cast<int>(most) + first : find_dof("--dof", shared, wanted, movement);
  const double scale = is_angle(dof) ? kTurn : 1.0;
  figure.quantity = fmt::format("{} [{}]", shortened(shared.dof_name(dof), 32), unit(dof));
  figure.input_curve = scale * input.col(dof);
  figure.output_curve = scale * output.col(dof);
}

AlignFigure::Warp warp_of(const AlignMethod& method, double slope_limit, const JudgedWarp& found,
                          const Eigen::VectorXd& smoothed) {
  return {method.title, found.output_time, found.warp.differential_warp, smoothed, slope_limit, found.onsets};
}

/// The method beside the chosen one; the even stretch where it cannot align these clips.
AlignAnswer add_compared(AlignFigure& figure, const Alignment& a, const AlignOptions& options,
                         Diagnostics& diagnostics) {
  const AlignMethod& other = compared_method(*a.method, a.settings.time.ends);
  try {
    AlignAnswer answer = solve(a, other);
    figure.compared = warp_of(other, other.slope_limit(a.settings), judge(a, answer.correspondence),
                              smoothed(answer.correspondence, other, options).differential_warp);
    return answer;
  } catch (const BadInput& error) {
    diagnostics.note(a.output.path,
                     fmt::format("not drawn beside {}: {}, which cannot align them", a.method->title, other.title),
                     error.hint());
    figure.compared = warp_of(other, 0.0, a.even, a.even.warp.differential_warp);
    figure.compared.title = kEvenTitle;
    return {};
  }
}

/// The part of the output that belongs to a part of the input.
Span mapped(const Span& input, const AlignFigure& figure) {
  const auto at = [&](double time) {
    const auto frame = static_cast<Eigen::Index>(std::lround(time * figure.frame_rate));
    const Eigen::VectorXd& to = figure.chosen.output_time;
    return to[std::clamp<Eigen::Index>(frame, 0, to.size() - 1)] / figure.frame_rate;
  };
  return {at(input.begin), at(input.end)};
}

FigureWindow window_of(const Span& input, const AlignFigure& figure) {
  Span output = mapped(input, figure);
  output.end = std::max(output.end, output.begin + 1.0 / figure.frame_rate);
  return {input, output};
}

void add_windows(AlignFigure& figure, const Alignment& a, const std::optional<Span>& asked) {
  const double rate = figure.frame_rate;
  const Span input{0.0, (a.input->motion.num_frames() - 1) / rate};
  const Span output{0.0, (a.output.motion.num_frames() - 1) / rate};
  if (asked) {
    const Span part{asked->begin, std::min(asked->end, input.end)};
    if (part.length() < 1.0 / rate) {
      throw InvalidArgument("--window", fmt::format("a part of the input, which lasts {:.2f} s", input.end),
                            fmt::format("{:g} to {:g} s", asked->begin, asked->end));
    }
    figure.mapped = figure.whole = figure.close = window_of(part, figure);
    return;
  }
  const bool is_open = !figure.begins_fixed || !figure.ends_fixed;
  figure.whole = is_open ? window_of(input, figure) : FigureWindow{input, output};
  figure.close = input.end > kLongestClose ? window_of({0.0, kCloseLength}, figure) : figure.whole;
  figure.mapped = is_open ? FigureWindow{input, output} : figure.close;
}

FrameMatrix part_of(const FrameMatrix& rows, const Span& span, double rate) {
  const auto begin = static_cast<Eigen::Index>(std::floor(span.begin * rate + 1e-6));
  const auto end = static_cast<Eigen::Index>(std::ceil(span.end * rate - 1e-6)) + 1;
  return rows.middleRows(begin, std::min(end, rows.rows()) - begin);
}

/// The distance from which on the shades no longer tell maps apart.
double darkest_of(const std::vector<AlignFigure::Map>& maps) {
  std::vector<double> all;
  for (const auto& map : maps) all.insert(all.end(), map.distances.data(), map.distances.data() + map.distances.size());
  const auto place = all.begin() + static_cast<std::ptrdiff_t>(kScaledShare * static_cast<double>(all.size() - 1));
  std::nth_element(all.begin(), place, all.end());
  return *place > 0.0 ? *place : 1.0;
}

std::vector<AlignFigure::Map> maps_of(const AlignFigure& figure, const Alignment& a, const AlignAnswer& compared,
                                      Eigen::Index cells) {
  const auto weighted = [&](FrameMatrix rows) {
    if (a.settings.time.weights.size() > 0) rows *= a.settings.time.weights.cwiseSqrt().asDiagonal();
    return rows;
  };
  const FrameMatrix output = weighted(part_of(a.features.output, figure.mapped.output, figure.frame_rate));
  std::vector<AlignFigure::Map> maps;
  const auto add = [&](const std::string& title, const FrameMatrix& input) {
    const FrameMatrix part = weighted(part_of(input, figure.mapped.input, figure.frame_rate));
    maps.push_back({title, block_distances(part, output, cells)});
  };
  add("Distance of the clips\u2019 frames", a.features.input);
  if (a.answer.seen_input.size() > 0) {
    add("After " + figure.chosen.title + "\u2019s spatial warp of the input", a.answer.seen_input);
  } else if (compared.seen_input.size() > 0) {
    add("After " + figure.compared.title + "\u2019s spatial warp of the input", compared.seen_input);
  }
  return maps;
}

/// The finest maps whose strokes the file can afford.
void add_maps(AlignFigure& figure, const Alignment& a, const AlignAnswer& compared) {
  for (const Eigen::Index cells : kMapCells) {
    figure.maps = maps_of(figure, a, compared, cells);
    figure.darkest = darkest_of(figure.maps);
    std::size_t runs = 0;
    for (const auto& map : figure.maps) runs += num_runs(map.distances / figure.darkest);
    if (runs <= kMostRuns) return;
  }
}

std::string told(const AlignClip& clip, const char* role) {
  return fmt::format("{}: {}, {} frames at {:g} frames/s ({:.2f} s).", role, shortened(file_name(clip.path), 60),
                     clip.motion.num_frames(), clip.motion.frame_rate(), clip.motion.duration());
}

void add_caption(AlignFigure& figure, const Alignment& a) {
  std::string text = fmt::format("{} {} Aligned by {} on {}", told(*a.input, "Input"), told(a.output, "Output"),
                                 a.method->title, signals_in_words(a.signals, num_compared(a)));
  if (a.slope_limit > 0.0) {
    const auto share_of = [&](const JudgedWarp& judged) {
      return 100.0 * align::share_at_slope_limit(judged.warp.differential_warp, a.slope_limit);
    };
    text += fmt::format(" with a slope limit of {:g}: {:.0f} % of the frames run along it", a.slope_limit,
                        share_of(a.found));
    if (is_smoothed(a)) text += fmt::format(", {:.0f} % after smoothing", share_of(a.smoothed));
  }
  if (a.settings.time.ends != align::Ends::kFixed) {
    text += fmt::format("; found from {:.2f} to {:.2f} s of the output", a.found.warp.output_begin / figure.frame_rate,
                        a.found.warp.output_end() / figure.frame_rate);
  }
  text += ".";
  if (figure.compared.title != kEvenTitle) text += fmt::format(" {} compares the same.", figure.compared.title);
  figure.caption.push_back(text);
  const double ms = 1e3 / figure.frame_rate;
  if (a.found.onsets && a.found.onsets->num_pairs > 0) {
    figure.caption.push_back(fmt::format(
        "Footplants: {} of the {} times a foot comes down in the input are paired with one of {} in the output; mean "
        "error {:.0f} ms, "
        "largest {:.0f} ms ({}{:.0f} ms if the input is stretched evenly).",
        a.found.onsets->num_pairs, a.found.onsets->onsets.size(), a.found.onsets->num_outputs(),
        a.found.onsets->mean * ms, a.found.onsets->largest * ms,
        is_smoothed(a) ? fmt::format("{:.0f} ms in the mean after smoothing, ", a.smoothed.onsets->mean * ms) : "",
        a.even.onsets->mean * ms));
  }
  std::string parts =
      "(a) A degree of freedom of both clips, and the input\u2019s curve brought into the output\u2019s time. (b) "
      "Squared distance between frames, in deviations of each ";
  parts += a.signals == SignalSet::kPosture ? "degree of freedom" : "signal, weighted";
  parts += ", with the paths found. (c) Where the warp puts the input; its slope";
  if (is_smoothed(a)) parts += " as found (grey) and smoothed (black)";
  const bool has_rings = a.found.onsets && a.found.onsets->num_pairs > 0 && a.found.onsets->onsets.size() <= kMostRings;
  if (has_rings) parts += "; rings: where a left (filled) or right (open) foot comes down in both clips";
  figure.caption.push_back(parts + ".");
  if (figure.close.input.end < figure.whole.input.end) {
    figure.caption.push_back(fmt::format("(a), (b), the slope and (d) show the first {:g} s.", figure.close.input.end));
  }
}

}  // namespace

FrameMatrix block_distances(const Eigen::Ref<const FrameMatrix>& input, const Eigen::Ref<const FrameMatrix>& output,
                            Eigen::Index most) {
  const Blocks of_input(input, most), of_output(output, most);
  FrameMatrix distances = -2.0 * of_output.means * of_input.means.transpose();
  distances.colwise() += of_output.squares;
  distances.rowwise() += of_input.squares.transpose();
  return distances.cwiseMax(0.0);
}

AlignFigure figure_of(const Alignment& a, const AlignOptions& options, Diagnostics& diagnostics) {
  AlignFigure figure;
  figure.frame_rate = a.input->motion.frame_rate();
  figure.input_name = file_name(a.input->path);
  figure.output_name = file_name(a.output.path);
  figure.begins_fixed = a.settings.time.ends == align::Ends::kFixed || a.settings.time.ends == align::Ends::kOpenEnd;
  figure.ends_fixed = a.settings.time.ends == align::Ends::kFixed || a.settings.time.ends == align::Ends::kOpenBegin;
  figure.chosen = warp_of(*a.method, a.slope_limit, a.found, a.smoothed.warp.differential_warp);
  figure.even = a.even.output_time;
  figure.plants = a.plants;
  figure.no_plants = a.no_plants;
  const AlignAnswer compared = add_compared(figure, a, options, diagnostics);
  figure.compared_first = a.answer.seen_input.size() > 0 || compared.seen_input.size() == 0;
  add_curves(figure, a, options.dof);
  add_windows(figure, a, options.window);
  add_maps(figure, a, compared);
  add_caption(figure, a);
  return figure;
}

}  // namespace strut::cli
