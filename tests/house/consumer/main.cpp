// Uses a header and a function of several rooms, as a program outside would.
#include "protocol/delta_codec.hpp"
#include "render/context.hpp"
#include "scene/camera.hpp"
#include "visibility/visible_set.hpp"

#include <cstdio>

int main() {
  const triptych::VisibleSet before = {1, 2, 3};
  const triptych::VisibleDelta delta = triptych::difference(before, {2, 3, 4});
  const bool same =
      triptych::decode_delta(triptych::encode_delta(delta, before), before, "consumer") == delta;
  std::puts(same ? "the delta came back" : "the delta is another one");
  return same ? 0 : 1;
}
