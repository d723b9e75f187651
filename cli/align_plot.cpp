// SPDX-License-Identifier: MIT
// Every panel stacks the two curves in bands of their own, at one scale, so that the ties between them can be seen.
#include "align_plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace strut::cli {
namespace {

constexpr double kPanelWidth = 300, kBandHeight = 118, kBandGap = 22;
constexpr double kLeft = 70, kRight = 16, kTop = 58, kBottom = 46, kPanelGap = 26;
constexpr const char* kInputColor = "#0072b2";  // blue and vermilion: told apart by colour-blind eyes and in grey
constexpr const char* kOutputColor = "#d55e00";
constexpr int kMostTies = 60;  // more would be a hatching

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else {
      result += c;
    }
  }
  return result;
}

/// 1, 2 or 5 times a power of ten, such that `range` holds about `count` of them.
double tick_step(double range, int count) {
  const double rough = range / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * 0.999) return factor * power;
  }
  return 10.0 * power;
}

/// From values of one curve to its band.
struct Band {
  double top = 0.0, highest = 0.0, scale = 1.0;  ///< y = top + (highest - value) * scale
  double lowest = 0.0;
  [[nodiscard]] double y(double value) const { return top + (highest - value) * scale; }
};

class Drawing {
 public:
  explicit Drawing(const AlignPlot& plot) : plot_(plot) {
    const double range = std::max({spread(plot.input), spread(plot.output), 1e-9}) * 1.12;
    input_band_ = band(plot.input, kTop, range);
    output_band_ = band(plot.output, kTop + kBandHeight + kBandGap, range);
    const auto frames = static_cast<double>(std::max(plot.input.size(), plot.output.size()) - 1);
    duration_ = std::max(frames, 1.0) / plot.frame_rate;
  }

  std::string draw() {
    const auto panels = static_cast<double>(1 + plot_.warped_input.size());
    const double width = kLeft + panels * kPanelWidth + (panels - 1) * kPanelGap + kRight;
    const double height = bottom() + kBottom;
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:g} {1:g}\" width=\"{0:g}\" height=\"{1:g}\" "
        "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"12\" fill=\"#333\">\n",
        width, height);
    add("<title>{}: {} aligned with {}</title>\n", escaped(plot_.quantity), escaped(plot_.input_name),
        escaped(plot_.output_name));
    add("<rect width=\"{:g}\" height=\"{:g}\" fill=\"#fff\"/>\n", width, height);
    legend();
    first_panel();
    double left = kLeft;
    for (const AlignPlot::Warp& warp : plot_.warped_input) warped_panel(left += kPanelWidth + kPanelGap, warp);
    svg_ += "</svg>\n";
    return std::move(svg_);
  }

 private:
  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(svg_), format, std::forward<Args>(args)...);
  }

  static double spread(const Eigen::VectorXd& values) { return values.maxCoeff() - values.minCoeff(); }

  static Band band(const Eigen::VectorXd& values, double top, double range) {
    const double middle = 0.5 * (values.maxCoeff() + values.minCoeff());
    return {top, middle + 0.5 * range, kBandHeight / range, middle - 0.5 * range};
  }

  static double bottom() { return kTop + 2 * kBandHeight + kBandGap; }
  [[nodiscard]] double x(double left, double frame) const {
    return left + frame / plot_.frame_rate / duration_ * kPanelWidth;
  }

  void legend() {
    double at = kLeft;
    for (const auto& [name, color] :
         {std::pair(plot_.input_name, kInputColor), std::pair(plot_.output_name, kOutputColor)}) {
      add("<line x1=\"{0:g}\" y1=\"16\" x2=\"{1:g}\" y2=\"16\" stroke=\"{2}\" stroke-width=\"2\"/>"
          "<text x=\"{3:g}\" y=\"20\">{4}</text>\n",
          at, at + 22, color, at + 28, escaped(name));
      at += 52 + 6.6 * static_cast<double>(name.size());
    }
  }

  /// A panel's frame, its title and its time axis.
  void axes(double left, const std::string& title, const std::string& time_of) {
    add("<text x=\"{:g}\" y=\"{:g}\" font-size=\"13\" font-weight=\"bold\">{}</text>\n", left, kTop - 12,
        escaped(title));
    for (const double top : {input_band_.top, output_band_.top}) {
      add("<rect x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\" fill=\"#f6f6f6\"/>\n", left, top, kPanelWidth,
          kBandHeight);
    }
    const double step = tick_step(duration_, 4);
    for (int k = 0; k * step <= duration_ * 1.0001; ++k) {
      const double at = left + k * step / duration_ * kPanelWidth;
      add("<line x1=\"{0:.1f}\" y1=\"{1:g}\" x2=\"{0:.1f}\" y2=\"{2:g}\" stroke=\"#999\"/>"
          "<text x=\"{0:.1f}\" y=\"{3:g}\" text-anchor=\"middle\">{4:g}</text>\n",
          at, bottom(), bottom() + 4, bottom() + 17, k * step);
    }
    add("<text x=\"{:g}\" y=\"{:g}\" text-anchor=\"middle\">{} [s]</text>\n", left + 0.5 * kPanelWidth, bottom() + 35,
        time_of);
  }

  /// The values beside the first panel.
  void value_axis(const Band& band, const char* color) {
    const double step = tick_step(band.highest - band.lowest, 4);
    for (double value = std::ceil(band.lowest / step) * step; value <= band.highest; value += step) {
      add("<line x1=\"{0:g}\" y1=\"{1:.1f}\" x2=\"{2:g}\" y2=\"{1:.1f}\" stroke=\"{3}\"/>"
          "<text x=\"{4:g}\" y=\"{5:.1f}\" text-anchor=\"end\" fill=\"{3}\">{6:g}</text>\n",
          kLeft - 4, band.y(value), kLeft, color, kLeft - 8, band.y(value) + 4,
          std::abs(value) < 1e-9 * step ? 0.0 : value);
    }
  }

  /// `values[t]` drawn at the frames `at[t]`.
  void curve(double left, const Eigen::VectorXd& at, const Eigen::VectorXd& values, const Band& band,
             const char* color) {
    add("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\" stroke-linejoin=\"round\" points=\"", color);
    for (Eigen::Index t = 0; t < values.size(); ++t) add("{:.1f},{:.1f} ", x(left, at[t]), band.y(values[t]));
    svg_ += "\"/>\n";
  }

  /// Lines from the input's frames, drawn at `input_at`, to the moments of the output they belong to.
  void ties(double left, const Eigen::VectorXd& input_at, const Eigen::VectorXd& output_time) {
    const Eigen::Index every = 1 + (plot_.input.size() - 1) / kMostTies;
    svg_ += "<g stroke=\"#888\" stroke-width=\"0.6\">\n";
    for (Eigen::Index t = 0; t < plot_.input.size(); t += every) {
      add("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>\n", x(left, input_at[t]),
          input_band_.y(plot_.input[t]), x(left, output_time[t]), output_band_.y(output_value(output_time[t])));
    }
    svg_ += "</g>\n";
  }

  [[nodiscard]] double output_value(double frame) const {
    const auto before = std::min(static_cast<Eigen::Index>(frame), plot_.output.size() - 1);
    const Eigen::Index after = std::min(before + 1, plot_.output.size() - 1);
    const double weight = frame - static_cast<double>(before);
    return (1.0 - weight) * plot_.output[before] + weight * plot_.output[after];
  }

  static Eigen::VectorXd own_frames(const Eigen::VectorXd& values) {
    return Eigen::VectorXd::LinSpaced(values.size(), 0.0, static_cast<double>(values.size() - 1));
  }

  void first_panel() {
    axes(kLeft, "Correspondence by " + plot_.correspondence.method, "time");
    value_axis(input_band_, kInputColor);
    value_axis(output_band_, kOutputColor);
    add("<text transform=\"translate(16 {:g}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        0.5 * (kTop + bottom()), escaped(plot_.quantity));
    ties(kLeft, own_frames(plot_.input), plot_.correspondence.output_time);
    curve(kLeft, own_frames(plot_.input), plot_.input, input_band_, kInputColor);
    curve(kLeft, own_frames(plot_.output), plot_.output, output_band_, kOutputColor);
  }

  void warped_panel(double left, const AlignPlot::Warp& warp) {
    axes(left, "Time-warped by " + warp.method, "output's time");
    ties(left, warp.output_time, warp.output_time);
    curve(left, warp.output_time, plot_.input, input_band_, kInputColor);
    curve(left, own_frames(plot_.output), plot_.output, output_band_, kOutputColor);
  }

  const AlignPlot& plot_;
  Band input_band_, output_band_;
  double duration_ = 1.0;
  std::string svg_;
};

}  // namespace

std::string draw_alignment(const AlignPlot& plot) {
  return Drawing(plot).draw();
}

}  // namespace strut::cli
