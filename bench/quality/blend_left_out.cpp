// SPDX-License-Identifier: MIT
// Every combination of style and speed is left out in turn and predicted from the others: by the bilinear models, and
// by what knows only one of the two factors.
#include "blend_study.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

#include <Eigen/QR>

#include <strut/blend/learn_gaits.h>
#include <strut/io/bvh.h>

namespace strut::study {
namespace {

using blend::BilinearKind;
using blend::GaitCell;
using blend::GaitExamples;
using blend::GaitLoop;
using Eigen::VectorXd;

constexpr int kSeeds = 3;
constexpr double kRate = 60.0;

struct Prediction {
  const char* name;
  bool is_single_factor;
};
constexpr Prediction kPredictions[] = {{"asymmetric bilinear", false},
                                       {"symmetric bilinear", false},
                                       {"additive: style + speed", false},
                                       {"style only: mean over speeds", true},
                                       {"speed only: fit over all styles", true},
                                       {"speed only: other styles at this speed", true},
                                       {"nearest speed of the style", true}};
constexpr std::size_t kCount = std::size(kPredictions);

/// Sums of errors per prediction.
struct Table {
  std::vector<CycleError> sums = std::vector<CycleError>(kCount);
  int cells = 0;
  std::vector<double> shares;  ///< of every cell: best single factor's angle over the asymmetric model's
  void add(const std::vector<CycleError>& errors) {
    double best = 1e300;
    for (std::size_t k = 0; k < kCount; ++k) {
      sums[k].angle += errors[k].angle;
      sums[k].position += errors[k].position;
      sums[k].duration += errors[k].duration;
      if (kPredictions[k].is_single_factor) best = std::min(best, errors[k].angle);
    }
    shares.push_back(best / errors[0].angle);
    ++cells;
  }
  void print() const {
    std::printf(
        "| prediction | joint angles [deg] | joint positions [cm] | duration [%%] |\n| --- | ---: | ---: | ---: |\n");
    double best_angle = 1e300, best_position = 1e300;
    for (std::size_t k = 0; k < kCount; ++k) {
      std::printf("| %s | %.2f | %.2f | %.2f |\n", kPredictions[k].name, sums[k].angle / cells,
                  sums[k].position / cells, sums[k].duration / cells);
      if (!kPredictions[k].is_single_factor) continue;
      best_angle = std::min(best_angle, sums[k].angle);
      best_position = std::min(best_position, sums[k].position);
    }
    std::vector<double> sorted = shares;
    std::sort(sorted.begin(), sorted.end());
    std::printf(
        "\n%d combinations left out. Best single factor over asymmetric: %.1f in angles, %.1f in positions; "
        "over symmetric %.1f, %.1f. Cell by cell, median %.1f, smallest %.1f.\n",
        cells, best_angle / sums[0].angle, best_position / sums[0].position, best_angle / sums[1].angle,
        best_position / sums[1].position, sorted[sorted.size() / 2], sorted.front());
  }
};

/// Predictions that need no model, as packed numbers.
VectorXd mean_of(const std::vector<const GaitCell*>& cells) {
  VectorXd sum = VectorXd::Zero(cells.front()->loop.packed().size());
  for (const GaitCell* cell : cells) sum += cell->loop.packed() / static_cast<double>(cells.size());
  return sum;
}

/// Least squares over `cells`: a parabola of the root of the speed, with a constant per style or one for all.
VectorXd fitted(const std::vector<const GaitCell*>& cells, int styles, const GaitCell& at) {
  const auto design = [&](const GaitCell& cell) {
    VectorXd row = VectorXd::Zero(styles + 2);
    row[styles > 1 ? cell.style : 0] = 1.0;
    row.tail<2>() << std::sqrt(cell.speed), cell.speed;
    return row;
  };
  Eigen::MatrixXd left(cells.size(), styles + 2), right(cells.size(), at.loop.packed().size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    left.row(static_cast<Eigen::Index>(k)) = design(*cells[k]);
    right.row(static_cast<Eigen::Index>(k)) = cells[k]->loop.packed();
  }
  return left.completeOrthogonalDecomposition().solve(right).transpose() * design(at);
}

GaitLoop by_model(const GaitExamples& examples, BilinearKind kind, const GaitCell& at) {
  const auto learnt = blend::learn_gaits(examples, {.kind = kind});
  VectorXd weights = VectorXd::Zero(static_cast<Eigen::Index>(examples.styles.size()));
  weights[at.style] = 1.0;
  return learnt.model->loop(weights, at.speed);
}

/// All predictions of cell `i` of `all` from the others, against `truth`. `peers`: the other styles' cells at its
/// speed.
std::vector<CycleError> predict(const GaitExamples& all, std::size_t i, const GaitLoop& truth,
                                const std::vector<const GaitCell*>& peers) {
  const GaitCell& at = all.cells[i];
  GaitExamples others = all;
  others.cells.erase(others.cells.begin() + static_cast<std::ptrdiff_t>(i));
  std::vector<const GaitCell*> everything, same_style;
  for (const GaitCell& cell : others.cells) {
    everything.push_back(&cell);
    if (cell.style == at.style) same_style.push_back(&cell);
  }
  const auto nearest = *std::min_element(same_style.begin(), same_style.end(), [&](const auto* a, const auto* b) {
    return std::abs(std::log(a->speed / at.speed)) < std::abs(std::log(b->speed / at.speed));
  });
  const int signals = truth.num_signals(), styles = static_cast<int>(all.styles.size());
  const auto loop = [&](const VectorXd& numbers) { return GaitLoop::unpacked(numbers, signals); };
  std::vector<CycleError> errors;
  const auto add = [&](const GaitLoop& predicted) {
    errors.push_back(cycle_error(*all.representation, predicted, truth));
  };
  add(by_model(others, BilinearKind::kAsymmetric, at));
  add(by_model(others, BilinearKind::kSymmetric, at));
  add(loop(fitted(everything, styles, at)));
  add(loop(mean_of(same_style)));
  add(loop(fitted(everything, 1, at)));
  add(loop(mean_of(peers)));
  add(nearest->loop);
  return errors;
}

/// Cells of the other styles whose speed is nearest, one of each.
std::vector<const GaitCell*> nearest_of_others(const GaitExamples& all, const GaitCell& at) {
  std::map<int, const GaitCell*> best;
  for (const GaitCell& cell : all.cells) {
    if (cell.style == at.style) continue;
    const GaitCell*& found = best[cell.style];
    if (found == nullptr || std::abs(std::log(cell.speed / at.speed)) < std::abs(std::log(found->speed / at.speed))) {
      found = &cell;
    }
  }
  std::vector<const GaitCell*> cells;
  for (const auto& [style, cell] : best) cells.push_back(cell);
  return cells;
}

/// A style's noisy cells and exact ones, which are aligned together so that they are on one phase.
struct Generated {
  GaitExamples examples;
  std::vector<GaitLoop> truth;  ///< per cell of the examples
};

Generated generated(std::uint64_t seed) {
  std::vector<blend::StyledClip> clips;
  const auto styles = walker_styles();
  for (const auto& [name, style] : styles) {
    for (const double speed : walker_speeds()) clips.push_back(walk_of(name, style, speed, 1.0, seed++, kRate));
  }
  for (const auto& [name, style] : styles) {
    for (const double speed : walker_speeds()) clips.push_back(walk_of("exact " + name, style, speed, 0.0, 1, kRate));
  }
  Generated made{blend::gait_examples(clips), {}};
  const auto num_styles = static_cast<int>(styles.size());
  std::vector<GaitCell> cells;
  for (const GaitCell& cell : made.examples.cells) {
    if (cell.style < num_styles) {
      cells.push_back(cell);
    } else {
      made.truth.push_back(cell.loop);
    }
  }
  made.examples.cells = std::move(cells);
  made.examples.styles.resize(static_cast<std::size_t>(num_styles));
  return made;
}

}  // namespace

void judge_generated() {
  Table table;
  std::map<std::string, Table> by_style;
  for (int k = 0; k < kSeeds; ++k) {
    const Generated made = generated(1000 * static_cast<std::uint64_t>(k) + 1);
    const std::size_t count = made.examples.cells.size(), speeds = walker_speeds().size();
    if (count != made.truth.size() || count != speeds * made.examples.styles.size()) {
      std::printf("seed %d: %zu cells, %zu exact\n", k, count, made.truth.size());
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<const GaitCell*> peers;
      for (std::size_t other = i % speeds; other < count; other += speeds) {
        if (other != i) peers.push_back(&made.examples.cells[other]);
      }
      const auto errors = predict(made.examples, i, made.truth[i], peers);
      table.add(errors);
      by_style[made.examples.styles[i / speeds]].add(errors);
      std::fprintf(stderr, "%s %.2f m/s: %.2f deg, style only %.2f, nearest %.2f\n",
                   made.examples.styles[i / speeds].c_str(), made.examples.cells[i].speed, errors[0].angle,
                   errors[3].angle, errors[6].angle);
    }
  }
  table.print();
}

namespace {

blend::StyledClip clip_of(const std::filesystem::path& path, const std::string& style) {
  return {style, read_bvh(path.string()).motion, path.filename().string()};
}

/// Walks and runs of four styles: those of takes `first` to `last`.
std::vector<blend::StyledClip> recorded(const std::string& folder, int first, int last, bool runs) {
  std::vector<blend::StyledClip> clips;
  for (const char* style : {"normal", "elderly", "active", "feminine"}) {
    for (const char* content : {"walk", "run"}) {
      if (!runs && std::string(content) == "run") continue;
      for (int take = first; take <= last; ++take) {
        char name[80];
        std::snprintf(name, sizeof name, "dataset-2_%s_%s_%03d.bvh", content, style, take);
        const std::filesystem::path path = std::filesystem::path(folder) / name;
        if (std::filesystem::exists(path)) clips.push_back(clip_of(path, style));
      }
    }
  }
  return clips;
}

void judge_cells(const char* heading, const GaitExamples& examples) {
  std::printf("\n### %s\n\n", heading);
  for (std::size_t s = 0; s < examples.styles.size(); ++s) {
    std::printf("%s:", examples.styles[s].c_str());
    for (const GaitCell& cell : examples.cells) {
      if (cell.style == static_cast<int>(s)) std::printf(" %.2f (%d)", cell.speed, cell.num_cycles);
    }
    std::printf(" m/s (cycles)\n");
  }
  std::printf("\n");
  Table table;
  for (std::size_t i = 0; i < examples.cells.size(); ++i) {
    const GaitCell& at = examples.cells[i];
    const auto same = std::count_if(examples.cells.begin(), examples.cells.end(),
                                    [&](const GaitCell& cell) { return cell.style == at.style; });
    if (same < 2) continue;
    table.add(predict(examples, i, at.loop, nearest_of_others(examples, at)));
  }
  if (table.cells > 0) table.print();
}

/// Cells of held-out takes, predicted by a model of the other takes.
void judge_takes(const char* heading, std::vector<blend::StyledClip> examples_of,
                 const std::vector<blend::StyledClip>& held_out) {
  std::printf("\n### %s\n\n", heading);
  for (blend::StyledClip clip : held_out) {
    clip.style = "held out " + clip.style;
    examples_of.push_back(std::move(clip));
  }
  GaitExamples all = blend::gait_examples(examples_of);
  std::vector<GaitCell> judged;
  std::vector<GaitCell> cells;
  const std::size_t styles = all.styles.size() / 2;
  for (const GaitCell& cell : all.cells) {
    (cell.style < static_cast<int>(styles) ? cells : judged).push_back(cell);
  }
  all.cells = cells;
  all.styles.resize(styles);
  Table table;
  for (GaitCell cell : judged) {
    cell.style -= static_cast<int>(styles);
    GaitExamples with = all;
    with.cells.push_back(cell);  // predict leaves it out again
    table.add(predict(with, with.cells.size() - 1, cell.loop, nearest_of_others(all, cell)));
  }
  table.print();
}

}  // namespace

void judge_recorded(const std::string& folder) {
  const auto walks = recorded(folder, 1, 12, false);
  if (walks.empty()) {
    std::printf("no clips in %s\n", folder.c_str());
    return;
  }
  const auto both = recorded(folder, 1, 12, true);
  judge_cells("Recorded walks, takes 1 to 12: every cell left out", blend::gait_examples(walks));
  judge_cells("Recorded walks and runs, takes 1 to 12: every cell left out", blend::gait_examples(both));
  judge_cells("The same, all walks of a style one cell and all its runs another",
              blend::gait_examples(both, {.speed_bin = 1.0}));
  judge_takes("Takes 13 to 17 predicted from takes 1 to 12, walks", walks, recorded(folder, 13, 17, false));
  judge_takes("Takes 13 to 17 predicted from takes 1 to 12, walks and runs", both, recorded(folder, 13, 17, true));
}

}  // namespace strut::study
