// What a build made, by what it made it of, in a file: the next build takes from there what is the same.
#pragma once

#include "base/content_key.hpp"
#include "base/descriptor.hpp"
#include "base/file.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tsl/robin_map.h>
#include <vector>

namespace triptych {

/// The file is replaced as a whole by what one build asked for, so that it never holds more than that; with a
/// limit, also by what earlier builds asked for, the latest first, as long as there is room. Two builds with
/// one file do not disturb each other: the later end wins. What a killed build had written beside it is
/// removed by the next one.
class BuildCache {
 public:
  /// Opens what an earlier build left, if there is any. What another `program` made is not used, nor what is
  /// damaged: it is made again. limit: bytes that the file may have; what this build asks for goes first, and
  /// of that what is asked for first. Error (file) if its folder cannot be written.
  BuildCache(const std::filesystem::path& file, const ContentKey& program,
             std::optional<uint64_t> limit = std::nullopt);

  /// What is kept under the key, or else what `make` gives, which is kept. Safe on several threads. A disk
  /// that is full is no error before commit().
  /// kind: under which it is counted.
  std::vector<std::byte> get(std::string_view kind, const ContentKey& key,
                             const std::function<std::vector<std::byte>()>& make);
  /// What `make` makes of what is kept under the key, which may be of something else than now, in part or
  /// all of it: `make` must tell. Empty where there is nothing. Safe on several threads; counted as found
  /// where it stays the same.
  void renew(std::string_view kind, const ContentKey& key,
             const std::function<std::vector<std::byte>(const std::vector<std::byte>& before)>& make);
  /// How often get() and renew() found something, and how often they did not.
  struct Count {
    uint64_t found = 0, made = 0;
  };
  using Counts = std::map<std::string, Count, std::less<>>;  ///< by kind
  const Counts& counts() const { return counts_; }
  Count count() const;  ///< of all kinds
  /// Counts what was looked for by find() or read() as get() does.
  void add_to_count(std::string_view kind, bool is_found);
  /// Bytes that this build asked for, and that are not kept since the limit has no room for them.
  uint64_t left_out_bytes() const { return left_out_bytes_; }

  /// What an earlier build kept under the key; it is kept further only by keep().
  std::optional<std::vector<std::byte>> find(const ContentKey& key) const;
  /// Hands it out a megabyte at a time. False where there is nothing, or where it is damaged: what was handed
  /// out then is worth nothing.
  bool read(const ContentKey& key, const std::function<void(std::span<const std::byte>)>& take) const;
  /// The first one under a key stays.
  void keep(const ContentKey& key, std::span<const std::byte> bytes);
  void keep_file(const ContentKey& key, const std::filesystem::path& file);
  /// So many bytes, which `write_to` hands to what it is given, in stretches.
  using Take = std::function<void(std::span<const std::byte>)>;
  void keep_stretches(const ContentKey& key, uint64_t bytes,
                      const std::function<void(const Take& take)>& write_to);

  /// Puts what was asked for in the file's place. Error if the disk is or was full; the file then stays as it
  /// was.
  void commit();

 private:
  struct Entry {
    ContentKey key;
    uint64_t offset = 0, size = 0, checksum = 0;
    uint64_t builds = 0;  ///< that did not ask for it since one did
  };
  const Entry* old_entry(const ContentKey& key) const;
  void open_old(const std::filesystem::path& file);
  /// Whether so many bytes more, and their entry, stay within the limit.
  bool has_room(uint64_t bytes) const;
  /// What this build did not ask for, the latest first, as long as there is room.
  void keep_earlier();

  ContentKey program_;
  std::optional<uint64_t> limit_;
  Descriptor old_;
  using Entries = tsl::robin_map<ContentKey, Entry, ContentKeyHash>;
  Entries old_entries_;
  std::mutex mutex_;  ///< of what follows
  AtomicFile file_;
  Entries entries_;
  std::string problem_;  ///< why nothing more is written; empty: none
  std::set<ContentKey> left_out_;
  Counts counts_;
  uint64_t left_out_bytes_ = 0;
};

}  // namespace triptych
