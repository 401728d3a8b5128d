#include "preprocess/pack_writer.hpp"

#include "base/hashing.hpp"
#include "base/unnamed_file.hpp"
#include "preprocess/encode_chunk.hpp"
#include "scene/effects.hpp"
#include "scene/layers.hpp"
#include "scene/pack_format.hpp"
#include "scene/pack_motion.hpp"
#include "scene/pack_skeleton.hpp"
#include "scene/seen_from_outside.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

namespace triptych {

namespace {

void write_unfinished_header(AtomicFile& file) {
  const PackHeader unfinished{.signature = {}};
  file.write(std::as_bytes(std::span(&unfinished, 1)));
}

/// Turns the unfinished pack of a killed process back into one that can be continued. If that fails, opening
/// the file reports the error.
const std::filesystem::path& without_header(const std::filesystem::path& partial, uint64_t kept) {
  const PackHeader unfinished{.signature = {}};
  if (kept >= sizeof(PackHeader)) {
    std::fstream file(partial, std::ios::in | std::ios::out | std::ios::binary);
    file.write(reinterpret_cast<const char*>(&unfinished), sizeof(unfinished));
  }
  return partial;
}

}  // namespace

EncodedChunk::EncodedChunk(const Chunk& chunk, std::span<const uint32_t> runs, Palette palette)
    : bytes(encode_chunk(chunk, runs, palette)),
      triangles(static_cast<uint32_t>(chunk.triangle_count())),
      box(chunk.box()),
      pieces(chunk.pieces()),
      normals(chunk.normals_from) {
  // The codec drops vertices that no triangle uses, so the bytes say how many there are.
  std::memcpy(&vertices, bytes.data(), sizeof(vertices));
}

PackWriter::PackWriter(const std::filesystem::path& file)
    : file_(file),
      pieces_(file.string() + ": a temporary file", open_unnamed_file(file.parent_path() / ".")) {
  write_unfinished_header(file_);
}

PackWriter::PackWriter(const std::filesystem::path& file, const std::filesystem::path& partial, Kept kept)
    : file_(file, without_header(partial, kept.pack.size), kept.pack),
      pieces_(std::filesystem::path(partial) += ".pieces", kept.pieces) {
  if (kept.pack.size == 0) write_unfinished_header(file_);
}

PackWriter::Kept PackWriter::flush() { return {file_.flush(), pieces_.kept()}; }

uint32_t PackWriter::add_chunk(const Chunk& chunk, uint32_t lattice) {
  return add_chunk(EncodedChunk(chunk), lattice);
}

uint32_t PackWriter::add_chunk(const EncodedChunk& chunk, uint32_t lattice) {
  chunks_.push_back({.offset = file_.size() - sizeof(PackHeader),
                     .size = chunk.bytes.size(),
                     .checksum = hash_bytes(chunk.bytes),
                     .vertex_count = chunk.vertices,
                     .triangle_count = chunk.triangles,
                     .lattice = lattice,
                     .first_piece = static_cast<uint32_t>(pieces_.size() / sizeof(LatticeBox)),
                     .box = chunk.box});
  if (!chunk.pieces.empty()) pieces_.append(std::as_bytes(std::span(chunk.pieces)));
  seen_from_outside_.push_back(chunk.seen_from_outside);
  normals_.add(chunk.normals);
  file_.write(chunk.bytes);
  return static_cast<uint32_t>(chunks_.size() - 1);
}

void PackWriter::adopt(std::span<const ChunkInfo> chunks, std::span<const uint8_t> seen_from_outside,
                       const NormalsUsed& normals) {
  normals_.add(normals);
  chunks_.insert(chunks_.end(), chunks.begin(), chunks.end());
  for (const uint8_t seen : seen_from_outside) seen_from_outside_.push_back(seen != 0);
}

void PackWriter::finish(StoredSkeleton skeleton, std::span<const std::byte> objects,
                        const PackOptions& options, const SpoolFile* texels) {
  skeleton.surrounding.chunks = std::move(chunks_);
  auto& effects = skeleton.surrounding.effects;
  if (normals_.of_files) effects.push_back(effect_name_in_pack(Effect::smooth_normals));
  if (normals_.of_levels) effects.emplace_back(level_normals_effect);
  const ClosedSurfaces& closed = skeleton.surrounding.closed;
  const bool colored =
      std::count(effects.begin(), effects.end(), effect_name_in_pack(Effect::vertex_colors)) > 0;
  const std::vector<std::byte> materials = encode_materials(skeleton.surrounding);
  const uint32_t version = has_baked_light(effects)                  ? lit_geometry_version
                           : !materials.empty()                      ? textured_geometry_version
                           : normals_.of_files || normals_.of_levels ? shaded_geometry_version
                           : has_layers(effects)                     ? layered_geometry_version
                           : colored                                 ? colored_geometry_version
                                                                     : geometry_version;
  std::vector<PackSection> table = {{.type = geometry_type,
                                     .version = version,
                                     .offset = sizeof(PackHeader),
                                     .size = file_.size() - sizeof(PackHeader),
                                     .checksum = geometry_checksum(skeleton.surrounding.chunks)}};
  const auto add_section = [&](const std::array<char, 4>& type, const auto& write_to) {
    const uint64_t offset = file_.size();
    StreamHash hash;
    write_to([&](std::span<const std::byte> bytes) {
      hash.add(bytes);
      file_.write(bytes);
    });
    table.push_back(
        {.type = type, .offset = offset, .size = file_.size() - offset, .checksum = hash.checksum()});
  };
  add_section(skeleton_type, [&](const auto& write) {
    write_skeleton(skeleton.surrounding, pieces_.size() / sizeof(LatticeBox), write);
    pieces_.read_all(write);
  });
  const bool instanced = !skeleton.instances.empty();
  if (instanced) {
    add_section(sub_hierarchies_type, [&](const auto& write) { write(encode_sub_hierarchies(skeleton)); });
  }
  if (!objects.empty()) {
    add_section(objects_type, [&](const auto& write) { write(objects); });
    table.back().version = objects_version;
  }
  if (!options.empty()) {
    add_section(options_type, [&](const auto& write) { write(encode_pack_options(options)); });
    table.back().version = options_version;
  }
  if (std::ranges::count(seen_from_outside_, true) > 0) {
    add_section(seen_from_outside_type,
                [&](const auto& write) { write(encode_seen_from_outside(seen_from_outside_)); });
    table.back().version = seen_from_outside_version;
  }
  if (!closed.empty()) {
    add_section(closed_surfaces_type, [&](const auto& write) { write(encode_closed_surfaces(closed)); });
    table.back().version = closed_surfaces_version;
  }
  if (!materials.empty()) {
    add_section(materials_type, [&](const auto& write) { write(materials); });
    table.back().version = materials_version;
  }
  if (!skeleton.surrounding.textures.empty()) {
    add_section(texels_type, [&](const auto& write) { texels->read_all(write); });
    table.back().version = texels_version;
    table.back().checksum = texels_checksum(skeleton.surrounding.textures);
  }
  if (!skeleton.motion.empty()) {
    add_section(motion_type, [&](const auto& write) { write(encode_motion(skeleton.motion)); });
    table.back().version = motion_version;
  }
  if (const auto& geo_place = skeleton.surrounding.geo_place) {
    add_section(geo_place_type, [&](const auto& write) { write(encode_geo_place(*geo_place)); });
    table.back().version = geo_place_version;
  }
  const auto table_bytes = std::as_bytes(std::span<const PackSection>(table));
  PackHeader header{.version = instanced ? instanced_pack_format_version : pack_format_version,
                    .section_count = static_cast<uint32_t>(table.size()),
                    .table_offset = file_.size()};
  header.table_checksum = hash_bytes(table_bytes, header.version);
  file_.write(table_bytes);
  file_.write_at(0, std::as_bytes(std::span(&header, 1)));
  file_.commit();
}

}  // namespace triptych
