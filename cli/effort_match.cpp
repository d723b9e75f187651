// SPDX-License-Identifier: MIT
// strut effort match: which fragments of a database show the same movement and which pairs can be blended; and where
// in all clips a fragment's movement occurs.
#include "effort_commands.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <strut/core/error.h>
#include <strut/effort/content_groups.h>
#include <strut/effort/fragment_database.h>
#include <strut/effort/fragment_features.h>
#include <strut/effort/fragment_search.h>
#include <strut/motion/legs.h>
#include <strut/motion/resample.h>

namespace strut::cli {
namespace {

using effort::FragmentDatabase;
using effort::FragmentRecord;
using effort::PairRecord;
using effort::PairStatus;

struct MatchArguments {
  std::string database, list;
  std::vector<std::int64_t> accept, reject;
  std::int64_t find = 0;
  int most = 20;
  bool force = false;
  effort::GroupOptions options;
};

std::vector<FrameMatrix> features_of(const std::vector<Motion>& motions) {
  const Eigen::Quaterniond upright = motion::upright_reference(motions);
  std::vector<FrameMatrix> features;
  for (const Motion& motion : motions) {
    const bool same_rate = std::abs(motion.frame_rate() / effort::kFeatureRate - 1.0) < 1e-6;
    features.push_back(
        effort::joint_features(same_rate ? motion : motion::resample(motion, effort::kFeatureRate), upright));
  }
  const effort::FeatureSpace space = effort::fit_feature_space(features);
  for (FrameMatrix& one : features) one = effort::project(space, one);
  return features;
}

std::vector<PairRecord> records_of(const effort::ContentGroups& groups, const std::vector<FragmentRecord>& fragments) {
  std::vector<PairRecord> records;
  for (const effort::MatchedPair& pair : groups.pairs) {
    const auto [first, second] = std::minmax(fragments[static_cast<std::size_t>(pair.first)].id,
                                             fragments[static_cast<std::size_t>(pair.second)].id);
    records.push_back({first, second, pair.cost, pair.share_at_limit,
                       pair.verdict == effort::PairVerdict::kAccepted ? PairStatus::kAccepted : PairStatus::kRejected});
  }
  return records;
}

void print_groups(const std::vector<FragmentRecord>& fragments, const effort::ContentGroups& groups) {
  std::vector<std::vector<const FragmentRecord*>> members(static_cast<std::size_t>(groups.num_groups));
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    members[static_cast<std::size_t>(groups.group[i])].push_back(&fragments[i]);
  }
  constexpr std::size_t kMostShown = 20;
  const auto alone = std::count_if(members.begin(), members.end(), [](const auto& group) { return group.size() == 1; });
  fmt::print("{} groups of like content; {} more fragments are like no other\n", groups.num_groups - alone, alone);
  std::size_t shown = 0;
  for (std::size_t g = 0; g < members.size(); ++g) {
    if (members[g].size() < 2 || ++shown > kMostShown) continue;
    const FragmentRecord& first = *members[g].front();
    fmt::print("  group {:>3}: {:>4} fragments, as {} ({} frames {} to {})\n", g, members[g].size(), first.id,
               first.clip_name, first.frames.begin, first.frames.end);
  }
  if (shown > kMostShown) fmt::print("  and {} more\n", shown - kMostShown);
}

/// Fragments too short to be compared are left out, with a warning.
std::vector<FragmentRecord> comparable(const FragmentDatabase& database, Diagnostics& diagnostics) {
  std::vector<FragmentRecord> fragments = database.fragments();
  std::erase_if(fragments, [&](const FragmentRecord& fragment) {
    const double frames = fragment.frames.num_frames() * effort::kFeatureRate / database.frame_rate();
    const bool unfit = frames > effort::kMostQueryFrames;
    if (unfit) diagnostics.warn(database.path(), fmt::format("fragment {} is too long to be compared", fragment.id));
    return unfit;
  });
  if (fragments.empty()) {
    throw BadInput(database.path(), "there are no fragments in it",
                   "strut effort segment cuts clips into fragments; --import takes cuts of your own");
  }
  return fragments;
}

void match(const MatchArguments& arguments, FragmentDatabase& database) {
  PrintedDiagnostics diagnostics;
  const std::vector<FragmentRecord> fragments = comparable(database, diagnostics);
  std::vector<Motion> motions;
  effort::ContentGroups groups;
  {
    ProgressLine line("matching");
    for (const FragmentRecord& fragment : fragments) {
      line.update("reading", static_cast<int>(motions.size()), static_cast<int>(fragments.size()));
      motions.push_back(database.motion(fragment));
    }
    line.update("comparing", 1, 2);
    groups = effort::group_fragments(features_of(motions), arguments.options);
  }
  std::vector<FragmentDatabase::GroupOf> of;
  for (std::size_t i = 0; i < fragments.size(); ++i) of.push_back({fragments[i].id, groups.group[i]});
  database.set_matching(of, records_of(groups, fragments));
  print_groups(fragments, groups);
  const auto counts = database.counts();
  fmt::print("{} pairs can be blended, {} of those compared cannot; like is what costs at most {:.4f} m\n",
             counts.accepted_pairs, counts.pairs - counts.accepted_pairs, groups.threshold);
  fmt::print("next: strut effort estimate {0}, or strut effort labels {0} --import labels.csv\n", database.path());
}

const char* name_of(PairStatus status) {
  switch (status) {
    case PairStatus::kAccepted:
      return "accepted";
    case PairStatus::kAcceptedByPerson:
      return "accepted by a person";
    case PairStatus::kRejectedByPerson:
      return "rejected by a person";
    case PairStatus::kRejected:
      break;
  }
  return "rejected";
}

std::string format_pairs(const FragmentDatabase& database) {
  std::string text = "first,second,cost_m,share_at_limit,status\n";
  for (const PairRecord& pair : database.pairs()) {
    const bool compared = effort::is_rated(pair.cost);
    text += fmt::format("{},{},{},{},{}\n", pair.first, pair.second, compared ? fmt::format("{:.6f}", pair.cost) : "",
                        compared ? fmt::format("{:.3f}", pair.share_at_limit) : "", name_of(pair.status));
  }
  return text;
}

void decide(const MatchArguments& arguments, FragmentDatabase& database) {
  naming_the_file(arguments.database, [&] {
    FragmentDatabase::Transaction transaction(database);
    for (const auto& [ids, accepted] : {std::pair(&arguments.accept, true), {&arguments.reject, false}}) {
      for (std::size_t k = 0; k + 1 < ids->size(); k += 2) database.decide_pair((*ids)[k], (*ids)[k + 1], accepted);
    }
    transaction.commit();
  });
  fmt::print("{} pairs decided; matching again keeps that\n", (arguments.accept.size() + arguments.reject.size()) / 2);
}

void find(const MatchArguments& arguments, const FragmentDatabase& database) {
  const auto fragment = database.find_fragment(arguments.find);
  if (!fragment) throw BadInput(arguments.database, fmt::format("there is no fragment {}", arguments.find));
  const std::vector<effort::ClipRecord> clips = database.clips();
  std::vector<Motion> motions{database.motion(*fragment)};
  for (const effort::ClipRecord& clip : clips) motions.push_back(database.motion(clip.id));
  std::vector<FrameMatrix> features = features_of(motions);
  const FrameMatrix query = features.front();
  features.erase(features.begin());
  const effort::SearchIndex index(features);
  std::vector<effort::FragmentMatch> matches = naming_the_file(arguments.database, [&] {
    return effort::find_matches(query, index, {1e9, arguments.options.max_share_at_limit});
  });
  std::sort(matches.begin(), matches.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
  fmt::print("{:>8}  {:>7} {:>7}  {}\n", "cost m", "begin", "end", "clip");
  for (std::size_t k = 0; k < std::min(matches.size(), static_cast<std::size_t>(arguments.most)); ++k) {
    const int clip = index.clip_of(matches[k].frames.begin), start = index.clip(clip).begin;
    const double scale = database.frame_rate() / effort::kFeatureRate;
    fmt::print("{:>8.4f}  {:>7.0f} {:>7.0f}  {}\n", matches[k].cost, (matches[k].frames.begin - start) * scale,
               (matches[k].frames.end - start) * scale, clips[static_cast<std::size_t>(clip)].name);
  }
}

void run(const MatchArguments& arguments) {
  if (!arguments.list.empty()) check_output(arguments.list, {arguments.database}, overwrite_if(arguments.force));
  if (arguments.find != 0) return find(arguments, FragmentDatabase::open(arguments.database));
  const bool decides = !arguments.accept.empty() || !arguments.reject.empty();
  FragmentDatabase database = FragmentDatabase::open(
      arguments.database, decides || arguments.list.empty() ? effort::Access::kReadWrite : effort::Access::kRead);
  if (decides) decide(arguments, database);
  if (!arguments.list.empty()) {
    write_file(arguments.list, format_pairs(database), overwrite_if(arguments.force));
    fmt::print("written {}\n", arguments.list);
  }
  if (!decides && arguments.list.empty()) match(arguments, database);
}

}  // namespace

void add_effort_match(CLI::App& app) {
  auto arguments = std::make_shared<MatchArguments>();
  CLI::App* command = app.add_subcommand("match", "Group fragments of like content and find pairs that can be blended");
  command->add_option("database", arguments->database, "Database made by strut effort segment")->required();
  command->add_option("--list", arguments->list, "Write the pairs found before as a table (CSV)");
  command->add_option("--accept", arguments->accept, "Two fragments that can be blended, whatever matching says: I,J")
      ->delimiter(',')
      ->expected(2)
      ->type_name("I,J");
  command->add_option("--reject", arguments->reject, "Two fragments that cannot: I,J")
      ->delimiter(',')
      ->expected(2)
      ->type_name("I,J");
  command->add_option("--find", arguments->find, "Show where in all clips this fragment's movement occurs")
      ->check(number_in(1, 1e15));
  command->add_option("--most", arguments->most, "Places that --find shows")
      ->check(number_in(1, 1e6))
      ->capture_default_str();
  command->add_option("--max-cost", arguments->options.max_cost, "The threshold itself instead, in metres")
      ->check(not_negative());
  command->add_flag("--force", arguments->force, "Overwrite an existing table");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
