// The inner seams of the glTF importer. Its JSON is a GltfDocument; buffers stay in their files. All
// references and ranges are checked where they are used.
#pragma once

#include "model/import/import_file.hpp"
#include "model/import/import_gltf_document.hpp"
#include "model/import/mesh_stream_indexed.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// The bytes of a buffer, which stay in their file; those of a data URI are in memory.
struct GltfBuffer {
  std::shared_ptr<const StreamSource> source;
  uint64_t offset = 0, size = 0;
  std::string missing = {};  ///< why there is no source
};

struct GltfImage {
  std::string name;
  std::shared_ptr<const std::string> uri;  ///< null where it is in a view
  int64_t view = -1;
};

struct GltfFile {
  GltfDocument model;  ///< without its buffers and images
  std::vector<GltfBuffer> buffers;
  std::vector<GltfImage> images;
  ImportOptions options;
  /// Views that were compressed, once they were needed.
  mutable std::map<size_t, GltfBuffer> unpacked_views;
};

/// The bytes of a buffer view, unpacked if it is compressed. Error (place) for a reference or a range that
/// leaves what it refers to, or data that cannot be unpacked.
GltfBuffer gltf_view_bytes(const GltfFile& gltf, int64_t view, const std::string& place);
std::vector<std::byte> read_gltf_bytes(const GltfBuffer& range);

/// The triangles and vertices of a primitive that Draco compressed, in memory.
struct GltfDracoMesh {
  IndexTable indices;
  PositionTable positions;
  std::optional<ColorTable> colors = std::nullopt;
  std::optional<PositionTable> normals = std::nullopt;
  std::optional<PositionTable> coordinates = std::nullopt;
};
/// set: which of the texture coordinates; none if it is negative. Error (place) if they cannot be unpacked.
GltfDracoMesh unpack_draco(const GltfFile& gltf, const GltfDraco& draco, int64_t set,
                           const std::string& place);

/// Parses a .gltf or .glb file. Error (file) for one that does not parse, lacks a buffer, or requires an
/// extension that is not known.
GltfFile load_gltf(FileImport& target, const std::shared_ptr<const StreamSource>& source);

/// The values of two top-level members of the JSON text; empty if there is none.
struct GltfTaken {
  std::string buffers, images;
};
/// Takes them out of the text. Error (place, byte) for JSON nested too deeply for a parser.
GltfTaken take_buffers(std::string& json, const std::string& place);
/// The files that buffers and images of the JSON text name; invalid values are ignored.
std::vector<std::string> names_in_gltf(const std::string& text, const std::string& place);
/// Finds what the JSON value "buffers" names. Files are looked for beside the target, and a buffer without an
/// URI is `binary`, the second chunk of a binary file. Nothing if it is not JSON; Error (place) for a buffer
/// that is none.
std::optional<std::vector<GltfBuffer>> find_buffers(const std::string& json, FileImport& target,
                                                    const std::optional<GltfBuffer>& binary);

bool is_data_uri(std::string_view uri);
/// Of a data URI of any media type (RFC 2397). Error (place) if it has none.
std::vector<std::byte> bytes_of_data_uri(const std::string& uri, const std::string& place);
/// The file that an URI names. Error (place) if it is not there, or has less than `size` bytes.
GltfBuffer gltf_file_beside(FileImport& target, const std::string& uri, uint64_t size,
                            const std::string& place);
/// What the JSON value "images" names; entries that are no objects have neither URI nor view.
std::vector<GltfImage> find_gltf_images(const std::string& json);

/// Adds images of the file to the model when they are asked for, each once. Those that are not there are
/// counted in a warning.
class GltfImages {
 public:
  GltfImages(const GltfFile& gltf, FileImport& target)
      : gltf_(gltf), target_(target), known_(gltf.images.size()) {}
  /// Its number in the model; no_id where it is not there.
  uint32_t image(int64_t index);

 private:
  ModelImage open(size_t index);
  void skip(const std::string& what);

  const GltfFile& gltf_;
  FileImport& target_;
  std::vector<std::optional<uint32_t>> known_;
  std::string first_missing_;
};

/// A material of the file, as the model's have them, and where its textures find their coordinates.
struct GltfSurface {
  Material material;
  int64_t coordinates = -1;  ///< of the attributes TEXCOORD_n; −1: it has no texture
  GltfTextureTransform transform = {};
};
GltfSurface read_gltf_material(const GltfFile& gltf, const GltfMaterial& material, GltfImages& images,
                               FileImport& target);

/// The elements of one accessor, sparse ones included. Construction checks every range (Error, place), so
/// that element 0 … count() − 1 never leaves the buffer.
class GltfAccessor {
 public:
  GltfAccessor(const GltfFile& gltf, int64_t accessor, const std::string& place);

  size_t count() const { return count_; }
  int components() const { return components_; }
  bool holds_indices() const;

  /// Whether all elements can be read directly from the file, so that they can stay there.
  bool can_stream() const { return !sparse_ && stride_ <= PositionTable::max_stride; }
  PositionTable positions() const;    ///< of three components
  ColorTable colors() const;          ///< of three components, and perhaps one more
  PositionTable coordinates() const;  ///< of two components, which come as x and y
  IndexTable indices() const;

  /// Reads all elements; needed before component().
  void load();
  /// Component c of element i; normalized integers as −1..1 or 0..1.
  double component(size_t i, int c) const;
  std::vector<std::byte> take_elements() { return std::move(elements_); }

 private:
  size_t count_ = 0, stride_ = 0, element_bytes_ = 0;
  int components_ = 0, component_type_ = 0;
  bool normalized_ = false, sparse_ = false;
  GltfBuffer data_, sparse_values_;       ///< without a source: every element is zero
  std::vector<uint32_t> sparse_indices_;  ///< ascending
  std::vector<std::byte> elements_;       ///< after load(), without gaps
};

/// Adds the meshes of the file to the target when they are requested, each once.
class GltfMeshes {
 public:
  GltfMeshes(const GltfFile& gltf, FileImport& target);
  /// The model's index of the file's mesh; nothing if it holds no triangles. Error for an index out of range.
  std::optional<uint32_t> mesh(int64_t index, const std::string& place);
  /// The mesh as its skin's joints hold it at rest; to be placed as it is, whatever its node's transform.
  std::optional<uint32_t> skinned_mesh(int64_t index, const std::vector<Affine>& joints, int64_t skin,
                                       const std::string& place);
  /// Whether a primitive of the mesh is bound to joints.
  bool has_joints(int64_t index) const;
  size_t unused_count() const;

 private:
  /// A primitive whose ranges are checked.
  struct Part {
    IndexedPart triangles;
    int64_t positions = -1;                 ///< accessor
    std::optional<PositionTable> unpacked;  ///< in place of the accessor
    std::optional<ColorTable> colors;
    std::optional<PositionTable> normals;
    std::optional<CoordinateTable> coordinates;
    const GltfPrimitive* primitive = nullptr;
    bool can_stream = false;
  };
  /// Where a vertex is moved to; null: nowhere.
  using Move = std::function<glm::dvec3(uint32_t vertex, const glm::dvec3& position)>;
  /// Positions of an accessor by number: from its file, or in memory.
  struct Positions {
    std::optional<GltfAccessor> accessor;  ///< nullopt: all is in the cache
    std::unique_ptr<PositionCache> cache;
    glm::dvec3 at(uint32_t vertex);
  };
  std::optional<uint32_t> read_mesh(size_t index);
  std::vector<Part> read_parts(size_t index);
  std::optional<Part> read_primitive(const GltfPrimitive& primitive, const std::string& place);
  void read_indices(const GltfPrimitive& primitive, const std::string& place, Part& part);
  void read_colors(const GltfPrimitive& primitive, const std::string& place, Part& part);
  void read_normals(const GltfPrimitive& primitive, const std::string& place, Part& part);
  static void hold_in_memory(GltfAccessor& accessor, const std::string& place, PositionTable& values);
  void read_coordinates(const GltfPrimitive& primitive, const std::string& place, Part& part);
  bool read_draco(const GltfPrimitive& primitive, const std::string& place, Part& part);
  void read_triangles(const Part& part, const Move& move, Mesh& mesh);
  static VertexNormal moved_normal(const Move& move, uint32_t vertex, const glm::dvec3& position,
                                   const VertexNormal& normal);
  Move skinning(const Part& part, const std::vector<Affine>& joints);
  Positions& positions(int64_t accessor, const std::string& place);
  const GltfFile& gltf_;
  FileImport& target_;
  std::vector<uint32_t> materials_;              ///< the file's to the model's
  std::vector<GltfSurface> surfaces_;            ///< of each of the file's materials
  std::vector<bool> known_;                      ///< whether the mesh was requested
  std::vector<std::optional<uint32_t>> meshes_;  ///< the file's to the model's
  std::vector<uint32_t> renamed_;  ///< an accessor's vertex to the mesh's, while a primitive is read
  std::map<std::pair<int64_t, int64_t>, std::optional<uint32_t>> skinned_;  ///< by mesh and skin
  std::string first_damage_;                          ///< the warning of primitives that cannot be read
  std::string first_bad_colors_, first_bad_normals_;  ///< and of those whose colours or normals cannot
  std::string first_bad_coordinates_;                 ///< and of those whose texture coordinates cannot
  int64_t last_accessor_ = -1;
  std::optional<Positions> last_positions_;  ///< files often keep the vertices of many meshes in one accessor
};

class GltfMotion;

/// Which subtrees of the node tree repeat.
struct GltfGroups {
  static constexpr uint32_t none = 0xffffffffu;
  /// For each node the group that its subtree (without its own transform) belongs to, or none.
  std::vector<uint32_t> of_node;
  std::vector<uint32_t> nodes;  ///< for each group one of its nodes; groups come before those they are in
  /// For each group how many places it has in the scene, also within other groups.
  std::vector<uint64_t> uses;
  /// For each group how many meshes it places, those of groups in it included.
  std::vector<uint64_t> placements;
};

/// Two subtrees are equal if their nodes place the same meshes under transforms that are equal to the bit,
/// without the transform of the topmost one, and the same nodes below it have names, of whatever text. Those
/// with something that moves are equal to no other. All of
/// them together must place as much as the options require (ImportOptions::find_groups), and they must have
/// at least two places: a subtree that is only part of another group, once, is not a group. `roots`: of a
/// tree. Reads no geometry.
GltfGroups find_gltf_groups(const GltfDocument& gltf, const std::vector<size_t>& roots,
                            const GltfMotion& motion, const ImportOptions& options);

/// Whether a node has a name or extras of its own.
bool gltf_node_is_named(const GltfNode& node);

/// Adds the objects of the scene, and says for each node which one its mesh belongs to: nodes with names or
/// extras, topmost nodes of groups, and nodes with a named mesh that are in no object; the others belong to
/// the object that they are in. Equal subtrees that are groups have as many objects, one after the other in
/// the same order. Nothing is added, and all is no_id, where neither nodes nor meshes have names.
std::vector<SourceObjectId> add_gltf_objects(const GltfDocument& gltf, const std::vector<size_t>& roots,
                                             const GltfGroups& groups, FileImport& target);

/// The transform of a node relative to its parent. Error (place) for lists of the wrong length.
Affine gltf_local_transform(const GltfNode& node, const std::string& place);

/// Of each joint of a skin the transform of its vertices to the scene, as the nodes stand at rest. `globals`:
/// of every node to the scene. Error (place) for references out of range.
std::vector<Affine> gltf_joint_transforms(const GltfFile& gltf, int64_t skin,
                                          const std::vector<Affine>& globals, const std::string& place);

/// Adds the lights of the nodes below the roots, each where its node is.
void add_gltf_lights(const GltfDocument& gltf, const std::vector<size_t>& roots, FileImport& target);

/// Walks the scene's node tree and places its meshes, EXT_mesh_gpu_instancing included, and what repeats as
/// groups. Error for nodes that are out of range, have several parents or form a cycle.
void place_gltf_nodes(const GltfFile& gltf, FileImport& target, GltfMeshes& meshes);

}  // namespace triptych
