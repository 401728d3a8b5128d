// Zip archives, whose members are unpacked when they are asked for.
#pragma once

#include "model/import/import.hpp"
#include "model/import/mesh_stream_source.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

class ModelArchive {
 public:
  /// Error (the source's name) if it is no zip archive, or its directory is damaged.
  explicit ModelArchive(std::shared_ptr<const StreamSource> source);
  ~ModelArchive();
  ModelArchive(const ModelArchive&) = delete;
  ModelArchive& operator=(const ModelArchive&) = delete;

  /// Of files, as the archive spells them, in its order.
  const std::vector<std::string>& members() const { return members_; }
  /// The member of this name, whatever the case of its letters; null where there is none.
  const std::string* find(std::string_view name) const;
  /// Unpacks a member: into memory, or if it is large into a temporary file without a name. Error (archive,
  /// member) if it is damaged, encrypted, or compressed in a way that is not known.
  std::shared_ptr<const StreamSource> read(const std::string& member, const ImportOptions& options) const;
  /// What the member `from` means by a name (model/import/beside.hpp); null where there is nothing.
  std::shared_ptr<const StreamSource> beside(const std::filesystem::path& from, std::string_view name,
                                             const ImportOptions& options) const;

 private:
  struct Reading;
  std::unique_ptr<Reading> reading_;
  std::string place_;
  std::vector<std::string> members_;
};

}  // namespace triptych
