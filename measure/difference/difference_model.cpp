#include "measure/difference/difference_model.hpp"

#include <algorithm>
#include <array>
#include <glm/vec4.hpp>
#include <map>
#include <tuple>

namespace triptych {

namespace {

/// Materials of the model, by index; linear light. Grey is what objects without a material have.
enum Shown : uint32_t { unchanged, added, changed, removed };
constexpr std::array<glm::vec4, 4> shown_colors = {
    {{0.45f, 0.45f, 0.45f, 1}, {0.02f, 0.5f, 0.04f, 1}, {0.9f, 0.62f, 0.01f, 1}, {0.72f, 0.012f, 0.012f, 1}}};

/// Adds what a revision shows to the model.
class RevisionPart {
 public:
  RevisionPart(const Revision& revision, Model& model) : revision_(revision), model_(model) {}

  /// An object in one colour, as the object `as` of the model; no_id: as none of them.
  void add(SourceObjectId object, Shown shown, SourceObjectId as) {
    // What one transform places is a mesh, or what the build divided it into.
    std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> chunks;  // by transform and lattice
    const Skeleton& skeleton = revision_.pack.skeleton();
    for (const Placement& placement : revision_.shapes.placements_of(object))
      chunks[{placement.transform, skeleton.chunks[placement.chunk].lattice}].push_back(placement.chunk);
    for (auto& [place, parts] : chunks) {
      std::sort(parts.begin(), parts.end());
      model_.instances.emplace_back(mesh_of(parts, shown), skeleton.transforms[place.first], as);
    }
  }

 private:
  uint32_t mesh_of(const std::vector<uint32_t>& chunks, Shown shown) {
    const auto [known, is_new] =
        meshes_.try_emplace({chunks, shown}, static_cast<uint32_t>(model_.meshes.size()));
    if (is_new) {
      Mesh mesh;
      for (const uint32_t chunk : chunks) append(chunk, shown, mesh);
      model_.meshes.push_back(std::move(mesh));
    }
    return known->second;
  }

  void append(uint32_t index, Shown shown, Mesh& mesh) const {
    const Skeleton& skeleton = revision_.pack.skeleton();
    const Lattice& lattice = skeleton.lattices[skeleton.chunks[index].lattice];
    const Chunk chunk = revision_.pack.read_chunk(index);
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const ChunkVertex& vertex : chunk.vertices) mesh.positions.push_back(lattice.position(vertex.point));
    for (size_t i = 0; i < chunk.indices.size(); i += 3) {
      mesh.triangles.push_back(
          {{first + chunk.indices[i], first + chunk.indices[i + 1], first + chunk.indices[i + 2]}, shown});
    }
  }

  const Revision& revision_;
  Model& model_;
  std::map<std::pair<std::vector<uint32_t>, Shown>, uint32_t> meshes_;
};

/// Copies objects with what is told of them.
class ObjectCopies {
 public:
  explicit ObjectCopies(SourceObjects& into) : into_(into) {}

  SourceObjectId add(const SourceObjects& from, SourceObjectId id, SourceObjectId parent,
                     const std::string& state) {
    SourceObject object = from.objects[id];
    for (uint32_t* text :
         {&object.name, &object.type, &object.guid, &object.layer, &object.storey, &object.number})
      *text = number_of(from.texts[*text]);
    object.parent = parent;
    object.first_set = static_cast<uint32_t>(into_.set_uses.size());
    for (const uint32_t set : from.sets_of(id)) into_.set_uses.push_back(set_of(from, set));
    into_.set_uses.push_back(state_set(state));
    into_.objects.push_back(object);
    return static_cast<SourceObjectId>(into_.objects.size() - 1);
  }

 private:
  uint32_t number_of(std::string_view text) {
    if (text.empty()) return 0;
    const auto [known, is_new] = texts_.try_emplace(std::string(text), 0u);
    if (is_new) known->second = into_.texts.add(text);
    return known->second;
  }

  uint32_t begin_set(std::string_view name) {
    into_.sets.push_back({number_of(name), static_cast<uint32_t>(into_.properties.size())});
    return static_cast<uint32_t>(into_.sets.size() - 1);
  }

  uint32_t set_of(const SourceObjects& from, uint32_t set) {
    const auto [known, is_new] = sets_.try_emplace({&from, set}, 0u);
    if (is_new) {
      known->second = begin_set(from.texts[from.sets[set].name]);
      for (const SourceProperty& property : from.properties_of(set))
        into_.properties.push_back(
            {number_of(from.texts[property.name]), number_of(from.texts[property.value])});
    }
    return known->second;
  }

  uint32_t state_set(const std::string& state) {
    const auto [known, is_new] = states_.try_emplace(state, 0u);
    if (is_new) {
      known->second = begin_set("Revision");
      into_.properties.push_back({number_of("State"), number_of(state)});
    }
    return known->second;
  }

  SourceObjects& into_;
  std::map<std::string, uint32_t, std::less<>> texts_;
  std::map<std::pair<const SourceObjects*, uint32_t>, uint32_t> sets_;
  std::map<std::string, uint32_t> states_;
};

/// Words none of which is part of another, so that a search for one finds that alone.
std::string state_of(const ObjectChange& change) {
  if (change.removed()) return "gone";
  if (change.added()) return "added";
  return change.differs() ? "changed: " + words_of(change) : "same";
}

Shown shown_as(const ObjectChange& change) {
  return change.added() ? added : change.removed() ? removed : change.differs() ? changed : unchanged;
}

}  // namespace

Model difference_model(const Revision& before, const Revision& after, const PackDifference& difference) {
  Model model;
  model.files = {after.pack.name(), before.pack.name()};
  for (const glm::vec4& color : shown_colors) model.materials.push_back({color});
  RevisionPart old_part(before, model), new_part(after, model);
  ObjectCopies copies(model.source_objects);
  // Ids of the newer revision stay; what was removed comes behind, in what it was in, if that is still there.
  std::vector<SourceObjectId> of_old(before.source().objects.size(), no_id);
  for (const ObjectChange& change : difference.objects) {
    const auto [old_id, new_id] = change.object;
    const std::string state = state_of(change);
    if (!change.removed()) {
      const bool named = new_id != after.shapes.nameless();
      if (named) copies.add(after.source(), new_id, after.source().objects[new_id].parent, state);
      if (named && old_id != no_id) of_old[old_id] = new_id;
      new_part.add(new_id, shown_as(change), named ? new_id : no_id);
    } else if (old_id != before.shapes.nameless()) {
      const SourceObjectId parent = before.source().objects[old_id].parent;
      of_old[old_id] = copies.add(before.source(), old_id, parent == no_id ? no_id : of_old[parent], state);
      old_part.add(old_id, removed, of_old[old_id]);
    } else {
      old_part.add(old_id, removed, no_id);
    }
  }
  return model;
}

}  // namespace triptych
