#include "scene/pack_skeleton.hpp"

#include "base/bytes.hpp"
#include "scene/check_skeleton.hpp"

namespace triptych {

namespace {

// The arrays are written as they stand in memory; these sizes are the format.
static_assert(sizeof(SceneNode) == 44 && sizeof(Drawable) == 24 && sizeof(Placement) == 8);
static_assert(sizeof(Affine) == 96 && sizeof(Lattice) == 32 && sizeof(ChunkInfo) == 64 &&
              sizeof(LatticeBox) == 24);

/// Of an instance, which is written field by field.
constexpr size_t instance_bytes = 20;

using Write = std::function<void(std::span<const std::byte>)>;

template <typename Value>
void write_array(const Write& write, const std::vector<Value>& values) {
  const uint64_t count = values.size();
  write(std::as_bytes(std::span(&count, 1)));
  write(std::as_bytes(std::span<const Value>(values)));
}

template <typename Value>
std::vector<Value> read_array(ByteReader& reader) {
  return reader.read_all<Value>(reader.read<uint64_t>());
}

void write_texts(ByteWriter& writer, const std::vector<std::string>& texts) {
  writer.write(static_cast<uint32_t>(texts.size()));
  for (const std::string& text : texts) writer.write_text(text);
}

std::vector<std::string> read_texts(ByteReader& reader) {
  std::vector<std::string> texts;
  for (auto count = reader.read<uint32_t>(); count > 0; --count) texts.push_back(reader.read_text());
  return texts;
}

void write_instances(ByteWriter& writer, const std::vector<HierarchyInstance>& instances) {
  writer.write(uint64_t{instances.size()});
  for (const HierarchyInstance& instance : instances) {
    writer.write(instance.scene_node);
    writer.write(instance.sub_hierarchy);
    writer.write(instance.transform);
    writer.write(instance.stretch);
  }
}

std::vector<HierarchyInstance> read_instances(ByteReader& reader) {
  const auto count = reader.read<uint64_t>();
  if (count > reader.left() / instance_bytes) {
    fail(reader.place(), "byte {}: {} instances promised, {} bytes left", reader.offset(), count,
         reader.left());
  }
  std::vector<HierarchyInstance> instances(static_cast<size_t>(count));
  for (HierarchyInstance& instance : instances) {
    instance.scene_node = reader.read<uint32_t>();
    instance.sub_hierarchy = reader.read<uint32_t>();
    instance.transform = reader.read<uint32_t>();
    instance.stretch = reader.read<double>();
  }
  return instances;
}

Skeleton read_skeleton(ByteReader& reader) {
  Skeleton skeleton;
  for (uint64_t* count :
       {&skeleton.source_triangles, &skeleton.placed_triangles, &skeleton.objects.initial,
        &skeleton.objects.partition1, &skeleton.objects.clusters, &skeleton.objects.partition2,
        &skeleton.import.dropped_triangles, &skeleton.import.welded_vertices, &skeleton.import.repaired_edges,
        &skeleton.import.stuck_groups}) {
    *count = reader.read<uint64_t>();
  }
  skeleton.import.warnings = read_texts(reader);
  skeleton.effects = read_texts(reader);
  skeleton.lattices = read_array<Lattice>(reader);
  skeleton.palette = read_array<std::array<uint8_t, 4>>(reader);
  skeleton.transforms = read_array<Affine>(reader);
  skeleton.scene_nodes = read_array<SceneNode>(reader);
  skeleton.drawables = read_array<Drawable>(reader);
  skeleton.placements = read_array<Placement>(reader);
  skeleton.chunks = read_array<ChunkInfo>(reader);
  skeleton.pieces = read_array<LatticeBox>(reader);
  reader.expect_end();
  return skeleton;
}

void read_sub_hierarchies(ByteReader& reader, StoredSkeleton& stored) {
  stored.instances = read_instances(reader);
  for (auto count = reader.read<uint64_t>(); count > 0; --count) {
    SubHierarchy& hierarchy = stored.sub_hierarchies.emplace_back();
    hierarchy.lattice = reader.read<uint32_t>();
    hierarchy.transforms = read_array<Affine>(reader);
    hierarchy.scene_nodes = read_array<SceneNode>(reader);
    hierarchy.drawables = read_array<Drawable>(reader);
    hierarchy.placements = read_array<Placement>(reader);
    hierarchy.instances = read_instances(reader);
  }
  reader.expect_end();
}

}  // namespace

void write_skeleton(const Skeleton& skeleton, uint64_t piece_count,
                    const std::function<void(std::span<const std::byte>)>& write) {
  ByteWriter head;
  for (const uint64_t count :
       {skeleton.source_triangles, skeleton.placed_triangles, skeleton.objects.initial,
        skeleton.objects.partition1, skeleton.objects.clusters, skeleton.objects.partition2,
        skeleton.import.dropped_triangles, skeleton.import.welded_vertices, skeleton.import.repaired_edges,
        skeleton.import.stuck_groups}) {
    head.write(count);
  }
  write_texts(head, skeleton.import.warnings);
  write_texts(head, skeleton.effects);
  write(head.bytes());
  write_array(write, skeleton.lattices);
  write_array(write, skeleton.palette);
  write_array(write, skeleton.transforms);
  write_array(write, skeleton.scene_nodes);
  write_array(write, skeleton.drawables);
  write_array(write, skeleton.placements);
  write_array(write, skeleton.chunks);
  write(std::as_bytes(std::span(&piece_count, 1)));
}

std::vector<std::byte> encode_skeleton(const Skeleton& skeleton) {
  ByteWriter writer;
  write_skeleton(skeleton, skeleton.pieces.size(),
                 [&](std::span<const std::byte> bytes) { writer.write_all(bytes); });
  writer.write_all(std::span<const LatticeBox>(skeleton.pieces));
  return std::move(writer.bytes());
}

std::vector<std::byte> encode_sub_hierarchies(const StoredSkeleton& stored) {
  ByteWriter writer;
  const Write write = [&](std::span<const std::byte> bytes) { writer.write_all(bytes); };
  write_instances(writer, stored.instances);
  writer.write(uint64_t{stored.sub_hierarchies.size()});
  for (const SubHierarchy& hierarchy : stored.sub_hierarchies) {
    writer.write(hierarchy.lattice);
    write_array(write, hierarchy.transforms);
    write_array(write, hierarchy.scene_nodes);
    write_array(write, hierarchy.drawables);
    write_array(write, hierarchy.placements);
    write_instances(writer, hierarchy.instances);
  }
  return std::move(writer.bytes());
}

Skeleton decode_skeleton(std::span<const std::byte> bytes, uint64_t geometry_size, const std::string& place) {
  ByteReader reader(bytes, place);
  StoredSkeleton stored{read_skeleton(reader), {}, {}};
  check_skeleton(stored, geometry_size, place, place);
  return std::move(stored.surrounding);
}

StoredSkeleton decode_skeleton(const SectionBytes& skeleton, const SectionBytes& sub_hierarchies,
                               uint64_t geometry_size) {
  ByteReader reader(skeleton.bytes, skeleton.place);
  StoredSkeleton stored{read_skeleton(reader), {}, {}};
  ByteReader sub_reader(sub_hierarchies.bytes, sub_hierarchies.place);
  read_sub_hierarchies(sub_reader, stored);
  check_skeleton(stored, geometry_size, skeleton.place, sub_hierarchies.place);
  return stored;
}

}  // namespace triptych
