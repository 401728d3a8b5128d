#include "render/gl/texture_buffer.hpp"

#include "render/gl/shaders.hpp"
#include "residency/take.hpp"

#include <algorithm>
#include <bit>

namespace triptych {

namespace {

/// Bytes of the texture from one of its levels on, with the places of the levels.
uint64_t bytes_from(const Texture& texture, uint32_t level) {
  uint64_t texels = 0;
  for (uint32_t i = level; i < texture.levels.size(); ++i)
    texels += uint64_t{side_at_level(texture.width, i)} * side_at_level(texture.height, i);
  return (texels + texture.levels.size() - level) * sizeof(uint32_t);
}

}  // namespace

void TextureBuffer::begin_view() {
  use_.coarser_views += shows_coarser_;
  // What had no room for its finest levels is read anew once it has.
  if (shows_coarser_ && wanted_bytes_ <= std::min(cap_, largest_)) {
    for (Held& held : held_)
      if (held.is_held() && held.finest > 0) drop(held);
  }
  shows_coarser_ = false;
  wanted_bytes_ = 0;
  ++view_;
}

TextureUse TextureBuffer::use() const {
  TextureUse use = use_;
  use.cap = cap_;
  use.bytes = bytes_;
  use.coarser_views += shows_coarser_;
  return use;
}

uint64_t TextureBuffer::require(uint32_t index) {
  if (held_.empty()) {
    held_.resize(skeleton_.textures.size());
    glNamedBufferStorage(records_, static_cast<GLsizeiptr>(held_.size() * sizeof(Record)), nullptr,
                         GL_DYNAMIC_STORAGE_BIT);
    GLint64 block = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block);
    largest_ = static_cast<uint64_t>(block) / sizeof(uint32_t) * sizeof(uint32_t);
  }
  Held& held = held_[index];
  const bool is_first = held.view != view_;
  held.view = view_;
  const Texture& texture = skeleton_.textures[index];
  if (is_first) wanted_bytes_ += bytes_from(texture, 0);
  if (held.is_held()) {
    use_.hits += is_first;
    shows_coarser_ |= held.finest > 0;
    return 0;
  }
  uint32_t finest = 0;
  const auto last = static_cast<uint32_t>(texture.levels.size() - 1);
  std::optional<uint64_t> found;
  while (!(found = place(bytes_from(texture, finest))) && finest < last) ++finest;
  if (!found) throw NoRoom(bytes_ + bytes_from(texture, last), cap_);
  held.offset = *found;
  held.bytes = bytes_from(texture, finest);
  held.finest = finest;
  shows_coarser_ |= finest > 0;
  bytes_ += held.bytes;
  use_.peak_bytes = std::max(use_.peak_bytes, bytes_);
  ++use_.misses;
  const uint32_t levels = last + 1 - finest;
  const auto first = static_cast<uint32_t>(held.offset / sizeof(uint32_t));
  std::vector<uint32_t> words(levels);
  for (uint32_t level = 0; level < levels; ++level) {
    words[level] = first + static_cast<uint32_t>(words.size());
    use_.read_bytes += texture.levels[finest + level].size;
    for (const Texel& texel : take_texels(residency_, texture, index, finest + level, missing_))
      words.push_back(std::bit_cast<uint32_t>(texel));
  }
  use_.decoded_bytes += (words.size() - levels) * sizeof(Texel);
  use_.uploaded_bytes += words.size() * sizeof(uint32_t);
  const Record record{side_at_level(texture.width, finest), side_at_level(texture.height, finest), levels,
                      first};
  glNamedBufferSubData(texels_, static_cast<GLintptr>(held.offset),
                       static_cast<GLsizeiptr>(words.size() * sizeof(uint32_t)), words.data());
  glNamedBufferSubData(records_, static_cast<GLintptr>(index * sizeof(Record)), sizeof(Record), &record);
  return held.bytes;
}

/// Where so many bytes have room, once what no longer has to stay has gone.
std::optional<uint64_t> TextureBuffer::place(uint64_t bytes) {
  while (bytes_ + bytes > std::min(cap_, largest_))
    if (!drop_oldest()) return std::nullopt;
  for (;;) {
    if (const auto found = space_.take(bytes, sizeof(uint32_t))) return found;
    const uint64_t most = std::min(cap_, largest_);
    if (space_.size() + bytes <= most) {
      grow(std::min(most, std::max(2 * space_.size(), space_.size() + bytes)));
    } else if (!drop_oldest()) {  // there is room, but not in one place
      return std::nullopt;
    }
  }
}

bool TextureBuffer::drop_oldest() {
  Held* oldest = nullptr;
  for (Held& held : held_) {
    if (held.is_held() && held.view < view_ && (oldest == nullptr || held.view < oldest->view))
      oldest = &held;
  }
  if (oldest == nullptr) return false;
  drop(*oldest);
  return true;
}

void TextureBuffer::drop(Held& held) {
  space_.give_back(held.offset, held.bytes);
  bytes_ -= held.bytes;
  held.bytes = 0;
  ++use_.evicted;
}

void TextureBuffer::grow(uint64_t bytes) {
  GlBuffer larger;
  glNamedBufferStorage(larger, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
  check_gl("device memory");
  if (space_.size() > 0)
    glCopyNamedBufferSubData(texels_, larger, 0, 0, static_cast<GLsizeiptr>(space_.size()));
  std::swap(texels_, larger);
  space_.grow(bytes);
}

void TextureBuffer::bind() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, textures_binding, records_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, texels_binding, texels_);
}

}  // namespace triptych
