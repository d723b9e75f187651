// SPDX-License-Identifier: MIT
#include "learn/learn_linear.h"

#include <cmath>
#include <mutex>

#include <tbb/parallel_for.h>

#include <strut/core/error.h>
#include <strut/sysid/regularized.h>

namespace strut::learn {
namespace {

using representation::kHeight;
using representation::kNumRootDofs;
using representation::Normalization;
using sysid::Role;

std::vector<int> kept(const Normalization& scaling, int first, int end) {
  std::vector<int> dofs;
  for (int d = first; d < end; ++d) {
    if (scaling.is_kept(d)) dofs.push_back(d);
  }
  return dofs;
}

/// What stands in a block until its system, and with it the number of its inputs, is identified.
sysid::LtiSystem no_system() {
  return {{}, Eigen::MatrixXd(0, 1), Eigen::MatrixXd(1, 0), Eigen::MatrixXd::Zero(1, 1)};
}

/// A block per part of the body, with its own inputs only, its system still to be identified. Parts of which only the
/// output moves are planned if there is a context to tell them from, and reported otherwise.
std::vector<StyleBlock> plan_blocks(const representation::Representation& body, const Scalings& scalings,
                                    bool has_context, LearnReport& report) {
  std::vector<StyleBlock> blocks;
  const auto plan = [&](const std::string& name, int first_in, int end_in, int first_out, int end_out) {
    const std::vector<int> from = kept(scalings.input, first_in, end_in);
    const std::vector<int> to = kept(scalings.output, first_out, end_out);
    if (to.empty()) return;
    if (from.empty() && !has_context) {
      report.untranslated.push_back(name);
    } else {
      blocks.push_back({name, from, to, no_system()});
    }
  };
  plan("root", 0, kNumRootDofs, 0, kNumRootDofs);
  int column = kNumRootDofs;
  for (const int joint : body.joints()) {
    plan(body.skeleton().joint(joint).name, column, column + 3, column, column + 3);
    column += 3;
  }
  // "The best results were achieved by using the differential position and orientation of the root" (4.2).
  plan("timing", 0, kHeight, column, column + 1);
  return blocks;
}

/// The columns `dofs` of normalized `rows`.
FrameMatrix columns_of(const FrameMatrix& rows, const std::vector<int>& dofs) {
  FrameMatrix result(rows.rows(), static_cast<Eigen::Index>(dofs.size()));
  for (std::size_t i = 0; i < dofs.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = rows.col(dofs[i]);
  return result;
}

std::vector<sysid::Experiment> experiments_of(const std::vector<NormalizedPair>& pairs, const StyleBlock& block) {
  std::vector<sysid::Experiment> experiments;
  experiments.reserve(pairs.size());
  for (const NormalizedPair& pair : pairs) {
    const Eigen::Index lead_in = pair.input.rows() - pair.output.rows();
    FrameMatrix output = FrameMatrix::Zero(pair.input.rows(), static_cast<Eigen::Index>(block.output_dofs.size()));
    output.bottomRows(pair.output.rows()) = columns_of(pair.output, block.output_dofs);
    experiments.push_back({columns_of(pair.input, block.input_dofs), std::move(output), static_cast<int>(lead_in)});
  }
  return experiments;
}

/// What identification did without, by the block's name. Its notes (fewer block rows on short clips) help nobody here.
void report_warnings(const std::vector<StyleBlock>& blocks, const std::vector<Diagnostics>& reports,
                     Diagnostics& diagnostics) {
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    for (const Diagnostic& entry : reports[b].entries()) {
      if (entry.severity == Severity::kWarning) diagnostics.warn("'" + blocks[b].name + "'", entry.message, entry.hint);
    }
  }
}

/// Fit of a system of `order` on pairs left out, as the regularized one is judged.
double left_out_fit(const std::vector<sysid::Experiment>& experiments, const sysid::LeaveOut& rounds, int order,
                    const sysid::IdentifyOptions& options) {
  sysid::FitSum sum(static_cast<int>(experiments.front().output.cols()));
  bool judged = false;
  for (const std::vector<Role>& roles : rounds.rounds) {
    std::vector<sysid::Experiment> learn, test;
    for (std::size_t i = 0; i < experiments.size(); ++i) {
      if (roles[i] == Role::kLearn) learn.push_back(experiments[i]);
      if (roles[i] == Role::kTest) test.push_back(experiments[i]);
    }
    if (learn.empty() || test.empty()) continue;
    const sysid::LtiSystem system = sysid::identify_order(learn, order, options);
    for (const sysid::Experiment& clip : test) sum.add(clip, sysid::simulate(system, clip.input));
    judged = true;
  }
  return judged ? sum.fit() : -1e300;
}

class BlockIdentifier {
 public:
  BlockIdentifier(const std::vector<AlignedPair>& aligned, const std::vector<NormalizedPair>& pairs,
                  const Scalings& scalings, int num_contexts, double frame_rate, const LearnOptions& options)
      : pairs_(pairs),
        num_dofs_(scalings.input.num_dofs()),
        num_contexts_(num_contexts),
        options_(options),
        subspace_(options.identification),
        rounds_(leave_out(aligned)) {
    for (const AlignedPair& pair : aligned) groups_.push_back(pair.input_clip);
    if (options.method == LearnMethod::kPaper) {
      subspace_.weighting = sysid::Weighting::kN4sid;
      subspace_.order_rule = sysid::OrderRule::kGap;
      // B and D from the simulated output: from the estimated states, on single gait cycles, no cell comes nearer.
      subspace_.input_matrices = sysid::InputMatrices::kSimulation;
      subspace_.max_radius = kBarelyStable;
    } else {
      subspace_.max_radius = std::exp(-1.0 / (options.longest_memory * frame_rate));
    }
    regularized_.taps = std::max(1, static_cast<int>(std::lround(options.lead_in * frame_rate)));
  }

  /// Sets the block's inputs and system.
  [[nodiscard]] BlockReport identify(StyleBlock& block, Diagnostics& diagnostics) const {
    const bool is_paper = options_.method == LearnMethod::kPaper;
    BlockReport report{block.name, 0, -1e300, 0.0};
    if (!block.input_dofs.empty()) by_subspace(block, report, diagnostics);
    if (!is_paper) by_regularization(block, report);
    report.states = block.system.num_states();
    report.fit = sysid::simulated_fit(block.system, experiments_of(pairs_, block));
    return report;
  }

 private:
  static constexpr double kBarelyStable = 0.9999;

  void by_subspace(StyleBlock& block, BlockReport& report, Diagnostics& diagnostics) const {
    const auto experiments = experiments_of(pairs_, block);
    const auto found = sysid::identify(experiments, groups_, subspace_, &diagnostics);
    block.system = found.system;
    report.left_out_fit = options_.method == LearnMethod::kPaper
                              ? found.fit
                              : left_out_fit(experiments, rounds_, found.system.num_states(), subspace_);
  }

  /// Takes the regularized system with the context if it predicts left-out pairs better.
  void by_regularization(StyleBlock& block, BlockReport& report) const {
    StyleBlock seeing = block;
    std::vector<int> sets(block.input_dofs.size(), 0);
    for (int k = 0; k < num_contexts_; ++k) {
      seeing.input_dofs.push_back(num_dofs_ + k);
      sets.push_back(block.input_dofs.empty() ? 0 : 1);
    }
    const auto found = sysid::identify_regularized(experiments_of(pairs_, seeing), rounds_, sets, regularized_);
    if (!block.input_dofs.empty() && !(found.fit > report.left_out_fit)) return;
    seeing.system = found.system;
    report.left_out_fit = found.fit;
    block = std::move(seeing);
  }

  const std::vector<NormalizedPair>& pairs_;
  int num_dofs_, num_contexts_;
  const LearnOptions& options_;
  sysid::IdentifyOptions subspace_;
  sysid::RegularizedOptions regularized_;
  sysid::LeaveOut rounds_;
  std::vector<int> groups_;
};

}  // namespace

std::vector<StyleBlock> identify_blocks(const Examples& examples, const std::vector<AlignedPair>& aligned,
                                        const std::vector<NormalizedPair>& pairs, const Scalings& scalings,
                                        int num_contexts, const LearnOptions& options, LearnReport& report,
                                        Diagnostics* diagnostics, const Progress& progress) {
  std::vector<StyleBlock> blocks = plan_blocks(examples.input.representation, scalings, num_contexts > 0, report);
  if (blocks.empty()) throw InvalidArgument("pairs", "clips in which something moves", "none");
  const BlockIdentifier identifier(aligned, pairs, scalings, num_contexts, examples.frame_rate, options);
  report.blocks.resize(blocks.size());
  std::vector<Diagnostics> reports(blocks.size());
  std::mutex mutex;
  int done = 0;
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
    report.blocks[b] = identifier.identify(blocks[b], reports[b]);
    const std::lock_guard<std::mutex> lock(mutex);
    if (progress) progress("identifying joints", ++done, static_cast<int>(blocks.size()));
  });
  if (diagnostics != nullptr) report_warnings(blocks, reports, *diagnostics);
  return blocks;
}

}  // namespace strut::learn
