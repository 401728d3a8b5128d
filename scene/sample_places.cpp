#include "scene/sample_places.hpp"

#include <array>
#include <cassert>

namespace triptych {

namespace {

// The standard places of Direct3D and Vulkan; those of sixteen moved by a thirty-second of a pixel, so that
// their mean is the centre, too. No two share a row or a column, so that an edge of any slope that moves over
// a pixel passes them one by one.
constexpr std::array<SamplePlace, 1> one = {{{0, 0}}};
constexpr std::array<SamplePlace, 4> four = {{{-4, -12}, {12, -4}, {-12, 4}, {4, 12}}};
constexpr std::array<SamplePlace, 8> eight = {
    {{2, -6}, {-2, 6}, {10, 2}, {-6, -10}, {-10, 10}, {-14, -2}, {6, 14}, {14, -14}}};
constexpr std::array<SamplePlace, 16> sixteen = {{{3, 3},
                                                  {-1, -5},
                                                  {-5, 5},
                                                  {9, -1},
                                                  {-9, -3},
                                                  {5, 11},
                                                  {11, 7},
                                                  {7, -9},
                                                  {-3, 13},
                                                  {1, -13},
                                                  {-7, -11},
                                                  {-11, 9},
                                                  {-15, 1},
                                                  {15, -7},
                                                  {13, 15},
                                                  {-13, -15}}};

}  // namespace

bool is_sample_count(uint64_t samples) {
  return samples == 1 || samples == 4 || samples == 8 || samples == 16;
}

std::span<const SamplePlace> sample_places(uint32_t samples) {
  assert(is_sample_count(samples));
  switch (samples) {
    case 4:
      return four;
    case 8:
      return eight;
    case 16:
      return sixteen;
    default:
      return one;
  }
}

}  // namespace triptych
