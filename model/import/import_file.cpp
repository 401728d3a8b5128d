#include "model/import/import_file.hpp"

#include "base/error.hpp"
#include "base/rounding.hpp"
#include "base/unnamed_file.hpp"
#include "model/import/beside.hpp"
#include "model/import/stored_mesh.hpp"

#include <algorithm>
#include <array>
#include <glm/mat4x4.hpp>
#include <limits>

namespace triptych {

namespace {

/// From the file's unit and axes to metres, y up.
Affine to_metres_y_up(const ImportOptions& options) {
  static constexpr std::array<double, 5> metres = {1, 0.01, 0.001, 0.0254, 0.3048};
  const double scale = metres[static_cast<size_t>(options.unit.value_or(LengthUnit::metre))];
  if (options.up.value_or(UpAxis::y) == UpAxis::y)
    return {glm::dvec3(scale, 0, 0), glm::dvec3(0, scale, 0), glm::dvec3(0, 0, scale), glm::dvec3(0)};
  return {glm::dvec3(scale, 0, 0), glm::dvec3(0, 0, -scale), glm::dvec3(0, scale, 0), glm::dvec3(0)};
}

/// Drops triangles with unusable coordinates, then the vertices that nothing uses any more. Returns how many
/// triangles.
uint64_t drop_unusable(Mesh& mesh) {
  if (std::all_of(mesh.positions.begin(), mesh.positions.end(), is_usable)) return 0;
  const auto dropped = std::erase_if(mesh.triangles, [&](const Triangle& triangle) {
    return !std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                        [&](uint32_t vertex) { return is_usable(mesh.positions[vertex]); });
  });
  std::vector<uint32_t> renamed(mesh.positions.size());
  uint32_t kept = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!is_usable(mesh.positions[i])) continue;
    mesh.positions[kept] = mesh.positions[i];
    if (!mesh.colors.empty()) mesh.colors[kept] = mesh.colors[i];
    if (!mesh.normals.empty()) mesh.normals[kept] = mesh.normals[i];
    if (!mesh.coordinates.empty()) mesh.coordinates[kept] = mesh.coordinates[i];
    renamed[i] = kept++;
  }
  mesh.positions.resize(kept);
  if (!mesh.colors.empty()) mesh.colors.resize(kept);
  if (!mesh.normals.empty()) mesh.normals.resize(kept);
  if (!mesh.coordinates.empty()) mesh.coordinates.resize(kept);
  for (Triangle& triangle : mesh.triangles) {
    for (uint32_t& vertex : triangle.vertices) vertex = renamed[vertex];
  }
  return dropped;
}

}  // namespace

FileImport::FileImport(std::filesystem::path file, Model& model, const ImportOptions& options)
    : file_(std::move(file)),
      model_(model),
      options_(options),
      first_instance_(model.instances.size()),
      first_group_instance_(model.group_instances.size()),
      first_warning_(model.report.warnings.size()),
      to_metres_y_up_(to_metres_y_up(options)),
      objects_(model.source_objects, file_.string()) {
  model_.files.push_back(file_);
  for (const Mesh& mesh : model_.meshes) {
    in_memory_ += held_triangles(mesh);
    held_bytes_ += held_bytes(mesh);
  }
}

std::string FileImport::line_place(uint64_t line) const { return fmt::format("{}: line {}", place(), line); }

std::shared_ptr<const StreamSource> FileImport::content() {
  if (!packed_.content) packed_.content = std::make_shared<StreamSource>(file_);
  return packed_.content;
}

std::shared_ptr<const StreamSource> FileImport::beside(std::string_view name) {
  if (packed_.archive) return packed_.archive->beside(packed_.name, name, options_);
  const auto found = find_beside(file_.parent_path(), name);
  return found ? std::make_shared<StreamSource>(*found) : nullptr;
}

void FileImport::unpacks(PackedFile packed) { packed_ = std::move(packed); }

void FileImport::warn(std::string_view what, uint64_t count) {
  if (count == 0) return;
  const auto known = std::find_if(warnings_.begin(), warnings_.end(),
                                  [&](const auto& warning) { return warning.first == what; });
  if (known != warnings_.end()) {
    known->second += count;
  } else {
    warnings_.emplace_back(what, count);
  }
}

void FileImport::remark(std::string what) { warnings_.emplace_back(std::move(what), 0); }

void FileImport::says_up(std::optional<UpAxis> up) {
  if (options_.up && options_.up != up) remark("the format says which axis is up; --up was not applied");
  options_.up.reset();
  to_metres_y_up_ = to_metres_y_up(options_);
}

void FileImport::assume_up(UpAxis up) {
  options_.up = options_.up.value_or(up);
  to_metres_y_up_ = to_metres_y_up(options_);
}

void FileImport::says_unit(std::optional<LengthUnit> unit) {
  if (options_.unit && options_.unit != unit) remark("the format says its unit; --unit was not applied");
  options_.unit.reset();
  to_metres_y_up_ = to_metres_y_up(options_);
}

void FileImport::says_geo_place(const GeoPlace& geo_place) {
  if (!model_.geo_place) {
    model_.geo_place = geo_place;
  } else if (!(*model_.geo_place == geo_place)) {
    remark("says another place on Earth than a file before it, and is shown there");
  }
}

void FileImport::drop(uint64_t triangles) {
  count_dropped(triangles);
  warn(not_finite_warning, triangles);
}

void FileImport::count_dropped(uint64_t triangles) { model_.report.dropped_triangles += triangles; }

void FileImport::take_warnings(const MeshStream& stream) {
  for (std::string& warning : stream.warnings()) model_.report.warnings.push_back(std::move(warning));
}

uint32_t FileImport::add_material(const Material& material) {
  model_.materials.push_back(material);
  return static_cast<uint32_t>(model_.materials.size() - 1);
}

void FileImport::add_light(ModelLight light) {
  const glm::dmat3 linear(to_metres_y_up_);
  light.position = to_metres_y_up_ * glm::dvec4(light.position, 1);
  light.direction = glm::normalize(linear * light.direction);
  light.range *= glm::length(linear[0]);
  model_.lights.push_back(light);
}

uint32_t FileImport::add_image(ModelImage image) {
  model_.images.push_back(std::move(image));
  return static_cast<uint32_t>(model_.images.size() - 1);
}

void FileImport::set_material(uint32_t index, const Material& material) {
  model_.materials[index] = material;
}

std::optional<uint32_t> FileImport::add_mesh(Mesh mesh) {
  drop(drop_unusable(mesh));
  if (mesh.triangles.empty()) return std::nullopt;
  in_memory_ += mesh.triangles.size();
  if (held_bytes_ + held_bytes(mesh) <= options_.held_bytes) {
    held_bytes_ += held_bytes(mesh);
    return push_mesh(std::move(mesh));
  }
  if (!store_) store_ = open_unnamed_spool(options_.temporary_folder);
  return add_stream(std::move(mesh.name), std::make_shared<StoredMesh>(store_, mesh));
}

bool FileImport::should_stream(uint64_t triangles) const {
  return triangles > options_.stream_above || triangles > memory_left();
}

uint64_t FileImport::memory_left() const {
  return options_.max_in_memory - std::min(in_memory_, options_.max_in_memory);
}

uint32_t FileImport::add_stream(std::string name, std::shared_ptr<const MeshStream> stream) {
  return push_mesh({.name = std::move(name), .positions = {}, .triangles = {}, .stream = std::move(stream)});
}

uint32_t FileImport::push_mesh(Mesh mesh) {
  if (model_.meshes.size() == std::numeric_limits<uint32_t>::max()) fail(place(), "holds too many meshes");
  model_.meshes.push_back(std::move(mesh));
  return static_cast<uint32_t>(model_.meshes.size() - 1);
}

void FileImport::add_instance(uint32_t mesh, const Affine& transform, SourceObjectId object) {
  model_.instances.push_back({mesh, to_metres_y_up_ * glm::dmat4(transform), object});
}

uint32_t FileImport::add_group(Group group) {
  model_.groups.push_back(std::move(group));
  return static_cast<uint32_t>(model_.groups.size() - 1);
}

void FileImport::add_group_instance(uint32_t group, const Affine& transform, SourceObjectId first_object) {
  model_.group_instances.push_back({group, to_metres_y_up_ * glm::dmat4(transform), first_object});
}

uint32_t FileImport::add_motion(Motion motion) {
  const auto first_track = static_cast<uint32_t>(model_.motion.tracks.size()),
             first_joint = static_cast<uint32_t>(model_.motion.joints.size());
  const auto move_on = [](uint32_t& index, uint32_t first) {
    if (index != MotionJoint::none) index += first;
  };
  for (MotionJoint& joint : motion.joints) {
    if (joint.parent == MotionJoint::none) joint.before = to_metres_y_up_ * glm::dmat4(joint.before);
    move_on(joint.parent, first_joint);
    for (uint32_t* const track : {&joint.translation_track, &joint.rotation_track, &joint.scale_track})
      move_on(*track, first_track);
    model_.motion.joints.push_back(joint);
  }
  std::ranges::move(motion.tracks, std::back_inserter(model_.motion.tracks));
  return first_joint;
}

void FileImport::add_moving_group(uint32_t group, uint32_t joint, SourceObjectId first_object) {
  GroupInstance& placed = model_.group_instances.emplace_back(
      group, round_to_nearest([&] { return transform_at(model_.motion, joint, 0); }), first_object);
  placed.joint = joint;
}

void FileImport::finish() {
  for (const auto& [what, count] : warnings_) {
    model_.report.warnings.push_back(count > 0 ? fmt::format("{}: {} {}", place(), count, what)
                                               : fmt::format("{}: {}", place(), what));
  }
  if (model_.instances.size() > first_instance_ || model_.group_instances.size() > first_group_instance_)
    return;
  std::string why;
  const std::string own = place() + ": ";
  for (size_t i = first_warning_; i < model_.report.warnings.size(); ++i) {
    const std::string_view warning = model_.report.warnings[i];
    why += why.empty() ? ": " : "; ";
    why += warning.starts_with(own) ? warning.substr(own.size()) : warning;
  }
  constexpr size_t longest = 280;
  if (why.size() > longest) why = why.substr(0, longest - 4) + " ...";
  fail(place(), "holds no triangles{}", why);
}

}  // namespace triptych
