// SPDX-License-Identifier: MIT
#include "svg.h"

#include <algorithm>
#include <cmath>

namespace strut::cli {
namespace {

constexpr double kTickLength = 3.0;
constexpr double kDigitWidth = 6.2;     // of tick labels, in the widest of the fonts
constexpr double kCurveError = 0.06;    // an eighth of the thinnest line
constexpr double kPointsPerUnit = 2.0;  // finer than that a curve's points cannot be told apart

/// A number with two decimals at most and no more digits than it needs.
std::string number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
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

std::string tick_label(double value) {
  std::string text = fmt::format("{:g}", value);
  if (text[0] == '-') text.replace(0, 1, "\u2212");
  return text;
}

std::vector<Tick> logarithmic_ticks(const Scale& scale) {
  const double base = scale.high / scale.low > 100.0 ? 10.0 : 2.0;
  std::vector<Tick> result;
  const double reach = 1.0 + 1e-9;
  for (double power = std::ceil(std::log(scale.low / reach) / std::log(base));; power += 1.0) {
    const double value = std::pow(base, power);
    if (value > scale.high * reach) return result;
    result.push_back({value, value < 1.0 ? fmt::format("1/{:g}", 1.0 / value) : fmt::format("{:g}", value)});
  }
}

/// Of the points that fall onto one place across the page, the first, lowest, highest and last.
std::vector<Point> thinned(const std::vector<Point>& points) {
  std::vector<Point> kept;
  for (std::size_t begin = 0; begin < points.size();) {
    const double column = std::floor(points[begin].x * kPointsPerUnit);
    std::size_t end = begin, lowest = begin, highest = begin;
    for (; end < points.size() && std::floor(points[end].x * kPointsPerUnit) == column; ++end) {
      if (points[end].y < points[lowest].y) lowest = end;
      if (points[end].y > points[highest].y) highest = end;
    }
    std::vector<std::size_t> chosen{begin, std::min(lowest, highest), std::max(lowest, highest), end - 1};
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (const std::size_t i : chosen) kept.push_back(points[i]);
    begin = end;
  }
  return kept;
}

/// Marks the points between `begin` and `end` that are needed to stay within kCurveError of all (Douglas and Peucker).
void mark_needed(const std::vector<Point>& points, std::size_t begin, std::size_t end, std::vector<bool>& needed) {
  std::vector<std::pair<std::size_t, std::size_t>> pending{{begin, end}};
  while (!pending.empty()) {
    const auto [first, last] = pending.back();
    pending.pop_back();
    const Point a = points[first], b = points[last];
    const double length = std::max(std::hypot(b.x - a.x, b.y - a.y), 1e-9);
    double farthest = kCurveError;
    std::size_t split = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double off = std::abs((b.x - a.x) * (points[i].y - a.y) - (b.y - a.y) * (points[i].x - a.x)) / length;
      if (off > farthest) {
        farthest = off;
        split = i;
      }
    }
    if (split == first) continue;
    needed[split] = true;
    pending.emplace_back(first, split);
    pending.emplace_back(split, last);
  }
}

/// The points a curve through all of them needs on paper.
std::vector<Point> simplified(const std::vector<Point>& points) {
  if (points.size() < 3) return points;
  std::vector<bool> needed(points.size(), false);
  needed.front() = needed.back() = true;
  mark_needed(points, 0, points.size() - 1, needed);
  std::vector<Point> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (needed[i]) kept.push_back(points[i]);
  }
  return kept;
}

bool continues_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

std::size_t num_characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char byte) { return !continues_character(byte); }));
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return result;
}

std::string shortened(const std::string& text, std::size_t most) {
  if (num_characters(text) <= most) return text;
  std::size_t head = (most - 1) / 3, tail = text.size() - (most - 1 - head);
  while (head > 0 && continues_character(text[head])) --head;
  while (tail < text.size() && continues_character(text[tail])) ++tail;
  return text.substr(0, head) + "\u2026" + text.substr(tail);
}

double Scale::at(double value) const {
  const double share = logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
  return from + share * (to - from);
}

std::vector<Tick> ticks(const Scale& scale, int count) {
  if (scale.logarithmic) return logarithmic_ticks(scale);
  const double step = tick_step(scale.high - scale.low, count);
  std::vector<Tick> result;
  const double reach = 1e-6;  // steps: a tick at the very end is not lost to rounding
  const double last = std::floor(scale.high / step + reach);
  for (double k = std::ceil(scale.low / step - reach); k <= last; k += 1.0) {
    result.push_back({k * step, tick_label(k == 0.0 ? 0.0 : k * step)});
  }
  return result;
}

void Svg::text(Point at, const std::string& text, const std::string& attributes) {
  add("<text x=\"{}\" y=\"{}\"{}{}>{}</text>\n", number(at.x), number(at.y), attributes.empty() ? "" : " ", attributes,
      escaped(text));
}

void Svg::text_upwards(Point at, const std::string& text) {
  add("<text transform=\"translate({} {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n", number(at.x), number(at.y),
      escaped(text));
}

void Svg::line(Point from, Point to, const std::string& attributes) {
  add("<path d=\"M{} {}L{} {}\"{}{}/>\n", number(from.x), number(from.y), number(to.x), number(to.y),
      attributes.empty() ? "" : " ", attributes);
}

void Svg::box(Point corner, double width, double height, const std::string& attributes) {
  add("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n", number(corner.x), number(corner.y), number(width),
      number(height), attributes);
}

void Svg::curve(const std::vector<Point>& points, const std::string& attributes) {
  add("<polyline fill=\"none\" stroke-linejoin=\"round\" {} points=\"", attributes);
  for (const Point& point : simplified(thinned(points))) add("{},{} ", number(point.x), number(point.y));
  add("\"/>\n");
}

void Svg::axis_below(const Scale& x, double y, const std::string& label, int count) {
  axis_along(x, y, label, count, false);
}

void Svg::axis_above(const Scale& x, double y, const std::string& label, int count) {
  axis_along(x, y, label, count, true);
}

void Svg::axis_along(const Scale& x, double y, const std::string& label, int count, bool is_above) {
  const double mark = is_above ? -kTickLength : kTickLength;
  begin_group("stroke=\"#333\" stroke-width=\"0.7\"");
  line({x.from, y}, {x.to, y});
  for (const Tick& tick : ticks(x, count)) line({x.at(tick.value), y}, {x.at(tick.value), y + mark});
  end_group();
  begin_group("text-anchor=\"middle\"");
  for (const Tick& tick : ticks(x, count)) text({x.at(tick.value), y + (is_above ? -6.0 : 13.0)}, tick.label);
  if (!label.empty()) text({0.5 * (x.from + x.to), y + (is_above ? -19.0 : 26.0)}, label);
  end_group();
}

void Svg::axis_left(const Scale& y, double x, const std::string& label, int count) {
  begin_group("stroke=\"#333\" stroke-width=\"0.7\"");
  line({x, y.from}, {x, y.to});
  for (const Tick& tick : ticks(y, count)) line({x - kTickLength, y.at(tick.value)}, {x, y.at(tick.value)});
  end_group();
  begin_group("text-anchor=\"end\"");
  for (const Tick& tick : ticks(y, count)) text({x - 5.0, y.at(tick.value) + 3.3}, tick.label);
  end_group();
  std::size_t longest = 0;
  for (const Tick& tick : ticks(y, count)) longest = std::max(longest, num_characters(tick.label));
  const double beside = 12.0 + kDigitWidth * static_cast<double>(longest);
  if (!label.empty()) text_upwards({x - beside, 0.5 * (y.from + y.to)}, label);
}

void Svg::begin_clip(Point corner, double width, double height) {
  add("<clipPath id=\"clip{}\">", ++num_clips_);
  box(corner, width, height, "");
  add("</clipPath>\n");
  begin_group(fmt::format("clip-path=\"url(#clip{})\"", num_clips_));
}

std::string Svg::finish(double height, const std::string& title, const std::string& description) const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
      "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"10\" fill=\"#222\">\n"
      "<title>{2}</title>\n<desc>{3}</desc>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{4}</svg>\n",
      number(width_), number(height), escaped(title), escaped(description), body_);
}

}  // namespace strut::cli
