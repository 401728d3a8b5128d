#include "preprocess/spatial_order.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

namespace triptych {

namespace {

/// The lower 21 bits, each followed by two zeros.
uint64_t spread_bits(uint64_t value) {
  value &= 0x1fffffu;
  value = (value | value << 32) & 0x1f00000000ffffu;
  value = (value | value << 16) & 0x1f0000ff0000ffu;
  value = (value | value << 8) & 0x100f00f00f00f00fu;
  value = (value | value << 4) & 0x10c30c30c30c30c3u;
  return (value | value << 2) & 0x1249249249249249u;
}

}  // namespace

std::vector<uint32_t> spatial_order(std::span<const Box> boxes) {
  Box whole;
  for (const Box& box : boxes) whole.extend(center(box));
  constexpr double cells = 1 << 21;
  const glm::dvec3 size = glm::max(whole.hi - whole.lo, glm::dvec3(1e-300));
  std::vector<uint64_t> codes;
  for (const Box& box : boxes) {
    const glm::dvec3 place =
        glm::clamp((center(box) - whole.lo) / size * cells, glm::dvec3(0), glm::dvec3(cells - 1));
    uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) code |= spread_bits(static_cast<uint64_t>(place[axis])) << axis;
    codes.push_back(code);
  }
  std::vector<uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](uint32_t index) { return codes[index]; });
  return order;
}

}  // namespace triptych
