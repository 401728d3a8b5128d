#include "protocol/message_bodies.hpp"

#include "protocol/delta_codec.hpp"
#include "protocol/wire.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <span>
#include <vector>

namespace triptych {

namespace {

constexpr uint32_t delta_type = 2, all_decided_mark = 0x80;
constexpr uint32_t largest_side = 1 << 15;
// Of a camera.
constexpr uint8_t last_mark = 1, warm_up_mark = 2, orthographic_mark = 4, symmetric_mark = 8;

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

void expect_not_negative(const ByteReader& in, double value, const char* what) {
  if (!std::isfinite(value) || value < 0) fail(in.place(), "{} is {}", what, value);
}

/// A floating-point number's bytes but for the zeros at its lower end: numbers that people choose, and
/// rounded ones, have many.
struct ShortNumber {
  uint64_t bits;
  uint32_t bytes;
};

ShortNumber shorten(double number) {
  const auto bits = std::bit_cast<uint64_t>(number);
  return {bits, bits == 0 ? 0 : 8 - static_cast<uint32_t>(std::countr_zero(bits)) / 8};
}

/// How many bytes each has, four bits each, two to a byte; then those bytes, the lowest first.
void write_numbers(ByteWriter& out, std::span<const double> numbers) {
  for (size_t i = 0; i < numbers.size(); i += 2) {
    const uint32_t next = i + 1 < numbers.size() ? shorten(numbers[i + 1]).bytes : 0;
    out.write(static_cast<uint8_t>(shorten(numbers[i]).bytes | next << 4));
  }
  for (const double number : numbers) {
    const ShortNumber shortened = shorten(number);
    for (uint32_t byte = 8 - shortened.bytes; byte < 8; ++byte)
      out.write(static_cast<uint8_t>(shortened.bits >> (8 * byte)));
  }
}

void read_numbers(ByteReader& in, std::span<double* const> numbers) {
  std::vector<uint32_t> lengths;
  while (lengths.size() < numbers.size()) {
    const auto pair = in.read<uint8_t>();
    lengths.push_back(pair & 15u);
    lengths.push_back(pair >> 4u);
  }
  if (lengths.size() > numbers.size() && lengths.back() != 0) fail(in.place(), "a number that nobody wants");
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (lengths[i] > 8) fail(in.place(), "a number of {} bytes", lengths[i]);
    uint64_t bits = 0;
    for (uint32_t byte = 8 - lengths[i]; byte < 8; ++byte)
      bits |= static_cast<uint64_t>(in.read<uint8_t>()) << (8 * byte);
    *numbers[i] = std::bit_cast<double>(bits);
    if (shorten(*numbers[i]).bytes != lengths[i]) fail(in.place(), "a number with a needless byte");
  }
}

/// Times and clocks, milliseconds.
void read_times(ByteReader& in, std::initializer_list<double*> times) {
  read_numbers(in, {times.begin(), times.size()});
  for (const double* time : times) expect_not_negative(in, *time, "a time");
}

uint32_t read_count(ByteReader& in) {
  const uint64_t count = in.read_varint();
  if (count > std::numeric_limits<uint32_t>::max()) fail(in.place(), "a count of {}", count);
  return static_cast<uint32_t>(count);
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

/// The numbers of a camera message in their order; a symmetric frustum's left and bottom say it all.
std::vector<double*> numbers_of(CameraMessage& message, bool symmetric) {
  Camera& camera = message.view.camera;
  std::vector<double*> numbers;
  for (auto* vector : {&camera.eye, &camera.target, &camera.up}) {
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(&(*vector)[axis]);
  }
  numbers.insert(numbers.end(), {&camera.near, &message.pixel_error, &camera.left, &camera.bottom});
  if (!symmetric) numbers.insert(numbers.end(), {&camera.right, &camera.top});
  return numbers;
}

bool is_symmetric(const Camera& camera) {
  return camera.right == -camera.left && camera.top == -camera.bottom;
}

void write_body(ByteWriter& out, const CameraMessage& message) {
  const Camera& camera = message.view.camera;
  const bool symmetric = is_symmetric(camera);
  out.write(static_cast<uint8_t>((message.last ? last_mark : 0) | (message.warm_up ? warm_up_mark : 0) |
                                 (camera.orthographic() ? orthographic_mark : 0) |
                                 (symmetric ? symmetric_mark : 0)));
  out.write_varint(static_cast<uint32_t>(message.view.width));
  out.write_varint(static_cast<uint32_t>(message.view.height));
  CameraMessage copy = message;
  std::vector<double> numbers;
  for (const double* number : numbers_of(copy, symmetric)) numbers.push_back(*number);
  write_numbers(out, numbers);
}

CameraMessage read_camera(ByteReader& in, uint32_t frame) {
  CameraMessage message;
  message.frame = frame;
  Camera& camera = message.view.camera;
  const auto marks = read_enum(
      in, static_cast<uint8_t>(last_mark | warm_up_mark | orthographic_mark | symmetric_mark), "camera mark");
  message.last = (marks & last_mark) != 0;
  message.warm_up = (marks & warm_up_mark) != 0;
  if ((marks & orthographic_mark) != 0) camera.projection = Projection::orthographic;
  const bool symmetric = (marks & symmetric_mark) != 0;
  const uint32_t width = read_count(in), height = read_count(in);
  if (width < 1 || width > largest_side || height < 1 || height > largest_side) {
    fail(in.place(), "a viewport of {}x{}", width, height);
  }
  message.view.width = static_cast<int>(width);
  message.view.height = static_cast<int>(height);
  read_numbers(in, numbers_of(message, symmetric));
  expect_not_negative(in, message.pixel_error, "the pixel error");
  if (symmetric) {
    camera.right = -camera.left;
    camera.top = -camera.bottom;
  }
  check_camera(camera, in.place());
  if (!symmetric && is_symmetric(camera)) fail(in.place(), "a symmetric frustum that is not marked");
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
  const StageTimes& times = message.times;
  out.write(message.digest);
  for (const uint32_t count :
       {message.visible, message.added, message.removed, times.queries, times.cut_size})
    out.write_varint(count);
  write_numbers(out, std::array{times.hardware_cull_ms, times.sent_at_ms});
}

Sentinel read_sentinel(ByteReader& in, uint32_t frame) {
  Sentinel message;
  message.frame = frame;
  StageTimes& times = message.times;
  message.digest = in.read<uint64_t>();
  for (auto* count : {&message.visible, &message.added, &message.removed, &times.queries, &times.cut_size})
    *count = read_count(in);
  read_times(in, {&times.hardware_cull_ms, &times.sent_at_ms});
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
  write_numbers(out, std::array{message.began_at_ms, message.occlusion_representation_ms,
                                message.camera_waiting_ms, message.packets_waiting_ms});
  out.write_varint(message.drawables);
  out.write_varint(message.triangles);
}

SwitchReport read_switch_report(ByteReader& in, uint32_t frame) {
  SwitchReport message;
  message.frame = frame;
  read_times(in, {&message.began_at_ms, &message.occlusion_representation_ms, &message.camera_waiting_ms,
                  &message.packets_waiting_ms});
  message.drawables = read_count(in);
  message.triangles = in.read_varint();
  return message;
}

void write_body(ByteWriter& out, const Bye& message) { write_line(out, message.reason); }

void write_body(ByteWriter&, const Ready&) {}

void write_body(ByteWriter&, const ClockRequest&) {}

void write_body(ByteWriter& out, const ClockAnswer& message) {
  write_numbers(out, std::array{message.clock_ms});
}

ClockAnswer read_clock_answer(ByteReader& in, uint32_t frame) {
  ClockAnswer message{frame, 0};
  read_times(in, {&message.clock_ms});
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
      return read_clock_answer(in, frame);
    default:
      fail(in.place(), "message type {} does not exist", type);
  }
}

}  // namespace triptych
