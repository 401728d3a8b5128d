#include "preprocess/cached_unit.hpp"

namespace triptych {

void write_unit_kind(ContentKeyWriter& writer, UnitKind kind, const BuildOptions& options) {
  writer.write(kind);
  for (const uint32_t number : {options.part_triangles, options.leaf_triangles, options.bucket_triangles,
                                options.hlod_triangles, static_cast<uint32_t>(options.hierarchy)})
    writer.write(number);
  const SimplifyLimits limits = options.simplify_limits();
  writer.write(uint64_t{limits.triangles});
  writer.write(limits.max_bound);
  writer.write(limits.colors);
  writer.write(limits.simplifier);
  writer.write(limits.bound);
  const Kept& keep = options.keep;
  const BuildRules& rules = options.rules;
  for (const bool flag : {keep.touching, keep.order, keep.planes, keep.cover, keep.shade,
                          options.share_instances, rules.bounds_hold_children, rules.bounds_hold_rounding,
                          rules.bounds_are_stretched, rules.mirrors_flip_winding, rules.contacts_hold,
                          rules.order_is_kept, rules.layers_are_told, rules.levels_are_marked})
    writer.write(flag);
  writer.write(rules.max_condition);
}

}  // namespace triptych
