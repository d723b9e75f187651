// SPDX-License-Identifier: MIT
// clips -> rows, footplants, cycles -> aligned to one phase -> closed -> means of cells.
#include "cycle_alignment.h"

#include <algorithm>
#include <cmath>

#include <strut/blend/gait_examples.h>
#include <strut/core/error.h>
#include <strut/math/sampling.h>
#include <strut/motion/gait_cycles.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>

namespace strut::blend {
namespace {

constexpr double kLeastSpeed = 0.05;  // who steps on the spot has no speed that others could be a share of [m/s]
constexpr int kSamples = 128;         // of a cycle when it is closed: more than twice the most harmonics

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

/// What is known of every clip.
struct Recording {
  std::vector<FrameMatrix> rows;
  std::vector<std::vector<motion::Footplant>> plants;
};

void check(const std::vector<StyledClip>& clips, const GaitExampleOptions& options) {
  const auto refuse = [](const char* name, const char* expected, double got) {
    throw InvalidArgument(name, expected, std::to_string(got));
  };
  if (options.harmonics < 1 || options.harmonics > 30) refuse("harmonics", "1 to 30", options.harmonics);
  if (options.rounds < 1 || options.rounds > 20) refuse("rounds", "1 to 20", options.rounds);
  if (!(options.speed_bin > 0.0 && options.speed_bin <= 1.0))
    refuse("speed_bin", "above 0, up to 1", options.speed_bin);
  if (!(options.most_turning > 0.0)) refuse("most_turning", "a positive angle", options.most_turning);
  if (clips.empty()) throw InvalidArgument("clips", "at least one", "none");
  for (const StyledClip& clip : clips) {
    if (clip.style.empty()) throw InvalidArgument("style", "a name for every clip's style", "an empty name");
    const std::string mismatch = describe_mismatch(clips.front().motion.skeleton(), clip.motion.skeleton());
    if (!mismatch.empty()) {
      throw SkeletonMismatch((clip.name.empty() ? "a clip" : clip.name) +
                             ": not the skeleton of the first clip: " + mismatch);
    }
  }
}

int style_index(std::vector<std::string>& styles, const std::string& name) {
  const auto found = std::find(styles.begin(), styles.end(), name);
  if (found != styles.end()) return static_cast<int>(found - styles.begin());
  styles.push_back(name);
  return static_cast<int>(styles.size()) - 1;
}

std::shared_ptr<const representation::Representation> common_representation(const std::vector<StyledClip>& clips) {
  std::vector<Motion> motions;
  for (const StyledClip& clip : clips) motions.push_back(clip.motion);
  return std::make_shared<const representation::Representation>(
      representation::fit_representation(motions, motion::upright_reference(motions)));
}

/// The usable cycles of one clip.
std::vector<CutCycle> cut(const StyledClip& clip, int style, int index, const GaitExampleOptions& options,
                          std::vector<motion::Footplant>& plants, Diagnostics* diagnostics) {
  const std::string name = clip.name.empty() ? "clip " + std::to_string(index) : clip.name;
  const auto legs = motion::find_legs(clip.motion);
  if (!legs) throw InvalidArgument("clips", "bodies with two legs", name + " with none that could be found");
  plants = postprocess::detect_footplants(clip.motion, *legs);
  Diagnostics left_out;
  std::vector<CutCycle> cycles;
  int turning = 0;
  for (const motion::GaitCycle& cycle : motion::gait_cycles(clip.motion, *legs, plants, &left_out)) {
    if (cycle.foot != 0 || !(cycle.speed > kLeastSpeed)) continue;
    if (std::abs(cycle.turning) > options.most_turning) {
      ++turning;
    } else {
      cycles.push_back({style, index, static_cast<double>(cycle.frames.begin),
                        static_cast<double>(cycle.frames.num_frames()), cycle.speed});
    }
  }
  if (cycles.empty() && diagnostics != nullptr) {
    diagnostics->warn(
        name, turning > 0 ? "all of its gait cycles turn too much to be used" : "no gait cycle was found in it",
        "a cycle is from one coming down of the left foot to the next; walk straight, two cycles or more");
  }
  return cycles;
}

/// Rows of a cycle at evenly spread phases, straightened, with the logarithm of the time a cycle takes at their pace.
/// `position`: an extra phase after the last, to see how far the cycle is from closing.
FrameMatrix signals_of(const CutCycle& cycle, const CycleWarp& warp, const FrameMatrix& rows,
                       const Eigen::VectorXd& phases, double frame_rate) {
  Eigen::VectorXd frames(phases.size()), pace(phases.size());
  for (Eigen::Index k = 0; k < phases.size(); ++k) {
    frames[k] = cycle.begin + cycle.length * warp.position(phases[k]);
    pace[k] = warp.pace(phases[k]);
  }
  constexpr int kVelocities = representation::kHeight;
  FrameMatrix signals(phases.size(), rows.cols() + 1);
  signals.leftCols(rows.cols()) = math::sample_rows(rows, frames);
  // A row's velocities are those half a frame before it.
  signals.leftCols(kVelocities) = math::sample_rows(rows.leftCols(kVelocities), frames.array() + 0.5);
  signals.rightCols<1>() = (pace.array() * (cycle.length / frame_rate)).log().matrix();
  const double turning = signals.col(representation::kTurningRate).dot(pace) / pace.sum();
  signals.col(representation::kTurningRate).array() -= turning;
  return signals;
}

FrameMatrix closed_series(const CutCycle& cycle, const CycleWarp& warp, const FrameMatrix& rows, double frame_rate,
                          int harmonics) {
  const Eigen::VectorXd phases =
      (Eigen::VectorXd::LinSpaced(kSamples, 0.0, kSamples - 1.0).array() + 0.5) / double{kSamples};
  const FrameMatrix ends = signals_of(cycle, warp, rows, Eigen::Vector2d(0.0, 1.0), frame_rate);
  return fit_series(signals_of(cycle, warp, rows, phases, frame_rate), (ends.row(1) - ends.row(0)).transpose(),
                    harmonics);
}

/// When a foot comes down and leaves in a cycle, as phases; a frame's middle is half a frame after its begin.
PlantPhase plant_phase(const CutCycle& cycle, const CycleWarp& warp, const std::vector<motion::Footplant>& plants,
                       int foot, int num_frames) {
  const auto phase_of = [&](int frame) { return warp.phase((frame - 0.5 - cycle.begin) / cycle.length); };
  PlantPhase phase{foot == 0 ? 0.0 : 0.5, std::nan("")};
  double earlier_end = std::nan("");
  for (const motion::Footplant& plant : plants) {
    if (plant.foot != foot) continue;
    if (plant.begin >= cycle.begin && plant.begin < cycle.begin + cycle.length) {
      phase.begin = phase_of(plant.begin);
      if (plant.end < num_frames) phase.end = phase_of(plant.end);
    } else if (plant.begin < cycle.begin && plant.end < cycle.begin + cycle.length) {
      earlier_end = phase_of(plant.end) + 1.0;  // the footplant before it, a cycle later
    }
  }
  if (std::isnan(phase.end)) phase.end = earlier_end;
  return phase;
}

/// Means of some cycles of one style.
class CellMean {
 public:
  void add(const FrameMatrix& series, const std::array<PlantPhase, 2>& plants, double speed) {
    series_ = count_ == 0 ? series : FrameMatrix(series_ + series);
    speed_ += speed;
    ++count_;
    for (const std::size_t foot : {0U, 1U}) {
      const double held = plants[foot].end - plants[foot].begin;
      begin_[foot] += plants[foot].begin;
      if (!(held > 0.0 && held < 1.0)) continue;
      held_[foot] += held;
      ++known_[foot];
    }
  }
  [[nodiscard]] GaitCell mean(int style) const {
    std::array<PlantPhase, 2> plants;
    for (const std::size_t foot : {0U, 1U}) {
      const std::size_t other = 1 - foot;  // stands for a foot whose footplants are all cut by the clips' ends
      const double held = known_[foot] > 0    ? held_[foot] / known_[foot]
                          : known_[other] > 0 ? held_[other] / known_[other]
                                              : 0.5;
      plants[foot] = {begin_[foot] / count_, begin_[foot] / count_ + held};
    }
    return {style, speed_ / count_, count_, GaitLoop(series_ / count_, plants)};
  }
  [[nodiscard]] bool is_empty() const { return count_ == 0; }

 private:
  FrameMatrix series_;
  std::array<double, 2> begin_{}, held_{};
  std::array<int, 2> known_{};
  double speed_ = 0.0;
  int count_ = 0;
};

/// Cycle numbers by style, then speed.
std::vector<std::size_t> in_order(const std::vector<CutCycle>& cycles) {
  std::vector<std::size_t> order(cycles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return cycles[a].style != cycles[b].style ? cycles[a].style < cycles[b].style : cycles[a].speed < cycles[b].speed;
  });
  return order;
}

std::vector<GaitCell> cells_of(const std::vector<StyledClip>& clips, const std::vector<CutCycle>& cycles,
                               const std::vector<CycleWarp>& warps, const Recording& recording,
                               const GaitExampleOptions& options) {
  std::vector<GaitCell> cells;
  CellMean cell;
  const CutCycle* first = nullptr;
  for (const std::size_t i : in_order(cycles)) {
    const CutCycle& cycle = cycles[i];
    if (first != nullptr && (cycle.style != first->style || cycle.speed > first->speed * (1.0 + options.speed_bin))) {
      cells.push_back(cell.mean(first->style));
      cell = {};
    }
    if (cell.is_empty()) first = &cycle;
    const Motion& motion = clips[at(cycle.clip)].motion;
    const auto& plants = recording.plants[at(cycle.clip)];
    cell.add(closed_series(cycle, warps[i], recording.rows[at(cycle.clip)], motion.frame_rate(), options.harmonics),
             {plant_phase(cycle, warps[i], plants, 0, motion.num_frames()),
              plant_phase(cycle, warps[i], plants, 1, motion.num_frames())},
             cycle.speed);
  }
  cells.push_back(cell.mean(first->style));
  return cells;
}

}  // namespace

GaitExamples gait_examples(const std::vector<StyledClip>& clips, const GaitExampleOptions& options,
                           Diagnostics* diagnostics) {
  check(clips, options);
  GaitExamples examples{common_representation(clips), clips.front().motion.frame_rate(), {}, {}};
  Recording recording;
  std::vector<CutCycle> cycles;
  for (int c = 0; c < static_cast<int>(clips.size()); ++c) {
    const StyledClip& clip = clips[at(c)];
    recording.rows.push_back(representation::encode(*examples.representation, clip.motion));
    recording.plants.emplace_back();
    const int style = style_index(examples.styles, clip.style);
    const auto more = cut(clip, style, c, options, recording.plants.back(), diagnostics);
    cycles.insert(cycles.end(), more.begin(), more.end());
  }
  for (int s = 0; s < static_cast<int>(examples.styles.size()); ++s) {
    const auto shows = [s](const CutCycle& cycle) { return cycle.style == s; };
    if (std::none_of(cycles.begin(), cycles.end(), shows)) {
      throw InvalidArgument("clips", "a straight gait cycle of every style", "none of '" + examples.styles[at(s)] + "'",
                            "give clips in which the left foot comes down three times or more, walking straight");
    }
  }
  const auto warps = align_cycles(cycles, recording.rows, static_cast<int>(examples.styles.size()), options.rounds);
  examples.cells = cells_of(clips, cycles, warps, recording, options);
  return examples;
}

}  // namespace strut::blend
