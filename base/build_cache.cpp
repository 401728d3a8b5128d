#include "base/build_cache.hpp"

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/hashing.hpp"

#include <algorithm>
#include <array>
#include <fcntl.h>
#include <fstream>

namespace triptych {

namespace {

constexpr std::array<char, 8> cache_magic = {'T', 'R', 'I', 'C', 'A', 'C', 'H', '1'};

struct CacheHeader {
  std::array<char, 8> magic = cache_magic;
  ContentKey program;
  uint64_t index_offset = 0, index_count = 0, index_checksum = 0;
};

/// Error for a file with something else in it than a cache, which would be lost.
const std::filesystem::path& checked(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error) || std::filesystem::file_size(file, error) == 0)
    return file;
  std::array<char, cache_magic.size()> beginning{};
  std::ifstream(file, std::ios::binary).read(beginning.data(), beginning.size());
  // The last sign is the version.
  if (!std::equal(beginning.begin(), beginning.end() - 1, cache_magic.begin()))
    fail(file.string(), "is no cache of a build, and would be lost: name another file, or remove it");
  return file;
}

}  // namespace

BuildCache::BuildCache(const std::filesystem::path& file, const ContentKey& program)
    : program_(program), file_(checked(file)) {
  const CacheHeader unfinished{.magic = {}, .program = {}};
  file_.write(std::as_bytes(std::span(&unfinished, 1)));
  open_old(file);
}

void BuildCache::open_old(const std::filesystem::path& file) {
  Descriptor old(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!old.is_open()) return;
  const std::string place = file.string();
  try {
    const uint64_t size = size_of(old.number(), place);
    std::vector<std::byte> bytes(sizeof(CacheHeader));
    read_at(old.number(), 0, bytes, place);
    const auto header = ByteReader(bytes, place).read<CacheHeader>();
    if (header.magic != cache_magic || header.program != program_ || header.index_offset > size ||
        header.index_count > (size - header.index_offset) / sizeof(Entry))
      return;
    bytes.resize(header.index_count * sizeof(Entry));
    read_at(old.number(), header.index_offset, bytes, place);
    if (hash_bytes(bytes) != header.index_checksum) return;
    for (const Entry& entry : ByteReader(bytes, place).read_all<Entry>(header.index_count)) {
      if (entry.offset <= size && entry.size <= size - entry.offset) old_entries_[entry.key] = entry;
    }
  } catch (const Error&) {
    return;  // cut short: nothing of it is used
  }
  old_ = std::move(old);
}

bool BuildCache::read_old(const ContentKey& key, std::vector<std::byte>& bytes) const {
  const auto found = old_entries_.find(key);
  if (found == old_entries_.end()) return false;
  const Entry& entry = found->second;
  bytes.resize(entry.size);
  try {
    read_at(old_.number(), entry.offset, bytes, "a build's cache");
  } catch (const Error&) {
    return false;
  }
  return hash_bytes(bytes) == entry.checksum;
}

void BuildCache::keep(const ContentKey& key, std::span<const std::byte> bytes) {
  const auto [at, is_new] = entries_.try_emplace(key);
  if (!is_new) return;
  at->second = {key, file_.size(), bytes.size(), hash_bytes(bytes)};
  file_.write(bytes);
}

std::vector<std::byte> BuildCache::get(const ContentKey& key,
                                       const std::function<std::vector<std::byte>()>& make) {
  std::vector<std::byte> bytes;
  const bool found = read_old(key, bytes);
  if (!found) bytes = make();
  const std::lock_guard lock(mutex_);
  ++(found ? found_ : made_);
  keep(key, bytes);
  return bytes;
}

void BuildCache::commit() {
  std::vector<Entry> index;
  for (const auto& [key, entry] : entries_) index.push_back(entry);
  const auto bytes = std::as_bytes(std::span<const Entry>(index));
  const CacheHeader header{.program = program_,
                           .index_offset = file_.size(),
                           .index_count = index.size(),
                           .index_checksum = hash_bytes(bytes)};
  file_.write(bytes);
  file_.write_at(0, std::as_bytes(std::span(&header, 1)));
  file_.commit();
}

}  // namespace triptych
