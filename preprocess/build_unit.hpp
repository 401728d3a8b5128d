// The seam between what a build does and where it is done: units of work.
//
// A unit is a function from (kind, index) to bytes. It reads the model, the options, and the results of units
// that were stored before; its bytes are a function of these only, not of threads, processes, clocks or the
// order in which units run. It writes to no file of the build and assigns no numbers. BuildWork does that
// when it stores the results, in the order of the indices: it appends chunks to the pack and geometry to
// spool files, which gives them their indices and places. So units of one batch may run anywhere: today they
// run on threads of this process; other processes that hold the same model and can read the same folder could
// run them as well, and send the bytes.
#pragma once

#include "base/progress.hpp"
#include "base/record.hpp"
#include "preprocess/pack_writer.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace triptych {

/// What a unit processes; the index counts within the kind.
enum class UnitKind : uint32_t {
  sorted_mesh,     ///< a mesh that is too large for memory, index as in BuildPlan::meshes
  divided_mesh,    ///< any other mesh, index as in BuildPlan::meshes
  divided_bucket,  ///< a bucket of a sorted mesh; buckets of all of these meshes are counted together
  part_levels,     ///< a part, index as in Parts::parts
  hlod,            ///< an inner scene node, index in its hierarchy; hierarchies come one after the other
  root_geometry,   ///< of a sub-hierarchy whose root has no HLODs; index 0
  light,           ///< a block of points of baked light; those of all passes are counted together
};

/// A chunk that a unit adds to the pack.
struct UnitChunk {
  EncodedChunk chunk;
  uint32_t lattice = 0;
};
template <>
inline constexpr auto record_members<UnitChunk> = std::tuple(&UnitChunk::chunk, &UnitChunk::lattice);

/// The result of a unit. Its bytes are record_bytes() of this.
struct UnitResult {
  std::vector<UnitChunk> chunks;                 ///< for the pack
  std::vector<std::vector<std::byte>> geometry;  ///< records for later units, kept in a spool file
  std::vector<std::byte> figures;                ///< a record for the function that takes the result
};
template <>
inline constexpr auto record_members<UnitResult> = std::tuple(&UnitResult::chunks, &UnitResult::geometry,
                                                              &UnitResult::figures);

/// The unit of a known kind with this index, as the bytes of its UnitResult. Safe on several threads.
using UnitFunction = std::function<std::vector<std::byte>(uint32_t index)>;

/// Runs units side by side on the threads of this process. Returns their results in the order of the indices;
/// the progress advances by one for each that is done. An exception of a unit is thrown again here.
std::vector<std::vector<std::byte>> run_units(std::span<const uint32_t> indices, const UnitFunction& unit,
                                              Progress* progress = nullptr);

}  // namespace triptych
