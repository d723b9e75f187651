// SPDX-License-Identifier: MIT
#include "learn/learn_radial.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include <tbb/parallel_for.h>

#include <strut/sysid/experiment.h>
#include <strut/sysid/fit_radial_basis.h>

namespace strut::learn {
namespace {

using sysid::RadialSums;
using sysid::Role;

std::vector<int> lags_in_frames(const RadialOptions& options, double frame_rate) {
  const int lag = std::max(1, static_cast<int>(std::lround(options.lag * frame_rate)));
  std::vector<int> lags;
  for (int l = 0; l < options.lags; ++l) lags.push_back(l * lag);
  return lags;
}

/// What the basis sees at the last `count` frames of `input` (frames x dofs + contexts): (features x count).
Eigen::MatrixXd features_of(const FrameMatrix& input, Eigen::Index num_dofs, const std::vector<int>& lags,
                            Eigen::Index count) {
  const Eigen::Index contexts = input.cols() - num_dofs;
  Eigen::MatrixXd features(contexts * static_cast<Eigen::Index>(lags.size()), count);
  for (std::size_t l = 0; l < lags.size(); ++l) {
    for (Eigen::Index t = 0; t < count; ++t) {
      // A lead-in shorter than the lag is taken to have stood at its first frame.
      const Eigen::Index row = std::max<Eigen::Index>(0, input.rows() - count + t - lags[l]);
      features.col(t).segment(static_cast<Eigen::Index>(l) * contexts, contexts) =
          input.row(row).tail(contexts).transpose();
    }
  }
  return features;
}

/// A stretch of input that one or more pairs share.
struct InputStretch {
  Eigen::MatrixXd features;  // (features x frames)
  Eigen::MatrixXd input;     // normalized (dofs x frames)
};

/// A map fitted to some of the pairs, and its functions on all.
struct Fitted {
  sysid::RadialBasis basis;
  std::vector<Eigen::MatrixXd> activations;  // per stretch (centres x frames)
  Eigen::MatrixXd weights;                   // of output (dofs + 1) above input (dofs)
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

/// Fits of every degree of freedom by itself, pooled over pairs.
class DofFits {
 public:
  explicit DofFits(Eigen::Index dofs) : sums_(static_cast<std::size_t>(dofs), sysid::FitSum(1)) {}

  /// (frames x dofs) each.
  void add(const FrameMatrix& wanted, const FrameMatrix& predicted) {
    for (std::size_t d = 0; d < sums_.size(); ++d) {
      const auto column = static_cast<Eigen::Index>(d);
      sums_[d].add(FrameMatrix(wanted.col(column)), FrameMatrix(predicted.col(column)));
    }
  }

  [[nodiscard]] Eigen::VectorXd fits() const {
    Eigen::VectorXd fits(static_cast<Eigen::Index>(sums_.size()));
    for (std::size_t d = 0; d < sums_.size(); ++d) fits[static_cast<Eigen::Index>(d)] = sums_[d].fit();
    return fits;
  }

 private:
  std::vector<sysid::FitSum> sums_;
};

class RadialLearner {
 public:
  RadialLearner(const Examples& examples, const std::vector<AlignedPair>& aligned,
                const std::vector<NormalizedPair>& pairs, const Scalings& scalings, const RadialOptions& options)
      : examples_(examples),
        pairs_(pairs),
        scalings_(scalings),
        options_(options),
        dofs_(scalings.input.num_dofs()),
        lags_(lags_in_frames(options, examples.frame_rate)),
        parts_(detail_parts(examples.input.representation, examples.output.representation)) {
    find_stretches(aligned);
  }

  LearntRadialMap learn(const sysid::LeaveOut& rounds) {
    const Fitted fitted = fit(std::vector<Role>(pairs_.size(), Role::kLearn));
    const auto [details, left_out_fits] = judge(rounds, fitted);
    RadialMap map{lags_,
                  fitted.basis,
                  fitted.weights.bottomRows(dofs_),
                  fitted.weights.topRows(dofs_ + 1),
                  0.0,
                  spread_of(details),
                  0.0,
                  share_of(details)};
    std::vector<Eigen::VectorXd> timing;
    for (std::size_t i = 0; i < pairs_.size(); ++i) timing.emplace_back(predict(fitted, i).col(dofs_));
    return {std::move(map), block_reports(left_out_fits, fits_of(fitted)), std::move(timing)};
  }

 private:
  void find_stretches(const std::vector<AlignedPair>& aligned) {
    std::map<std::tuple<int, int, int>, std::size_t> known;
    for (std::size_t i = 0; i < aligned.size(); ++i) {
      const AlignedPair& pair = aligned[i];
      const auto [place, is_new] =
          known.try_emplace({pair.input_clip, pair.input_frames.begin, pair.input_frames.end}, stretches_.size());
      stretch_of_.push_back(place->second);
      if (!is_new) continue;
      const Eigen::Index frames = pair.output.rows();
      stretches_.push_back({features_of(pairs_[i].input, dofs_, lags_, frames),
                            pairs_[i].input.bottomRows(frames).leftCols(dofs_).transpose()});
    }
  }

  /// Over the stretches that `counts` has pairs of: a basis that stood on what is left out would know where it is, and
  /// nothing of it.
  [[nodiscard]] sysid::RadialBasis fit_basis(const std::vector<double>& counts) const {
    constexpr int kFramesPerCentre = 4;
    Eigen::Index frames = 0;
    for (std::size_t s = 0; s < counts.size(); ++s) frames += counts[s] > 0.0 ? stretches_[s].features.cols() : 0;
    Eigen::MatrixXd all(stretches_.front().features.rows(), frames);
    Eigen::Index column = 0;
    for (std::size_t s = 0; s < counts.size(); ++s) {
      if (counts[s] == 0.0) continue;
      all.middleCols(column, stretches_[s].features.cols()) = stretches_[s].features;
      column += stretches_[s].features.cols();
    }
    const int centres = std::min(options_.centres, std::max(1, static_cast<int>(frames) / kFramesPerCentre));
    return sysid::fit_radial_basis(all, centres, options_.width);
  }

  /// From the pairs that are to be learnt from, of which there is one.
  [[nodiscard]] Fitted fit(const std::vector<Role>& roles) const {
    std::vector<double> counts(stretches_.size(), 0.0);
    std::vector<Eigen::MatrixXd> outputs(stretches_.size());
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      if (roles[i] != Role::kLearn) continue;
      Eigen::MatrixXd& output = outputs[stretch_of_[i]];
      if (output.size() == 0) output = Eigen::MatrixXd::Zero(dofs_ + 1, pairs_[i].output.rows());
      output += pairs_[i].output.transpose();
      counts[stretch_of_[i]] += 1.0;
    }
    Fitted fitted{fit_basis(counts), std::vector<Eigen::MatrixXd>(stretches_.size()), {}};
    tbb::parallel_for(std::size_t{0}, stretches_.size(), [&](std::size_t s) {
      fitted.activations[s] = sysid::activations(fitted.basis, stretches_[s].features);
    });
    RadialSums sums(fitted.basis.num_centres(), 2 * dofs_ + 1);
    for (std::size_t s = 0; s < stretches_.size(); ++s) {
      if (counts[s] == 0.0) continue;
      Eigen::MatrixXd targets(2 * dofs_ + 1, outputs[s].cols());
      targets << outputs[s] / counts[s], stretches_[s].input;
      sums.add(fitted.activations[s], targets, counts[s]);
    }
    fitted.weights = sysid::fit_weights(sums, options_.ridge);
    return fitted;
  }

  [[nodiscard]] FrameMatrix predict(const Fitted& fitted, std::size_t pair) const {
    return (fitted.weights.topRows(dofs_ + 1) * fitted.activations[stretch_of_[pair]]).transpose();
  }

  /// Detail and fit on pairs left out; where no pair can be left out, on those learnt from.
  [[nodiscard]] std::pair<DetailSums, Eigen::VectorXd> judge(const sysid::LeaveOut& rounds, const Fitted& whole) const {
    std::vector<std::optional<Fitted>> of_round(rounds.rounds.size());
    tbb::parallel_for(std::size_t{0}, of_round.size(), [&](std::size_t r) {
      if (learns(rounds.rounds[r])) of_round[r].emplace(fit(rounds.rounds[r]));
    });
    DetailSums details(dofs_, parts_.size());
    DofFits fits(dofs_ + 1);
    const auto add = [&](std::size_t pair, const Fitted& from) {
      const FrameMatrix predicted = predict(from, pair);
      fits.add(pairs_[pair].output, predicted);
      add_details(pair, from, predicted, details);
    };
    for (std::size_t r = 0; r < of_round.size(); ++r) {
      for (std::size_t i = 0; i < pairs_.size(); ++i) {
        if (rounds.rounds[r][i] == Role::kTest && of_round[r]) add(i, *of_round[r]);
      }
    }
    if (details.frames == 0.0) {
      for (std::size_t i = 0; i < pairs_.size(); ++i) add(i, whole);
    }
    return {std::move(details), fits.fits()};
  }

  static bool learns(const std::vector<Role>& roles) {
    return std::find(roles.begin(), roles.end(), Role::kLearn) != roles.end();
  }

  void add_details(std::size_t pair, const Fitted& fitted, const FrameMatrix& predicted, DetailSums& sums) const {
    const InputStretch& stretch = stretches_[stretch_of_[pair]];
    const Eigen::MatrixXd input =
        scalings_.input.scale().asDiagonal() *
        (stretch.input - fitted.weights.bottomRows(dofs_) * fitted.activations[stretch_of_[pair]]);
    const Eigen::MatrixXd output = (pairs_[pair].output - predicted).leftCols(dofs_).transpose();
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

  [[nodiscard]] Eigen::VectorXd fits_of(const Fitted& fitted) const {
    DofFits fits(dofs_ + 1);
    for (std::size_t i = 0; i < pairs_.size(); ++i) fits.add(pairs_[i].output, predict(fitted, i));
    return fits.fits();
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
  const std::vector<NormalizedPair>& pairs_;
  const Scalings& scalings_;
  const RadialOptions& options_;
  Eigen::Index dofs_;
  std::vector<int> lags_;
  std::vector<DetailPart> parts_;
  std::vector<InputStretch> stretches_;
  std::vector<std::size_t> stretch_of_;  // pairs
};

}  // namespace

LearntRadialMap learn_radial_map(const Examples& examples, const std::vector<AlignedPair>& aligned,
                                 const std::vector<NormalizedPair>& pairs, const Scalings& scalings,
                                 const RadialOptions& options) {
  return RadialLearner(examples, aligned, pairs, scalings, options).learn(leave_out(aligned));
}

}  // namespace strut::learn
