#include "protocol/message_bodies.hpp"

#include "protocol/delta_codec.hpp"
#include "protocol/wire.hpp"

#include <cmath>

namespace triptych {

namespace {

constexpr uint32_t delta_type = 2, all_decided_mark = 0x80;
constexpr uint32_t largest_side = 1 << 15;
constexpr uint8_t last_mark = 1, rehearsal_mark = 2, orthographic_mark = 4;  // of a camera

bool is_control(char character) { return static_cast<unsigned char>(character) < 0x20 || character == 0x7f; }

void write_line(ByteWriter& out, const std::string& text) {
  std::string line = text.substr(0, text_limit);
  for (char& character : line) {
    if (is_control(character)) character = ' ';
  }
  out.write_text(line);
}

std::string read_line(ByteReader& in) {
  const std::string line = in.read_text();
  if (line.size() > text_limit) fail(in.place(), "a text of {} bytes", line.size());
  for (const char character : line) {
    if (is_control(character)) fail(in.place(), "a text with control characters");
  }
  return line;
}

template <typename Enum>
Enum read_enum(ByteReader& in, Enum largest, const char* what) {
  const auto value = in.read<uint8_t>();
  if (value > static_cast<uint8_t>(largest)) fail(in.place(), "{} {} does not exist", what, value);
  return static_cast<Enum>(value);
}

double read_not_negative(ByteReader& in, const char* what) {
  const auto value = in.read<double>();
  if (!std::isfinite(value) || value < 0) fail(in.place(), "{} is {}", what, value);
  return value;
}

// One write and one read for each message; the frame is in the header.

void write_body(ByteWriter& out, const Hello& hello) {
  out.write(hello.version);
  out.write(hello.role);
  out.write(hello.channel);
  out.write(hello.called);
  out.write(hello.session);
  out.write(hello.pack_hash);
  for (const auto* text : {&hello.gl_vendor, &hello.gl_renderer, &hello.gl_version, &hello.raster})
    write_line(out, *text);
}

Hello read_hello(ByteReader& in) {
  Hello hello;
  hello.version = in.read<uint32_t>();
  hello.role = read_enum(in, Role::switch_1, "role");
  hello.channel = read_enum(in, Channel::nodes, "channel");
  hello.called = read_enum(in, Role::switch_1, "role");
  if (hello.version != protocol_version) {
    in.read_all<std::byte>(in.left());
    return hello;
  }
  hello.session = in.read<uint64_t>();
  hello.pack_hash = in.read<uint64_t>();
  for (auto* text : {&hello.gl_vendor, &hello.gl_renderer, &hello.gl_version, &hello.raster})
    *text = read_line(in);
  return hello;
}

void write_body(ByteWriter& out, const CameraMessage& message) {
  const Camera& camera = message.view.camera;
  for (const auto* vector : {&camera.eye, &camera.target, &camera.up}) {
    for (int axis = 0; axis < 3; ++axis) out.write((*vector)[axis]);
  }
  for (const double side : {camera.left, camera.right, camera.bottom, camera.top}) out.write(side);
  out.write(camera.near);
  out.write(static_cast<uint32_t>(message.view.width));
  out.write(static_cast<uint32_t>(message.view.height));
  out.write(message.pixel_error);
  out.write(static_cast<uint8_t>((message.last ? last_mark : 0) | (message.rehearsal ? rehearsal_mark : 0) |
                                 (camera.orthographic() ? orthographic_mark : 0)));
}

CameraMessage read_camera(ByteReader& in, uint32_t frame) {
  CameraMessage message;
  message.frame = frame;
  Camera& camera = message.view.camera;
  for (auto* vector : {&camera.eye, &camera.target, &camera.up}) {
    for (int axis = 0; axis < 3; ++axis) (*vector)[axis] = in.read<double>();
  }
  for (auto* side : {&camera.left, &camera.right, &camera.bottom, &camera.top}) *side = in.read<double>();
  camera.near = in.read<double>();
  const auto width = in.read<uint32_t>(), height = in.read<uint32_t>();
  if (width < 1 || width > largest_side || height < 1 || height > largest_side) {
    fail(in.place(), "a viewport of {}x{}", width, height);
  }
  message.view.width = static_cast<int>(width);
  message.view.height = static_cast<int>(height);
  message.pixel_error = read_not_negative(in, "the pixel error");
  const auto marks =
      read_enum(in, static_cast<uint8_t>(last_mark | rehearsal_mark | orthographic_mark), "camera mark");
  message.last = (marks & last_mark) != 0;
  message.rehearsal = (marks & rehearsal_mark) != 0;
  if ((marks & orthographic_mark) != 0) camera.projection = Projection::orthographic;
  check_camera(camera, in.place());
  return message;
}

void write_body(ByteWriter& out, const DeltaMessage& message) {
  if (message.watermark != everything_decided) {
    out.write_varint(message.watermark.distance);
    out.write_varint(message.watermark.id);
  }
  out.write_all(std::span<const std::byte>(message.encoded));
}

DeltaMessage read_delta(ByteReader& in, uint32_t frame, bool all_decided) {
  DeltaMessage message{frame, everything_decided, {}};
  if (!all_decided) {
    message.watermark.distance = in.read_varint();
    const uint64_t id = in.read_varint();
    if (id > no_id) fail(in.place(), "a watermark beyond the ids");
    message.watermark.id = static_cast<DrawableId>(id);
  }
  message.encoded = in.read_all<std::byte>(in.left());
  return message;
}

void write_body(ByteWriter& out, const Sentinel& message) {
  for (const uint32_t count : {message.visible, message.added, message.removed}) out.write(count);
  out.write(message.digest);
  const StageTimes& times = message.times;
  out.write(times.hardware_cull_ms);
  out.write(times.queries);
  out.write(times.cut_size);
  out.write(times.sent_at_ms);
}

Sentinel read_sentinel(ByteReader& in, uint32_t frame) {
  Sentinel message;
  message.frame = frame;
  for (auto* count : {&message.visible, &message.added, &message.removed}) *count = in.read<uint32_t>();
  message.digest = in.read<uint64_t>();
  StageTimes& times = message.times;
  times.hardware_cull_ms = read_not_negative(in, "a stage's time");
  times.queries = in.read<uint32_t>();
  times.cut_size = in.read<uint32_t>();
  times.sent_at_ms = read_not_negative(in, "a clock");
  return message;
}

void write_body(ByteWriter&, const FullSetRequest&) {}

void write_body(ByteWriter& out, const FullSet& message) {
  out.write_all(std::span<const std::byte>(encode_delta({message.visible, {}}, {})));
}

FullSet read_full_set(ByteReader& in, uint32_t frame) {
  return {frame, decode_delta(in.read_all<std::byte>(in.left()), {}, in.place()).added};
}

void write_body(ByteWriter& out, const SwitchReport& message) {
  for (const double time : {message.began_at_ms, message.occlusion_representation_ms,
                            message.camera_waiting_ms, message.packets_waiting_ms}) {
    out.write(time);
  }
  out.write(message.drawables);
  out.write(message.triangles);
}

SwitchReport read_switch_report(ByteReader& in, uint32_t frame) {
  SwitchReport message;
  message.frame = frame;
  for (auto* time : {&message.began_at_ms, &message.occlusion_representation_ms, &message.camera_waiting_ms,
                     &message.packets_waiting_ms}) {
    *time = read_not_negative(in, "a stage's time");
  }
  message.drawables = in.read<uint32_t>();
  message.triangles = in.read<uint64_t>();
  return message;
}

void write_body(ByteWriter& out, const Bye& message) { write_line(out, message.reason); }

void write_body(ByteWriter&, const Ready&) {}

void write_body(ByteWriter&, const ClockRequest&) {}

void write_body(ByteWriter& out, const ClockAnswer& message) { out.write(message.clock_ms); }

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
  std::visit([&](const auto& content) { write_body(out, content); }, message);
}

Message read_message_body(uint32_t type, uint32_t frame, ByteReader& in) {
  switch (type) {
    case 0:
      return read_hello(in);
    case 1:
      return read_camera(in, frame);
    case delta_type:
    case delta_type | all_decided_mark:
      return read_delta(in, frame, type != delta_type);
    case 3:
      return read_sentinel(in, frame);
    case 4:
      return FullSetRequest{frame};
    case 5:
      return read_full_set(in, frame);
    case 6:
      return read_switch_report(in, frame);
    case 7:
      return Bye{read_line(in)};
    case 8:
      return Ready{frame};
    case 9:
      return ClockRequest{frame};
    case 10:
      return ClockAnswer{frame, read_not_negative(in, "a clock")};
    default:
      fail(in.place(), "message type {} does not exist", type);
  }
}

}  // namespace triptych
