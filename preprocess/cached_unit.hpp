// Units whose results an earlier build may have kept (base/build_cache.hpp).
#pragma once

#include "base/build_cache.hpp"
#include "preprocess/build.hpp"
#include "preprocess/build_unit.hpp"

namespace triptych {

/// Begins the key of a unit's result: its kind, and every option that may matter to any unit.
void write_unit_kind(ContentKeyWriter& writer, UnitKind kind, const BuildOptions& options);

/// What `make` gives, or gave when it was made of the same: its chunks then get this lattice, since lattices
/// have other numbers in each build. Null: it is made. name: of its kind, as the build's figures say it.
template <typename Make>
UnitResult cached_unit(BuildCache* cache, std::string_view name, const ContentKeyWriter& key,
                       uint32_t lattice, const Make& make) {
  if (!cache) return make();
  const std::vector<std::byte> bytes = cache->get(name, key.key(), [&] { return record_bytes(make()); });
  auto result = record_of<UnitResult>(bytes, "a build's cache");
  for (UnitChunk& chunk : result.chunks) chunk.lattice = lattice;
  return result;
}

}  // namespace triptych
