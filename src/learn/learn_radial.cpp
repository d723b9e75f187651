// SPDX-License-Identifier: MIT
#include "learn/learn_radial.h"

#include "learn/covered_frames.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <tbb/parallel_for.h>

#include <strut/sysid/experiment.h>
#include <strut/sysid/fit_radial_basis.h>

namespace strut::learn {
namespace {

using sysid::Role;

std::vector<int> lags_in_frames(const RadialOptions& options, double frame_rate) {
  const int lag = std::max(1, static_cast<int>(std::lround(options.lag * frame_rate)));
  std::vector<int> lags;
  for (int l = 0; l < options.lags; ++l) lags.push_back(l * lag);
  return lags;
}

/// Where `counts` are not zero, in order.
std::vector<Eigen::Index> places_of(const Eigen::VectorXd& counts) {
  std::vector<Eigen::Index> places;
  for (Eigen::Index t = 0; t < counts.size(); ++t) {
    if (counts[t] > 0.0) places.push_back(t);
  }
  return places;
}

/// A map fitted to some of the pairs.
struct Fitted {
  sysid::RadialBasis basis;
  Eigen::MatrixXd weights;  // of output (dofs + 1) above input (dofs)
};

/// The examples that a map is fitted to: every covered frame that pairs learnt from have, once.
struct RadialExamples {
  std::vector<Eigen::Index> frames;  // columns of the covered frames
  Eigen::VectorXd pairs, stretches;  // how many have the frame
  std::vector<Eigen::Index> starts;  // of the basis's centres: places in `frames`
  Eigen::MatrixXd targets;           // mean output over the pairs (dofs + 1) above input (dofs)
};

/// Sums of squares and products of details on left-out pairs, in the units of the degrees of freedom.
struct DetailSums {
  Eigen::VectorXd input_squares;           // (dofs)
  Eigen::VectorXd products, part_squares;  // (parts)
  double frames = 0.0;

  DetailSums(Eigen::Index dofs, std::size_t parts)
      : input_squares(Eigen::VectorXd::Zero(dofs)),
        products(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(parts))),
        part_squares(products) {}
};

class RadialLearner {
 public:
  RadialLearner(const Examples& examples, const std::vector<AlignedPair>& aligned, const Scalings& scalings,
                const Eigen::MatrixXd& context, const RadialOptions& options)
      : examples_(examples),
        scalings_(scalings),
        options_(options),
        dofs_(scalings.input.num_dofs()),
        lags_(lags_in_frames(options, examples.frame_rate)),
        parts_(detail_parts(examples.input.representation, examples.output.representation)),
        frames_(cover_frames(examples, aligned, scalings, context, lags_)),
        outputs_(aligned.size()) {
    tbb::parallel_for(std::size_t{0}, aligned.size(),
                      [&](std::size_t i) { outputs_[i] = scalings.output.normalize(aligned[i].output); });
    find_stretches();
  }

  LearntRadialMap learn(const sysid::LeaveOut& rounds) {
    const std::vector<Role> everything(outputs_.size(), Role::kLearn);
    const Fitted fitted = fit(everything);
    const Eigen::MatrixXd predicted = predict(fitted, everything, Role::kLearn);
    const auto [details, left_out_fits] = judge(rounds, predicted);
    sysid::FitSum fits(static_cast<int>(dofs_) + 1);
    std::vector<Eigen::VectorXd> timing;
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      fits.add(outputs_[i], output_of(predicted, i));
      timing.emplace_back(predicted.row(dofs_).segment(frames_.of_pair[i].first, frames_.of_pair[i].count));
    }
    RadialMap map{lags_,
                  fitted.basis,
                  fitted.weights.bottomRows(dofs_),
                  fitted.weights.topRows(dofs_ + 1),
                  0.0,
                  spread_of(details),
                  0.0,
                  share_of(details)};
    return {std::move(map), block_reports(left_out_fits, fits.fit_per_output()), std::move(timing)};
  }

 private:
  void find_stretches() {
    std::map<std::pair<Eigen::Index, Eigen::Index>, std::size_t> known;
    for (const Columns& columns : frames_.of_pair) {
      const auto [place, is_new] = known.try_emplace({columns.first, columns.count}, stretches_.size());
      stretch_of_.push_back(place->second);
      if (is_new) stretches_.push_back(columns);
    }
  }

  /// How many pairs of `role` have each covered frame.
  [[nodiscard]] Eigen::VectorXd pairs_with(const std::vector<Role>& roles, Role role) const {
    Eigen::VectorXd pairs = Eigen::VectorXd::Zero(frames_.size());
    for (std::size_t i = 0; i < roles.size(); ++i) {
      if (roles[i] == role) pairs.segment(frames_.of_pair[i].first, frames_.of_pair[i].count).array() += 1.0;
    }
    return pairs;
  }

  /// The basis stands on the stretches that pairs learnt from have: on what is left out, it would know where that is,
  /// and nothing of it.
  [[nodiscard]] RadialExamples examples_of(const std::vector<Role>& roles) const {
    const Eigen::VectorXd pairs = pairs_with(roles, Role::kLearn);
    Eigen::VectorXd stretches = Eigen::VectorXd::Zero(frames_.size());
    Eigen::MatrixXd outputs = Eigen::MatrixXd::Zero(dofs_ + 1, frames_.size());
    std::vector<bool> is_learnt(stretches_.size(), false);
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      if (roles[i] != Role::kLearn) continue;
      const auto [first, count] = frames_.of_pair[i];
      outputs.middleCols(first, count) += outputs_[i].transpose();
      if (!is_learnt[stretch_of_[i]]) stretches.segment(first, count).array() += 1.0;
      is_learnt[stretch_of_[i]] = true;
    }
    RadialExamples found;
    found.frames = places_of(pairs);
    found.pairs = pairs(found.frames);
    found.stretches = stretches(found.frames);
    found.targets.resize(2 * dofs_ + 1, found.pairs.size());
    found.targets << outputs(Eigen::all, found.frames) * found.pairs.cwiseInverse().asDiagonal(),
        frames_.input(Eigen::all, found.frames);
    for (const Eigen::Index start : starts_of(is_learnt)) {
      found.starts.push_back(std::lower_bound(found.frames.begin(), found.frames.end(), start) - found.frames.begin());
    }
    return found;
  }

  /// Covered frames at even distances along the stretches learnt from, one after the other.
  [[nodiscard]] std::vector<Eigen::Index> starts_of(const std::vector<bool>& is_learnt) const {
    constexpr int kFramesPerCentre = 4;
    std::vector<Eigen::Index> frames;
    for (std::size_t s = 0; s < stretches_.size(); ++s) {
      for (Eigen::Index t = 0; is_learnt[s] && t < stretches_[s].count; ++t) frames.push_back(stretches_[s].first + t);
    }
    const int most = std::max(1, static_cast<int>(frames.size()) / kFramesPerCentre);
    std::vector<Eigen::Index> starts;
    for (const Eigen::Index place :
         sysid::evenly_spaced(static_cast<Eigen::Index>(frames.size()), std::min(options_.centres, most))) {
      starts.push_back(frames[static_cast<std::size_t>(place)]);
    }
    return starts;
  }

  /// From the pairs that are to be learnt from, of which there is one.
  [[nodiscard]] Fitted fit(const std::vector<Role>& roles) const {
    const RadialExamples learnt = examples_of(roles);
    const Eigen::MatrixXd features = frames_.features(Eigen::all, learnt.frames);
    sysid::RadialBasis basis = sysid::fit_radial_basis(features, learnt.stretches, learnt.starts, options_.width);
    const sysid::RadialSums sums = sysid::radial_sums(basis, features, learnt.targets, learnt.pairs);
    return {std::move(basis), sysid::fit_weights(sums, options_.ridge)};
  }

  /// At the frames that pairs of `role` have; the others are zero (2 dofs + 1 x covered frames).
  [[nodiscard]] Eigen::MatrixXd predict(const Fitted& fitted, const std::vector<Role>& roles, Role role) const {
    const std::vector<Eigen::Index> frames = places_of(pairs_with(roles, role));
    Eigen::MatrixXd predicted = Eigen::MatrixXd::Zero(2 * dofs_ + 1, frames_.size());
    predicted(Eigen::all, frames) = sysid::predict(fitted.basis, fitted.weights, frames_.features(Eigen::all, frames));
    return predicted;
  }

  /// A pair's predicted output (frames x dofs + 1).
  [[nodiscard]] FrameMatrix output_of(const Eigen::MatrixXd& predicted, std::size_t pair) const {
    const auto [first, count] = frames_.of_pair[pair];
    return predicted.block(0, first, dofs_ + 1, count).transpose();
  }

  /// Detail and fit on pairs left out; where no pair can be left out, on those learnt from, as `whole` predicts them.
  [[nodiscard]] std::pair<DetailSums, Eigen::VectorXd> judge(const sysid::LeaveOut& rounds,
                                                             const Eigen::MatrixXd& whole) const {
    std::vector<std::optional<Eigen::MatrixXd>> of_round(rounds.rounds.size());
    tbb::parallel_for(std::size_t{0}, of_round.size(), [&](std::size_t r) {
      const std::vector<Role>& roles = rounds.rounds[r];
      if (learns(roles)) of_round[r] = predict(fit(roles), roles, Role::kTest);
    });
    DetailSums details(dofs_, parts_.size());
    sysid::FitSum fits(static_cast<int>(dofs_) + 1);
    const auto add = [&](std::size_t pair, const Eigen::MatrixXd& predicted) {
      fits.add(outputs_[pair], output_of(predicted, pair));
      add_details(pair, predicted, details);
    };
    for (std::size_t r = 0; r < of_round.size(); ++r) {
      for (std::size_t i = 0; i < outputs_.size(); ++i) {
        if (rounds.rounds[r][i] == Role::kTest && of_round[r]) add(i, *of_round[r]);
      }
    }
    if (details.frames == 0.0) {
      for (std::size_t i = 0; i < outputs_.size(); ++i) add(i, whole);
    }
    return {std::move(details), fits.fit_per_output()};
  }

  static bool learns(const std::vector<Role>& roles) {
    return std::find(roles.begin(), roles.end(), Role::kLearn) != roles.end();
  }

  void add_details(std::size_t pair, const Eigen::MatrixXd& predicted, DetailSums& sums) const {
    const auto [first, count] = frames_.of_pair[pair];
    const Eigen::MatrixXd input =
        scalings_.input.scale().asDiagonal() *
        (frames_.input.middleCols(first, count) - predicted.block(dofs_ + 1, first, dofs_, count));
    const Eigen::MatrixXd output = outputs_[pair].leftCols(dofs_).transpose() - predicted.block(0, first, dofs_, count);
    sums.input_squares += input.rowwise().squaredNorm();
    sums.frames += static_cast<double>(input.cols());
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const DetailPart& part = parts_[p];
      const Eigen::MatrixXd wanted = scalings_.output.scale().segment(part.first, part.size).asDiagonal() *
                                     output.middleRows(part.first, part.size);
      const Eigen::MatrixXd given =
          part.turn.topLeftCorner(part.size, part.size) * input.middleRows(part.first, part.size);
      sums.products[static_cast<Eigen::Index>(p)] += given.cwiseProduct(wanted).sum();
      sums.part_squares[static_cast<Eigen::Index>(p)] += given.squaredNorm();
    }
  }

  [[nodiscard]] Eigen::VectorXd spread_of(const DetailSums& sums) const {
    Eigen::VectorXd spread = (sums.input_squares / sums.frames).cwiseSqrt();
    for (Eigen::Index d = 0; d < dofs_; ++d) spread[d] = std::max(spread[d], representation::least_deviation(d));
    return spread;
  }

  /// Of the root's velocities, the regression of the output's detail on the input's: what examples of both styles have
  /// in common beyond their style. None of posture: a share of its ordinary detail brought translations no nearer.
  [[nodiscard]] Eigen::VectorXd share_of(const DetailSums& sums) const {
    Eigen::VectorXd share = Eigen::VectorXd::Zero(dofs_);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const auto k = static_cast<Eigen::Index>(p);
      if (!parts_[p].is_velocity || !(sums.part_squares[k] > 0.0)) continue;
      share.segment(parts_[p].first, parts_[p].size)
          .setConstant(std::clamp(sums.products[k] / sums.part_squares[k], 0.0, 1.0));
    }
    return share;
  }

  /// Means over the degrees of freedom of a part of the body that move.
  [[nodiscard]] std::vector<BlockReport> block_reports(const Eigen::VectorXd& left_out,
                                                       const Eigen::VectorXd& learnt) const {
    std::vector<BlockReport> blocks;
    const auto report = [&](const std::string& name, Eigen::Index first, Eigen::Index end) {
      BlockReport block{name};
      double moving = 0.0;
      for (Eigen::Index d = first; d < end; ++d) {
        if (!scalings_.output.is_kept(static_cast<int>(d))) continue;
        block.left_out_fit += left_out[d];
        block.fit += learnt[d];
        moving += 1.0;
      }
      if (moving == 0.0) return;
      block.left_out_fit /= moving;
      block.fit /= moving;
      blocks.push_back(std::move(block));
    };
    const representation::Representation& body = examples_.input.representation;
    report("root", 0, representation::kNumRootDofs);
    Eigen::Index column = representation::kNumRootDofs;
    for (const int joint : body.joints()) {
      report(body.skeleton().joint(joint).name, column, column + 3);
      column += 3;
    }
    report("timing", dofs_, dofs_ + 1);
    return blocks;
  }

  const Examples& examples_;
  const Scalings& scalings_;
  const RadialOptions& options_;
  Eigen::Index dofs_;
  std::vector<int> lags_;
  std::vector<DetailPart> parts_;
  CoveredFrames frames_;
  std::vector<FrameMatrix> outputs_;     // normalized, of every pair (frames x dofs + 1)
  std::vector<Columns> stretches_;       // that one or more pairs share
  std::vector<std::size_t> stretch_of_;  // pairs
};

}  // namespace

LearntRadialMap learn_radial_map(const Examples& examples, const std::vector<AlignedPair>& aligned,
                                 const Scalings& scalings, const Eigen::MatrixXd& context,
                                 const RadialOptions& options) {
  return RadialLearner(examples, aligned, scalings, context, options).learn(leave_out(aligned));
}

}  // namespace strut::learn
