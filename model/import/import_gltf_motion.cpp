#include "model/import/import_gltf_motion.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace triptych {

namespace {

constexpr uint32_t no_track = MotionJoint::none;

bool is_path_of_nodes(const std::string& path) {
  return path == "translation" || path == "rotation" || path == "scale";
}

std::vector<double> read_values(const GltfFile& gltf, int64_t accessor, int components,
                                const std::string& place) {
  GltfAccessor values(gltf, accessor, place);
  if (values.components() != components)
    fail(place, "values of {} numbers, where {} are expected", values.components(), components);
  values.load();
  std::vector<double> numbers;
  numbers.reserve(values.count() * static_cast<size_t>(components));
  for (size_t i = 0; i < values.count(); ++i) {
    for (int c = 0; c < components; ++c) numbers.push_back(values.component(i, c));
  }
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (!(std::abs(numbers[i]) <= max_import_coordinate))
      fail(place, "value {} of accessor {} is not a finite number", i / static_cast<size_t>(components),
           accessor);
  }
  return numbers;
}

const GltfAnimationSampler& sampler_of(const GltfAnimation& animation, const GltfAnimationChannel& channel,
                                       const std::string& place) {
  if (channel.sampler < 0 || static_cast<size_t>(channel.sampler) >= animation.samplers.size())
    fail(place, "names sampler {} of {}", channel.sampler, animation.samplers.size());
  return animation.samplers[static_cast<size_t>(channel.sampler)];
}

std::vector<double> read_times(const GltfFile& gltf, const GltfAnimationSampler& sampler,
                               const std::string& place) {
  const std::vector<double> times = read_values(gltf, sampler.input, 1, place);
  if (times.empty()) fail(place, "has no keys");
  if (times.front() < 0) fail(place, "begins before 0, at {} seconds", times.front());
  for (size_t i = 1; i < times.size(); ++i) {
    if (times[i] <= times[i - 1])
      fail(place, "its times do not increase: key {} is at {} seconds, after one at {}", i, times[i],
           times[i - 1]);
  }
  return times;
}

Interpolation interpolation_of(const GltfAnimationSampler& sampler, const std::string& place) {
  static const std::array<std::pair<const char*, Interpolation>, 3> known = {
      {{"STEP", Interpolation::step},
       {"LINEAR", Interpolation::linear},
       {"CUBICSPLINE", Interpolation::cubic_spline}}};
  for (const auto& [name, interpolation] : known) {
    if (sampler.interpolation == name) return interpolation;
  }
  fail(place, "interpolates by \"{}\", which is none of STEP, LINEAR and CUBICSPLINE",
       sampler.interpolation.substr(0, 20));
}

bool has_length(const double* quaternion) {
  return quaternion[0] != 0 || quaternion[1] != 0 || quaternion[2] != 0 || quaternion[3] != 0;
}

/// Whether the track leaves the node as it stands: exporters write many of those.
bool is_at_rest(const MotionTrack& track, const std::vector<double>& given, double otherwise) {
  const size_t count = track.components;
  const bool cubic = track.interpolation == Interpolation::cubic_spline;
  for (size_t i = 0; i < track.values.size(); ++i) {
    const bool tangent = cubic && i / count % 3 != 1;
    double rest = i % count == 3 ? 1 : otherwise;
    if (!given.empty()) rest = given[i % count];
    if (tangent) rest = 0;
    if (std::abs(track.values[i] - rest) > 1e-6 * std::abs(rest)) return false;
  }
  return given.empty() || given.size() == count;
}

}  // namespace

GltfMotion::GltfMotion(const GltfFile& gltf, FileImport& target) : gltf_(gltf), target_(target) {
  if (gltf.model.animations.empty()) return;
  tracks_.resize(gltf.model.nodes.size());
  for (size_t i = 0; i < gltf.model.animations.size(); ++i) read_animation(i);
  find_carried();
}

void GltfMotion::read_animation(size_t index) {
  const GltfAnimation& animation = gltf_.model.animations[index];
  double length = 0;  // the last of all keys, whichever channel has it
  for (const bool all_are_known : {false, true}) {
    for (size_t i = 0; i < animation.channels.size(); ++i) {
      const GltfAnimationChannel& channel = animation.channels[i];
      if (channel.node == -1) continue;  // glTF: to be ignored
      const std::string place = fmt::format("{}: animation {}: channel {}", target_.place(), index, i);
      if (channel.node < 0 || static_cast<size_t>(channel.node) >= tracks_.size())
        fail(place, "names node {} of {}", channel.node, tracks_.size());
      if (!is_path_of_nodes(channel.path)) {
        if (channel.path != "weights" && channel.path != "pointer")
          fail(place, "moves \"{}\", which is none of translation, rotation, scale and weights",
               channel.path.substr(0, 20));
        if (all_are_known) target_.warn("animations of weights or of what is no node are not played");
        continue;
      }
      if (all_are_known) {
        read_channel(animation, channel, length, place);
      } else {
        length = std::max(length, read_times(gltf_, sampler_of(animation, channel, place), place).back());
      }
    }
  }
}

MotionTrack GltfMotion::read_track(const GltfAnimation& animation, const GltfAnimationChannel& channel,
                                   uint32_t components, const std::string& place) const {
  const GltfAnimationSampler& sampler = sampler_of(animation, channel, place);
  MotionTrack track{.interpolation = interpolation_of(sampler, place),
                    .components = components,
                    .length = 0,
                    .times = read_times(gltf_, sampler, place),
                    .values = read_values(gltf_, sampler.output, static_cast<int>(components), place)};
  const bool cubic = track.interpolation == Interpolation::cubic_spline;
  const size_t expected = track.times.size() * (cubic ? 3 : 1), found = track.values.size() / components;
  if (found != expected)
    fail(place, "has {} values for {} keys, where {} are expected", found, track.times.size(), expected);
  for (size_t key = 0; components == 4 && key < track.times.size(); ++key) {
    if (!has_length(track.values.data() + 4 * (cubic ? 3 * key + 1 : key)))
      fail(place, "key {} is a rotation without a length", key);
  }
  return track;
}

void GltfMotion::read_channel(const GltfAnimation& animation, const GltfAnimationChannel& channel,
                              double length, const std::string& place) {
  const auto node = static_cast<size_t>(channel.node);
  const GltfNode& of = gltf_.model.nodes[node];
  const bool turns = channel.path == "rotation", stretches = channel.path == "scale";
  MotionTrack track = read_track(animation, channel, turns ? 4 : 3, place);
  track.length = length;
  if (!of.matrix.empty()) fail(place, "moves node {}, which has a matrix", node);
  NodeTracks& tracks = tracks_[node];
  uint32_t& index = turns ? tracks.rotation : stretches ? tracks.scale : tracks.translation;
  if (index != no_track)
    return target_.warn("animations move what another one moves already, and are not played");
  const std::vector<double>& given = turns ? of.rotation : stretches ? of.scale : of.translation;
  if (is_at_rest(track, given, stretches ? 1 : 0)) return;
  index = static_cast<uint32_t>(motion_.tracks.size());
  motion_.tracks.push_back(std::move(track));
}

void GltfMotion::find_carried() {
  carried_.resize(tracks_.size(), false);
  std::vector<size_t> open;
  for (size_t node = 0; node < tracks_.size(); ++node) {
    if (moves(node)) open.push_back(node);
  }
  while (!open.empty()) {
    const size_t node = open.back();
    open.pop_back();
    if (carried_[node]) continue;
    carried_[node] = true;
    for (const int64_t child : gltf_.model.nodes[node].children) open.push_back(static_cast<size_t>(child));
  }
}

uint32_t GltfMotion::add_joint(size_t node, uint32_t above, const Affine& before) {
  const GltfNode& of = gltf_.model.nodes[node];
  MotionJoint joint{.parent = above,
                    .translation_track = tracks_[node].translation,
                    .rotation_track = tracks_[node].rotation,
                    .scale_track = tracks_[node].scale,
                    .before = before};
  if (of.translation.size() == 3)
    joint.translation = {of.translation[0], of.translation[1], of.translation[2]};
  if (of.rotation.size() == 4)
    joint.rotation = {of.rotation[0], of.rotation[1], of.rotation[2], of.rotation[3]};
  if (of.scale.size() == 3) joint.scale = {of.scale[0], of.scale[1], of.scale[2]};
  motion_.joints.push_back(joint);
  groups_.emplace_back();
  return static_cast<uint32_t>(motion_.joints.size() - 1);
}

void GltfMotion::place_groups() {
  if (groups_.empty()) return;
  const uint32_t first = target_.add_motion(std::move(motion_));
  for (uint32_t joint = 0; joint < groups_.size(); ++joint) {
    Group& group = groups_[joint];
    if (group.instances.empty() && group.groups.empty()) continue;
    // Objects count from the first one of them.
    SourceObjectId least = no_id;
    for (const Instance& instance : group.instances) least = std::min(least, instance.object);
    for (const GroupInstance& inner : group.groups) least = std::min(least, inner.first_object);
    for (Instance& instance : group.instances)
      if (instance.object != no_id) instance.object -= least;
    for (GroupInstance& inner : group.groups)
      if (inner.first_object != no_id) inner.first_object -= least;
    target_.add_moving_group(target_.add_group(std::move(group)), first + joint, least);
  }
}

}  // namespace triptych
