// Drawables as OpenGL draws them: one record per placement, in the order given, the bounds of its pieces, and
// an indirect command; several where backs of some of its triangles are left out, or show cut surfaces.
#pragma once

#include "lod/representation.hpp"
#include "scene/transparency.hpp"
#include "visibility/cut_bodies.hpp"
#include "visibility/screen_bounds.hpp"
#include "visibility/vertex_terms.hpp"

#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace triptych {

/// Where a chunk lies in the device's buffers; empty if it is not loaded.
struct ChunkRange {
  uint32_t first_index = 0, index_count = 0, base_vertex = 0;
  std::vector<uint32_t> outward_runs = {};  ///< Chunk::outward_runs
  bool colored = false;                     ///< whether vertices have colours
  ChunkNormals normals = ChunkNormals::none;
  std::vector<uint32_t> transparent = {};  ///< transparent_runs()
  bool textured = false;                   ///< whether vertices have places on textures
  bool emissive = false;                   ///< whether any of its surfaces has light of its own
  bool cut_out = false;                    ///< whether any of them has holes
  std::vector<uint32_t> textures = {};     ///< that they have
  bool layered = false;                    ///< whether any of its triangles is in a layer (scene/layers.hpp)
  bool lit = false;                        ///< whether vertices have baked light
  bool loaded() const { return index_count > 0; }
};

/// What the vertex stage reads for one placement (render/gl/vertex_layout.cpp).
struct DrawRecord {
  glm::vec4 rows[3];
  glm::ivec3 cell;
  uint32_t item;
  uint32_t first_bound;  ///< of the chunk's first piece; those of the others follow
  uint32_t cut;          ///< SectionPlace::cut, and the two bits below where it is not 0

  static constexpr uint32_t closed = 1u << 30;    ///< its triangles belong to a closed surface
  static constexpr uint32_t mirrored = 1u << 31;  ///< their fronts go round clockwise
};

struct DrawCommand {
  uint32_t index_count, instance_count, first_index;
  int32_t base_vertex;
  uint32_t base_instance;
};

/// Commands that follow each other, show the same sides of triangles, and are of chunks that have the same of
/// what ChunkRange names; or those of one closed surface that a section may cut, for its cut surfaces.
struct DrawGroup {
  int32_t front = 0;  ///< outward_front(); 0 draws both sides
  bool colored = false, textured = false, emissive = false, cut_out = false, lit = false;
  bool layered = false;                       ///< of cut surfaces never
  ChunkNormals normals = ChunkNormals::none;  ///< of cut surfaces none
  bool is_alike(const DrawGroup& other) const {
    return colored == other.colored && textured == other.textured && emissive == other.emissive &&
           cut_out == other.cut_out && layered == other.layered && lit == other.lit &&
           normals == other.normals;
  }
  enum class Caps : uint8_t { none, plain, mirrored } caps = Caps::none;
  uint32_t count = 0;
  /// Of cut surfaces: so many commands behind those `count`, which draw the whole surface, draw what of it
  /// shows them.
  uint32_t shown = 0;
};

/// Which triangles of drawables a list draws.
enum class DrawPart : uint8_t { all, opaque, transparent };

struct DrawList {
  std::vector<DrawRecord> records;
  std::vector<PixelDepthBound> bounds;
  std::vector<DrawCommand> commands;
  std::vector<DrawGroup> groups;
  uint64_t triangles = 0;

  /// Empties it and keeps its memory.
  void clear();
};

/// Makes draw lists under one frame view at a time. Reuses its memory from frame to frame.
class DrawListBuilder {
 public:
  explicit DrawListBuilder(const Skeleton& skeleton) : skeleton_(skeleton), placer_(skeleton) {}

  void begin(const FrameView& view);
  /// ranges: for each chunk where it lies in device memory; chunks that are not loaded are left out.
  /// bodies: found among the items; all of their chunks are loaded. Of what is transparent alone there are no
  /// cut surfaces.
  void append(std::span<const ChunkRange> ranges, std::span<const DrawItem> items, const CutBodies& bodies,
              DrawPart part, DrawList& list);

 private:
  static void add_command(const ChunkRange& range, const DrawGroup& group, uint32_t first_triangle,
                          uint32_t end, DrawList& list);
  void add_surfaces(const ChunkRange& range, const DrawItem& item, DrawPart part, DrawList& list);
  void add_caps(std::span<const ChunkRange> ranges, std::span<const DrawItem> items, const CutBody& body,
                std::span<const CutRun> runs, uint32_t first, uint32_t last, DrawList& list);
  DrawRecord record(uint32_t transform, uint32_t lattice, const DrawList& list);

  const Skeleton& skeleton_;
  LatticePlacer placer_;
  std::optional<FrameView> view_;
  std::optional<BoxProjector> projector_;
  std::vector<std::pair<uint32_t, uint32_t>>
      capped_items_;  ///< item, index of the body that it shows a part of
  std::vector<DrawCommand> shown_;
};

}  // namespace triptych
