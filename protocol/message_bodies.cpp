#include "protocol/message_bodies.hpp"

#include "protocol/delta_codec.hpp"
#include "protocol/wire.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
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
constexpr uint8_t planes_bits = 7, section_box_mark = 8, hidden_mark = 16;

uint8_t samples_marks(uint32_t samples) {
  const auto* const found = std::find(sample_counts.begin(), sample_counts.end(), samples);
  assert(found != sample_counts.end());
  return static_cast<uint8_t>((found - sample_counts.begin()) << samples_shift);
}

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

void expect_not_negative(const ByteReader& in, double value, const char* what) {
  if (!std::isfinite(value) || value < 0) fail(in.place(), "{} is {}", what, value);
}

/// A floating-point number's bytes without the zero bytes at its lower end: round numbers have many.
struct ShortNumber {
  uint64_t bits;
  uint32_t bytes;
};

ShortNumber shorten(double number) {
  const auto bits = std::bit_cast<uint64_t>(number);
  return {bits, bits == 0 ? 0 : 8 - static_cast<uint32_t>(std::countr_zero(bits)) / 8};
}

/// How many bytes each has, four bits each, two to a byte; then those bytes, the lowest first.
void write_numbers(ByteWriter& out, std::span<const double* const> numbers) {
  for (size_t i = 0; i < numbers.size(); i += 2) {
    const uint32_t next = i + 1 < numbers.size() ? shorten(*numbers[i + 1]).bytes : 0;
    out.write(static_cast<uint8_t>(shorten(*numbers[i]).bytes | next << 4));
  }
  for (const double* number : numbers) {
    const ShortNumber shortened = shorten(*number);
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
  if (lengths.size() > numbers.size() && lengths.back() != 0) fail(in.place(), "a number too many");
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (lengths[i] > 8) fail(in.place(), "a number of {} bytes", lengths[i]);
    uint64_t bits = 0;
    for (uint32_t byte = 8 - lengths[i]; byte < 8; ++byte)
      bits |= static_cast<uint64_t>(in.read<uint8_t>()) << (8 * byte);
    *numbers[i] = std::bit_cast<double>(bits);
    if (shorten(*numbers[i]).bytes != lengths[i]) fail(in.place(), "a number with a needless byte");
  }
}

/// A position in the bytes of a message: a BodyWriter writes the fields that it is given, a BodyReader reads
/// them. So one description of a message serves both.
class BodyWriter {
 public:
  static constexpr bool reads = false;
  explicit BodyWriter(ByteWriter& out) : out_(out) {}

  template <typename Value>
  void plain(const Value& value) {
    out_.write(value);
  }
  /// One byte; `largest` is the last valid value.
  template <typename Enum>
  void choice(const Enum& value, Enum /*largest*/, const char* /*what*/) {
    out_.write(static_cast<uint8_t>(value));
  }
  void line(const std::string& text) { write_line(out_, text); }
  void count(uint32_t value) { out_.write_varint(value); }
  void count(uint64_t value) { out_.write_varint(value); }
  void numbers(std::span<const double* const> numbers) { write_numbers(out_, numbers); }
  /// Milliseconds, not negative.
  void times(std::initializer_list<const double*> times) { numbers({times.begin(), times.size()}); }
  void rest(const std::vector<std::byte>& bytes) { out_.write_all(std::span<const std::byte>(bytes)); }

 private:
  ByteWriter& out_;
};

class BodyReader {
 public:
  static constexpr bool reads = true;
  explicit BodyReader(ByteReader& in) : in_(in) {}

  template <typename Value>
  void plain(Value& value) {
    value = in_.read<Value>();
  }
  template <typename Enum>
  void choice(Enum& value, Enum largest, const char* what) {
    const auto read = in_.read<uint8_t>();
    if (read > static_cast<uint8_t>(largest)) fail(place(), "{} {} does not exist", what, read);
    value = static_cast<Enum>(read);
  }
  void line(std::string& text) { text = read_line(in_); }
  void count(uint32_t& value) {
    const uint64_t read = in_.read_varint();
    if (read > std::numeric_limits<uint32_t>::max()) fail(place(), "a count of {}", read);
    value = static_cast<uint32_t>(read);
  }
  void count(uint64_t& value) { value = in_.read_varint(); }
  void numbers(std::span<double* const> numbers) { read_numbers(in_, numbers); }
  void times(std::initializer_list<double*> times) {
    numbers({times.begin(), times.size()});
    for (const double* time : times) expect_not_negative(in_, *time, "a time");
  }
  void rest(std::vector<std::byte>& bytes) { bytes = in_.read_all<std::byte>(in_.left()); }

  ByteReader& bytes() { return in_; }
  const std::string& place() const { return in_.place(); }

 private:
  ByteReader& in_;
};

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
                              (state.hiding.name == HiddenName() ? 0 : hidden_mark));
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
  constexpr uint8_t all_marks = planes_bits | section_box_mark | hidden_mark;
  body.choice(more, all_marks, "camera mark");
  if constexpr (Body::reads) {
    if (more == 0) fail(body.place(), "marks that mark nothing");
    message.state.section = read_section(body, more);
  } else {
    write_section(body, message.state.section);
  }
  if ((more & hidden_mark) != 0) describe_hidden_name(body, message.state.hiding.name);
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
