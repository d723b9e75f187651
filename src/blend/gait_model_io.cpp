// SPDX-License-Identifier: MIT
// Between GaitModel and its FlatBuffers file. The Verifier proves that every offset stays inside the bytes; the
// constructors of GaitModel and its parts then check that the content means something.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <gait_model_generated.h>
#include <utility>
#include <vector>

#include <strut/blend/gait_model_io.h>
#include <strut/core/error.h>

namespace strut::blend {
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
Eigen::Vector3d from_fb(const fb::Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

[[noreturn]] void refuse(const std::string& name, const std::string& found) {
  throw ParseError(name, 0, 0, "an intact gait model", found, "learn the model again, or copy the file again");
}

Eigen::Quaterniond rotation_of(const fb::Quaternion& q, const std::string& name) {
  Eigen::Quaterniond rotation(q.w(), q.x(), q.y(), q.z());
  if (!(std::abs(rotation.norm() - 1.0) < 1e-6)) refuse(name, "a rotation that is not of unit length");
  return rotation;
}

/// The Verifier looks at where a vector begins, but its elements stand behind a shorter count. (An empty one may stand
/// anywhere.)
template <typename Elements>
void check_alignment(const Elements& elements, const std::string& name) {
  if (elements.size() == 0 || reinterpret_cast<std::uintptr_t>(elements.Data()) % alignof(double) == 0) return;
  refuse(name, "numbers that are out of place");
}

Offset<fb::Joint> write_joint(FlatBufferBuilder& out, const Joint& joint) {
  const fb::Vector3 offset = to_fb(joint.offset);
  const fb::Vector3 end_site = to_fb(joint.end_site);
  return fb::CreateJoint(out, out.CreateString(joint.name), joint.parent, &offset,
                         joint.has_end_site ? &end_site : nullptr);
}

Offset<fb::Style> write_style(FlatBufferBuilder& out, const GaitStyle& style) {
  const FrameMatrix rows = style.coefficients;
  return fb::CreateStyle(out, out.CreateString(style.name),
                         out.CreateVector(rows.data(), static_cast<std::size_t>(rows.size())), style.typical,
                         style.slowest, style.fastest, style.num_cycles);
}

std::shared_ptr<const Skeleton> read_skeleton(const fb::GaitModel& root) {
  std::vector<Joint> joints;
  for (const fb::Joint* joint : *root.joints()) {
    Joint read{joint->name()->str(), joint->parent(), from_fb(*joint->offset())};
    read.has_end_site = joint->end_site() != nullptr;
    if (read.has_end_site) read.end_site = from_fb(*joint->end_site());
    joints.push_back(std::move(read));
  }
  return std::make_shared<const Skeleton>(std::move(joints));
}

GaitStyle read_style(const fb::Style& style, int functions, const std::string& name) {
  const auto& numbers = *style.coefficients();
  check_alignment(numbers, name);
  const auto size = static_cast<Eigen::Index>(numbers.size());
  if (functions < 1 || size % functions != 0) refuse(name, "a matrix of another size than its style's");
  return {style.name()->str(), Eigen::Map<const FrameMatrix>(numbers.data(), size / functions, functions),
          style.typical(),     style.slowest(),
          style.fastest(),     style.cycles()};
}

std::shared_ptr<const GaitModel> read_model(const fb::GaitModel& root, const std::string& name) {
  check_alignment(*root.mean_rotations(), name);
  std::vector<Eigen::Quaterniond> means;
  for (const fb::Quaternion* q : *root.mean_rotations()) means.push_back(rotation_of(*q, name));
  GaitModelParts parts{
      std::make_shared<const representation::Representation>(read_skeleton(root), std::move(means),
                                                             rotation_of(*root.upright(), name), root.travel_joint()),
      root.frame_rate(),
      SpeedBasis(root.slowest_ratio(), root.fastest_ratio(), root.functions()),
      {},
      root.provenance()->str()};
  for (const fb::Style* style : *root.styles()) parts.styles.push_back(read_style(*style, root.functions(), name));
  return std::make_shared<const GaitModel>(std::move(parts));
}

}  // namespace

bool is_gait_model(std::string_view bytes) noexcept {
  constexpr std::size_t kIdentifierEnd = 2 * sizeof(flatbuffers::uoffset_t);
  return bytes.size() >= kIdentifierEnd && fb::GaitModelBufferHasIdentifier(bytes.data());
}

std::shared_ptr<const GaitModel> parse_gait_model(std::string_view bytes, const std::string& name) {
  if (!is_gait_model(bytes)) {
    throw ParseError(name, 0, 0, "a gait model made by strut blend",
                     bytes.empty() ? "an empty file" : "another kind of file");
  }
  // FlatBuffers needs its buffer aligned; the caller's bytes may start anywhere.
  std::vector<std::uint64_t> aligned((bytes.size() + 7) / 8);
  std::memcpy(aligned.data(), bytes.data(), bytes.size());
  const auto* data = reinterpret_cast<const std::uint8_t*>(aligned.data());
  flatbuffers::Verifier verifier(data, bytes.size());
  if (!fb::VerifyGaitModelBuffer(verifier)) refuse(name, "damaged or truncated bytes");
  const fb::GaitModel& root = *fb::GetGaitModel(data);
  if (root.version() != kFormatVersion) throw VersionError(name, root.version(), kFormatVersion);
  try {
    return read_model(root, name);
  } catch (const InvalidArgument& error) {
    refuse(name, std::string("parts that do not fit: ") + error.what());
  }
}

std::shared_ptr<const GaitModel> read_gait_model(const std::string& path) {
  return parse_gait_model(read_file(path), path);
}

std::string format_gait_model(const GaitModel& model) {
  FlatBufferBuilder out;
  const representation::Representation& representation = model.representation();
  std::vector<Offset<fb::Joint>> joints;
  for (const Joint& joint : representation.skeleton().joints()) joints.push_back(write_joint(out, joint));
  std::vector<Offset<fb::Style>> styles;
  for (const GaitStyle& style : model.styles()) styles.push_back(write_style(out, style));
  std::vector<fb::Quaternion> means;
  for (const auto& q : representation.mean_rotations()) means.push_back(to_fb(q));
  const fb::Quaternion upright = to_fb(representation.upright());
  fb::FinishGaitModelBuffer(
      out, fb::CreateGaitModel(out, kFormatVersion, model.frame_rate(), out.CreateVector(joints),
                               representation.travel_joint(), &upright, out.CreateVectorOfStructs(means),
                               model.basis().slowest(), model.basis().fastest(), model.basis().size(),
                               out.CreateVector(styles), out.CreateString(model.provenance())));
  return {reinterpret_cast<const char*>(out.GetBufferPointer()), out.GetSize()};
}

void write_gait_model(const std::string& path, const GaitModel& model, Overwrite overwrite) {
  write_file(path, format_gait_model(model), overwrite);
}

}  // namespace strut::blend
