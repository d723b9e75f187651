// SPDX-License-Identifier: MIT
#include "view/report.h"

#include "svg.h"
#include "view/alignment_answer.h"
#include "view/clip_answer.h"
#include "view/curve_answer.h"
#include "view/page.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/core/version.h>

namespace strut::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kDataMark = R"(<script type="application/json" id="report">null</script>)";
constexpr std::string_view kTitleMark = "<title>strut</title>";

std::string in_base64(std::string_view bytes) {
  static constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18U - 6U * k) & 0x3fU] : '=';
    }
  }
  return text;
}

/// JSON that no "</script>" or "<!--" in a name can end: "<" stands in strings only.
std::string inert(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    text.replace(at, 1, "\\u003c");
  }
  return text;
}

std::string id_of(std::size_t clip) {
  return fmt::format("c{}", clip);
}

Json json_files(const std::vector<ReportClip>& clips) {
  Json files = Json::array();
  for (std::size_t i = 0; i < clips.size(); ++i) {
    files.push_back({{"id", id_of(i)}, {"kind", "clip"}, {"name", clips[i].name}, {"path", clips[i].name}});
  }
  return files;
}

bool is_of_body(const Json& curve) {
  return curve.at("name").get_ref<const std::string&>().starts_with("body/");
}

/// What all curves of `clips` take [bytes].
double size_of_curves(const std::vector<Container>& clips) {
  double size = 0.0;
  for (const Container& clip : clips) {
    const Json& header = clip.header();
    size +=
        static_cast<double>(sizeof(std::uint16_t) * header.at("curves").size()) * header.at("numFrames").get<double>();
  }
  return size;
}

/// Whether the curves of single joints are to be left out.
bool only_body(const std::vector<Container>& clips, ReportCurves curves) {
  if (curves == ReportCurves::kFitting) return size_of_curves(clips) > kCurveBudget;
  return curves == ReportCurves::kBody;
}

void leave_out_joints(Container& clip) {
  Json& curves = clip.header()["curves"];
  curves.erase(std::remove_if(curves.begin(), curves.end(), [](const Json& curve) { return !is_of_body(curve); }),
               curves.end());
}

/// Puts the clip's own figures before those that were measured.
Container answer_of(const ReportClip& clip, const std::string& id) {
  Container answer = clip_answer(id, clip.name, clip.motion, clip.notes, Packing::kSmall);
  Json figures = as_json(clip.figures);
  for (Json& figure : answer.header()["figures"]) figures.push_back(std::move(figure));
  answer.header()["figures"] = std::move(figures);
  return answer;
}

/// All curves that `clip`, the answer of `motion`, names.
Container curves_in(const Container& clip, const Motion& motion) {
  Container container(Json::object());
  for (const Json& curve : clip.header().at("curves")) {
    const auto& name = curve.at("name").get_ref<const std::string&>();
    container.add_rounded(name, curve_values(motion, name));
  }
  return container;
}

ViewClip view_clip(const ReportClip& clip, const std::string& id) {
  ViewClip view{{}, {clip.motion, {}}, {}};
  view.file.id = id;
  view.file.name = view.file.path = clip.name;
  return view;
}

/// The alignments with the first clip, by clip; what has none is said in `left_out`.
Json alignments_of(const std::vector<ReportClip>& clips, Json& left_out) {
  Json alignments = Json::object();
  if (clips.size() < 2) return alignments;
  const ViewClip first = view_clip(clips[0], id_of(0));
  for (std::size_t i = 1; i < clips.size(); ++i) {
    try {
      const Container answer = alignment_answer(first, view_clip(clips[i], id_of(i)), {});
      alignments[id_of(i)] = in_base64(answer.bytes());
    } catch (const Error& error) {
      left_out.push_back(fmt::format("The alignment of {} with {}: {}", clips[i].name, clips[0].name, error.what()));
    }
  }
  return alignments;
}

/// Puts clips and curves into `report`, and returns what of them is left out.
Json put_clips(const std::vector<ReportClip>& clips, ReportCurves curves, Json& report) {
  std::vector<Container> answers;
  for (std::size_t i = 0; i < clips.size(); ++i) answers.push_back(answer_of(clips[i], id_of(i)));
  Json left_out = Json::array();
  if (only_body(answers, curves)) {
    left_out.push_back(
        fmt::format("The curves of single joints, which would take {:.0f} MB: strut report --curves all puts them in.",
                    1e-6 * size_of_curves(answers)));
    for (Container& answer : answers) leave_out_joints(answer);
  }
  for (std::size_t i = 0; i < clips.size(); ++i) {
    report["clips"][id_of(i)] = in_base64(answers[i].bytes());
    report["curves"][id_of(i)] = in_base64(curves_in(answers[i], clips[i].motion).bytes());
  }
  return left_out;
}

std::string with(std::string page, std::string_view mark, const std::string& text) {
  return page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

std::string report_page(const std::vector<ReportClip>& clips, const ReportOptions& options) {
  Json report{{"session", Json::object()}, {"clips", Json::object()}, {"curves", Json::object()}};
  Json left_out = put_clips(clips, options.curves, report);
  report["alignments"] = options.align ? alignments_of(clips, left_out) : Json::object();
  report["session"] = {{"version", version()},
                       {"files", json_files(clips)},
                       {"report", {{"title", options.title}, {"notes", options.notes}, {"leftOut", left_out}}}};
  const std::string data = fmt::format(R"(<script type="application/json" id="report">{}</script>)", inert(report));
  const std::string title = fmt::format("<title>{}</title>", escaped(options.title));
  return with(with(std::string(kViewerPage), kTitleMark, title), kDataMark, data);
}

}  // namespace strut::cli
