#include "measure/difference/pack_difference.hpp"

#include "base/progress.hpp"
#include "base/threads.hpp"

#include <algorithm>
#include <map>

namespace triptych {

namespace {

/// All that files say of an object that is not its number there, by what it is about.
std::map<std::string, std::string> told_of(const SourceObjects& source, SourceObjectId id) {
  const SourceObject& object = source.objects[id];
  const auto text = [&](uint32_t number) { return std::string(source.texts[number]); };
  std::map<std::string, std::string> told = {{"name", text(object.name)},
                                             {"type", text(object.type)},
                                             {"guid", text(object.guid)},
                                             {"layer", text(object.layer)},
                                             {"storey", text(object.storey)}};
  for (const uint32_t set : source.sets_of(id)) {
    for (const SourceProperty& property : source.properties_of(set)) {
      std::string& value = told[text(source.sets[set].name) + "." + text(property.name)];
      value += (value.empty() ? "" : "; ") + text(property.value);
    }
  }
  return told;
}

std::vector<ToldChange> told_otherwise(const SourceObjects& before, SourceObjectId of_before,
                                       const SourceObjects& after, SourceObjectId of_after) {
  std::map<std::string, ToldChange> all;
  for (auto& [what, value] : told_of(before, of_before)) all[what] = {what, value, ""};
  for (auto& [what, value] : told_of(after, of_after)) {
    all[what].what = what;
    all[what].after = value;
  }
  std::vector<ToldChange> changes;
  for (auto& [what, change] : all) {
    if (change.before != change.after) changes.push_back(std::move(change));
  }
  return changes;
}

ShapeChange shape_change(const ObjectShapes& before, SourceObjectId of_before, const ObjectShapes& after,
                         SourceObjectId of_after) {
  if (before.signature_of(of_before) == after.signature_of(of_after)) return {};
  return compare_shapes(before.shape_of(of_before), after.shape_of(of_after));
}

}  // namespace

bool PackDifference::equal() const {
  return std::none_of(objects.begin(), objects.end(),
                      [](const ObjectChange& change) { return change.differs(); });
}

PackDifference compare_packs(const Revision& before, const Revision& after) {
  std::vector<ObjectPair> pairs = pair_objects(before.source(), before.shapes, after.source(), after.shapes);
  const SourceObjectId none_before = before.shapes.nameless(), none_after = after.shapes.nameless();
  const bool any_before = before.shapes.triangles_of(none_before) > 0,
             any_after = after.shapes.triangles_of(none_after) > 0;
  if (any_before || any_after)
    pairs.push_back({any_before ? none_before : no_id, any_after ? none_after : no_id});
  PackDifference difference;
  difference.objects.resize(pairs.size());
  Progress progress("comparing objects", pairs.size());
  parallel_for(pairs.size(), [&](size_t i) {
    ObjectChange& change = difference.objects[i];
    change.object = pairs[i];
    if (!change.added() && !change.removed()) {
      change.shape = shape_change(before.shapes, pairs[i].before, after.shapes, pairs[i].after);
      if (pairs[i].before != none_before && pairs[i].after != none_after)
        change.told = told_otherwise(before.source(), pairs[i].before, after.source(), pairs[i].after);
    }
    progress.advance();
  });
  return difference;
}

std::string words_of(const ObjectChange& change) {
  if (change.added()) return "added";
  if (change.removed()) return "removed";
  std::string words;
  const auto add = [&](bool does, const char* word) {
    if (does) words += (words.empty() ? "" : ", ") + std::string(word);
  };
  add(change.shape.moved, "moved");
  add(change.shape.recolored, "recoloured");
  add(change.shape.reshaped, "reshaped");
  add(!change.told.empty(), "told otherwise");
  return words.empty() ? "unchanged" : words;
}

}  // namespace triptych
