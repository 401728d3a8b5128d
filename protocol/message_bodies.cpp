#include "protocol/message_bodies.hpp"

#include "protocol/body_fields.hpp"
#include "protocol/delta_codec.hpp"
#include "protocol/wire.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace triptych {

namespace {

constexpr uint32_t delta_type = 2, all_decided_mark = 0x80;
constexpr uint32_t max_side = 1 << 15;
// The marks of a camera.
constexpr uint8_t last_mark = 1, warm_up_mark = 2, orthographic_mark = 4, symmetric_mark = 8, edges_mark = 16;
// Two bits of them are a place in this list.
constexpr std::array<uint32_t, 4> sample_counts = {1, 4, 8, 16};
constexpr uint32_t samples_shift = 5;
constexpr uint8_t samples_bits = 3;
// Another byte of marks follows, which are not all 0. Its lowest bits are the number of section planes.
constexpr uint8_t more_mark = 128;
constexpr uint8_t planes_bits = 7, section_box_mark = 8, hidden_mark = 16, effects_mark = 32, time_mark = 64,
                  sky_mark = 128;

uint8_t samples_marks(uint32_t samples) {
  const auto* const found = std::find(sample_counts.begin(), sample_counts.end(), samples);
  assert(found != sample_counts.end());
  return static_cast<uint8_t>((found - sample_counts.begin()) << samples_shift);
}

// One description of each message's body; the frame is in the header.

/// A message to read, or a constant one to write.
template <typename M, typename Type>
concept Either = std::is_same_v<std::remove_const_t<M>, Type>;

template <typename Body, Either<Hello> M>
void describe(Body& body, M& hello) {
  body.plain(hello.version);
  body.choice(hello.role, Role::switch_1, "role");
  body.choice(hello.channel, Channel::nodes, "channel");
  body.choice(hello.called, Role::switch_1, "role");
  if constexpr (Body::reads) {
    if (hello.version != protocol_version) {
      std::vector<std::byte> unknown;
      return body.rest(unknown);
    }
  }
  body.plain(hello.session);
  body.plain(hello.pack_hash);
  for (auto* text : {&hello.device.vendor, &hello.device.renderer, &hello.device.version, &hello.raster})
    body.line(*text);
}

bool is_symmetric(const Camera& camera) {
  return camera.right == -camera.left && camera.top == -camera.bottom;
}

uint8_t section_marks(const Section& section) {
  return static_cast<uint8_t>(section.planes().size() | (section.box() ? section_box_mark : 0));
}

template <typename Body>
void describe_plane(Body& body, auto& plane) {
  const std::array numbers = {&plane.normal.x, &plane.normal.y, &plane.normal.z, &plane.offset};
  body.numbers(numbers);
}

template <typename Body>
void describe_box(Body& body, auto& box) {
  const std::array numbers = {&box.lo.x, &box.lo.y, &box.lo.z, &box.hi.x, &box.hi.y, &box.hi.z};
  body.numbers(numbers);
}

void write_section(BodyWriter& body, const Section& section) {
  for (const SectionPlane& plane : section.planes()) describe_plane(body, plane);
  if (section.box()) describe_box(body, *section.box());
}

Section read_section(BodyReader& body, uint8_t marks) {
  Section section;
  for (int i = 0; i < (marks & planes_bits); ++i) {
    SectionPlane plane;
    describe_plane(body, plane);
    section.add_plane(plane, body.place());
    if (section.planes().back() != plane) fail(body.place(), "a section plane's normal is not of length 1");
  }
  if ((marks & section_box_mark) != 0) {
    Box box;
    describe_box(body, box);
    section.set_box(box, body.place());
  }
  return section;
}

uint8_t more_marks(const FrameState& state) {
  return static_cast<uint8_t>(section_marks(state.section) |
                              (state.hiding.name == HiddenName() ? 0 : hidden_mark) |
                              (state.effects == Effects::all() ? 0 : effects_mark) |
                              (state.time == 0 ? 0 : time_mark) | (state.sky.shown ? sky_mark : 0));
}

/// Those that are switched off.
template <typename Body>
void describe_effects(Body& body, auto& effects) {
  uint32_t off = Effects::all().bits() & ~effects.bits();
  body.count(off);
  if constexpr (Body::reads) {
    if (off == 0 || !Effects::known(off)) fail(body.place(), "unknown effects are switched off");
    effects = Effects(Effects::all().bits() & ~off);
  }
}

template <typename Body>
void describe_time(Body& body, auto& time) {
  const std::array numbers = {&time};
  body.numbers(numbers);
  if constexpr (Body::reads) {
    if (time == 0) fail(body.place(), "a time that need not be said");
  }
}

template <typename Body>
void describe_sky(Body& body, auto& sky) {
  const std::array numbers = {&sky.to_sun.x, &sky.to_sun.y, &sky.to_sun.z};
  body.numbers(numbers);
  if constexpr (Body::reads) {
    sky.shown = true;
    constexpr double tolerance = 1e-9;
    if (!(std::abs(glm::length(sky.to_sun) - 1) <= tolerance))
      fail(body.place(), "the direction to the sun is not of length 1");
  }
}

template <typename Body>
void describe_hidden_name(Body& body, auto& name) {
  body.count(name.count);
  body.plain(name.hash);
  if constexpr (Body::reads) {
    if (name.count == 0) fail(body.place(), "a set of no hidden objects");
  }
}

template <typename Body, Either<CameraMessage> M>
void describe(Body& body, M& message) {
  auto& view = message.state.view;
  auto& camera = view.camera;
  auto marks = static_cast<uint8_t>(
      (message.last ? last_mark : 0) | (message.warm_up ? warm_up_mark : 0) |
      (camera.orthographic() ? orthographic_mark : 0) | (is_symmetric(camera) ? symmetric_mark : 0) |
      (message.state.edges ? edges_mark : 0) | samples_marks(message.state.samples) |
      (more_marks(message.state) == 0 ? 0 : more_mark));
  auto width = static_cast<uint32_t>(view.width), height = static_cast<uint32_t>(view.height);
  body.plain(marks);
  body.count(width);
  body.count(height);
  const bool symmetric = (marks & symmetric_mark) != 0;
  // A symmetric frustum is determined by its left and bottom sides.
  const std::array numbers = {&camera.eye.x,
                              &camera.eye.y,
                              &camera.eye.z,
                              &camera.target.x,
                              &camera.target.y,
                              &camera.target.z,
                              &camera.up.x,
                              &camera.up.y,
                              &camera.up.z,
                              &camera.near,
                              &message.state.pixel_error,
                              &camera.left,
                              &camera.bottom,
                              &camera.right,
                              &camera.top};
  body.numbers(std::span(numbers).first(numbers.size() - (symmetric ? 2 : 0)));
  if constexpr (Body::reads) {
    message.last = (marks & last_mark) != 0;
    message.warm_up = (marks & warm_up_mark) != 0;
    message.state.edges = (marks & edges_mark) != 0;
    message.state.samples = sample_counts.at(marks >> samples_shift & samples_bits);
    if ((marks & orthographic_mark) != 0) camera.projection = Projection::orthographic;
    if (width < 1 || width > max_side || height < 1 || height > max_side)
      fail(body.place(), "a viewport of {}x{}", width, height);
    view.width = static_cast<int>(width);
    view.height = static_cast<int>(height);
    expect_not_negative(body.bytes(), message.state.pixel_error, "the pixel error");
    if (symmetric) {
      camera.right = -camera.left;
      camera.top = -camera.bottom;
    }
    check_camera(camera, body.place());
    if (!symmetric && is_symmetric(camera)) fail(body.place(), "a symmetric frustum that is not marked");
  }
  if ((marks & more_mark) == 0) return;
  auto more = more_marks(message.state);
  constexpr uint8_t all_marks =
      planes_bits | section_box_mark | hidden_mark | effects_mark | time_mark | sky_mark;
  body.choice(more, all_marks, "camera mark");
  if constexpr (Body::reads) {
    if (more == 0) fail(body.place(), "marks that mark nothing");
    message.state.section = read_section(body, more);
  } else {
    write_section(body, message.state.section);
  }
  if ((more & hidden_mark) != 0) describe_hidden_name(body, message.state.hiding.name);
  if ((more & effects_mark) != 0) describe_effects(body, message.state.effects);
  if ((more & time_mark) != 0) describe_time(body, message.state.time);
  if ((more & sky_mark) != 0) describe_sky(body, message.state.sky);
}

/// Where everything is decided, the type says so, and the watermark is not in the body.
template <typename Body, Either<DeltaMessage> M>
void describe(Body& body, M& message) {
  if (message.watermark != everything_decided) {
    auto id = static_cast<uint64_t>(message.watermark.id);
    body.count(message.watermark.distance);
    body.count(id);
    if constexpr (Body::reads) {
      if (id > no_id) fail(body.place(), "a watermark beyond the ids");
      message.watermark.id = static_cast<DrawableId>(id);
    }
  }
  body.rest(message.encoded);
}

template <typename Body, Either<Sentinel> M>
void describe(Body& body, M& message) {
  auto& times = message.times;
  body.plain(message.digest);
  for (auto* count : {&message.visible, &message.added, &message.removed, &times.queries, &times.cut_size})
    body.count(*count);
  body.times({&times.hardware_cull_ms, &times.hardware_cull_cpu_ms, &times.sent_at_ms});
}

/// Ascending ids, as the change of an empty set; they are the rest of the body.
template <typename Body>
void describe_set(Body& body, auto& ids) {
  if constexpr (Body::reads) {
    std::vector<std::byte> encoded;
    body.rest(encoded);
    ids = decode_delta(encoded, {}, body.place()).added;
  } else {
    body.rest(encode_delta({ids, {}}, {}));
  }
}

template <typename Body, Either<FullSet> M>
void describe(Body& body, M& message) {
  describe_set(body, message.visible);
}

template <typename Body, Either<HiddenSet> M>
void describe(Body& body, M& message) {
  describe_set(body, message.objects);
  if constexpr (Body::reads) {
    if (message.objects.empty()) fail(body.place(), "a set of no hidden objects");
  }
}

template <typename Body, Either<SwitchReport> M>
void describe(Body& body, M& message) {
  body.times({&message.began_at_ms, &message.occlusion_representation_ms,
              &message.occlusion_representation_cpu_ms, &message.camera_waiting_ms,
              &message.packets_waiting_ms});
  body.count(message.drawables);
  body.count(message.triangles);
}

template <typename Body, Either<Bye> M>
void describe(Body& body, M& message) {
  body.line(message.reason);
}

template <typename Body, Either<ClockAnswer> M>
void describe(Body& body, M& message) {
  body.times({&message.clock_ms});
}

/// No body: the frame in the header is all.
template <typename Body, typename M>
requires Either<M, FullSetRequest> || Either<M, Ready> || Either<M, ClockRequest>
void describe(Body&, M&) {}

/// A default-constructed message of this type.
template <size_t... types>
Message empty_message(uint32_t type, std::index_sequence<types...>) {
  Message message;
  ((type == types ? static_cast<void>(message.emplace<types>()) : void()), ...);
  return message;
}

}  // namespace

uint32_t type_of(const Message& message) {
  const auto* delta = std::get_if<DeltaMessage>(&message);
  const bool all_decided = delta != nullptr && delta->watermark == everything_decided;
  return static_cast<uint32_t>(message.index()) | (all_decided ? all_decided_mark : 0);
}

bool is_message_type(uint32_t type) {
  return type < std::variant_size_v<Message> || type == (delta_type | all_decided_mark);
}

void write_message_body(ByteWriter& out, const Message& message) {
  BodyWriter body(out);
  std::visit([&](const auto& content) { describe(body, content); }, message);
}

Message read_message_body(uint32_t type, uint32_t frame, ByteReader& in) {
  if (!is_message_type(type)) fail(in.place(), "message type {} does not exist", type);
  Message message =
      empty_message(type & ~all_decided_mark, std::make_index_sequence<std::variant_size_v<Message>>());
  BodyReader body(in);
  std::visit(
      [&](auto& content) {
        if constexpr (requires { content.frame; }) content.frame = frame;
        if constexpr (requires { content.watermark; }) {
          if ((type & all_decided_mark) != 0) content.watermark = everything_decided;
        }
        describe(body, content);
      },
      message);
  return message;
}

}  // namespace triptych
