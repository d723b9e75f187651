// SPDX-License-Identifier: MIT
// One file that holds everything the Effort engine learns from: clips of one skeleton, the fragments they are cut into,
// which fragments can be blended, what people say of fragments and blends, and, apart from that, what was estimated.
// It opens at once however long it is; frames are read when asked for. A crash loses nothing that was committed.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <strut/core/diagnostics.h>
#include <strut/effort/effort.h>
#include <strut/motion/annotation.h>
#include <strut/motion/motion.h>

namespace strut::effort {

/// The number of a record; it is never given again in this database, even when the record is gone. From 1.
using RecordId = std::int64_t;

/// Who decided where a clip is cut.
enum class CutSource { kSuggested, kPerson };

/// A clip to be added. Performer and action serve cross-validation; empty where they are not known.
struct NewClip {
  std::string name;       ///< unique in the database, e.g. the file's path as given
  std::string performer;  ///< who moves
  std::string action;     ///< what is done
};

/// A clip of the database.
struct ClipRecord {
  RecordId id = 0;
  std::string name, performer, action;  ///< as NewClip
  int num_frames = 0;                   ///< at the database's frame rate
};

/// A unit of movement: some frames of a clip.
struct FragmentRecord {
  RecordId id = 0;
  RecordId clip = 0;
  std::string clip_name, performer, action;  ///< the clip's
  motion::FrameRange frames;                 ///< of the clip
  CutSource cut = CutSource::kSuggested;
  int group = -1;  ///< of like content, from 0; -1: none
};

/// Whether two fragments may be blended.
enum class PairStatus { kRejected, kAccepted, kRejectedByPerson, kAcceptedByPerson };

/// Two fragments that were compared. What a person says of them stands above the threshold, and is kept when
/// fragments are matched again.
struct PairRecord {
  RecordId first = 0, second = 0;  ///< fragments, first < second
  double cost = 0.0;            ///< mean distance along the alignment [m]; kNotRated if a person alone names the pair
  double share_at_limit = 0.0;  ///< of the alignment, at a slope limit, 0 ... 1; kNotRated as above
  PairStatus status = PairStatus::kRejected;

  [[nodiscard]] bool is_accepted() const {
    return status == PairStatus::kAccepted || status == PairStatus::kAcceptedByPerson;
  }
};

/// A blend that was or will be shown to raters, kept so that it can be labelled.
struct BlendRecord {
  RecordId id = 0;
  RecordId first = 0, second = 0;  ///< fragments, first < second
  double alpha = 0.0;              ///< 0: the first, 1: the second
};

/// What a label is about.
enum class TargetKind { kFragment, kBlend };
struct LabelTarget {
  TargetKind kind = TargetKind::kFragment;
  RecordId id = 0;  ///< of the fragment or the blend
  friend bool operator==(const LabelTarget&, const LabelTarget&) = default;
  friend bool operator<(const LabelTarget& a, const LabelTarget& b) {
    return a.kind == b.kind ? a.id < b.id : a.kind < b.kind;
  }
};

/// Where a label comes from. A synthetic rater is a formula that stands in for a person in a study. Estimates are no
/// labels and have a record of their own.
enum class LabelSource { kPerson, kSynthetic };

/// What one rater said of one fragment or blend at one time.
struct LabelRecord {
  RecordId id = 0;  ///< given by the database
  LabelTarget target;
  std::string rater;        ///< not empty
  std::string labelled_at;  ///< ISO 8601, e.g. "2026-03-01T14:05:00Z"
  LabelSource source = LabelSource::kPerson;
  Rating rating = Rating::Constant(kNotRated);  ///< in [-1, 1]; kNotRated where a factor was left out
  std::array<bool, kNumFactors> not_present{};  ///< the rater says that the factor does not show here; then not rated
  bool is_repeat = false;                       ///< shown again without the rater knowing, to see how well they repeat
  std::string comment;                          ///< one line
};

/// The labels that people gave one fragment or blend, brought together: each rater's mean first, then the mean over
/// raters.
struct MeanLabel {
  LabelTarget target;
  Rating mean = Rating::Constant(kNotRated);             ///< kNotRated where nobody rated the factor
  Eigen::Vector4i num_raters = Eigen::Vector4i::Zero();  ///< that rated each factor
  struct RaterCount {
    std::string rater;
    int num_labels = 0;
  };
  std::vector<RaterCount> raters;  ///< by name
};

/// Starting values for labelling, made by the program. Never returned where labels are asked for.
struct EstimateRecord {
  RecordId fragment = 0;
  EffortVector effort = EffortVector::Constant(kNotRated);  ///< in [-1, 1]
  EffortVector confidence = EffortVector::Zero();           ///< 0 ... 1, per factor
};

/// How many of what a database holds.
struct DatabaseCounts {
  std::int64_t clips = 0, frames = 0, fragments = 0, groups = 0, pairs = 0, accepted_pairs = 0, blends = 0, labels = 0,
               raters = 0, estimates = 0;
};

/// How a database is opened.
enum class Access { kRead, kReadWrite };

/// What happens to labels of fragments that are cut away.
enum class OnLabels { kRefuse, kDiscard };

/// Whether bytes begin as a fragment database does (the first 100 bytes of a file are enough).
bool is_fragment_database(std::string_view bytes) noexcept;

/// The database. Every writing function is one transaction: all of it or nothing, also after a crash. Const functions
/// are thread-safe. Everything may throw FileError (disk full, no permission, another program writes for longer than
/// five seconds) and ParseError (damaged bytes).
class FragmentDatabase {
 public:
  /// Makes an empty database. Throws FileError if the file exists or cannot be written, InvalidArgument if the
  /// skeleton is null or the rate is not positive and finite.
  static FragmentDatabase create(const std::string& path, const std::shared_ptr<const Skeleton>& skeleton,
                                 double frame_rate);
  /// Opens one. Throws FileError if it cannot be read (or written), ParseError if it is another kind of file,
  /// VersionError if a newer strut made it. Cost: a few pages, whatever its size.
  static FragmentDatabase open(const std::string& path, Access access = Access::kRead);
  FragmentDatabase(FragmentDatabase&&) noexcept;
  FragmentDatabase& operator=(FragmentDatabase&&) noexcept;
  ~FragmentDatabase();

  [[nodiscard]] const std::string& path() const noexcept;
  [[nodiscard]] const std::shared_ptr<const Skeleton>& skeleton() const noexcept;
  [[nodiscard]] double frame_rate() const noexcept;  ///< [frames/s]
  [[nodiscard]] DatabaseCounts counts() const;
  /// Reads every page and throws ParseError, with SQLite's words, where something is damaged. Cost: the whole file.
  void check_integrity() const;

  /// Adds a clip and its fragments: `cuts` ascend and do not overlap. The motion is resampled to the database's rate,
  /// with a note, if it has another; `cuts` then count its frames as they come and are carried over. A motion of a body
  /// with other bones is put on the database's: joints turn alike, travel and height grow with the legs, with a note.
  /// Rotations are kept to 4e-7 rad, translations to 1e-9 m. Throws SkeletonMismatch naming joints that do not fit,
  /// InvalidArgument if the name is empty or taken, the motion is empty or a cut is not inside. Cost O(frames x
  /// joints).
  RecordId add_clip(const NewClip& clip, const Motion& motion, const std::vector<motion::FrameRange>& cuts,
                    CutSource source = CutSource::kSuggested, Diagnostics* diagnostics = nullptr);
  /// Takes a clip away with its fragments, their pairs and estimates. Throws InvalidArgument if there is no such clip
  /// or, with kRefuse, if a fragment of it or a blend with one is labelled.
  void remove_clip(RecordId clip, OnLabels labels = OnLabels::kRefuse);
  /// Says who moves and what is done. Throws InvalidArgument if there is no such clip.
  void describe_clip(RecordId clip, const std::string& performer, const std::string& action);

  /// In the order in which they were added.
  [[nodiscard]] std::vector<ClipRecord> clips() const;
  [[nodiscard]] std::optional<ClipRecord> find_clip(const std::string& name) const;
  /// A whole clip, or the frames `range` of it, without reading the rest; on the database's skeleton. Throws
  /// InvalidArgument if there is no such clip or the range is not inside.
  [[nodiscard]] Motion motion(RecordId clip) const;
  [[nodiscard]] Motion motion(RecordId clip, const motion::FrameRange& range) const;
  [[nodiscard]] Motion motion(const FragmentRecord& fragment) const { return motion(fragment.clip, fragment.frames); }

  /// By clip in the order of clips(), then by frame.
  [[nodiscard]] std::vector<FragmentRecord> fragments() const;
  [[nodiscard]] std::optional<FragmentRecord> find_fragment(RecordId fragment) const;
  /// The labelled fragments (or with labelled blends) that set_cuts would take away.
  [[nodiscard]] std::vector<FragmentRecord> labelled_without(RecordId clip,
                                                             const std::vector<motion::FrameRange>& cuts) const;
  /// Cuts a clip anew. A fragment whose frames stay keeps its id and all that is known of it. Throws InvalidArgument
  /// as add_clip does, and with kRefuse, naming them, if labelled fragments would go.
  void set_cuts(RecordId clip, const std::vector<motion::FrameRange>& cuts, CutSource source,
                OnLabels labels = OnLabels::kRefuse);

  /// What matching found: a group of like content for every fragment.
  struct GroupOf {
    RecordId fragment = 0;
    int group = -1;  ///< from 0; -1: none
  };
  /// Replaces the groups of all fragments and what thresholds say of pairs; what people said of pairs stays. A status
  /// given as a person's becomes a person's. Throws InvalidArgument for unknown fragments or a pair that is not in
  /// order.
  void set_matching(const std::vector<GroupOf>& groups, const std::vector<PairRecord>& pairs);
  /// A person's word on a pair, in either order. Throws InvalidArgument for unknown fragments or one with itself.
  void decide_pair(RecordId one, RecordId other, bool accepted);
  /// All that were compared or decided on, by first, then second; or the accepted ones alone.
  [[nodiscard]] std::vector<PairRecord> pairs() const;
  [[nodiscard]] std::vector<PairRecord> accepted_pairs() const;

  /// The id of a blend, which is added unless it is there. (i, j, alpha) and (j, i, 1 - alpha) are one blend, kept with
  /// the smaller id first; alphas closer than 1e-9 are one. Throws InvalidArgument for unknown fragments, one with
  /// itself or an alpha that is not finite.
  RecordId add_blend(RecordId first, RecordId second, double alpha);
  /// The blend if it is there, told in either order.
  [[nodiscard]] std::optional<BlendRecord> find_blend(RecordId first, RecordId second, double alpha) const;
  [[nodiscard]] std::vector<BlendRecord> blends() const;  ///< by id

  /// Adds labels, all or none (their ids are given by the database); those with rater, target and time of one that is
  /// there are left out. How many were added. Throws InvalidArgument, saying which, for an unknown target, an empty
  /// rater, a time that is not ISO 8601, a rating outside [-1, 1] or of a factor said not to be present, no rating at
  /// all, or a comment of several lines.
  int add_labels(const std::vector<LabelRecord>& labels);
  /// Takes back the label that the person `rater` gave last, and nobody else's: what it was; nothing if the rater has
  /// given none.
  std::optional<LabelRecord> remove_last_label(const std::string& rater);
  /// By id. People's and synthetic raters' labels; never estimates.
  [[nodiscard]] std::vector<LabelRecord> labels() const;
  /// By target: people's labels, never mixed with synthetic ones; or, if a rater is named, all of that rater alone,
  /// person or not. Blind repeats count like any label of their rater.
  [[nodiscard]] std::vector<MeanLabel> mean_labels(const std::string& rater = {}) const;

  /// Replaces all estimates. Throws InvalidArgument for unknown fragments, values outside [-1, 1] or confidences
  /// outside [0, 1].
  void set_estimates(const std::vector<EstimateRecord>& estimates);
  [[nodiscard]] std::vector<EstimateRecord> estimates() const;  ///< by fragment

  /// Several changes as one: what is written while it lives stays only if commit() is called. May be nested.
  class Transaction {
   public:
    explicit Transaction(FragmentDatabase& database);
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    ~Transaction();
    void commit();

   private:
    struct Scope;
    std::unique_ptr<Scope> scope_;
  };

 private:
  struct Parts;
  explicit FragmentDatabase(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace strut::effort
