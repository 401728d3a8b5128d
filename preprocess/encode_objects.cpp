#include "preprocess/encode_objects.hpp"

#include "base/bytes.hpp"
#include "preprocess/write_packed.hpp"

#include <algorithm>
#include <meshoptimizer.h>
#include <numeric>

namespace triptych {

namespace {

/// The texts in their order, each once, and for each number the one that it gets there.
struct SortedTexts {
  std::vector<uint32_t> order = {0};
  std::vector<uint32_t> renumbered;

  explicit SortedTexts(const TextTable& texts) : renumbered(texts.size()) {
    std::vector<uint32_t> all(texts.size());
    std::iota(all.begin(), all.end(), 0u);
    std::sort(all.begin(), all.end(), [&](uint32_t one, uint32_t other) {
      return texts[one] != texts[other] ? texts[one] < texts[other] : one < other;
    });
    for (const uint32_t text : all) {  // the empty one is the first
      if (texts[text] != texts[order.back()]) order.push_back(text);
      renumbered[text] = static_cast<uint32_t>(order.size() - 1);
    }
  }
};

void write_texts(const TextTable& texts, const std::vector<uint32_t>& order, ByteWriter& writer) {
  uint64_t total = 0;
  for (const uint32_t text : order) total += texts[text].size();
  writer.write(total);
  for (size_t i = 1; i < order.size(); ++i) {
    const std::string_view before = texts[order[i - 1]], text = texts[order[i]];
    const auto differs = std::mismatch(before.begin(), before.end(), text.begin(), text.end());
    const auto shared = static_cast<size_t>(differs.first - before.begin());
    writer.write_varint(shared);
    writer.write_varint(text.size() - shared);
    writer.write_all(std::span<const char>(text.substr(shared)));
  }
}

/// No object as 0, everything else one larger.
void write_object(SourceObjectId object, ByteWriter& writer) {
  writer.write_varint(static_cast<uint32_t>(object + 1));
}

void write_hierarchy(const HierarchyObjects& hierarchy, ByteWriter& writer) {
  writer.write_varint(hierarchy.leaves.size());
  SceneNodeId next = 0;
  for (size_t i = 0; i < hierarchy.leaves.size(); ++i) {
    writer.write_varint(hierarchy.leaves[i] - next);
    next = hierarchy.leaves[i] + 1;
    const std::span<const ObjectRun> runs = hierarchy.runs_of(i);
    writer.write_varint(runs.size());
    for (const ObjectRun& run : runs) {
      writer.write_varint(run.placements);
      write_object(run.object, writer);
    }
  }
  writer.write_varint(hierarchy.instances.size());
  for (const SourceObjectId first : hierarchy.instances) write_object(first, writer);
  writer.write_varint(hierarchy.drawables.size());
  next = 0;
  for (size_t i = 0; i < hierarchy.drawables.size(); ++i) {
    writer.write_varint(hierarchy.drawables[i] - next);
    next = hierarchy.drawables[i] + 1;
    const std::span<const std::byte> triangles = hierarchy.triangles_of(i);
    writer.write_varint(triangles.size());
    writer.write_all(triangles);
  }
}

}  // namespace

std::vector<std::byte> encode_objects(const StoredObjects& stored) {
  const SourceObjects& source = stored.objects;
  const SortedTexts texts(source.texts);
  const auto rename = [&](uint32_t& text) { text = texts.renumbered[text]; };
  ByteWriter writer;
  for (const size_t count : {texts.order.size(), source.objects.size(), source.set_uses.size(),
                             source.sets.size(), source.properties.size(), stored.hierarchies.size()})
    writer.write(static_cast<uint32_t>(count));
  write_texts(source.texts, texts.order, writer);
  std::vector<SourceObject> objects = source.objects;
  for (SourceObject& object : objects) {
    for (uint32_t* text :
         {&object.name, &object.type, &object.guid, &object.layer, &object.storey, &object.number})
      rename(*text);
  }
  write_packed(objects, writer);
  write_packed(source.set_uses, writer);
  std::vector<SourcePropertySet> sets = source.sets;
  for (SourcePropertySet& set : sets) rename(set.name);
  write_packed(sets, writer);
  std::vector<SourceProperty> properties = source.properties;
  for (SourceProperty& property : properties) rename(property.name), rename(property.value);
  write_packed(properties, writer);
  for (const HierarchyObjects& hierarchy : stored.hierarchies) write_hierarchy(hierarchy, writer);
  return std::move(writer.bytes());
}

}  // namespace triptych
