// What a reader's process wrote (scene_stream.hpp) as a part of the model. An instance's material is
// inherited by the faces that have none: each material that a mesh is placed with makes a mesh of its own.
#include "base/error.hpp"
#include "model/import/import_file.hpp"
#include "model/import/mesh_stream_indexed.hpp"
#include "model/import/scene_stream.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

namespace triptych {

namespace {

/// From a component as it is displayed (sRGB) to light.
float linear_of_display(float display) {
  if (!(display > 0)) return 0;
  if (display >= 1) return 1;
  return display <= 0.04045f ? display / 12.92f : std::pow((display + 0.055f) / 1.055f, 2.4f);
}

bool is_usable(const Affine& transform) {
  for (int column = 0; column < 4; ++column) {
    if (!triptych::is_usable(transform[column])) return false;
  }
  return true;
}

class SceneImport : public SceneSink {
 public:
  SceneImport(FileImport& target, std::shared_ptr<const StreamSource> source)
      : target_(target), source_(std::move(source)), reader_(source_) {}

  void begin(bool has_unit, bool has_axes) override {
    if (has_axes) {
      target_.says_up(UpAxis::z);
    } else {
      target_.assume_up(UpAxis::z);
    }
    if (has_unit) {
      target_.says_unit(std::nullopt);
    } else if (!target_.options().unit) {
      target_.remark("names no unit of length; metres are assumed (--unit says another)");
    }
  }

  void material(const glm::vec4& color) override {
    Material material;
    for (int i = 0; i < 3; ++i) material.base_color[i] = linear_of_display(color[i]);
    material.base_color.a = std::clamp(color.a, 0.0f, 1.0f);
    materials_.push_back(target_.add_material(material));
  }

  void geo_place(const GeoPlace& geo_place) override { target_.says_geo_place(geo_place); }

  void mesh(SceneMesh mesh) override { meshes_.push_back(std::move(mesh)); }

  void property_set(ScenePropertySet set) override {
    property_sets_.push_back(target_.objects().add_set(set.name, set.properties));
  }

  void object(SceneObject object) override {
    for (uint32_t& set : object.property_sets) set = property_sets_[set];
    objects_.push_back(target_.objects().add({.name = object.name,
                                              .type = object.type,
                                              .guid = object.guid,
                                              .layer = object.layer,
                                              .storey = object.storey,
                                              .number = object.id},
                                             no_id, object.property_sets));
  }

  void instance(const SceneInstance& instance) override {
    if (!is_usable(instance.transform)) {
      target_.warn("placements were left out: their coordinates are not finite");
      return;
    }
    const SourceObjectId object = instance.object == no_record ? no_id : objects_[instance.object];
    if (const auto mesh = placed(instance)) target_.add_instance(*mesh, instance.transform, object);
  }

 private:
  /// The model's mesh of an instance: the stream's in the instance's material; nullopt without triangles.
  std::optional<uint32_t> placed(const SceneInstance& instance) {
    const SceneMesh& mesh = meshes_[instance.mesh];
    const bool inherits = std::any_of(mesh.parts.begin(), mesh.parts.end(), [](const ScenePart& part) {
      return part.triangles > 0 && part.material == no_record;
    });
    const std::pair key(instance.mesh, inherits ? instance.material : no_record);
    const auto [known, is_new] = placed_.try_emplace(key);
    if (is_new) known->second = add(mesh, key.second);
    return known->second;
  }

  uint32_t material_of(const ScenePart& part, uint32_t inherited) const {
    const uint32_t material = part.material == no_record ? inherited : part.material;
    return material == no_record ? 0 : materials_[material];
  }

  std::optional<uint32_t> add(const SceneMesh& mesh, uint32_t inherited) {
    const uint64_t triangles = mesh.triangle_count();
    if (triangles == 0) return std::nullopt;
    if (target_.should_stream(triangles)) return target_.add_stream(mesh.name, stream(mesh, inherited));
    Mesh result{.name = mesh.name, .positions = positions_of(mesh), .triangles = {}};
    result.triangles.reserve(triangles);
    std::vector<uint32_t> indices(3 * triangles);
    reader_.read(mesh.indices_at, std::as_writable_bytes(std::span(indices)));
    auto next = indices.begin();
    for (const ScenePart& part : mesh.parts) {
      for (uint32_t i = 0; i < part.triangles; ++i, next += 3) {
        const Triangle triangle{{next[0], next[1], next[2]}, material_of(part, inherited)};
        for (const uint32_t vertex : triangle.vertices) {
          if (vertex >= mesh.vertex_count)
            fail(target_.place(), "a mesh names vertex {} of {}", vertex, mesh.vertex_count);
        }
        result.triangles.push_back(triangle);
      }
    }
    return target_.add_mesh(std::move(result));
  }

  std::vector<glm::dvec3> positions_of(const SceneMesh& mesh) const {
    std::vector<glm::dvec3> positions(mesh.vertex_count);
    if (mesh.coordinate_bytes == 8) {
      reader_.read(mesh.positions_at, std::as_writable_bytes(std::span(positions)));
      return positions;
    }
    std::vector<glm::vec3> single(mesh.vertex_count);
    reader_.read(mesh.positions_at, std::as_writable_bytes(std::span(single)));
    std::copy(single.begin(), single.end(), positions.begin());
    return positions;
  }

  std::shared_ptr<const MeshStream> stream(const SceneMesh& mesh, uint32_t inherited) const {
    const ScalarType scalar = mesh.coordinate_bytes == 8 ? ScalarType::float64 : ScalarType::float32;
    PositionTable positions{.source = source_,
                            .offset = mesh.positions_at,
                            .count = mesh.vertex_count,
                            .stride = 3 * size_t{mesh.coordinate_bytes}};
    for (size_t i = 0; i < 3; ++i) positions.fields[i] = {i * mesh.coordinate_bytes, scalar};
    std::vector<IndexedStream::Part> parts;
    uint64_t at = mesh.indices_at;
    for (const ScenePart& part : mesh.parts) {
      const IndexTable indices{
          .source = source_, .offset = at, .count = 3 * uint64_t{part.triangles}, .stride = 4};
      at += 12 * uint64_t{part.triangles};
      if (part.triangles == 0) continue;
      parts.push_back({{.vertex_count = mesh.vertex_count,
                        .indices = indices,
                        .material = material_of(part, inherited),
                        .place = target_.place()},
                       positions});
    }
    return std::make_shared<IndexedStream>(std::move(parts));
  }

  FileImport& target_;
  std::shared_ptr<const StreamSource> source_;
  SourceReader reader_;
  std::vector<uint32_t> materials_;                ///< of the stream to the model's
  std::vector<uint32_t> property_sets_, objects_;  ///< of the stream to the model's
  std::vector<SceneMesh> meshes_;
  std::map<std::pair<uint32_t, uint32_t>, std::optional<uint32_t>>
      placed_;  ///< by mesh and inherited material
};

}  // namespace

void import_scene(FileImport& target, std::shared_ptr<const StreamSource> source) {
  SceneImport scene(target, source);
  read_scene_stream(source, scene);
}

}  // namespace triptych
