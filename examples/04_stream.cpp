// SPDX-License-Identifier: MIT
// Frame in, frame out, as an engine does it: reads the model the third example wrote and pushes frames through it.
// What this uses is strut::runtime (but for the walk that feeds it); once running, push() allocates nothing.
#include <cstdio>

#include <strut/core/error.h>
#include <strut/generate/walker.h>
#include <strut/model/style_model_io.h>
#include <strut/translate/translator.h>

int main(int argc, char** argv) {
  try {
    // 1. One model for all characters, one translator per character.
    const auto model = strut::read_style_model(argc > 1 ? argv[1] : "limp.strut");
    strut::Translator translator(model);

    // 2. Frames come at the model's rate, from wherever they come.
    const auto walk = strut::generate::generate_walk({.duration = 5.0, .speed = 1.2}, {}, model->frame_rate()).motion;
    strut::Pose translated;
    for (int t = 0; t < walk.num_frames(); ++t) {
      translator.push(walk.frame(t), translated);
      if (t % 30 == 0) {
        std::printf("frame %3d: hips %.3f m high, %.3f m as walked; lasts %.2f frames in the style\n", t,
                    translated.translations[0].y(), walk.frame(t).translations[0].y(), translator.time_warp());
      }
    }
    return 0;
  } catch (const strut::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
