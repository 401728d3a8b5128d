// Zip archives of a few small members.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace triptych {

class ZipReader {
 public:
  static constexpr uint64_t max_member_bytes = uint64_t{16} << 20;
  static constexpr size_t max_members = 100'000;

  /// Error (file) if it is no zip archive, or its directory is damaged or too long.
  explicit ZipReader(const std::filesystem::path& file);
  ~ZipReader();
  ZipReader(const ZipReader&) = delete;
  ZipReader& operator=(const ZipReader&) = delete;

  /// Of files, as the archive spells them, in its order.
  const std::vector<std::string>& members() const { return members_; }
  bool has(const std::string& member) const;
  /// Error (file, member) if it is missing, damaged, encrypted, compressed in a way that is not known, or
  /// unpacks to more than max_member_bytes.
  std::string read(const std::string& member) const;

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
  std::string place_;
  std::vector<std::string> members_;
};

/// The file appears under its name when it is complete. The same members give the same bytes.
class ZipWriter {
 public:
  explicit ZipWriter(std::filesystem::path file);
  ~ZipWriter();  ///< without commit() nothing is left
  ZipWriter(const ZipWriter&) = delete;
  ZipWriter& operator=(const ZipWriter&) = delete;

  /// A name that ends with a slash is a folder. Error (file) where the disk is full.
  void add(const std::string& member, std::span<const std::byte> bytes);
  void add(const std::string& member, const std::string& text);
  void commit();

 private:
  void release();  ///< the file under construction, which is removed if it is still there

  void* zip_ = nullptr;
  std::filesystem::path file_, partial_;
  std::FILE* held_ = nullptr;  ///< so that other processes see that it is under construction
};

}  // namespace triptych
