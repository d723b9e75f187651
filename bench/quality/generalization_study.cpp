// SPDX-License-Identifier: MIT
// What heuristic generalization (Hsu et al. 2005, 4.5) does, in figures: tables for docs/generalization.md on standard
// output, its pictures into a folder.
//   generalization_study FOLDER_OF_CLIPS docs/images [CONFIDENCE PREFERENCE FADE]
#include "clip_variations.h"
#include "unfamiliar_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <strut/core/file.h>
#include <strut/metrics/body_track.h>
#include <strut/metrics/smoothness.h>
#include <strut/model/model_step.h>
#include <strut/representation/representation.h>
#include <strut/translate/translator.h>

namespace {

using namespace strut;
using postprocess::GeneralizationOptions;
using quality::UnfamiliarCase;

constexpr double kCm = 100.0;
constexpr double kRamp = 0.4;        // in which a variation goes [s] (clip_variations.cpp)
constexpr double kBackWithin = 1.0;  // of the translation that was not interrupted [cm]

// ---- what comes out -------------------------------------------------------------------------------------------------

struct Translated {
  Motion motion;
  std::vector<double> share;
};

Translated translated(const UnfamiliarCase& given, const Motion& clip, const GeneralizationOptions& options) {
  Translator translator(given.model, {.generalization = options});
  std::vector<Pose> frames = clip.frames();
  std::vector<double> share;
  for (Pose& pose : frames) {
    translator.push(pose, pose);
    share.push_back(translator.input_share());
  }
  return {Motion(clip.shared_skeleton(), clip.frame_rate(), std::move(frames)), std::move(share)};
}

double mean(const std::vector<double>& values, int begin, int end) {
  double sum = 0.0;
  for (int t = begin; t < end; ++t) sum += values[static_cast<std::size_t>(t)];
  return sum / std::max(1, end - begin);
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Seconds after the variation is gone until `varied` stays near the translation that was not interrupted.
std::optional<double> time_to_return(const UnfamiliarCase& given, const Motion& varied,
                                     const GeneralizationOptions& options) {
  const int gone = given.frames.end + static_cast<int>(kRamp * varied.frame_rate());
  if (!given.plain || gone >= varied.num_frames()) return std::nullopt;
  const Motion plain = translated(given, *given.plain, options).motion;
  for (int t = plain.num_frames() - 1; t >= gone; --t) {
    if (kCm * quality::frame_distance(varied, plain, {t, t + 1}) > kBackWithin) {
      return (t + 1 - gone) / plain.frame_rate();
    }
  }
  return 0.0;
}

// ---- tables ---------------------------------------------------------------------------------------------------------

void print_case(const UnfamiliarCase& given, const GeneralizationOptions& options) {
  GeneralizationOptions off = options;
  off.enabled = false;
  const Translated with = translated(given, given.clip, options), without = translated(given, given.clip, off);
  const double jerk = metrics::smoothness(given.clip).jerk;
  const auto back = time_to_return(given, with.motion, options);
  std::printf("| %s | %.2f | %.2f | %.2f | %.1f | %.1f | %s |\n", given.name.c_str(),
              mean(with.share, given.frames.begin, given.frames.end), metrics::smoothness(without.motion).jerk / jerk,
              metrics::smoothness(with.motion).jerk / jerk,
              kCm * quality::frame_distance(without.motion, given.clip, given.frames),
              kCm * quality::frame_distance(with.motion, given.clip, given.frames),
              back ? std::to_string(*back).substr(0, 4).c_str() : "-");
}

void print_cases(const char* title, const std::vector<UnfamiliarCase>& cases, const GeneralizationOptions& options) {
  std::printf(
      "\n%s\n\n| input | share | jerk, off | jerk, on | cm from input, off | cm, on | back after, s |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n",
      title);
  for (const UnfamiliarCase& given : cases) print_case(given, options);
}

/// The largest deviations of every frame, of all takes.
std::vector<double> deviations(const quality::FamiliarContent& content) {
  std::vector<double> all;
  ModelStep<double> step(content.model);
  Eigen::RowVectorXd output(content.model->num_dofs() + 1);
  for (const Motion& take : content.takes) {
    const FrameMatrix rows = representation::encode(content.model->input(), take);
    for (Eigen::Index t = 0; t < rows.rows(); ++t) {
      step.step(rows.row(t), output);
      all.push_back(step.largest_deviation());
    }
  }
  return all;
}

void print_familiar(const std::vector<quality::FamiliarContent>& contents, const GeneralizationOptions& options) {
  std::printf(
      "\n| content | deviation, median | 95 %% | largest | share, median | mean |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: |\n");
  for (const quality::FamiliarContent& content : contents) {
    const std::vector<double> all = deviations(content);
    std::vector<double> share;
    for (const double deviation : all) share.push_back(postprocess::input_share(deviation, options));
    std::printf("| %s | %.1f | %.1f | %.1f | %.4f | %.4f |\n", content.name.c_str(), quantile(all, 0.5),
                quantile(all, 0.95), quantile(all, 1.0), quantile(share, 0.5),
                mean(share, 0, static_cast<int>(share.size())));
  }
}

// ---- pictures -------------------------------------------------------------------------------------------------------

/// Curves in one frame: x to the right, shares from 0 to 1 upwards.
class Chart {
 public:
  Chart(double left, double width, double largest_x, double step, const std::string& title, const std::string& x_label)
      : left_(left), width_(width), largest_x_(largest_x) {
    text(left, 22, title, "start", "#111");
    for (double x = 0.0; x <= largest_x + 1e-9; x += step) {
      add("<path d=\"M%.1f %.1fV%.1f\" stroke=\"#ddd\"/>", at_x(x), at_y(0.0), at_y(1.0));
      char number[32];
      std::snprintf(number, sizeof number, "%g", x);
      text(at_x(x), at_y(0.0) + 16, number, "middle", "#333");
    }
    for (const double y : {0.0, 0.5, 1.0}) {
      add("<path d=\"M%.1f %.1fH%.1f\" stroke=\"#ddd\"/>", left, at_y(y), left + width);
      char number[32];
      std::snprintf(number, sizeof number, "%g", y);
      text(left - 6, at_y(y) + 4, number, "end", "#333");
    }
    text(left + width / 2, at_y(0.0) + 34, x_label, "middle", "#333");
  }

  void curve(const std::function<double(double)>& share, const char* color, double thickness, const std::string& name) {
    std::string path;
    constexpr int kPoints = 240;
    for (int i = 0; i <= kPoints; ++i) {
      const double x = largest_x_ * i / kPoints;
      char point[64];
      std::snprintf(point, sizeof point, "%c%.1f %.1f", i == 0 ? 'M' : 'L', at_x(x), at_y(share(x)));
      path += point;
    }
    add("<path d=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%g\"/>", path.c_str(), color, thickness);
    text(left_, 286 + 15 * num_curves_++, name, "start", color);
  }
  [[nodiscard]] const std::string& svg() const { return svg_; }

 private:
  [[nodiscard]] double at_x(double x) const { return left_ + width_ * x / largest_x_; }
  static double at_y(double y) { return 230.0 - 190.0 * y; }
  void add(const char* format, ...) __attribute__((format(printf, 2, 3))) {
    std::array<char, 16384> buffer{};
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
    va_end(arguments);
    svg_ += std::string(buffer.data()) + "\n";
  }
  void text(double x, double y, const std::string& words, const char* anchor, const char* color) {
    add("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" fill=\"%s\">%s</text>", x, y, anchor, color, words.c_str());
  }

  double left_, width_, largest_x_;
  int num_curves_ = 0;
  std::string svg_;
};

void write_picture(const std::string& path, const std::string& title, const std::vector<Chart>& charts) {
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 860 345\" width=\"860\" height=\"345\" "
      "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"12\">\n<title>" +
      title + "</title>\n<rect width=\"860\" height=\"345\" fill=\"#fff\"/>\n";
  for (const Chart& chart : charts) svg += chart.svg();
  write_file(path, svg + "</svg>\n", Overwrite::kAllow);
}

constexpr std::array<const char*, 4> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};  // told apart by all eyes

/// Figure 4 of the paper.
void draw_blend(const std::string& folder, const GeneralizationOptions& options) {
  const auto curves = [&](Chart& chart, const std::vector<GeneralizationOptions>& settings) {
    for (std::size_t i = 0; i < settings.size(); ++i) {
      char name[64];
      std::snprintf(name, sizeof name, "k_c %g, k_p %g", settings[i].confidence, settings[i].preference);
      const bool is_default =
          settings[i].confidence == options.confidence && settings[i].preference == options.preference;
      chart.curve([&, i](double x) { return postprocess::input_share(x, settings[i]); }, kColors[i],
                  is_default ? 2.5 : 1.2, name + std::string(is_default ? " (default)" : ""));
    }
  };
  const double c = options.confidence, p = options.preference;
  Chart by_confidence(50, 360, 10, 2, "share of the input, by confidence", "deviations from the examples' mean");
  curves(by_confidence, {{.confidence = 0.5 * c, .preference = p},
                         {.confidence = c, .preference = p},
                         {.confidence = 2.0 * c, .preference = p}});
  Chart by_preference(480, 360, 10, 2, "share of the input, by preference", "deviations from the examples' mean");
  curves(by_preference, {{.confidence = c, .preference = 1.0},
                         {.confidence = c, .preference = p / 4.0},
                         {.confidence = c, .preference = p},
                         {.confidence = c, .preference = 4.0 * p}});
  write_picture(folder + "/generalization_blend.svg", "The blend of the input over its deviation",
                {by_confidence, by_preference});
}

/// The share of the input over time, of cases that come and go.
void draw_shares(const std::string& folder, const std::vector<UnfamiliarCase>& generated,
                 const std::vector<UnfamiliarCase>& real, const GeneralizationOptions& options) {
  const auto chart_of = [&](double left, const char* title, const std::vector<UnfamiliarCase>& cases) {
    Chart chart(left, 360, 9, 1, title, "seconds");
    for (std::size_t i = 0; i < kColors.size(); ++i) {
      const std::vector<double> share = translated(cases[i], cases[i].clip, options).share;
      const double rate = cases[i].clip.frame_rate();
      chart.curve([&](double x) { return share[std::min(share.size() - 1, static_cast<std::size_t>(x * rate))]; },
                  kColors[i], 1.5, cases[i].name);
    }
    return chart;
  };
  write_picture(folder + "/generalization_share.svg", "The share of the input over time",
                {chart_of(50, "generated walks, unfamiliar in the middle", generated),
                 chart_of(480, "a real walk, varied in the middle", real)});
}

void run(const std::string& clips, const std::string& pictures, const GeneralizationOptions& options) {
  const auto generated = quality::generated_cases();
  const auto contents = quality::familiar_contents(clips);
  const auto real = quality::real_cases(clips, contents.front());
  std::printf("confidence %g, preference %g, fade %g s\n", options.confidence, options.preference, options.fade);
  print_familiar(contents, options);
  print_cases("Generated", generated, options);
  print_cases("Real", real, options);
  draw_blend(pictures, options);
  draw_shares(pictures, generated, real, options);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 && argc != 6) {
    std::fputs("usage: generalization_study FOLDER_OF_CLIPS FOLDER_OF_PICTURES [CONFIDENCE PREFERENCE FADE]\n", stderr);
    return 2;
  }
  try {
    GeneralizationOptions options;
    if (argc == 6) options = {true, std::atof(argv[3]), std::atof(argv[4]), std::atof(argv[5])};
    run(argv[1], argv[2], options);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generalization_study: %s\n", error.what());
    return 1;
  }
}
