// SPDX-License-Identifier: MIT
#include "view/report.h"

#include "view/clip_answer.h"
#include "view/page.h"

#include <cstdint>
#include <string_view>

#include <fmt/core.h>

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

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string id_of(std::size_t clip) {
  return fmt::format("c{}", clip);
}

Json json_session(const std::vector<ReportClip>& clips, const ReportOptions& options) {
  Json files = Json::array();
  for (std::size_t i = 0; i < clips.size(); ++i) {
    files.push_back({{"id", id_of(i)}, {"kind", "clip"}, {"name", clips[i].name}, {"path", clips[i].name}});
  }
  return {{"version", version()},
          {"files", files},
          {"report", {{"title", options.title}, {"notes", options.notes}, {"leftOut", Json::array()}}}};
}

std::string packed_clip(const ReportClip& clip, const std::string& id) {
  Container answer = clip_answer(id, clip.name, clip.motion, clip.notes, Packing::kSmall);
  Json figures = as_json(clip.figures);
  for (Json& figure : answer.header()["figures"]) figures.push_back(std::move(figure));
  answer.header()["figures"] = std::move(figures);
  return in_base64(answer.bytes());
}

std::string with(std::string page, std::string_view mark, const std::string& text) {
  return page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

std::string report_page(const std::vector<ReportClip>& clips, const ReportOptions& options) {
  Json report{{"session", json_session(clips, options)}, {"clips", Json::object()}};
  for (std::size_t i = 0; i < clips.size(); ++i) report["clips"][id_of(i)] = packed_clip(clips[i], id_of(i));
  const std::string data = fmt::format(R"(<script type="application/json" id="report">{}</script>)", inert(report));
  const std::string title = fmt::format("<title>{}</title>", escaped(options.title));
  return with(with(std::string(kViewerPage), kTitleMark, title), kDataMark, data);
}

}  // namespace strut::cli
