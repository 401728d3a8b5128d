#include "preprocess/build_unit.hpp"

#include "base/threads.hpp"

namespace triptych {

std::vector<std::vector<std::byte>> run_units(std::span<const uint32_t> indices, const UnitFunction& unit,
                                              Progress* progress) {
  std::vector<std::vector<std::byte>> results(indices.size());
  parallel_for(indices.size(), [&](size_t i) {
    results[i] = unit(indices[i]);
    if (progress) progress->advance();
  });
  return results;
}

}  // namespace triptych
