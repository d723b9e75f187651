// SPDX-License-Identifier: MIT
// How well models tell footplants, on takes 001 to 012 of the real clips in three folds; run by hand, its table is in
// docs/footplants.md:   build/release/bench/footplant_study FOLDER
// Of the takes left out it compares what the classifier says of translated clips, frame by frame, with what the
// detector sees in the style's real takes.
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <strut/io/bvh.h>
#include <strut/learn/learn_style.h>
#include <strut/model/model_step.h>
#include <strut/motion/legs.h>
#include <strut/postprocess/footplant_detector.h>
#include <strut/representation/extrapolation.h>
#include <strut/representation/representation.h>
#include <strut/translate/translate_motion.h>

namespace {

using namespace strut;

constexpr int kTakes = 12;
constexpr int kFolds = 3;
constexpr double kWarmUp = 0.3;    // as translate_motion [s]
constexpr double kFlicker = 0.08;  // a shorter footplant is none [s]

/// Of both feet together.
struct Tally {
  double seconds = 0.0, planted = 0.0;  // of a foot
  int onsets = 0, flickers = 0;         // footplants that begin inside a clip; of them too short ones

  void add(const Tally& other) {
    seconds += other.seconds;
    planted += other.planted;
    onsets += other.onsets;
    flickers += other.flickers;
  }
};

Tally seen_by_detector(const Motion& clip) {
  Tally tally{2.0 * clip.num_frames() / clip.frame_rate()};
  for (const auto& plant : postprocess::detect_footplants(clip, motion::find_legs(clip).value())) {
    tally.planted += (plant.end - plant.begin) / clip.frame_rate();
    tally.onsets += plant.begin > 0 ? 1 : 0;
  }
  return tally;
}

/// The footplants of one foot as they stream in, each frame as long as the style makes it.
class Foot {
 public:
  void add(bool is_planted, double seconds, Tally& tally) {
    if (is_planted && !was_planted_ && started_) ++tally.onsets;
    if (!is_planted && was_planted_ && lasted_ < kFlicker) ++tally.flickers;
    lasted_ = is_planted == was_planted_ ? lasted_ + seconds : seconds;
    was_planted_ = is_planted;
    started_ = true;
    tally.seconds += seconds;
    tally.planted += is_planted ? seconds : 0.0;
  }

 private:
  bool was_planted_ = false, started_ = false;
  double lasted_ = 0.0;
};

Tally told_by_classifier(const std::shared_ptr<const StyleModel>& model, const Motion& input) {
  const FrameMatrix rows = representation::encode(model->input(), input);
  ModelStep<double> step(model);
  Eigen::RowVectorXd output(model->num_dofs() + 1);
  Eigen::VectorXd state(model->state_size());
  const auto warm_up = static_cast<int>(std::lround(kWarmUp * model->frame_rate()));
  const FrameMatrix before = representation::extrapolate_back(rows, warm_up);
  for (Eigen::Index t = 0; t < before.rows(); ++t) step.step(before.row(t), output);
  Tally tally;
  std::array<Foot, 2> feet;
  for (Eigen::Index t = 0; t < rows.rows(); ++t) {
    step.step(rows.row(t), output);
    step.state(state);
    const double seconds = std::exp(output[model->time_warp_dof()]) / model->frame_rate();
    for (int foot = 0; foot < 2; ++foot) {
      feet[static_cast<std::size_t>(foot)].add(model->footplants()->is_planted(foot, state), seconds, tally);
    }
  }
  return tally;
}

/// What one cell shows.
struct Cell {
  Tally real, told, translated;
  double left_out = 0.0, learnt = 0.0;  // agreement
};

class Study {
 public:
  explicit Study(std::string folder) : folder_(std::move(folder)) {}

  [[nodiscard]] Cell run(const std::string& content, const std::string& style) const {
    Cell cell;
    for (int fold = 0; fold < kFolds; ++fold) run_fold(content, style, fold, cell);
    return cell;
  }

 private:
  [[nodiscard]] Motion read(const std::string& content, const std::string& style, int take) const {
    char name[16];
    std::snprintf(name, sizeof name, "_%03d.bvh", take);
    return read_bvh(folder_ + "/dataset-2_" + content + "_" + style + name).motion;
  }

  void run_fold(const std::string& content, const std::string& style, int fold, Cell& cell) const {
    std::vector<Motion> inputs, outputs, left_out_inputs, left_out_outputs;
    for (int take = 1; take <= kTakes; ++take) {
      const bool is_left_out = take % kFolds == fold;
      (is_left_out ? left_out_inputs : inputs).push_back(read(content, "normal", take));
      (is_left_out ? left_out_outputs : outputs).push_back(read(content, style, take));
    }
    const LearntStyle learnt = learn_style(inputs, outputs, learn::find_pairs(inputs, outputs).pairs);
    cell.left_out += learnt.report.footplants->left_out_agreement / kFolds;
    cell.learnt += learnt.report.footplants->agreement / kFolds;
    for (const Motion& clip : left_out_outputs) cell.real.add(seen_by_detector(clip));
    for (const Motion& clip : left_out_inputs) {
      cell.told.add(told_by_classifier(learnt.model, clip));
      cell.translated.add(seen_by_detector(translate_motion(learnt.model, clip, {.clean_feet = false})));
    }
  }

  std::string folder_;
};

void print(const std::string& name, const Cell& cell) {
  const auto share = [](const Tally& tally) { return tally.planted / tally.seconds; };
  const auto rate = [](const Tally& tally) { return 2.0 * tally.onsets / tally.seconds; };
  std::printf("| %s | %.1f | %.1f | %.3f | %.3f | %.3f | %.2f | %.2f | %.2f | %d |\n", name.c_str(),
              100.0 * cell.learnt, 100.0 * cell.left_out, share(cell.real), share(cell.told), share(cell.translated),
              rate(cell.real), rate(cell.told), rate(cell.translated), cell.told.flickers);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: footplant_study FOLDER (of the Bandai-Namco clips)\n");
    return 2;
  }
  const Study study(argv[1]);
  std::printf(
      "| cell | agreement learnt, %% | left out, %% | stance: real | told | seen in translated | footplants/s: real | "
      "told "
      "| seen in translated | flickers told |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const char* content : {"walk", "walk-turn-left", "walk-turn-right", "run", "wave-left-hand", "wave-both-hands",
                              "raise-up-right-hand"}) {
    for (const char* style : {"elderly", "active", "feminine"}) {
      print(std::string(content) + " " + style, study.run(content, style));
    }
  }
}
