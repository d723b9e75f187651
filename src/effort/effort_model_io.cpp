// SPDX-License-Identifier: MIT
// Between EffortModel and its FlatBuffers file. The Verifier proves that every offset stays inside the bytes; the
// constructors of EffortModel and its parts then check that the content means something. Bones are rigid but for a few
// joints (the root, mostly), so translations are kept of those only.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <effort_model_generated.h>
#include <utility>
#include <vector>

#include <strut/core/error.h>
#include <strut/effort/effort_model_io.h>

namespace strut::effort {
namespace {

using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

constexpr int kFormatVersion = 1;

fb::Quaternion to_fb(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}
fb::Vector3 to_fb(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
fb::Effort effort_to_fb(const EffortVector& effort) {
  return {effort[kFlow], effort[kWeight], effort[kTime]};
}
Eigen::Quaterniond from_fb(const fb::Quaternion& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}
Eigen::Vector3d from_fb(const fb::Vector3& v) {
  return {v.x(), v.y(), v.z()};
}
EffortVector from_fb(const fb::Effort& effort) {
  return {effort.flow(), effort.weight(), effort.time()};
}

[[noreturn]] void refuse(const std::string& name, const std::string& found) {
  throw ParseError(name, 0, 0, "an intact effort model", found, "learn the model again, or copy the file again");
}

/// The Verifier looks at where a vector begins, but its elements stand behind a shorter count. (An empty one may stand
/// anywhere.)
template <typename Elements>
const Elements& aligned(const Elements& elements, const std::string& name) {
  if (elements.size() != 0 && reinterpret_cast<std::uintptr_t>(elements.Data()) % alignof(double) != 0) {
    refuse(name, "numbers that are out of place");
  }
  return elements;
}

std::vector<int> moving_joints(const EffortModel& model) {
  std::vector<bool> moves(static_cast<std::size_t>(model.skeleton().num_joints()), false);
  for (const ModelFragment& fragment : model.fragments()) {
    for (const Pose& pose : fragment.motion.frames()) {
      for (std::size_t j = 0; j < moves.size(); ++j) {
        if (pose.translations[j] != model.skeleton().joints()[j].offset) moves[j] = true;
      }
    }
  }
  std::vector<int> joints;
  for (std::size_t j = 0; j < moves.size(); ++j) {
    if (moves[j]) joints.push_back(static_cast<int>(j));
  }
  return joints;
}

Offset<fb::Joint> write_joint(FlatBufferBuilder& out, const Joint& joint) {
  const fb::Vector3 offset = to_fb(joint.offset);
  const fb::Vector3 end_site = to_fb(joint.end_site);
  return fb::CreateJoint(out, out.CreateString(joint.name), joint.parent, &offset,
                         joint.has_end_site ? &end_site : nullptr);
}

Offset<fb::Fragment> write_fragment(FlatBufferBuilder& out, const ModelFragment& fragment,
                                    const std::vector<int>& moving) {
  std::vector<fb::Quaternion> rotations;
  std::vector<fb::Vector3> translations;
  for (const Pose& pose : fragment.motion.frames()) {
    for (const Eigen::Quaterniond& rotation : pose.rotations) rotations.push_back(to_fb(rotation));
    for (const int joint : moving) translations.push_back(to_fb(pose.translations[static_cast<std::size_t>(joint)]));
  }
  const fb::Effort effort = effort_to_fb(fragment.effort);
  return fb::CreateFragment(out, out.CreateString(fragment.name), fragment.group, &effort,
                            out.CreateVectorOfStructs(rotations), out.CreateVectorOfStructs(translations));
}

std::shared_ptr<const Skeleton> read_skeleton(const fb::EffortModel& root) {
  std::vector<Joint> joints;
  for (const fb::Joint* joint : *root.joints()) {
    Joint read{joint->name()->str(), joint->parent(), from_fb(*joint->offset())};
    read.has_end_site = joint->end_site() != nullptr;
    if (read.has_end_site) read.end_site = from_fb(*joint->end_site());
    joints.push_back(std::move(read));
  }
  return std::make_shared<const Skeleton>(std::move(joints));
}

std::vector<int> read_moving_joints(const fb::EffortModel& root, const Skeleton& skeleton, const std::string& name) {
  std::vector<int> moving(root.moving_joints()->begin(), root.moving_joints()->end());
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const int least = i == 0 ? 0 : moving[i - 1] + 1;
    if (moving[i] < least || moving[i] >= skeleton.num_joints()) refuse(name, "a moving joint that is none");
  }
  return moving;
}

Motion read_motion(const fb::Fragment& fragment, const std::shared_ptr<const Skeleton>& skeleton, double frame_rate,
                   const std::vector<int>& moving, const std::string& name) {
  const auto& rotations = aligned(*fragment.rotations(), name);
  const auto& translations = aligned(*fragment.translations(), name);
  const auto joints = static_cast<std::size_t>(skeleton->num_joints());
  const std::size_t frames = rotations.size() / joints;
  if (rotations.size() != frames * joints || translations.size() != frames * moving.size()) {
    refuse(name, "a fragment whose frames are not whole");
  }
  std::vector<Pose> poses(frames, rest_pose(*skeleton));
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < joints; ++j) {
      poses[f].rotations[j] = from_fb(*rotations.Get(static_cast<flatbuffers::uoffset_t>(f * joints + j)));
    }
    for (std::size_t m = 0; m < moving.size(); ++m) {
      poses[f].translations[static_cast<std::size_t>(moving[m])] =
          from_fb(*translations.Get(static_cast<flatbuffers::uoffset_t>(f * moving.size() + m)));
    }
  }
  return {skeleton, frame_rate, std::move(poses)};
}

FeatureSpace read_space(const fb::EffortModel& root, const std::string& name) {
  const auto& mean = aligned(*root.feature_mean(), name);
  const auto& components = aligned(*root.feature_components(), name);
  const auto features = static_cast<Eigen::Index>(mean.size());
  const auto size = static_cast<Eigen::Index>(components.size());
  if (features == 0 || size == 0 || size % features != 0) refuse(name, "a feature space of another size");
  return {Eigen::Map<const Eigen::VectorXd>(mean.data(), features),
          Eigen::Map<const FrameMatrix>(components.data(), features, size / features), root.feature_kept()};
}

Eigen::VectorXd vector_of(const flatbuffers::Vector<double>& numbers, const std::string& name) {
  return Eigen::Map<const Eigen::VectorXd>(aligned(numbers, name).data(), static_cast<Eigen::Index>(numbers.size()));
}

/// `numbers` row by row.
Eigen::MatrixXd matrix_of(const flatbuffers::Vector<double>& numbers, Eigen::Index rows, const std::string& name) {
  const auto size = static_cast<Eigen::Index>(numbers.size());
  if (size == 0) return Eigen::MatrixXd(rows, 0);
  if (rows == 0 || size % rows != 0) refuse(name, "a matrix of another size than it says");
  return Eigen::Map<const FrameMatrix>(aligned(numbers, name).data(), rows, size / rows);
}

void read_fragments_of_regression(EffortRegressionParts& parts, const std::vector<ModelFragment>& fragments) {
  const auto count = static_cast<Eigen::Index>(fragments.size());
  parts.effort.resize(count, kNumPredictedFactors);
  parts.group.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    parts.effort.row(i) = fragments[static_cast<std::size_t>(i)].effort.transpose();
    parts.group[i] = fragments[static_cast<std::size_t>(i)].group;
  }
}

EffortRegression read_regression(const fb::Regression& from, const std::vector<ModelFragment>& fragments,
                                 const std::string& name) {
  if (from.method() < 0 || from.method() >= kNumRegressionMethods) refuse(name, "an unknown method of regression");
  if (from.residual()->size() != kNumPredictedFactors || from.support()->size() != kNumPredictedFactors) {
    refuse(name, "a regression of other factors");
  }
  EffortRegressionParts parts;
  parts.method = static_cast<RegressionMethod>(from.method());
  read_fragments_of_regression(parts, fragments);
  parts.duration = vector_of(*from.duration(), name);
  parts.posture = matrix_of(*from.posture(), parts.group.size(), name);
  parts.curves = matrix_of(*from.curves(), parts.group.size(), name);
  for (const fb::Blend* blend : aligned(*from.blends(), name)) {
    parts.blends.push_back({blend->first(), blend->second(), blend->alpha(), from_fb(blend->effort())});
  }
  const auto& residual = aligned(*from.residual(), name);
  for (flatbuffers::uoffset_t factor = 0; factor < kNumPredictedFactors; ++factor) {
    const fb::ResidualSettings& r = *residual.Get(factor);
    parts.residual.at(factor) = {r.kinematics(),  r.labels(),      r.posture(),       r.noise(),      r.misfit(),
                                 r.label_reach(), r.alpha_reach(), r.posture_reach(), r.calibration()};
    const fb::SupportVectors& support = *from.support()->Get(factor);
    parts.support.at(factor) = {
        matrix_of(*support.inputs(), static_cast<Eigen::Index>(support.coefficients()->size()), name),
        vector_of(*support.coefficients(), name), support.offset(), support.gamma()};
  }
  return EffortRegression(std::move(parts));
}

KinematicEstimator read_estimator(const fb::Estimator& from, const std::string& name) {
  EstimatorNumbers numbers;
  for (const fb::GroupScale* group : *from.groups()) {
    numbers.groups.push_back({vector_of(*group->mean(), name), vector_of(*group->deviation(), name),
                              group->braking_slope(), group->fragments()});
  }
  numbers.weights = matrix_of(*from.weights(), kNumPredictedFactors, name);
  numbers.left_out_error = from_fb(*from.left_out_error());
  numbers.label_deviation = from_fb(*from.label_deviation());
  if (from.labels()->size() != kNumPredictedFactors) refuse(name, "an estimator of other factors");
  for (int factor = 0; factor < kNumPredictedFactors; ++factor) {
    numbers.num_labels[factor] = from.labels()->Get(static_cast<flatbuffers::uoffset_t>(factor));
  }
  return KinematicEstimator(std::move(numbers));
}

std::shared_ptr<const EffortModel> read_model(const fb::EffortModel& root, const std::string& name) {
  const auto skeleton = read_skeleton(root);
  const std::vector<int> moving = read_moving_joints(root, *skeleton, name);
  std::vector<ModelFragment> fragments;
  for (const fb::Fragment* fragment : *root.fragments()) {
    fragments.push_back({fragment->name()->str(), fragment->group(),
                         read_motion(*fragment, skeleton, root.frame_rate(), moving, name),
                         from_fb(*fragment->effort())});
  }
  std::vector<FragmentPair> pairs;
  for (const fb::Pair* pair : *root.pairs()) pairs.push_back({pair->first(), pair->second()});
  EffortRegression regression = read_regression(*root.regression(), fragments, name);
  EffortModelParts parts{from_fb(*root.upright()), read_space(root, name), std::move(fragments),
                         std::move(pairs),         std::move(regression),  read_estimator(*root.estimator(), name),
                         root.threshold(),         root.estimates(),       root.provenance()->str()};
  return std::make_shared<const EffortModel>(std::move(parts));
}

Offset<flatbuffers::Vector<double>> numbers(FlatBufferBuilder& out, const FrameMatrix& matrix) {
  return out.CreateVector(matrix.data(), static_cast<std::size_t>(matrix.size()));
}

Offset<fb::Regression> write_regression(FlatBufferBuilder& out, const EffortRegressionParts& parts) {
  std::vector<fb::Blend> blends;
  for (const LabelledBlend& blend : parts.blends) {
    blends.emplace_back(blend.first, blend.second, blend.alpha, effort_to_fb(blend.effort));
  }
  std::vector<fb::ResidualSettings> residual;
  for (const ResidualSettings& r : parts.residual) {
    residual.emplace_back(r.kinematics, r.labels, r.posture, r.noise, r.misfit, r.label_reach, r.alpha_reach,
                          r.posture_reach, r.calibration);
  }
  std::vector<Offset<fb::SupportVectors>> support;
  for (const SupportVectors& s : parts.support) {
    support.push_back(
        fb::CreateSupportVectors(out, numbers(out, s.inputs), numbers(out, s.coefficients), s.offset, s.gamma));
  }
  const auto duration = numbers(out, parts.duration), posture = numbers(out, parts.posture),
             curves = numbers(out, parts.curves);
  return fb::CreateRegression(out, static_cast<int>(parts.method), duration, posture, curves,
                              out.CreateVectorOfStructs(blends), out.CreateVectorOfStructs(residual),
                              out.CreateVector(support));
}

Offset<fb::Estimator> write_estimator(FlatBufferBuilder& out, const EstimatorNumbers& from) {
  std::vector<Offset<fb::GroupScale>> groups;
  for (const DescriptorScale& scale : from.groups) {
    const auto mean = numbers(out, scale.mean), deviation = numbers(out, scale.deviation);
    groups.push_back(fb::CreateGroupScale(out, mean, deviation, scale.braking_slope, scale.num_fragments));
  }
  const fb::Effort left_out = effort_to_fb(from.left_out_error), spread = effort_to_fb(from.label_deviation);
  const auto weights = numbers(out, from.weights);
  const auto labels = out.CreateVector(from.num_labels.data(), kNumPredictedFactors);
  return fb::CreateEstimator(out, out.CreateVector(groups), weights, &left_out, &spread, labels);
}

Offset<fb::EffortModel> write_model(FlatBufferBuilder& out, const EffortModel& model) {
  const EffortModelParts& parts = model.parts();
  std::vector<Offset<fb::Joint>> joints;
  for (const Joint& joint : model.skeleton().joints()) joints.push_back(write_joint(out, joint));
  const std::vector<int> moving = moving_joints(model);
  std::vector<Offset<fb::Fragment>> fragments;
  for (const ModelFragment& fragment : parts.fragments) fragments.push_back(write_fragment(out, fragment, moving));
  std::vector<fb::Pair> pairs;
  for (const FragmentPair& pair : parts.pairs) pairs.emplace_back(pair.first, pair.second);
  const fb::Quaternion upright = to_fb(parts.upright);
  const auto mean = numbers(out, parts.space.mean), components = numbers(out, parts.space.components);
  const auto regression = write_regression(out, parts.regression.parts());
  const auto estimator = write_estimator(out, parts.estimator.numbers());
  return fb::CreateEffortModel(out, kFormatVersion, model.frame_rate(), out.CreateVector(joints),
                               out.CreateVector(moving), &upright, mean, components, parts.space.kept,
                               out.CreateVector(fragments), out.CreateVectorOfStructs(pairs), regression, estimator,
                               parts.threshold, parts.are_estimates, out.CreateString(parts.provenance));
}

}  // namespace

bool is_effort_model(std::string_view bytes) noexcept {
  constexpr std::size_t kIdentifierEnd = 2 * sizeof(flatbuffers::uoffset_t);
  return bytes.size() >= kIdentifierEnd && fb::EffortModelBufferHasIdentifier(bytes.data());
}

std::shared_ptr<const EffortModel> parse_effort_model(std::string_view bytes, const std::string& name) {
  if (!is_effort_model(bytes)) {
    throw ParseError(name, 0, 0, "an effort model made by strut effort learn",
                     bytes.empty() ? "an empty file" : "another kind of file");
  }
  // FlatBuffers needs its buffer aligned; the caller's bytes may start anywhere.
  std::vector<std::uint64_t> copy((bytes.size() + 7) / 8);
  std::memcpy(copy.data(), bytes.data(), bytes.size());
  const auto* data = reinterpret_cast<const std::uint8_t*>(copy.data());
  flatbuffers::Verifier verifier(data, bytes.size());
  if (!fb::VerifyEffortModelBuffer(verifier)) refuse(name, "damaged or truncated bytes");
  const fb::EffortModel& root = *fb::GetEffortModel(data);
  if (root.version() != kFormatVersion) throw VersionError(name, root.version(), kFormatVersion);
  try {
    return read_model(root, name);
  } catch (const InvalidArgument& error) {
    refuse(name, std::string("parts that do not fit: ") + error.what());
  }
}

std::shared_ptr<const EffortModel> read_effort_model(const std::string& path) {
  return parse_effort_model(read_file(path), path);
}

std::string format_effort_model(const EffortModel& model) {
  FlatBufferBuilder out;
  fb::FinishEffortModelBuffer(out, write_model(out, model));
  return {reinterpret_cast<const char*>(out.GetBufferPointer()), out.GetSize()};
}

void write_effort_model(const std::string& path, const EffortModel& model, Overwrite overwrite) {
  write_file(path, format_effort_model(model), overwrite);
}

}  // namespace strut::effort
