// The parts of a pack that its reader and its writer share: header, section table, checksums.
// docs/pack-format.md describes every byte.
#pragma once

#include "scene/skeleton.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace triptych {

/// Of packs without sub-hierarchies.
inline constexpr uint32_t pack_format_version = 2;
/// Of packs with the section SUBH: programs that do not know it must not misread them.
inline constexpr uint32_t instanced_pack_format_version = 3;

inline constexpr std::array<char, 8> pack_magic = {'T', 'R', 'I', 'P', 'T', 'Y', 'C', 'H'};
inline constexpr std::array<char, 4> geometry_type = {'G', 'E', 'O', 'M'};
/// Of that section; SKEL and SUBH are of version 1.
inline constexpr uint32_t geometry_version = 2;
/// Of that section where chunks may have vertex colours (Skeleton::effects names them).
inline constexpr uint32_t colored_geometry_version = 3;
/// Of that section where vertices may say how many layers lie on them (Skeleton::effects names those, and
/// vertex colours if there are any).
inline constexpr uint32_t layered_geometry_version = 4;
/// Of that section where chunks may have shading normals (Skeleton::effects names them, and the others if
/// there are any).
inline constexpr uint32_t shaded_geometry_version = 5;
/// Of that section where chunks may have texture coordinates, and what the versions before may have.
inline constexpr uint32_t textured_geometry_version = 6;
/// Of that section where chunks may have baked light (Skeleton::effects names it, or ambient occlusion), and
/// what the versions before may have.
inline constexpr uint32_t lit_geometry_version = 7;
inline constexpr std::array<char, 4> skeleton_type = {'S', 'K', 'E', 'L'};
inline constexpr std::array<char, 4> sub_hierarchies_type = {'S', 'U', 'B', 'H'};
/// Only in packs of models with names. It is not read when a pack is opened.
inline constexpr std::array<char, 4> objects_type = {'O', 'B', 'J', 'S'};
inline constexpr uint32_t objects_version = 1;
/// How the pack was built. It is not read when a pack is opened.
inline constexpr std::array<char, 4> options_type = {'O', 'P', 'T', 'S'};
inline constexpr uint32_t options_version = 1;
/// Only in packs with chunks that are made to be seen from outside.
inline constexpr std::array<char, 4> seen_from_outside_type = {'S', 'E', 'E', 'N'};
inline constexpr uint32_t seen_from_outside_version = 1;
/// Only in packs with closed surfaces.
inline constexpr std::array<char, 4> closed_surfaces_type = {'B', 'O', 'D', 'Y'};
inline constexpr uint32_t closed_surfaces_version = 1;

/// Only in packs with textures, or with surfaces that have light of their own.
inline constexpr std::array<char, 4> materials_type = {'M', 'A', 'T', 'L'};
inline constexpr uint32_t materials_version = 1;
/// Only in packs with textures. It is not read when a pack is opened; its checksum is that of the checksums
/// of the textures' levels in order.
inline constexpr std::array<char, 4> texels_type = {'T', 'E', 'X', 'L'};
inline constexpr uint32_t texels_version = 1;

/// Only in packs of models where something moves: with it and with sub-hierarchies, which are what moves.
inline constexpr std::array<char, 4> motion_type = {'M', 'O', 'V', 'E'};
inline constexpr uint32_t motion_version = 1;
/// Only in packs of models whose place on Earth is known (scene/geo_place.hpp).
inline constexpr std::array<char, 4> geo_place_type = {'S', 'K', 'Y', 'L'};
inline constexpr uint32_t geo_place_version = 1;

struct PackHeader {
  std::array<char, 8> signature = pack_magic;
  uint32_t version = pack_format_version;
  uint32_t section_count = 0;
  uint64_t table_offset = 0;
  uint64_t table_checksum = 0;  ///< of the table's bytes, seeded with the version
};
static_assert(sizeof(PackHeader) == 32);

struct PackSection {
  std::array<char, 4> type{};
  uint32_t version = 1;
  uint64_t offset = 0, size = 0;
  uint64_t checksum = 0;
};
static_assert(sizeof(PackSection) == 32);

/// The geometry section is too large to be read at once: its checksum is that of its chunks' checksums in
/// order.
uint64_t geometry_checksum(std::span<const ChunkInfo> chunks);

/// The same of the section of texels.
uint64_t texels_checksum(std::span<const Texture> textures);

/// The content hash of a pack with both sections.
uint64_t instanced_content_hash(uint64_t skeleton_checksum, uint64_t sub_hierarchies_checksum);

}  // namespace triptych
