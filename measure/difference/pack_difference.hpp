// What changed from one revision of a model to the next: their packs, object by object.
#pragma once

#include "measure/difference/object_pairs.hpp"
#include "measure/difference/shape_change.hpp"

#include <string>
#include <vector>

namespace triptych {

/// Something that the model's files say of an object otherwise: "name", "storey",
/// "Pset_WallCommon.FireRating". Empty where one of them does not say it.
struct ToldChange {
  std::string what, before, after;
};

struct ObjectChange {
  ObjectPair object;  ///< the ids of both; ObjectShapes::nameless() for what belongs to no object
  ShapeChange shape;
  std::vector<ToldChange> told;

  bool added() const { return object.before == no_id; }
  bool removed() const { return object.after == no_id; }
  bool differs() const { return added() || removed() || shape.any() || !told.empty(); }
};

/// A pack with all that is asked about it.
struct Revision {
  explicit Revision(const std::filesystem::path& file)
      : pack(file), objects(pack.read_objects()), shapes(pack, objects) {}
  const SourceObjects& source() const { return objects.source(); }

  Pack pack;
  PackObjects objects;
  ObjectShapes shapes;
};

struct PackDifference {
  std::vector<ObjectChange>
      objects;  ///< of both revisions, in the order of pair_objects(), also those that stayed

  bool equal() const;
};

/// Shapes are compared at full detail in the model's space, to within the packs' lattices: how the packs were
/// built does not matter. Ids and numbers of objects in their files do not count either. Error (pack, chunk)
/// for damage.
PackDifference compare_packs(const Revision& before, const Revision& after);

/// In a word or two, for tables: "added", "moved, recoloured".
std::string words_of(const ObjectChange& change);

}  // namespace triptych
