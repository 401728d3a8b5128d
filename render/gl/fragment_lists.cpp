#include "render/gl/fragment_lists.hpp"

#include "base/error.hpp"
#include "render/gl/shaders.hpp"

#include <algorithm>
#include <bit>
#include <vector>

namespace triptych {

namespace {

/// As the shaders have it.
struct Fragment {
  uint32_t next, depth, color, item, record, triangle;
};
/// Before the fragments: how many there are, and how many have room.
struct Header {
  uint32_t count, capacity, unused[2];
};

/// Within the cap, and what a shader can reach.
uint64_t max_fragments(uint64_t cap_bytes) {
  GLint64 block = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
  return (std::min(static_cast<uint64_t>(block), cap_bytes) - sizeof(Header)) / sizeof(Fragment);
}

const char* const whole_picture = R"(
void main() {  // one triangle over the whole picture
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

// Sorts the list of a pixel, the nearest first, by inserting one after the other; at one depth in the order
// of drawing. What two that are alike in all of this look like is alike, too.
const char* const compose_source = R"(
layout(location = 0) out vec4 veil;
bool precedes(uint a, uint b) {
  Fragment p = fragments[a - 1u], q = fragments[b - 1u];
  if (p.depth != q.depth) return p.depth > q.depth;
  if (p.record != q.record) return p.record < q.record;
  if (p.triangle != q.triangle) return p.triangle < q.triangle;
  return p.color < q.color;
}
void main() {
  uint rest = imageLoad(heads, ivec2(gl_FragCoord.xy)).r, sorted = 0u;
  while (rest != 0u) {
    uint taken = rest, before = 0u, after = sorted;
    rest = fragments[taken - 1u].next;
    while (after != 0u && precedes(after, taken)) {
      before = after;
      after = fragments[after - 1u].next;
    }
    fragments[taken - 1u].next = after;
    if (before == 0u) sorted = taken;
    else fragments[before - 1u].next = taken;
  }
  vec3 added = vec3(0.0);
  float through = 1.0;
  for (; sorted != 0u; sorted = fragments[sorted - 1u].next) {
    vec4 color = unpackUnorm4x8(fragments[sorted - 1u].color);
    added += through * color.a * color.rgb;
    through *= 1.0 - color.a;
  }
  veil = vec4(added, through);
}
)";

}  // namespace

void FragmentLists::begin(const Framebuffer& planes) {
  fragments_ = splits_ = 0;
  const uint32_t count = planes.layout().samples;
  if (target_ && target_->width == planes.width() && target_->height == planes.height() &&
      target_->planes == count)
    return;
  target_.emplace(planes.width(), planes.height(), count);
  glTextureStorage2D(target_->heads, 1, GL_R32UI, target_->width, target_->height);
  glTextureStorage3D(target_->veils, 1, GL_RGBA32F, target_->width, target_->height,
                     static_cast<GLsizei>(count));
  glNamedFramebufferParameteri(target_->nothing, GL_FRAMEBUFFER_DEFAULT_WIDTH, target_->width);
  glNamedFramebufferParameteri(target_->nothing, GL_FRAMEBUFFER_DEFAULT_HEIGHT, target_->height);
  check_gl("transparency");
}

void FragmentLists::make(const Framebuffer& planes, uint32_t plane, const std::function<void()>& draw,
                         VisibleSet* owners) {
  glNamedFramebufferTextureLayer(target_->framebuffer, GL_COLOR_ATTACHMENT0, target_->veils, 0,
                                 static_cast<GLint>(plane));
  glViewport(0, 0, target_->width, target_->height);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_SCISSOR_TEST);
  glBindTextureUnit(opaque_depths_unit, planes.depths());
  glBindImageTexture(heads_image, target_->heads, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
  make_area({0, 0, target_->width, target_->height}, draw, owners);
  glDisable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
}

void FragmentLists::make_area(const Area& area, const std::function<void()>& draw, VisibleSet* owners) {
  constexpr uint64_t few = 1 << 18;
  if (capacity_ == 0) {
    most_ = max_fragments(cap_bytes_);
    make_room(std::min(few, most_));
  }
  uint32_t count = draw_area(area, draw);
  if (count > capacity_ && capacity_ < most_) {
    make_room(std::min(std::bit_ceil(uint64_t{count}), most_));
    count = draw_area(area, draw);
  }
  if (count <= capacity_) {
    if (owners != nullptr) collect(count, *owners);
    compose();
    fragments_ += count;
    return;
  }
  ++splits_;
  Area first = area, second = area;
  if (area.height > 1) {
    first.height = area.height / 2;
    second.bottom += first.height;
    second.height -= first.height;
  } else if (area.width > 1) {
    first.width = area.width / 2;
    second.left += first.width;
    second.width -= first.width;
  } else {
    fail("OpenGL", "{} transparent surfaces behind one pixel, where there is room for {}", count, capacity_);
  }
  make_area(first, draw, owners);
  make_area(second, draw, owners);
}

/// How many fragments there are, whether they have room or not.
uint32_t FragmentLists::draw_area(const Area& area, const std::function<void()>& draw) {
  const GLuint no_list = 0;
  glClearTexSubImage(target_->heads, 0, area.left, area.bottom, 0, area.width, area.height, 1, GL_RED_INTEGER,
                     GL_UNSIGNED_INT, &no_list);
  Header header{0, static_cast<uint32_t>(capacity_), {}};
  glNamedBufferSubData(nodes_, 0, sizeof(header), &header);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, fragments_binding, nodes_);
  glScissor(area.left, area.bottom, area.width, area.height);
  glBindFramebuffer(GL_FRAMEBUFFER, target_->nothing);
  draw();
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(nodes_, 0, sizeof(header), &header);
  return header.count;
}

void FragmentLists::make_room(uint64_t fragments) {
  GlBuffer larger;
  glNamedBufferStorage(larger, static_cast<GLsizeiptr>(sizeof(Header) + fragments * sizeof(Fragment)),
                       nullptr, GL_DYNAMIC_STORAGE_BIT);
  check_gl("transparency");
  std::swap(nodes_, larger);
  capacity_ = fragments;
}

void FragmentLists::collect(uint32_t count, VisibleSet& owners) const {
  std::vector<Fragment> fragments(count);
  glGetNamedBufferSubData(nodes_, sizeof(Header), static_cast<GLsizeiptr>(count * sizeof(Fragment)),
                          fragments.data());
  for (const Fragment& fragment : fragments) owners.push_back(fragment.item);
}

void FragmentLists::compose() {
  if (!compose_) {
    compose_ = make_program("veil", shader_version + std::string(whole_picture),
                            shader_version + fragment_list_source() + compose_source);
  }
  glUseProgram(*compose_);
  glBindFramebuffer(GL_FRAMEBUFFER, target_->framebuffer);
  glBindVertexArray(vertex_array_);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

}  // namespace triptych
