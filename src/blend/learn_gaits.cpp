// SPDX-License-Identifier: MIT
// cells -> numbers in comparable units -> settings by left-out cells -> the model of all cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <Eigen/QR>
#include <tbb/parallel_for.h>

#include <strut/blend/bilinear.h>
#include <strut/blend/learn_gaits.h>
#include <strut/core/error.h>

namespace strut::blend {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::array kFunctions{3, 4};  // tried: a parabola or a cubic of the logarithm of the speed
constexpr std::array kRidges{0.001, 0.01, 0.1, 1.0, 10.0};  // tried
constexpr int kMostContentDims = 3;                         // tried
constexpr std::array kStyleDims{2, 4, 8};                   // tried
constexpr int kFolds = 8;  // at most, in which every style misses as few cells as may be

std::size_t at(Index index) {
  return static_cast<std::size_t>(index);
}

/// The numbers of a bilinear model.
struct Settings {
  int style_dims = 1, content_dims = 1, functions = 1;
  double ridge = 0.0;
  bool is_relative = true;  // speeds are those over the style's typical
};

/// Cells as vectors in which every kind of signal varies as much as joint angles do.
class Cells {
 public:
  explicit Cells(const GaitExamples& examples)
      : num_signals_(examples.representation->num_dofs() + 1), cells_(examples.cells) {
    std::map<int, int> per_style;
    for (const GaitCell& cell : cells_) {
      FrameMatrix series = cell.loop.series();
      series.topRows<2>() /= std::max(cell.loop.velocity().norm(), 1e-3);  // as shares of the speed
      values_.push_back(GaitLoop(std::move(series), cell.loop.plants()).packed());
      most_per_style_ = std::max(most_per_style_, ++per_style[cell.style]);
    }
    mean_ = std::accumulate(values_.begin(), values_.end(), VectorXd(VectorXd::Zero(values_.front().size())));
    mean_ /= static_cast<double>(values_.size());
    find_scale();
    MatrixXd all(mean_.size(), count());
    for (Index i = 0; i < count(); ++i) all.col(i) = (values_[at(i)] - mean_).cwiseQuotient(scale_);
    const Index rank = std::min(all.rows(), all.cols());
    span_ = Eigen::HouseholderQR<MatrixXd>(all).householderQ() * MatrixXd::Identity(all.rows(), rank);
    for (Index i = 0; i < count(); ++i) values_[at(i)] = span_.transpose() * all.col(i);
  }

  [[nodiscard]] Index count() const { return static_cast<Index>(cells_.size()); }
  [[nodiscard]] const GaitCell& cell(Index i) const { return cells_[at(i)]; }
  [[nodiscard]] const VectorXd& values(Index i) const { return values_[at(i)]; }
  /// Cells of the style that has most.
  [[nodiscard]] int most_per_style() const { return most_per_style_; }

  /// A cell of many cycles is known better than one of few; cells differ by more than that from any model.
  [[nodiscard]] double weight(Index i) const { return cell(i).num_cycles / (cell(i).num_cycles + 1.0); }

  /// Coefficients for values as those of the packed loops.
  [[nodiscard]] MatrixXd unscaled(const MatrixXd& coefficients) const {
    MatrixXd own = scale_.asDiagonal() * (span_ * coefficients);
    own.col(0) += mean_;
    return own;
  }

  /// Root mean square over cycle and joints of what a difference of values amounts to in rotation [rad].
  [[nodiscard]] double angle(const VectorXd& of_values) const {
    const VectorXd difference = span_ * of_values;
    const Index columns = (difference.size() - 4) / num_signals_;
    const Index first = representation::kTiltX * columns, size = (num_signals_ - 1) * columns - first;
    const Index joints = (num_signals_ - 1 - representation::kNumRootDofs) / 3 + 1;  // the tilt counts as one
    return std::sqrt(difference.segment(first, size).squaredNorm() / static_cast<double>(joints));
  }

 private:
  void find_scale() {
    const Index columns = (mean_.size() - 4) / num_signals_;
    scale_ = VectorXd::Ones(mean_.size());
    VectorXd varies = VectorXd::Zero(mean_.size());
    for (const VectorXd& value : values_) varies += (value - mean_).cwiseAbs2();
    // Rows of one kind, in signals: velocities, turning, height, time; then the four phases.
    const Index angles = representation::kTiltX * columns;
    const Index angle_count = num_signals_ - 1 - representation::kTiltX;
    const double unit =
        std::sqrt(varies.segment(angles, angle_count * columns).sum() / static_cast<double>(angle_count));
    const auto bring = [&](Index first, Index size, double signals) {
      const double own = std::sqrt(varies.segment(first, size).sum() / signals);
      if (own > 1e-9 && unit > 1e-9) scale_.segment(first, size).setConstant(own / unit);
    };
    bring(0, 2 * columns, 2.0);
    bring(representation::kTurningRate * columns, columns, 1.0);
    bring(representation::kHeight * columns, columns, 1.0);
    bring((num_signals_ - 1) * columns, columns, 1.0);
    bring(num_signals_ * columns, 4, 4.0);
  }

  Index num_signals_;
  std::vector<GaitCell> cells_;
  std::vector<VectorXd> values_;
  VectorXd mean_, scale_;
  MatrixXd span_;  // of the cells: values_ are coordinates in it
  int most_per_style_ = 0;
};

/// A model of some cells, with the typical speeds that belong to it.
struct Fit {
  BilinearModel model;
  SpeedBasis basis;
  VectorXd log_typical;  ///< per style [ln m/s]

  [[nodiscard]] VectorXd at(const GaitCell& cell) const {
    const auto style = static_cast<std::size_t>(cell.style);
    return model.coefficients[style] * basis.at(cell.speed / std::exp(log_typical[cell.style]));
  }
};

/// Logarithms of the styles' typical speeds: the mean of each style's cells, or one for all.
VectorXd log_typical_of(const Cells& cells, int num_styles, const std::vector<Index>& used, bool is_relative) {
  VectorXd sum = VectorXd::Zero(num_styles), count = VectorXd::Zero(num_styles);
  for (const Index i : used) {
    sum[cells.cell(i).style] += std::log(cells.cell(i).speed);
    count[cells.cell(i).style] += 1.0;
  }
  if (is_relative) return sum.cwiseQuotient(count);
  return VectorXd::Constant(num_styles, sum.sum() / count.sum());
}

/// The model of all cells but `left_out`.
Fit fit(const Cells& cells, int num_styles, BilinearKind kind, const Settings& settings,
        const std::vector<Index>& left_out, BilinearOptions options) {
  std::vector<Index> used;
  for (Index i = 0; i < cells.count(); ++i) {
    if (std::find(left_out.begin(), left_out.end(), i) == left_out.end()) used.push_back(i);
  }
  const VectorXd log_typical = log_typical_of(cells, num_styles, used, settings.is_relative);
  std::vector<double> ratios;
  for (const Index i : used) ratios.push_back(cells.cell(i).speed / std::exp(log_typical[cells.cell(i).style]));
  const auto [slowest, fastest] = std::minmax_element(ratios.begin(), ratios.end());
  // Where leaving cells out leaves a single speed per style, there is nothing to say about others.
  const int functions = *fastest > (1.0 + 1e-9) * *slowest ? settings.functions : 1;
  const int content_dims = std::min(functions, settings.content_dims);
  const SpeedBasis basis(*slowest, *fastest, functions);
  std::vector<BilinearObservation> observations;
  for (std::size_t k = 0; k < used.size(); ++k) {
    observations.push_back(
        {cells.cell(used[k]).style, basis.at(ratios[k]), cells.values(used[k]), cells.weight(used[k])});
  }
  options.ridge = settings.ridge;
  return {kind == BilinearKind::kAsymmetric
              ? fit_asymmetric(observations, num_styles, content_dims, options)
              : fit_symmetric(observations, num_styles, settings.style_dims, content_dims, options),
          basis, log_typical};
}

/// Cells that may be left out: their style has another.
std::vector<Index> may_be_left_out(const Cells& cells) {
  std::vector<Index> found;
  for (Index i = 0; i < cells.count(); ++i) {
    for (Index k = 0; k < cells.count(); ++k) {
      if (k == i || cells.cell(k).style != cells.cell(i).style) continue;
      found.push_back(i);
      break;
    }
  }
  return found;
}

VectorXd style_mean(const Cells& cells, Index i) {
  VectorXd sum = VectorXd::Zero(cells.values(i).size());
  double count = 0.0;
  for (Index k = 0; k < cells.count(); ++k) {
    if (k == i || cells.cell(k).style != cells.cell(i).style) continue;
    sum += cells.values(k);
    count += 1.0;
  }
  return sum / count;
}

VectorXd nearest(const Cells& cells, Index i) {
  Index best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < cells.count(); ++k) {
    const double away = std::abs(std::log(cells.cell(k).speed / cells.cell(i).speed));
    if (k == i || cells.cell(k).style != cells.cell(i).style || away >= least) continue;
    least = away;
    best = k;
  }
  return cells.values(best);
}

/// Least squares over all other cells: a parabola of the speed's root, and a constant per style where `styles` is
/// above 1.
VectorXd shared_fit(const Cells& cells, int styles, Index i) {
  const auto design = [&](Index k) {
    VectorXd row = VectorXd::Zero(styles + 2);
    row[styles > 1 ? cells.cell(k).style : 0] = 1.0;
    row.tail<2>() << std::sqrt(cells.cell(k).speed), cells.cell(k).speed;
    return row;
  };
  MatrixXd left(cells.count() - 1, styles + 2), right(cells.count() - 1, cells.values(i).size());
  Index row = 0;
  for (Index k = 0; k < cells.count(); ++k) {
    if (k == i) continue;
    left.row(row) = design(k);
    right.row(row++) = cells.values(k);
  }
  return left.completeOrthogonalDecomposition().solve(right).transpose() * design(i);
}

/// The settings to be tried, those given fixed.
std::vector<Settings> candidates(const GaitLearnOptions& options, int num_styles, int most_cells) {
  std::vector<int> function_counts, content_dims, style_dims{num_styles};
  for (const int functions : kFunctions) {
    if (function_counts.empty() || functions <= most_cells) function_counts.push_back(std::min(functions, most_cells));
  }
  for (int dims = 1; dims <= kMostContentDims; ++dims) content_dims.push_back(dims);
  if (options.speed_functions) function_counts = {*options.speed_functions};
  if (options.kind == BilinearKind::kSymmetric) {
    for (const int dims : kStyleDims) {
      if (dims < num_styles) style_dims.push_back(dims);
    }
  }
  if (options.content_dims) content_dims = {*options.content_dims};
  if (options.style_dims && options.kind == BilinearKind::kSymmetric) style_dims = {*options.style_dims};
  std::vector<double> ridges(kRidges.begin(), kRidges.end());
  if (options.ridge) ridges = {*options.ridge};
  std::vector<bool> relative{true, false};
  if (options.relative_speed) relative = {*options.relative_speed};
  std::vector<Settings> all;
  for (const int functions : function_counts) {
    for (const int content : content_dims) {
      for (const int style : style_dims) {
        for (const double ridge : ridges) {
          for (const bool is_relative : relative) all.push_back({style, content, functions, ridge, is_relative});
        }
      }
    }
  }
  std::erase_if(all, [](const Settings& settings) { return settings.content_dims > settings.functions; });
  return all;
}

/// `left_out` dealt out so that a style misses as few cells at a time as may be.
std::vector<std::vector<Index>> folds_of(const std::vector<Index>& left_out) {
  const std::size_t count = std::min<std::size_t>(kFolds, left_out.size());
  std::vector<std::vector<Index>> folds(count);
  for (std::size_t k = 0; k < left_out.size(); ++k) folds[k % count].push_back(left_out[k]);
  return folds;
}

void check(const GaitExamples& examples, const GaitLearnOptions& options) {
  const int styles = static_cast<int>(examples.styles.size());
  if (styles < 2) {
    throw InvalidArgument("examples", "cycles of two styles or more", std::to_string(styles),
                          "with one style there is nothing to blend");
  }
  const auto check_range = [](const char* name, const std::optional<int>& value, int most) {
    if (!value || (*value >= 1 && *value <= most)) return;
    throw InvalidArgument(name, "1 to " + std::to_string(most), std::to_string(*value));
  };
  check_range("style_dims", options.style_dims, styles);
  check_range("speed_functions", options.speed_functions, 6);
  check_range("content_dims", options.content_dims, options.speed_functions.value_or(kMostContentDims));
  if (options.ridge && !(*options.ridge > 0.0 && std::isfinite(*options.ridge))) {
    throw InvalidArgument("ridge", "a positive number", std::to_string(*options.ridge));
  }
}

/// Summed squared error of predicting the cells of every fold from the others.
double left_out_error(const Cells& cells, int num_styles, BilinearKind kind, const Settings& settings,
                      const std::vector<std::vector<Index>>& folds) {
  double sum = 0.0;
  for (const std::vector<Index>& fold : folds) {
    const Fit made = fit(cells, num_styles, kind, settings, fold, {.max_rounds = 20, .tolerance = 1e-4});
    for (const Index i : fold) sum += (made.at(cells.cell(i)) - cells.values(i)).squaredNorm();
  }
  return sum;
}

Settings choose(const Cells& cells, int num_styles, const GaitLearnOptions& options,
                const std::vector<Index>& left_out) {
  const std::vector<Settings> tried = candidates(options, num_styles, cells.most_per_style());
  if (tried.empty()) {
    throw InvalidArgument("content_dims", "at most as many as there are functions of the speed, or speeds of a style",
                          std::to_string(options.content_dims.value_or(0)));
  }
  if (left_out.empty() || tried.size() == 1) return tried.front();
  const auto folds = folds_of(left_out);
  std::vector<double> errors(tried.size());
  tbb::parallel_for(std::size_t{0}, tried.size(), [&](std::size_t k) {
    errors[k] = left_out_error(cells, num_styles, options.kind, tried[k], folds);
  });
  return tried[at(std::min_element(errors.begin(), errors.end()) - errors.begin())];
}

LeftOutCell judged(const Cells& cells, int num_styles, BilinearKind kind, const Settings& settings, Index i) {
  const auto error = [&](const VectorXd& prediction) { return cells.angle(prediction - cells.values(i)); };
  const Fit made = fit(cells, num_styles, kind, settings, {i}, {});
  return {cells.cell(i).style,
          cells.cell(i).speed,
          {error(made.at(cells.cell(i))), error(style_mean(cells, i)), error(shared_fit(cells, 1, i)),
           error(nearest(cells, i)), error(shared_fit(cells, num_styles, i))}};
}

void judge(const Cells& cells, int num_styles, BilinearKind kind, const Settings& settings,
           const std::vector<Index>& left_out, GaitReport& report) {
  report.left_out.resize(left_out.size());
  tbb::parallel_for(std::size_t{0}, left_out.size(), [&](std::size_t k) {
    report.left_out[k] = judged(cells, num_styles, kind, settings, left_out[k]);
  });
  const double share = 1.0 / std::max(1.0, static_cast<double>(left_out.size()));
  for (const LeftOutCell& cell : report.left_out) {
    report.mean.bilinear += share * cell.errors.bilinear;
    report.mean.style_only += share * cell.errors.style_only;
    report.mean.speed_only += share * cell.errors.speed_only;
    report.mean.nearest += share * cell.errors.nearest;
    report.mean.additive += share * cell.errors.additive;
  }
}

/// The styles with what their examples show.
std::vector<GaitStyle> styles_of(const GaitExamples& examples, const Cells& cells, const Fit& made) {
  std::vector<GaitStyle> styles;
  for (std::size_t s = 0; s < examples.styles.size(); ++s) {
    GaitStyle style{examples.styles[s],
                    cells.unscaled(made.model.coefficients[s]),
                    std::exp(made.log_typical[static_cast<Index>(s)]),
                    std::numeric_limits<double>::infinity(),
                    0.0,
                    0};
    for (const GaitCell& cell : examples.cells) {
      if (cell.style != static_cast<int>(s)) continue;
      style.slowest = std::min(style.slowest, cell.speed);
      style.fastest = std::max(style.fastest, cell.speed);
      style.num_cycles += cell.num_cycles;
    }
    styles.push_back(std::move(style));
  }
  return styles;
}

void warn_of_single_speeds(const std::vector<GaitStyle>& styles, Diagnostics* diagnostics) {
  if (diagnostics == nullptr) return;
  for (const GaitStyle& style : styles) {
    if (style.fastest > style.slowest) continue;
    diagnostics->warn("blend", "the examples of style '" + style.name + "' all have about one speed",
                      "how it changes with speed is taken from the mean of all styles");
  }
}

}  // namespace

LearntGaits learn_gaits(const GaitExamples& examples, const GaitLearnOptions& options,
                        const std::function<std::string(const GaitReport&)>& provenance, Diagnostics* diagnostics) {
  check(examples, options);
  const Cells cells(examples);
  const int num_styles = static_cast<int>(examples.styles.size());
  const std::vector<Index> left_out = may_be_left_out(cells);
  const Settings settings = choose(cells, num_styles, options, left_out);
  GaitReport report{.num_cells = static_cast<int>(cells.count()),
                    .style_dims = settings.style_dims,
                    .content_dims = settings.content_dims,
                    .speed_functions = settings.functions,
                    .ridge = settings.ridge,
                    .relative_speed = settings.is_relative};
  judge(cells, num_styles, options.kind, settings, left_out, report);
  const Fit made = fit(cells, num_styles, options.kind, settings, {}, {});
  report.converged = made.model.converged;
  std::vector<GaitStyle> styles = styles_of(examples, cells, made);
  for (const GaitStyle& style : styles) report.num_cycles += style.num_cycles;
  warn_of_single_speeds(styles, diagnostics);
  if (left_out.empty() && diagnostics != nullptr) {
    diagnostics->warn("blend", "no style has two speeds, so that nothing could be left out to judge the model by");
  }
  const std::string origin = provenance ? provenance(report) : std::string();
  return {std::make_shared<const GaitModel>(
              GaitModelParts{examples.representation, examples.frame_rate, made.basis, std::move(styles), origin}),
          std::move(report)};
}

}  // namespace strut::blend
