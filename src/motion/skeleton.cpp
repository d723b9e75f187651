// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include <strut/core/error.h>
#include <strut/motion/skeleton.h>

namespace strut {
namespace {

void check_joint(const std::vector<Joint>& joints, std::size_t index) {
  const Joint& joint = joints[index];
  const std::string which = "joints[" + std::to_string(index) + "]";
  if (index == 0 && joint.parent != -1)
    throw InvalidArgument(which + ".parent", "-1 (the root comes first)", "another joint");
  if (index > 0 && (joint.parent < 0 || joint.parent >= static_cast<int>(index))) {
    throw InvalidArgument(which + ".parent", "a joint that precedes it", std::to_string(joint.parent));
  }
  if (!joint.offset.allFinite() || !joint.end_site.allFinite()) {
    throw InvalidArgument(which + ".offset", "finite numbers", "NaN or infinity");
  }
}

std::set<std::string> names_of(const Skeleton& skeleton) {
  std::set<std::string> names;
  for (const Joint& joint : skeleton.joints()) names.insert(joint.name);
  return names;
}

std::string listed(const std::set<std::string>& names) {
  std::string text;
  int count = 0;
  for (const auto& name : names) {
    if (++count > 5) return text + ", and " + std::to_string(names.size() - 5) + " more";
    text += (text.empty() ? "'" : ", '") + name + "'";
  }
  return text;
}

std::set<std::string> difference(const std::set<std::string>& a, const std::set<std::string>& b) {
  std::set<std::string> only;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(only, only.end()));
  return only;
}

std::string parent_name(const Skeleton& skeleton, int index) {
  const int parent = skeleton.joint(index).parent;
  return parent < 0 ? "nothing" : "'" + skeleton.joint(parent).name + "'";
}

}  // namespace

Skeleton::Skeleton(std::vector<Joint> joints) : joints_(std::move(joints)), children_(joints_.size()) {
  if (joints_.empty()) throw InvalidArgument("joints", "at least one joint", "none");
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    check_joint(joints_, i);
    if (i > 0) children_[static_cast<std::size_t>(joints_[i].parent)].push_back(static_cast<int>(i));
  }
  while (children(pelvis_).size() == 1) pelvis_ = children(pelvis_).front();
}

int Skeleton::find(const std::string& name) const noexcept {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

std::string describe_mismatch(const Skeleton& a, const Skeleton& b) {
  const auto missing = difference(names_of(a), names_of(b));
  const auto extra = difference(names_of(b), names_of(a));
  if (!missing.empty() || !extra.empty()) {
    std::string text;
    if (!missing.empty()) text += "missing " + listed(missing);
    if (!extra.empty()) text += (text.empty() ? "unknown " : "; unknown ") + listed(extra);
    return text;
  }
  if (a.num_joints() != b.num_joints()) {
    return std::to_string(b.num_joints()) + " joints instead of " + std::to_string(a.num_joints());
  }
  for (int i = 0; i < a.num_joints(); ++i) {
    if (a.joint(i).name != b.joint(i).name) {
      return "joint " + std::to_string(i) + " is '" + b.joint(i).name + "' instead of '" + a.joint(i).name + "'";
    }
    if (a.joint(i).parent != b.joint(i).parent) {
      return "'" + b.joint(i).name + "' hangs on " + parent_name(b, i) + " instead of " + parent_name(a, i);
    }
  }
  return {};
}

}  // namespace strut
