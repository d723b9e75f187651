// SPDX-License-Identifier: MIT
// The main job in one page: two handfuls of clips, pairs, a model, a translated clip, and how near it comes to the
// truth. Writes limp.strut, which the next example streams through.
#include <cstdio>
#include <vector>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/learn/clip_pair.h>
#include <strut/learn/learn_style.h>
#include <strut/metrics/clip_distance.h>
#include <strut/model/style_model_io.h>
#include <strut/translate/translate_motion.h>

namespace {

const strut::generate::WalkStyle kNormal{};
const strut::generate::WalkStyle kLimping{.cadence_scale = 0.9, .limp = 0.8};

/// One walk per speed, each somewhat different from the others.
std::vector<strut::Motion> walks(const strut::generate::WalkStyle& style) {
  std::vector<strut::Motion> clips;
  for (const double speed : {0.9, 1.1, 1.3}) {
    clips.push_back(strut::generate::generate_walk({.duration = 6.0, .speed = speed}, style, 30.0).motion);
  }
  return clips;
}

}  // namespace

int main() {
  try {
    // 1. Examples of both styles.
    const auto inputs = walks(kNormal);
    const auto outputs = walks(kLimping);

    // 2. Which gait cycle belongs to which.
    const strut::learn::Pairing pairing = strut::learn::find_pairs(inputs, outputs);
    std::printf("%zu pairs\n", pairing.pairs.size());

    // 3. Learn; keep the model as a file.
    const strut::LearntStyle learnt = strut::learn_style(inputs, outputs, pairing.pairs);
    std::printf("%d centres\n", learnt.report.num_centres);
    strut::write_style_model("limp.strut", *learnt.model, strut::Overwrite::kAllow);

    // 4. Put the limp on a walk that learning has not seen.
    const strut::generate::WalkContent content{.duration = 5.0, .speed = 1.2};
    const auto walk = strut::generate::generate_walk(content, kNormal, 30.0).motion;
    const auto truth = strut::generate::generate_walk(content, kLimping, 30.0).motion;
    const strut::Motion translated = strut::translate_motion(learnt.model, walk);

    // 5. How far are the two from the true limp?
    std::printf("to the true limp: %.1f cm before, %.1f cm after\n",
                100.0 * strut::metrics::clip_distance(walk, truth).distance,
                100.0 * strut::metrics::clip_distance(translated, truth).distance);
    return 0;
  } catch (const strut::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
