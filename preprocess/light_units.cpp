#include "preprocess/light_units.hpp"

#include <algorithm>
#include <numeric>

namespace triptych {

std::vector<float> LightUnits::run(const std::string& what, uint32_t count, const PointValues& of_item) {
  const uint32_t units = (count + unit_points - 1) / unit_points;
  Progress progress(what, units);
  std::vector<float> values;
  for (uint32_t first = 0; first < units; first += batch_units) {
    std::vector<uint32_t> indices(std::min(batch_units, units - first));
    std::iota(indices.begin(), indices.end(), before_ + first);
    work_.run(
        UnitKind::light, indices,
        [&](uint32_t index) {
          std::vector<float> own;
          const uint32_t begin = (index - before_) * unit_points;
          for (uint32_t i = begin; i < std::min(count, begin + unit_points); ++i) of_item(i, own);
          return record_bytes(UnitResult{{}, {}, record_bytes(own)});
        },
        [&](uint32_t, const StoredUnit& stored) {
          const auto own = stored.figures_as<std::vector<float>>();
          values.insert(values.end(), own.begin(), own.end());
        },
        &progress);
  }
  before_ += units;
  return values;
}

}  // namespace triptych
