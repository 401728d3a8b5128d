#include "scene/stored_objects.hpp"

#include "base/bytes.hpp"

#include <meshoptimizer.h>

namespace triptych {

namespace {

/// Bytes of a decoded array for one of its code, at most: the codec has at least half a byte for 16 values
/// of a byte.
constexpr uint64_t max_expansion = 64;

/// An array of `count` structs: the size of its code, and that.
template <typename Item>
std::vector<Item> read_array(ByteReader& reader, uint64_t count) {
  const auto code = reader.read_all<uint8_t>(reader.read<uint32_t>());
  if (count == 0 && code.empty()) return {};
  if (count == 0 || count > code.size() * max_expansion / sizeof(Item) + 1)
    fail(reader.place(), "byte {}: {} values in {} bytes", reader.offset(), count, code.size());
  std::vector<Item> items(static_cast<size_t>(count));
  if (meshopt_decodeVertexBuffer(items.data(), items.size(), sizeof(Item), code.data(), code.size()) != 0)
    fail(reader.place(), "byte {}: an array does not decode", reader.offset());
  return items;
}

/// Sorted, each by what it shares with the one before.
TextTable read_texts(ByteReader& reader, uint32_t count) {
  TextTable texts;
  const auto total = reader.read<uint64_t>();
  if (total > TextTable::max_bytes) fail(reader.place(), "{} bytes of text", total);
  std::string text;
  for (uint32_t i = 1; i < count; ++i) {
    const uint64_t shared = reader.read_varint();
    const auto rest = reader.read_all<char>(reader.read_varint());
    if (shared > text.size()) fail(reader.place(), "byte {}: text {} shares too much", reader.offset(), i);
    text.resize(static_cast<size_t>(shared));
    text.append(rest.begin(), rest.end());
    if (texts.bytes() + text.size() > total)
      fail(reader.place(), "byte {}: more text than the {} bytes that it says", reader.offset(), total);
    texts.add(text);
  }
  return texts;
}

void check_numbers(const SourceObjects& objects, const std::string& place) {
  const auto check = [&](uint32_t number, size_t count, const char* what) {
    if (number >= count) fail(place, "names {} {} of {}", what, number, count);
  };
  const auto check_first = [&](uint32_t first, uint32_t before, size_t count, const char* what) {
    if (first < before || first > count) fail(place, "{} begin at {} of {}", what, first, count);
  };
  const size_t texts = objects.texts.size();
  uint32_t before = 0;
  for (size_t i = 0; i < objects.objects.size(); ++i) {
    const SourceObject& object = objects.objects[i];
    for (const uint32_t text :
         {object.name, object.type, object.guid, object.layer, object.storey, object.number})
      check(text, texts, "text");
    if (object.parent != no_id && object.parent >= i)
      fail(place, "object {} is in object {}, which comes later", i, object.parent);
    check_first(object.first_set, before, objects.set_uses.size(), "the property sets of an object");
    before = object.first_set;
  }
  for (const uint32_t set : objects.set_uses) check(set, objects.sets.size(), "property set");
  before = 0;
  for (const SourcePropertySet& set : objects.sets) {
    check(set.name, texts, "text");
    check_first(set.first_property, before, objects.properties.size(), "the properties of a set");
    before = set.first_property;
  }
  for (const SourceProperty& property : objects.properties) {
    check(property.name, texts, "text");
    check(property.value, texts, "text");
  }
}

/// no_id as 0, everything else one larger.
SourceObjectId read_object(ByteReader& reader) {
  const uint64_t number = reader.read_varint();
  if (number > no_id) fail(reader.place(), "byte {}: an object of more than 32 bits", reader.offset());
  return static_cast<SourceObjectId>(number) - 1;
}

uint32_t read_number(ByteReader& reader) {
  const uint64_t number = reader.read_varint();
  if (number >= no_id) fail(reader.place(), "byte {}: a number of more than 32 bits", reader.offset());
  return static_cast<uint32_t>(number);
}

HierarchyObjects read_hierarchy(ByteReader& reader) {
  HierarchyObjects hierarchy;
  uint64_t next = 0;  // the smallest id that the next leaf can have
  for (uint32_t left = read_number(reader); left > 0; --left) {
    const uint64_t leaf = next + read_number(reader);
    if (leaf >= no_id) fail(reader.place(), "byte {}: scene node {}", reader.offset(), leaf);
    next = leaf + 1;
    std::vector<ObjectRun> runs;
    for (uint32_t count = read_number(reader); count > 0; --count) {
      const uint32_t placements = read_number(reader);
      if (placements == 0) fail(reader.place(), "byte {}: an object without placements", reader.offset());
      runs.push_back({placements, read_object(reader)});
    }
    hierarchy.add_leaf(static_cast<SceneNodeId>(leaf), runs);
  }
  for (uint32_t left = read_number(reader); left > 0; --left)
    hierarchy.instances.push_back(read_object(reader));
  next = 0;
  for (uint32_t left = read_number(reader); left > 0; --left) {
    const uint64_t drawable = next + read_number(reader);
    if (drawable >= no_id) fail(reader.place(), "byte {}: drawable {}", reader.offset(), drawable);
    next = drawable + 1;
    hierarchy.add_drawable(static_cast<DrawableId>(drawable),
                           reader.read_all<std::byte>(reader.read_varint()));
  }
  return hierarchy;
}

}  // namespace

void HierarchyObjects::add_leaf(SceneNodeId leaf, std::span<const ObjectRun> of_placements) {
  leaves.push_back(leaf);
  first_runs.push_back(static_cast<uint32_t>(runs.size()));
  runs.insert(runs.end(), of_placements.begin(), of_placements.end());
}

std::span<const ObjectRun> HierarchyObjects::runs_of(size_t leaf) const {
  const size_t end = leaf + 1 < first_runs.size() ? first_runs[leaf + 1] : runs.size();
  return std::span(runs).subspan(first_runs[leaf], end - first_runs[leaf]);
}

void HierarchyObjects::add_drawable(DrawableId drawable, std::span<const std::byte> of_triangles) {
  drawables.push_back(drawable);
  first_bytes.push_back(triangles.size());
  triangles.insert(triangles.end(), of_triangles.begin(), of_triangles.end());
}

std::span<const std::byte> HierarchyObjects::triangles_of(size_t drawable) const {
  const uint64_t end = drawable + 1 < first_bytes.size() ? first_bytes[drawable + 1] : triangles.size();
  return std::span(triangles).subspan(first_bytes[drawable], end - first_bytes[drawable]);
}

StoredObjects decode_objects(std::span<const std::byte> bytes, const std::string& place) {
  ByteReader reader(bytes, place);
  const auto texts = reader.read<uint32_t>(), objects = reader.read<uint32_t>(),
             set_uses = reader.read<uint32_t>(), sets = reader.read<uint32_t>(),
             properties = reader.read<uint32_t>(), hierarchies = reader.read<uint32_t>();
  StoredObjects stored;
  stored.objects.texts = read_texts(reader, texts);
  stored.objects.objects = read_array<SourceObject>(reader, objects);
  stored.objects.set_uses = read_array<uint32_t>(reader, set_uses);
  stored.objects.sets = read_array<SourcePropertySet>(reader, sets);
  stored.objects.properties = read_array<SourceProperty>(reader, properties);
  check_numbers(stored.objects, place);
  for (uint32_t i = 0; i < hierarchies; ++i) stored.hierarchies.push_back(read_hierarchy(reader));
  reader.expect_end();
  return stored;
}

}  // namespace triptych
