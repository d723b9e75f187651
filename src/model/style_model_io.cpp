// SPDX-License-Identifier: MIT
// Between StyleModel and its FlatBuffers file. The Verifier proves that every offset stays inside the bytes; the
// constructors of StyleModel and its parts then check that the content means something.
#include <cstdint>
#include <cstring>
#include <style_model_generated.h>
#include <utility>
#include <vector>

#include <strut/core/error.h>
#include <strut/model/style_model_io.h>

namespace strut {
namespace {

namespace fb = model::fb;
using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

constexpr int kFormatVersion = 2;
constexpr int kOldestVersion = 1;  // had neither context nor radial map

fb::Quaternion to_fb(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}
fb::Vector3 to_fb(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}
Eigen::Quaterniond from_fb(const fb::Quaternion& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}
Eigen::Vector3d from_fb(const fb::Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

Offset<flatbuffers::Vector<double>> numbers(FlatBufferBuilder& out, const FrameMatrix& matrix) {
  return out.CreateVector(matrix.data(), static_cast<std::size_t>(matrix.size()));
}

Offset<fb::Joint> write_joint(FlatBufferBuilder& out, const Joint& joint) {
  const fb::Vector3 offset = to_fb(joint.offset);
  const fb::Vector3 end_site = to_fb(joint.end_site);
  return fb::CreateJoint(out, out.CreateString(joint.name), joint.parent, &offset,
                         joint.has_end_site ? &end_site : nullptr);
}

Offset<fb::Style> write_style(FlatBufferBuilder& out, const representation::Representation& representation,
                              const representation::Normalization& scaling) {
  std::vector<fb::Quaternion> means;
  for (const auto& q : representation.mean_rotations()) means.push_back(to_fb(q));
  return fb::CreateStyle(out, out.CreateVectorOfStructs(means), numbers(out, scaling.mean()),
                         numbers(out, scaling.scale()));
}

Offset<fb::Block> write_block(FlatBufferBuilder& out, const StyleBlock& block) {
  return fb::CreateBlock(out, out.CreateString(block.name), out.CreateVector(block.input_dofs),
                         out.CreateVector(block.output_dofs), block.system.num_states(), numbers(out, block.system.a()),
                         numbers(out, block.system.b()), numbers(out, block.system.c()),
                         numbers(out, block.system.d()));
}

Offset<fb::RadialMap> write_radial_map(FlatBufferBuilder& out, const std::optional<RadialMap>& map) {
  if (!map) return 0;
  return fb::CreateRadialMap(out, out.CreateVector(map->lags), map->basis.width(), numbers(out, map->basis.centres()),
                             numbers(out, map->input), numbers(out, map->output), map->smoothing,
                             numbers(out, map->spread), numbers(out, map->share), map->fast);
}

Offset<flatbuffers::Vector<Offset<fb::FootplantBoundary>>> write_footplants(
    FlatBufferBuilder& out, const std::optional<postprocess::FootplantClassifier>& classifier) {
  if (!classifier) return 0;
  std::vector<Offset<fb::FootplantBoundary>> feet;
  for (int foot = 0; foot < 2; ++foot) {
    const postprocess::FootplantBoundary& at = classifier->foot(foot);
    feet.push_back(fb::CreateFootplantBoundary(out, numbers(out, at.projection), at.boundary, at.is_planted_above));
  }
  return out.CreateVector(feet);
}

[[noreturn]] void refuse(const std::string& name, const std::string& found) {
  throw ParseError(name, 0, 0, "an intact style model", found, "learn the model again, or copy the file again");
}

/// The Verifier looks at where a vector begins, but its elements stand behind a shorter count. (An empty one may stand
/// anywhere.)
template <typename Elements>
void check_alignment(const Elements& elements, const std::string& name) {
  if (elements.size() == 0 || reinterpret_cast<std::uintptr_t>(elements.Data()) % alignof(double) == 0) return;
  refuse(name, "numbers that are out of place");
}

Eigen::VectorXd vector_of(const flatbuffers::Vector<double>& numbers, const std::string& name) {
  check_alignment(numbers, name);
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

Eigen::MatrixXd matrix_of(const flatbuffers::Vector<double>& numbers, Eigen::Index rows, Eigen::Index cols,
                          const std::string& name) {
  if (static_cast<Eigen::Index>(numbers.size()) != rows * cols)
    refuse(name, "a matrix of another size than its block's");
  check_alignment(numbers, name);
  return Eigen::Map<const FrameMatrix>(numbers.data(), rows, cols);
}

std::shared_ptr<const Skeleton> read_skeleton(const fb::StyleModel& root) {
  std::vector<Joint> joints;
  for (const fb::Joint* joint : *root.joints()) {
    Joint read{joint->name()->str(), joint->parent(), from_fb(*joint->offset())};
    read.has_end_site = joint->end_site() != nullptr;
    if (read.has_end_site) read.end_site = from_fb(*joint->end_site());
    joints.push_back(std::move(read));
  }
  return std::make_shared<const Skeleton>(std::move(joints));
}

representation::Representation read_representation(const fb::StyleModel& root, const fb::Style& style,
                                                   const std::shared_ptr<const Skeleton>& skeleton,
                                                   const std::string& name) {
  std::vector<Eigen::Quaterniond> means;
  check_alignment(*style.mean_rotations(), name);
  for (const fb::Quaternion* q : *style.mean_rotations()) {
    means.push_back(from_fb(*q));
    if (!(std::abs(means.back().norm() - 1.0) < 1e-6)) refuse(name, "a rotation that is not of unit length");
  }
  const Eigen::Quaterniond upright = from_fb(*root.upright());
  if (!(std::abs(upright.norm() - 1.0) < 1e-6)) refuse(name, "a rotation that is not of unit length");
  return {skeleton, std::move(means), upright, root.travel_joint()};
}

StyleBlock read_block(const fb::Block& block, const std::string& name) {
  const auto inputs = static_cast<Eigen::Index>(block.input_dofs()->size());
  const auto outputs = static_cast<Eigen::Index>(block.output_dofs()->size());
  const Eigen::Index states = block.states();
  if (states < 0 || states > 10000) refuse(name, std::to_string(states) + " states in a block");
  return {block.name()->str(),
          {block.input_dofs()->begin(), block.input_dofs()->end()},
          {block.output_dofs()->begin(), block.output_dofs()->end()},
          {matrix_of(*block.a(), states, states, name), matrix_of(*block.b(), states, inputs, name),
           matrix_of(*block.c(), outputs, states, name), matrix_of(*block.d(), outputs, inputs, name)}};
}

Eigen::MatrixXd read_context(const fb::StyleModel& root, const std::string& name) {
  const auto dofs = static_cast<Eigen::Index>(root.input()->mean()->size());
  if (root.context() == nullptr || dofs == 0) return {};
  return matrix_of(*root.context(), static_cast<Eigen::Index>(root.context()->size()) / dofs, dofs, name);
}

std::optional<RadialMap> read_radial_map(const fb::StyleModel& root, const std::string& name) {
  const fb::RadialMap* map = root.radial_map();
  if (map == nullptr) return std::nullopt;
  const auto dofs = static_cast<Eigen::Index>(root.input()->mean()->size());
  if (dofs == 0 || map->input()->size() == 0) refuse(name, "an empty map");
  const auto centres = static_cast<Eigen::Index>(map->input()->size()) / dofs;
  if (centres == 0) refuse(name, "an empty map");
  const auto features = static_cast<Eigen::Index>(map->centres()->size()) / centres;
  return RadialMap{{map->lags()->begin(), map->lags()->end()},
                   {matrix_of(*map->centres(), features, centres, name), map->width()},
                   matrix_of(*map->input(), dofs, centres, name),
                   matrix_of(*map->output(), dofs + 1, centres, name),
                   map->smoothing(),
                   vector_of(*map->spread(), name),
                   map->fast(),
                   vector_of(*map->share(), name)};
}

std::optional<postprocess::FootplantClassifier> read_footplants(const fb::StyleModel& root, const std::string& name) {
  if (root.footplants() == nullptr) return std::nullopt;
  if (root.footplants()->size() != 2)
    refuse(name, "footplants of " + std::to_string(root.footplants()->size()) + " feet");
  const auto read = [&](flatbuffers::uoffset_t foot) {
    const fb::FootplantBoundary& at = *root.footplants()->Get(foot);
    return postprocess::FootplantBoundary{vector_of(*at.projection(), name), at.boundary(), at.planted_above()};
  };
  return postprocess::FootplantClassifier({read(0), read(1)});
}

std::shared_ptr<const StyleModel> read_model(const fb::StyleModel& root, const std::string& name) {
  const auto skeleton = read_skeleton(root);
  StyleModelParts parts{root.frame_rate(),
                        read_representation(root, *root.input(), skeleton, name),
                        read_representation(root, *root.output(), skeleton, name),
                        {vector_of(*root.input()->mean(), name), vector_of(*root.input()->scale(), name)},
                        {vector_of(*root.output()->mean(), name), vector_of(*root.output()->scale(), name)},
                        read_context(root, name),
                        {},
                        read_radial_map(root, name),
                        root.provenance()->str(),
                        read_footplants(root, name)};
  for (const fb::Block* block : *root.blocks()) parts.blocks.push_back(read_block(*block, name));
  return std::make_shared<const StyleModel>(std::move(parts));
}

}  // namespace

bool is_style_model(std::string_view bytes) noexcept {
  constexpr std::size_t kIdentifierEnd = 2 * sizeof(flatbuffers::uoffset_t);
  return bytes.size() >= kIdentifierEnd && fb::StyleModelBufferHasIdentifier(bytes.data());
}

std::shared_ptr<const StyleModel> parse_style_model(std::string_view bytes, const std::string& name) {
  if (!is_style_model(bytes)) {
    throw ParseError(name, 0, 0, "a style model made by strut learn",
                     bytes.empty() ? "an empty file" : "another kind of file");
  }
  // FlatBuffers needs its buffer aligned; the caller's bytes may start anywhere.
  std::vector<std::uint64_t> aligned((bytes.size() + 7) / 8);
  std::memcpy(aligned.data(), bytes.data(), bytes.size());
  const auto* data = reinterpret_cast<const std::uint8_t*>(aligned.data());
  flatbuffers::Verifier verifier(data, bytes.size());
  if (!fb::VerifyStyleModelBuffer(verifier)) refuse(name, "damaged or truncated bytes");
  const fb::StyleModel& root = *fb::GetStyleModel(data);
  if (root.version() < kOldestVersion || root.version() > kFormatVersion)
    throw VersionError(name, root.version(), kFormatVersion);
  try {
    return read_model(root, name);
  } catch (const InvalidArgument& error) {
    refuse(name, std::string("parts that do not fit: ") + error.what());
  }
}

std::shared_ptr<const StyleModel> read_style_model(const std::string& path) {
  return parse_style_model(read_file(path), path);
}

std::string format_style_model(const StyleModel& model) {
  FlatBufferBuilder out;
  std::vector<Offset<fb::Joint>> joints;
  for (const Joint& joint : model.skeleton().joints()) joints.push_back(write_joint(out, joint));
  std::vector<Offset<fb::Block>> blocks;
  for (const StyleBlock& block : model.blocks()) blocks.push_back(write_block(out, block));
  const auto input = write_style(out, model.input(), model.input_scaling());
  const auto output = write_style(out, model.output(), model.output_scaling());
  const fb::Quaternion upright = to_fb(model.input().upright());
  fb::FinishStyleModelBuffer(
      out, fb::CreateStyleModel(out, kFormatVersion, model.frame_rate(), out.CreateVector(joints),
                                model.input().travel_joint(), &upright, input, output, out.CreateVector(blocks),
                                out.CreateString(model.provenance()), numbers(out, model.context()),
                                write_radial_map(out, model.radial_map()), write_footplants(out, model.footplants())));
  return {reinterpret_cast<const char*>(out.GetBufferPointer()), out.GetSize()};
}

void write_style_model(const std::string& path, const StyleModel& model, Overwrite overwrite) {
  write_file(path, format_style_model(model), overwrite);
}

}  // namespace strut
