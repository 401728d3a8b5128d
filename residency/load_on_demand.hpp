// Chunks are read when they are taken.
#pragma once

#include "residency/residency.hpp"
#include "scene/pack.hpp"

namespace triptych {

/// Reads chunks out of the pack, which must outlive it. Nobody reads meanwhile: all are ready.
class LoadOnDemand final : public Residency {
 public:
  explicit LoadOnDemand(const Pack& pack) : pack_(pack) {}

  void expect(uint32_t, float) override {}
  Chunk take(uint32_t chunk) override { return pack_.read_chunk(chunk); }
  std::optional<Chunk> take_if_ready(uint32_t chunk) override { return take(chunk); }
  std::vector<Texel> read_texels(uint32_t texture, uint32_t level) override {
    return pack_.read_texels(texture, level);
  }

 private:
  const Pack& pack_;
};

}  // namespace triptych
