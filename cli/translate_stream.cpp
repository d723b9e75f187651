// SPDX-License-Identifier: MIT
#include "translate_stream.h"

#include "feet_options.h"
#include "input_files.h"
#include "live_files.h"
#include "terminal.h"

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include <strut/core/error.h>
#include <strut/io/bvh_stream.h>
#include <strut/representation/representation.h>
#include <strut/translate/translator.h>

namespace strut::cli {
namespace {

std::string name_of(const std::string& path) {
  return path == "-" ? "<stdin>" : path;
}

/// The rows that went in and whose pose has not come out yet, to write unchanged angles as the source has them.
class SourceRows {
 public:
  void push(std::span<const double> row) { rows_.emplace_back(row.begin(), row.end()); }
  /// The oldest one's numbers, which stay until the next call.
  std::span<const double> pop() {
    oldest_ = std::move(rows_.front());
    rows_.pop_front();
    return oldest_;
  }

 private:
  std::deque<std::vector<double>> rows_;
  std::vector<double> oldest_;
};

void check_fits(const StyleModel& model, const BvhRowReader& reader, const std::string& name) {
  try {
    representation::check_skeleton(model.input(), *reader.shared_skeleton());
  } catch (const SkeletonMismatch& error) {
    refuse_clip(name, error);
  }
  if (reader.frame_rate() == model.frame_rate()) return;
  throw BadInput(name,
                 fmt::format("runs at {:g} frames per second, the model at {:g}, and a stream is not resampled",
                             reader.frame_rate(), model.frame_rate()),
                 "translate the whole clip, which is; or learn with --frame-rate");
}

/// Everything between the first byte in and the last row out.
class StreamTranslation {
 public:
  StreamTranslation(const StyleArguments& style, const StreamArguments& stream, const InterruptSignals& signals)
      : keeps_layout_(stream.keep_layout), input_(stream.input, signals) {
    const auto models = read_models(style);
    if (stream.is_followed) input_.follow({stream.idle, [this] { return has_all_it_claims(); }});
    reader_.emplace([this](char* to, std::size_t size) { return input_.read(to, size); }, name_of(stream.input),
                    stream.read, &diagnostics_);
    check_fits(*models.front(), *reader_, name_of(stream.input));
    const BvhLayout layout = wanted_layout();
    translator_.emplace(models, options(style, stream.clean_feet, layout, *models.front()));
    writer_.emplace(reader_->shared_skeleton(), reader_->frame_rate(), layout);
    output_.emplace(stream.output, overwrite_if(stream.force), signals);
    print_diagnostics(std::exchange(diagnostics_, {}));  // now and not at the end, which may be hours away
  }

  /// As many rows out as in, also where an interrupt ends the input.
  void run() {
    output_->write(writer_->header(reader_->claimed_frames()));
    try {
      translate_rows();
    } catch (const Interrupted&) {
      // What had come by then is to come out.
    } catch (const Error&) {
      give_the_rest();
      throw;
    }
    give_the_rest();
  }

  /// What was found out on the way.
  void report() {
    writer_->report(diagnostics_);
    print_diagnostics(diagnostics_);
  }
  [[nodiscard]] long long num_written() const { return num_written_; }

 private:
  void translate_rows() {
    while (reader_->next(pose_)) {
      sources_.push(reader_->row());
      if (translator_->push(pose_, pose_)) write_row();
    }
  }
  void give_the_rest() {
    while (translator_->flush(pose_)) write_row();
  }

  [[nodiscard]] bool has_all_it_claims() const {
    return reader_ && reader_->claimed_frames() > 0 && reader_->num_rows() >= reader_->claimed_frames();
  }

  static TranslatorOptions options(const StyleArguments& style, bool clean_feet, const BvhLayout& layout,
                                   const StyleModel& model) {
    TranslatorOptions options{
        .controls = style.controls, .generalization = style.generalization, .clean_feet = clean_feet};
    const auto& skeleton = model.output().shared_skeleton();
    const auto legs = motion::find_legs(Motion(skeleton, 1.0, {representation::mean_pose(model.output())}));
    if (!legs || !holds_stretch(layout, *legs)) options.footskate.max_stretch = 0.0;
    return options;
  }

  [[nodiscard]] BvhLayout wanted_layout() const {
    const BvhLayout& source = reader_->layout();
    return keeps_layout_ ? source : default_layout(*reader_->shared_skeleton(), source.unit, source.up);
  }

  void write_row() {
    const std::span<const double> source = sources_.pop();
    output_->write(keeps_layout_ ? writer_->row(pose_, source) : writer_->row(pose_));
    ++num_written_;
  }

  bool keeps_layout_;
  Diagnostics diagnostics_;
  LiveInput input_;
  std::optional<BvhRowReader> reader_;
  std::optional<Translator> translator_;
  std::optional<BvhRowWriter> writer_;
  std::optional<LiveOutput> output_;
  SourceRows sources_;
  Pose pose_;
  long long num_written_ = 0;
};

}  // namespace

void translate_stream(const StyleArguments& style, const StreamArguments& stream) {
  std::vector<std::string> inputs = style.paths();
  if (stream.input != "-") inputs.push_back(stream.input);
  if (stream.output != "-") check_output(stream.output, inputs, overwrite_if(stream.force));
  const InterruptSignals signals;
  try {
    StreamTranslation translation(style, stream, signals);
    try {
      translation.run();
    } catch (const OutputClosed&) {
      // Whoever read has seen enough.
    }
    translation.report();
    if (stream.output != "-") fmt::print("{}: {} frames\n", stream.output, translation.num_written());
  } catch (const Interrupted&) {
    // Before the first row.
  }
}

}  // namespace strut::cli
