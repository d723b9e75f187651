// SPDX-License-Identifier: MIT
// The demo's still picture. Time runs to the right: every pose stands where its time is, and below it lie the stretches
// in which each foot stands, so that both the pose and the timing of a style can be seen.
#include "demo_picture.h"

#include "demo_body.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include <strut/math/rotation.h>
#include <strut/motion/resample.h>

namespace strut::cli {
namespace {

constexpr double kWidth = 1000.0, kLeftEdge = 172.0, kRightEdge = 978.0, kRowHeight = 214.0, kTop = 12.0;
constexpr double kSeconds = 1.95;    // of motion in a row
constexpr double kPoseEvery = 0.15;  // [s]
constexpr double kPixelsPerMetre = 82.0;
constexpr double kViewAngle = -0.95;  // of the viewer against the direction faced, from the body's right front [rad]
constexpr double kViewTilt = 0.10;    // from above [rad]

constexpr char kStyle[] =
    "text{font:14px system-ui,sans-serif;fill:#1d2327}.s{font-size:12px;fill:#5a6570}"
    "line,path{fill:none;stroke-linecap:round;stroke-width:3}.c{stroke:#3d464e}.l{stroke:#c2410c}"
    ".r{stroke:#1d5fbf;stroke-dasharray:6 4.5}.h{stroke:#3d464e;stroke-width:2.4}.g{stroke:#c9cdd1;stroke-width:1}"
    ".p{stroke-width:6;stroke-linecap:butt;stroke-dasharray:none}.q{stroke-width:6;stroke-linecap:butt;stroke-"
    "dasharray:9 2}"
    ".b{fill:#fff}"
    "@media(prefers-color-scheme:dark){text{fill:#e8eaec}.s{fill:#a3adb6}.c,.h{stroke:#c5ccd2}.l{stroke:#fb923c}"
    ".r{stroke:#7db3ff}.g{stroke:#3c4349}.b{fill:#15181b}}";

/// A point seen by the viewer, relative to the body's place on the ground: right and up [m].
Eigen::Vector2d seen(const Eigen::Vector3d& point, const Eigen::Vector3d& ground, double heading) {
  const Eigen::Vector3d p = math::rotation_about_y(-heading - kViewAngle) * (point - ground);
  return {p.x(), p.y() * std::cos(kViewTilt) - p.z() * std::sin(kViewTilt)};
}

std::string draw_pose(const Motion& motion, double time, double x, double y) {
  const Pose pose = motion::sample(motion, time);
  const std::vector<Eigen::Vector3d> points = body_points(motion.skeleton(), pose);
  const BodyDrawing drawing = body_drawing(motion.skeleton());
  const Eigen::Vector3d ground(points[0].x(), 0.0, points[0].z());
  const double heading = math::heading(pose.rotations[0]);
  const auto place = [&](std::size_t i) -> Eigen::Vector2d {
    const Eigen::Vector2d p = kPixelsPerMetre * seen(points[i], ground, heading);
    return {x + p.x(), y - p.y()};
  };
  std::string out;
  for (const int side : {2, 0, 1}) {  // seen from the right front the left limbs would lie behind; they carry the limp
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (drawing.sides[i] != side) continue;
      const auto from = static_cast<std::size_t>(drawing.parents[i]);
      if (static_cast<int>(i) == drawing.head) continue;
      const Eigen::Vector2d a = place(from), b = place(i);
      out += fmt::format("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>",
                         side == 1   ? "l"
                         : side == 2 ? "r"
                                     : "c",
                         a.x(), a.y(), b.x(), b.y());
    }
  }
  const auto top = static_cast<std::size_t>(drawing.head);
  const Eigen::Vector2d middle = (place(top) + place(static_cast<std::size_t>(drawing.parents[top]))) / 2.0;
  return out + fmt::format("<path class=\"h\" d=\"M{:.1f} {:.1f}a9 9 0 1 0 18 0a9 9 0 1 0 -18 0\"/>", middle.x() - 9.0,
                           middle.y());
}

std::string draw_plants(const DemoClip& clip, double begin, double y) {
  const double pixels_per_second = (kRightEdge - kLeftEdge) / kSeconds;
  std::string out;
  for (const motion::Footplant& plant : clip.plants) {
    const double from = std::max(plant.begin * clip.motion.frame_time() - begin, -kPoseEvery / 2);
    const double to = std::min(plant.end * clip.motion.frame_time() - begin, kSeconds - kPoseEvery / 2);
    if (to <= from) continue;
    const double x = kLeftEdge + pixels_per_second * kPoseEvery / 2;
    out += fmt::format("<path class=\"{0}\" d=\"M{1:.1f} {3:.1f}H{2:.1f}\"/>", plant.foot == 0 ? "l p" : "r q",
                       x + pixels_per_second * from, x + pixels_per_second * to, y + (plant.foot == 0 ? 10.0 : 20.0));
  }
  return out;
}

std::string draw_row(const DemoClip& clip, double begin, double y) {
  const double pixels_per_second = (kRightEdge - kLeftEdge) / kSeconds;
  const double ground = y + kRowHeight - 42.0;
  std::string out = fmt::format("<text x=\"14\" y=\"{:.0f}\">{}</text>", y + 80.0, clip.title);
  std::size_t line = 0, from = 0;  // the note, broken at its commas
  while (from < clip.note.size()) {
    const std::size_t to = std::min(clip.note.find(", ", from), clip.note.size());
    out += fmt::format("<text class=\"s\" x=\"14\" y=\"{:.0f}\">{}</text>",
                       y + 100.0 + 16.0 * static_cast<double>(line++), clip.note.substr(from, to - from));
    from = to + 2;
  }
  out += fmt::format("<path class=\"g\" d=\"M{:.0f} {:.1f}H{:.0f}\"/>", kLeftEdge, ground, kRightEdge);
  for (int i = 0; i * kPoseEvery < kSeconds - 1e-9; ++i) {
    const double x = kLeftEdge + pixels_per_second * (i + 0.5) * kPoseEvery;
    out += draw_pose(clip.motion, begin + i * kPoseEvery, x, ground);
  }
  return out + draw_plants(clip, begin, ground);
}

}  // namespace

std::string demo_picture(const std::string& title, const std::vector<DemoClip>& clips,
                         const std::vector<double>& begins) {
  const double height = kTop + kRowHeight * static_cast<double>(clips.size()) + 26.0;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
      "role=\"img\"><title>{2}</title><style>{3}</style><rect class=\"b\" width=\"100%\" height=\"100%\" rx=\"8\"/>",
      kWidth, height, title, kStyle);
  for (std::size_t i = 0; i < clips.size(); ++i) {
    out += draw_row(clips[i], begins[i], kTop + kRowHeight * static_cast<double>(i)) + "\n";
  }
  out += fmt::format(
      "<text class=\"s\" x=\"{:.0f}\" y=\"{:.0f}\">A pose every {:.2f} s. Left side solid, right side dashed; bars: "
      "when each "
      "foot stands. Drawn by strut demo.</text></svg>\n",
      kLeftEdge, height - 12.0, kPoseEvery);
  return out;
}

}  // namespace strut::cli
