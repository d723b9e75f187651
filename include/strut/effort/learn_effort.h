// SPDX-License-Identifier: MIT
// From a database of fragments, blends and what people said of them to an effort model, and what can be expected of it
// (Torresani, Hackney, Bregler 2006: the training stage).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/effort/effort_model.h>
#include <strut/effort/fragment_database.h>

namespace strut::effort {

/// What is learnt from.
struct LearnOptions {
  bool from_estimates = false;  ///< from the program's estimates instead of labels; the two are never mixed
  std::string rater;            ///< of one rater alone, person or synthetic; empty: the mean over all people
  RegressionOptions regression;
};

/// What a database holds for learning, brought together and read.
struct EffortExamples {
  std::vector<ModelFragment> fragments;          ///< labelled, in groups from 0 without gaps
  std::vector<RecordId> ids;                     ///< of each in the database
  std::vector<std::string> performers, actions;  ///< of each; may be empty
  std::vector<FragmentPair> pairs;               ///< accepted, of these
  std::vector<LabelledBlend> blends;             ///< labelled, of these
  std::vector<DescriptorScale> scales;           ///< per group, of all its fragments, labelled or not
  FeatureSpace space;                            ///< of all fragments
  Eigen::Quaterniond upright;                    ///< of all fragments
  double threshold =
      0.0;             ///< of the least alike pair that was accepted, at least like_threshold (content_groups.h) [m]
  int num_labels = 0;  ///< single labels that all this is the mean of
  std::vector<std::string> raters;  ///< who gave them
  bool are_synthetic = false;       ///< whether a synthetic rater did
};

/// Reads a database. Fragments of no group, without a label or too short to be described (less than four frames at
/// kFeatureRate) are left out. Warns where there are few labels. Throws InvalidArgument, saying which command helps, if
/// nothing is labelled by people (or estimated, or labelled by the one rater), no labelled fragment is in a group, or
/// no two of them are an accepted pair.
EffortExamples effort_examples(const FragmentDatabase& database, const LearnOptions& options,
                               Diagnostics* diagnostics = nullptr);

/// Learns from examples. `provenance`: JSON, for the model.
std::shared_ptr<const EffortModel> learn_effort(const EffortExamples& examples, const LearnOptions& options,
                                                const std::string& provenance = "{}",
                                                Diagnostics* diagnostics = nullptr);

/// The fragments as the regression sees them.
std::vector<LabelledFragment> labelled_fragments(const EffortExamples& examples);

}  // namespace strut::effort
