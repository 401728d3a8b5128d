// What readers of further formats made of files, kept from build to build by the files' bytes.
#pragma once

#include "base/build_cache.hpp"
#include "model/import/converter.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace triptych {

/// Of readers that open nothing but their file: of all others the file's bytes do not say what they make.
class KeptConversions {
 public:
  /// readers: the programs that read, by their content. The cache must outlive this.
  KeptConversions(BuildCache& cache, const ContentKey& readers) : cache_(cache), readers_(readers) {}

  /// What is kept of the source, or else what `convert` gives, which is kept unless the source changed
  /// meanwhile. how: which reader, and its flags. folder: for a temporary file. Error of `convert`, and where
  /// the source cannot be read.
  Converted get(const std::shared_ptr<const StreamSource>& source, const std::string& how,
                const std::filesystem::path& folder, const std::function<Converted()>& convert);

 private:
  /// Of the scene stream, and of what the reader said.
  struct Keys {
    ContentKey output, words;
  };
  Keys keys_of(const std::shared_ptr<const StreamSource>& source, const std::string& how) const;
  std::optional<Converted> find(const Keys& keys, const std::string& place,
                                const std::filesystem::path& folder) const;
  void keep(const Keys& keys, const Converted& converted);

  BuildCache& cache_;
  ContentKey readers_;
};

}  // namespace triptych
