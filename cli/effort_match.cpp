// SPDX-License-Identifier: MIT
// strut effort match: which fragments of a database show the same movement and which pairs can be blended; and where
// in all clips a fragment's movement occurs.
#include "effort_commands.h"
#include "input_files.h"
#include "terminal.h"
#include "usage.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
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
  bool force = false, ignore_actions = false;
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

std::string base_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

/// The largest groups first, of equals in the order of their numbers.
void print_groups(const std::vector<FragmentRecord>& fragments, const effort::ContentGroups& groups) {
  std::vector<std::vector<const FragmentRecord*>> members(static_cast<std::size_t>(groups.num_groups));
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    members[static_cast<std::size_t>(groups.group[i])].push_back(&fragments[i]);
  }
  std::vector<std::size_t> shown;
  for (std::size_t g = 0; g < members.size(); ++g) {
    if (members[g].size() > 1) shown.push_back(g);
  }
  std::stable_sort(shown.begin(), shown.end(),
                   [&](std::size_t a, std::size_t b) { return members[a].size() > members[b].size(); });
  fmt::print("{} groups of like content; {} more fragments are like no other\n", shown.size(),
             members.size() - shown.size());
  constexpr std::size_t kMostShown = 20;
  std::size_t folded = 0;
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const auto& group = members[shown[k]];
    if (k >= kMostShown) {
      folded += group.size();
      continue;
    }
    const FragmentRecord& first = *group.front();
    fmt::print("  group {:>3}: {:>4} fragments, as {} ({} frames {} to {})\n", shown[k], group.size(), first.id,
               base_name(first.clip_name), first.frames.begin, first.frames.end);
  }
  if (folded > 0) fmt::print("  and {} smaller ones of {} fragments\n", shown.size() - kMostShown, folded);
}

/// How many fragments have an accepted partner from another clip.
std::size_t count_paired(const FragmentDatabase& database, const std::vector<FragmentRecord>& fragments) {
  std::map<effort::RecordId, effort::RecordId> clip_of;
  for (const FragmentRecord& fragment : fragments) clip_of[fragment.id] = fragment.clip;
  std::set<effort::RecordId> paired;
  for (const PairRecord& pair : database.accepted_pairs()) {
    const auto first = clip_of.find(pair.first), second = clip_of.find(pair.second);
    if (first == clip_of.end() || second == clip_of.end() || first->second == second->second) continue;
    paired.insert({pair.first, pair.second});
  }
  return paired.size();
}

void print_pairs(const FragmentDatabase& database, const std::vector<FragmentRecord>& fragments) {
  const auto counts = database.counts();
  fmt::print(
      "{} pairs can be blended, {} of those compared cannot; {} of {} fragments have a partner in another clip\n",
      counts.accepted_pairs, counts.pairs - counts.accepted_pairs, count_paired(database, fragments), fragments.size());
}

/// Says what told contents apart: names, the threshold, or both.
void print_measure(const std::vector<FragmentRecord>& fragments, const effort::GroupOptions& options,
                   double threshold) {
  std::set<std::string> named(options.contents.begin(), options.contents.end());
  const bool some_unnamed = named.erase("") > 0 || options.contents.empty();
  if (!named.empty()) {
    fmt::print("{} named actions tell contents apart, and movement within each; --ignore-actions compares all\n",
               named.size());
  }
  if (some_unnamed) fmt::print("without a name, like is what costs at most {:.4f} m\n", threshold);
  const bool is_told = std::any_of(fragments.begin(), fragments.end(), [](const auto& f) { return !f.action.empty(); });
  if (!is_told) {
    fmt::print("styles of far postures join better with names: strut effort segment --action PATTERN --replace\n");
  }
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

effort::ContentGroups group(const FragmentDatabase& database, const std::vector<FragmentRecord>& fragments,
                            effort::GroupOptions options) {
  ProgressLine line("matching");
  std::vector<Motion> motions;
  for (const FragmentRecord& fragment : fragments) {
    line.update("reading", static_cast<int>(motions.size()), static_cast<int>(fragments.size()));
    motions.push_back(database.motion(fragment));
  }
  options.progress = [&line](int done, int total) { line.update("comparing", done, total); };
  return effort::group_fragments(features_of(motions), options);
}

void match(const MatchArguments& arguments, FragmentDatabase& database) {
  PrintedDiagnostics diagnostics;
  const std::vector<FragmentRecord> fragments = comparable(database, diagnostics);
  effort::GroupOptions options = arguments.options;
  for (const FragmentRecord& fragment : fragments) {
    if (!arguments.ignore_actions) options.contents.push_back(fragment.action);
  }
  const effort::ContentGroups groups = group(database, fragments, options);
  std::vector<FragmentDatabase::GroupOf> of;
  for (std::size_t i = 0; i < fragments.size(); ++i) of.push_back({fragments[i].id, groups.group[i]});
  database.set_matching(of, records_of(groups, fragments));
  print_groups(fragments, groups);
  print_pairs(database, fragments);
  print_measure(fragments, options, groups.threshold);
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

/// Why matching did not accept a pair, as far as what is stored of it tells.
const char* reason_of(const PairRecord& pair, bool is_one_group, double max_share_at_limit) {
  if (pair.status != PairStatus::kRejected) return "";
  if (!is_one_group) return name_of(effort::PairVerdict::kOtherGroup);
  return pair.share_at_limit > max_share_at_limit ? name_of(effort::PairVerdict::kSlopeLimit) : "unlike or out of step";
}

std::string format_pairs(const FragmentDatabase& database, double max_share_at_limit) {
  std::map<effort::RecordId, int> group_of;
  for (const FragmentRecord& fragment : database.fragments()) group_of[fragment.id] = fragment.group;
  std::string text = "first,second,cost_m,share_at_limit,status,reason\n";
  for (const PairRecord& pair : database.pairs()) {
    const bool compared = effort::is_rated(pair.cost);
    text +=
        fmt::format("{},{},{},{},{},{}\n", pair.first, pair.second, compared ? fmt::format("{:.6f}", pair.cost) : "",
                    compared ? fmt::format("{:.3f}", pair.share_at_limit) : "", name_of(pair.status),
                    reason_of(pair, group_of[pair.first] == group_of[pair.second], max_share_at_limit));
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
               (matches[k].frames.end - start) * scale, base_name(clips[static_cast<std::size_t>(clip)].name));
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
    write_file(arguments.list, format_pairs(database, arguments.options.max_share_at_limit),
               overwrite_if(arguments.force));
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
  command
      ->add_option("--max-cost", arguments->options.max_cost,
                   "The threshold itself instead, in metres, where no action is named")
      ->check(not_negative());
  command->add_flag("--ignore-actions", arguments->ignore_actions,
                    "Compare all with all, whatever actions strut effort segment --action named");
  command->add_flag("--force", arguments->force, "Overwrite an existing table");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace strut::cli
