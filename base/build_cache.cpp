#include "base/build_cache.hpp"

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/file_access.hpp"
#include "base/hashing.hpp"

#include <algorithm>
#include <array>
#include <fcntl.h>
#include <fstream>

namespace triptych {

namespace {

constexpr std::array<char, 8> cache_magic = {'T', 'R', 'I', 'C', 'A', 'C', 'H', '2'};

struct CacheHeader {
  std::array<char, 8> magic = cache_magic;
  ContentKey program;
  uint64_t index_offset = 0, index_count = 0, index_checksum = 0;
};

constexpr const char* in_general = "a build's cache";

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

BuildCache::BuildCache(const std::filesystem::path& file, const ContentKey& program,
                       std::optional<uint64_t> limit)
    : program_(program), limit_(limit), file_(checked(file)) {
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

const BuildCache::Entry* BuildCache::old_entry(const ContentKey& key) const {
  const auto found = old_entries_.find(key);
  return found == old_entries_.end() ? nullptr : &found->second;
}

std::optional<std::vector<std::byte>> BuildCache::find(const ContentKey& key) const {
  const Entry* const entry = old_entry(key);
  if (!entry) return std::nullopt;
  std::vector<std::byte> bytes(entry->size);
  try {
    read_at(old_.number(), entry->offset, bytes, in_general);
  } catch (const Error&) {
    return std::nullopt;
  }
  if (hash_bytes(bytes) != entry->checksum) return std::nullopt;
  return bytes;
}

bool BuildCache::read(const ContentKey& key,
                      const std::function<void(std::span<const std::byte>)>& take) const {
  const Entry* const entry = old_entry(key);
  if (!entry) return false;
  StreamHash hash;
  std::vector<std::byte> stretch;
  for (uint64_t done = 0; done < entry->size; done += stretch.size()) {
    stretch.resize(std::min<uint64_t>(entry->size - done, uint64_t{1} << 20));
    try {
      read_at(old_.number(), entry->offset + done, stretch, in_general);
    } catch (const Error&) {
      return false;
    }
    hash.add(stretch);
    take(stretch);
  }
  return hash.checksum() == entry->checksum;
}

bool BuildCache::has_room(uint64_t bytes) const {
  return !limit_ || file_.size() + bytes + (entries_.size() + 1) * sizeof(Entry) <= *limit_;
}

void BuildCache::keep(const ContentKey& key, std::span<const std::byte> bytes) {
  keep_stretches(key, bytes.size(), [&](const Take& take) { take(bytes); });
}

void BuildCache::keep_file(const ContentKey& key, const std::filesystem::path& file) {
  const Descriptor opened = open_to_read(file);
  const uint64_t size = size_of(opened.number(), file.string());
  keep_stretches(key, size,
                 [&](const Take& take) { read_in_stretches(opened.number(), size, file.string(), take); });
}

void BuildCache::keep_stretches(const ContentKey& key, uint64_t bytes,
                                const std::function<void(const Take& take)>& write_to) {
  const std::lock_guard lock(mutex_);
  if (!problem_.empty() || entries_.count(key) > 0) return;
  if (!has_room(bytes)) {
    if (left_out_.insert(key).second) left_out_bytes_ += bytes + sizeof(Entry);
    return;
  }
  Entry entry{key, file_.size(), 0, 0, 0};
  StreamHash hash;
  try {
    write_to([&](std::span<const std::byte> stretch) {
      file_.write(stretch);
      hash.add(stretch);
    });
  } catch (const Error& error) {
    problem_ = error.what();
  }
  entry.size = file_.size() - entry.offset;
  entry.checksum = hash.checksum();
  entries_[key] = entry;
}

void BuildCache::keep_earlier() {
  std::vector<const Entry*> earlier;
  for (const auto& [key, entry] : old_entries_) {
    if (entries_.count(key) == 0) earlier.push_back(&entry);
  }
  std::sort(earlier.begin(), earlier.end(), [](const Entry* a, const Entry* b) {
    return std::pair(a->builds, a->offset) < std::pair(b->builds, b->offset);
  });
  for (const Entry* entry : earlier) {
    if (!has_room(entry->size)) continue;
    const uint64_t offset = file_.size();
    // What is damaged leaves a gap.
    if (read(entry->key, [&](std::span<const std::byte> stretch) { file_.write(stretch); }))
      entries_[entry->key] = {entry->key, offset, entry->size, entry->checksum, entry->builds + 1};
  }
}

BuildCache::Count BuildCache::count() const {
  Count all;
  for (const auto& [kind, count] : counts_) {
    all.found += count.found;
    all.made += count.made;
  }
  return all;
}

void BuildCache::add_to_count(std::string_view kind, bool is_found) {
  const std::lock_guard lock(mutex_);
  auto known = counts_.find(kind);
  if (known == counts_.end()) known = counts_.emplace(kind, Count()).first;
  ++(is_found ? known->second.found : known->second.made);
}

std::vector<std::byte> BuildCache::get(std::string_view kind, const ContentKey& key,
                                       const std::function<std::vector<std::byte>()>& make) {
  std::optional<std::vector<std::byte>> known = find(key);
  const bool found = known.has_value();
  std::vector<std::byte> bytes = found ? std::move(*known) : make();
  add_to_count(kind, found);
  keep(key, bytes);
  return bytes;
}

void BuildCache::renew(
    std::string_view kind, const ContentKey& key,
    const std::function<std::vector<std::byte>(const std::vector<std::byte>& before)>& make) {
  const std::vector<std::byte> before = find(key).value_or(std::vector<std::byte>());
  const std::vector<std::byte> bytes = make(before);
  add_to_count(kind, bytes == before);
  keep(key, bytes);
}

void BuildCache::commit() {
  if (!problem_.empty()) fail(in_general, "{}", problem_);
  if (limit_) keep_earlier();
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
