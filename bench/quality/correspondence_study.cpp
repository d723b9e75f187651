// SPDX-License-Identifier: MIT
// How well do iterative motion warping, its time-warp stage alone, dynamic time warping and the continuous warp find
// which moments belong together? Makes docs/correspondence.md from the text in correspondence_page.md:
//   correspondence_study CLIPS TEXT PAGE           as `./dev correspondence` calls it
//   correspondence_study --walks INPUT OUTPUT      a pair of generated walks, for the page's figure
#include "correspondence_clips.h"
#include "correspondence_groups.h"
#include "correspondence_page.h"
#include "correspondence_walks.h"

#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>

#include <strut/io/bvh.h>

namespace {

using namespace strut;
using namespace strut::study;

constexpr double kNoise = 0.01;  // [rad], over half a degree in every joint and frame
const std::vector<std::string> kStyles = {"elderly", "active", "feminine"};
const std::vector<std::string> kContents = {"walk", "walk-turn-left", "walk-turn-right", "run"};
using Features = representation::FeatureShares;

Method continuous(const std::string& name, const Features& features = {}) {
  return {name, Solver::kContinuous, features};
}

/// With the paper's slope limit.
Method limited(const std::string& name, const Features& features = {}) {
  Method method = continuous(name, features);
  method.slope_limit = 2.0;
  return method;
}

/// The paper's methods by posture, by all signals, and the continuous warp by both.
std::vector<Method> main_methods() {
  std::vector<Method> all = papers_methods(kPosture, ", posture");
  Method smoothed = all.front();
  smoothed.name += ", smoothed";
  smoothed.is_smoothed = true;
  all.push_back(smoothed);
  all.push_back(continuous("continuous warp, posture", kPosture));
  for (const Method& method : papers_methods(Features{}, ", all signals")) all.push_back(method);
  all.push_back(limited("continuous warp, all signals, slope limit 2"));
  all.push_back(continuous("**continuous warp, all signals**"));
  return all;
}

Method uniform() {
  return {"no alignment: even", Solver::kUniform, kPosture};
}

std::vector<std::string> full_row(const std::string& name, const Figures& f) {
  return {name,
          number(f.mean()),
          number(f.quantile(0.5)),
          number(f.quantile(0.95)),
          number(f.roughness(), 3),
          percent(f.share_at_limit())};
}

// ---- generated walks ------------------------------------------------------------------------------------------------

std::string walk_table(const std::vector<WalkPair>& pairs, const std::vector<Method>& methods) {
  Table table({"method", "mean", "median", "95th percentile", "roughness", "at the limit"});
  for (const Method& method : methods) table.add(full_row(method.name, judge(method, pairs).back()));
  const Figures truth = true_figures(pairs);
  table.add({"the truth", "", "", "", number(truth.roughness(), 3), percent(truth.share_at_limit())});
  return table.markdown();
}

std::string style_table(const std::vector<WalkPair>& pairs, const std::vector<Method>& methods) {
  std::vector<std::string> head{"method"};
  for (const std::string& style : walk_styles()) head.push_back(style);
  Table table(head);
  for (const Method& method : methods) {
    std::vector<std::string> row{method.name};
    const std::vector<Figures> figures = judge(method, pairs);
    for (std::size_t k = 0; k + 1 < figures.size(); ++k) row.push_back(number(figures[k].mean()));
    table.add(row);
  }
  return table.markdown();
}

std::string single_dof_table(const std::vector<WalkPair>& clean, const std::vector<WalkPair>& noisy) {
  Table table({"method", "mean", "median", "95th percentile", "roughness", "at the limit", "mean, with noise"});
  std::vector<Method> methods = papers_methods(kPosture);
  methods.push_back(continuous("continuous warp", kPosture));
  methods.push_back(continuous("**continuous warp, with its movement**", {1.0, 0.5, 0.0}));
  methods.push_back(uniform());
  for (const Method& method : methods) {
    std::vector<std::string> row = full_row(method.name, judge_single_dofs(method, clean));
    row.push_back(number(judge_single_dofs(method, noisy).mean()));
    table.add(row);
  }
  return table.markdown();
}

/// Seven styles of one content: pair by pair, by way of the plain one, by way of a common timeline.
std::string group_table() {
  Table table({"method", "pair by pair", "by way of the plain walk", "by way of the common timeline"});
  const auto groups = walk_groups(3, 30.0);
  Method smoothed = papers_methods(kPosture).front();
  smoothed.name += ", smoothed";
  smoothed.is_smoothed = true;
  for (const Method& method : {smoothed, continuous("continuous warp", kPosture)}) {
    const GroupFigures figures = judge_groups(method, groups);
    table.add({method.name, number(figures.direct.mean()), number(figures.reference.mean()),
               number(figures.timeline.mean())});
  }
  return table.markdown();
}

// ---- real clips -----------------------------------------------------------------------------------------------------

/// Mean errors of landings and lift-offs, by style.
std::string clip_table(const std::vector<Cell>& cells, EventKind kind, const std::vector<Method>& methods) {
  std::vector<std::string> head{"method"};
  for (const Cell& cell : cells) head.push_back(cell.style + ": mean");
  for (const char* name : {"median", "95th percentile", "roughness", "at the limit"}) head.emplace_back(name);
  Table table(head);
  std::vector<std::vector<ClipFigures>> figures;
  for (const Cell& cell : cells) figures.push_back(judge(cell, kind, methods));
  for (std::size_t m = 0; m < methods.size(); ++m) {
    std::vector<std::string> row{methods[m].name};
    Figures all;
    for (const auto& of_cell : figures) {
      const ClipFigures& f = of_cell[m];
      row.push_back(number(f.all.mean()) + " (" + number(f.landings.mean()) + ", " + number(f.leavings.mean()) + ")");
      all.add(f.all);
    }
    for (const std::string& value : {number(all.quantile(0.5)), number(all.quantile(0.95)), number(all.roughness(), 3),
                                     percent(all.share_at_limit())}) {
      row.push_back(value);
    }
    table.add(row);
  }
  for (const double limit : {2.0, 3.0}) {
    std::vector<std::string> row{"least that a slope limit of " + number(limit, 0) + " allows"};
    for (const Cell& cell : cells) {
      row.push_back(number(least_mean_error(cell, kind, limit, false)) + " (" +
                    number(least_mean_error(cell, kind, limit, true)) + ", -)");
    }
    row.resize(head.size());
    table.add(row);
  }
  return table.markdown();
}

/// What it costs to know events to the frame only.
std::string rounding_table(const std::vector<Cell>& cells) {
  const std::vector<Method> methods{{"IMW, posture", Solver::kIterative, kPosture},
                                    {"DTW, Type I, all signals", Solver::kDtw1, Features{}},
                                    continuous("**continuous warp, all signals**")};
  std::vector<std::string> head{"method"};
  for (const Cell& cell : cells) {
    head.push_back(cell.style);
    head.push_back(cell.style + ", to the frame");
  }
  Table table(head);
  std::vector<std::vector<std::string>> rows;
  for (const Method& method : methods) rows.push_back({method.name});
  for (const Cell& cell : cells) {
    for (const EventKind kind : {EventKind::kThresholds, EventKind::kRounded}) {
      const std::vector<ClipFigures> figures = judge(cell, kind, methods);
      for (std::size_t m = 0; m < methods.size(); ++m) rows[m].push_back(number(figures[m].all.mean()));
    }
  }
  for (const auto& row : rows) table.add(row);
  return table.markdown();
}

std::vector<Cell> cells_of(const std::string& folder, const std::string& content, Takes takes) {
  std::vector<Cell> cells;
  for (const std::string& style : kStyles) cells.push_back(read_cell(folder, content, style, takes));
  return cells;
}

std::string content_table(const std::string& folder, Takes takes) {
  std::vector<Method> methods = papers_methods(kPosture, ", posture");
  methods.push_back({"DTW, Type I, all signals", Solver::kDtw1, Features{}});
  methods.push_back({"DTW, Type III, all signals", Solver::kDtw3, Features{}});
  methods.push_back({"IMW, all signals", Solver::kIterative, Features{}});
  methods.push_back(limited("continuous warp, limit 2"));
  methods.push_back(continuous("**continuous warp**"));
  std::vector<std::string> head{"clips"};
  for (const Method& method : methods) head.push_back(method.name);
  head.emplace_back("least, limit 3");
  Table table(head);
  for (const std::string& content : kContents) {
    for (const Cell& cell : cells_of(folder, content, takes)) {
      std::vector<std::string> row{content + " " + cell.style};
      for (const ClipFigures& f : judge(cell, EventKind::kThresholds, methods)) row.push_back(number(f.all.mean()));
      row.push_back(number(least_mean_error(cell, EventKind::kThresholds, 3.0, false)));
      table.add(row);
    }
  }
  return table.markdown();
}

// ---- what each ingredient brings ------------------------------------------------------------------------------------

std::vector<Method> ingredients() {
  std::vector<Method> all{{"IMW by posture (the paper)", Solver::kIterative, kPosture},
                          {"the same, smoothed over 0.1 s", Solver::kIterative, kPosture, true},
                          continuous("continuous warp by posture", kPosture),
                          continuous("and movement", {1.0, 0.5, 0.0}),
                          continuous("**and feet: the default**"),
                          continuous("posture and feet", {1.0, 0.0, 4.0}),
                          continuous("feet counting 1", {1.0, 0.5, 1.0}),
                          continuous("feet counting 16", {1.0, 0.5, 16.0})};
  const auto changed = [&all](const char* name, double limit, double slope, double space) {
    all.push_back({name, Solver::kContinuous, {}, false, limit, slope, space});
  };
  changed("slope limit 2", 2.0, -1, -1);
  changed("slope limit 4", 4.0, -1, -1);
  changed("slopes 3 times as stiff", 3.0, 0.009, -1);
  changed("slopes a third as stiff", 3.0, 0.001, -1);
  changed("space warp 3 times as stiff", 3.0, -1, 1.5);
  changed("space warp a third as stiff", 3.0, -1, 0.167);
  changed("as `strut learn` has it: limit 2, both stiffer", 2.0, 0.006, 1.0);
  return all;
}

std::string ingredient_table(const std::vector<Cell>& cells, const std::vector<WalkPair>& clean,
                             const std::vector<WalkPair>& noisy) {
  std::vector<std::string> head{"method"};
  for (const Cell& cell : cells) head.push_back(cell.style);
  for (const char* name : {"at the limit", "generated", "generated, noise"}) head.emplace_back(name);
  Table table(head);
  const std::vector<Method> methods = ingredients();
  std::vector<std::vector<ClipFigures>> figures;
  for (const Cell& cell : cells) figures.push_back(judge(cell, EventKind::kThresholds, methods));
  for (std::size_t m = 0; m < methods.size(); ++m) {
    std::vector<std::string> row{methods[m].name};
    Figures all;
    for (const auto& of_cell : figures) {
      row.push_back(number(of_cell[m].all.mean()));
      all.add(of_cell[m].all);
    }
    row.push_back(percent(all.share_at_limit()));
    for (const auto* pairs : {&clean, &noisy}) row.push_back(number(judge(methods[m], *pairs).back().mean()));
    table.add(row);
  }
  return table.markdown();
}

class Clock {
 public:
  void tell(const char* what) const {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    std::fprintf(stderr, "%5.1f s  %s\n", passed.count(), what);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::map<std::string, std::string> tables(const std::string& folder) {
  const Clock clock;
  std::map<std::string, std::string> parts;
  std::vector<Method> methods = main_methods();
  methods.push_back(uniform());
  {
    const auto walks = cells_of(folder, "walk", Takes::kLearnt), held_out = cells_of(folder, "walk", Takes::kHeldOut);
    parts["walks"] = clip_table(walks, EventKind::kThresholds, methods);
    parts["walks_held_out"] = clip_table(held_out, EventKind::kThresholds, methods);
    parts["walks_rounded"] = rounding_table(walks);
    parts["walks_detected"] = clip_table(walks, EventKind::kDetected, methods);
    clock.tell("real walks");
    const auto clean = walk_pairs(2, 30.0, 0.0), noisy = walk_pairs(2, 30.0, kNoise);
    parts["ingredients"] = ingredient_table(walks, clean, noisy);
    clock.tell("ingredients");
    parts["single_dofs"] = single_dof_table(walk_pairs(1, 30.0, 0.0), walk_pairs(1, 30.0, kNoise));
    clock.tell("single degrees of freedom");
  }
  parts["contents"] = content_table(folder, Takes::kLearnt);
  parts["contents_held_out"] = content_table(folder, Takes::kHeldOut);
  clock.tell("real turns and runs");
  const auto clean = walk_pairs(5, 30.0, 0.0);
  parts["generated"] = walk_table(clean, methods);
  parts["generated_styles"] = style_table(clean, methods);
  parts["generated_noise"] = walk_table(walk_pairs(5, 30.0, kNoise), methods);
  clock.tell("generated walks at 30 frames/s");
  parts["generated_120"] = walk_table(walk_pairs(1, 120.0, 0.0), methods);
  parts["generated_120_noise"] = walk_table(walk_pairs(1, 120.0, kNoise), methods);
  clock.tell("generated walks at 120 frames/s");
  parts["groups"] = group_table();
  clock.tell("groups");
  return parts;
}

void write_walks(const char* input, const char* output) {
  const WalkPair pair = walk_pairs(1, 30.0, 0.0).front();
  const BvhLayout layout = default_layout(pair.input.skeleton());
  write_bvh(input, pair.input, layout, Overwrite::kAllow);
  write_bvh(output, pair.output, layout, Overwrite::kAllow);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 4 && std::strcmp(argv[1], "--walks") == 0) {
      write_walks(argv[2], argv[3]);
    } else if (argc == 4) {
      write_page(argv[2], argv[3], tables(argv[1]));
    } else {
      std::fprintf(stderr, "usage: correspondence_study CLIPS TEXT PAGE | --walks INPUT OUTPUT\n");
      return 2;
    }
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "correspondence_study: %s\n", error.what());
    return 1;
  }
}
