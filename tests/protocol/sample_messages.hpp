// One message of each type, with something in every field.
#pragma once

#include "protocol/delta_codec.hpp"
#include "protocol/messages.hpp"

#include <vector>

namespace triptych {

inline View sample_view() {
  View view{{{1.5, -2, 3e6}, {4, 5, 6}, {0, 0, 1}}, 641, 479};
  set_field_of_view(view.camera, 60, 641.0 / 479.0);
  view.camera.near = 0.05;
  return view;
}

inline View sample_orthographic_view() {
  View view = sample_view();
  set_orthographic_height(view.camera, 12, 641.0 / 479.0);
  return view;
}

inline Section sample_section() {
  Section section;
  section.add_plane({{1, 2, -3}, 4.5}, "sample");
  section.add_plane({{0, 0, -1}, -2.75}, "sample");
  section.set_box({{-1, -2, -3}, {1e6, 2, 0.1}}, "sample");
  return section;
}

inline Hello sample_hello(Role role) {
  Hello hello;
  hello.role = role;
  hello.session = 77;
  hello.pack_hash = 0x0123456789abcdef;
  hello.device.vendor = "Mesa";
  hello.device.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
  hello.device.version = "4.5 (Core Profile) Mesa 22.3.6";
  hello.raster = "exact";
  return hello;
}

inline std::vector<Message> sample_messages() {
  const StageTimes times{4.25, 2.125, 431, 1800, 9.5};
  return {sample_hello(Role::switch_1),
          CameraMessage{12,
                        {sample_view(),
                         1.5,
                         8,
                         true,
                         sample_section(),
                         {{3, 0x1234567890abcdef}},
                         Effects::all(),
                         2.5,
                         {true, {0, 0.6, -0.8}}},
                        true,
                        true},
          DeltaMessage{12, {1ull << 50, 17}, encode_delta({{1, 2, 3, 900}, {4, 77}}, {4, 77, 5000})},
          Sentinel{12, 1000, 4, 3, 0xfedcba9876543210, times},
          FullSetRequest{12},
          FullSet{12, {0, 5, 6, 7, 123456}},
          SwitchReport{12, 99.5, 7.5, 3.75, 0.25, 1.75, 1000, 3'000'000'000},
          Bye{"the pack differs"},
          Ready{12},
          ClockRequest{3},
          ClockAnswer{3, 123456.75},
          HiddenSet{12, {0, 2, 4, 6, 100000}}};
}

}  // namespace triptych
