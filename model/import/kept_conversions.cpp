#include "model/import/kept_conversions.hpp"

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/unnamed_file.hpp"
#include "model/import/mesh_stream_source.hpp"

#include <algorithm>
#include <string_view>

namespace triptych {

namespace {

using Take = BuildCache::Take;

void read_all(const std::shared_ptr<const StreamSource>& source, const Take& take) {
  const SourceReader reader(source);
  std::vector<std::byte> block(size_t{1} << 20);
  for (uint64_t offset = 0; offset < source->size(); offset += block.size()) {
    block.resize(static_cast<size_t>(std::min<uint64_t>(block.size(), source->size() - offset)));
    reader.read(offset, block);
    take(block);
  }
}

bool has_changed(const std::shared_ptr<const StreamSource>& source) {
  try {
    const SourceReader reader(source);
    return false;
  } catch (const Error&) {
    return true;
  }
}

}  // namespace

KeptConversions::Keys KeptConversions::keys_of(const std::shared_ptr<const StreamSource>& source,
                                               const std::string& how) const {
  const auto key_of = [](std::string_view what, const ContentKey& content) {
    ContentKeyWriter writer;
    writer.write_all(std::span<const char>(what));
    writer.write(content);
    return writer.key();
  };
  ContentKeyWriter writer;
  writer.write(readers_);
  writer.write(uint64_t{how.size()});
  writer.write_all(std::span<const char>(how));
  read_all(source, [&](std::span<const std::byte> bytes) { writer.write_all(bytes); });
  return {key_of("scene stream of a file\n", writer.key()), key_of("words about a file\n", writer.key())};
}

Converted KeptConversions::get(const std::shared_ptr<const StreamSource>& source, const std::string& how,
                               const std::filesystem::path& folder,
                               const std::function<Converted()>& convert) {
  const Keys keys = keys_of(source, how);
  std::optional<Converted> found = find(keys, source->name(), folder);
  cache_.add_to_count("converted files", found.has_value());
  Converted converted = found ? std::move(*found) : convert();
  if (converted.also_read.empty() && !has_changed(source)) keep(keys, converted);
  return converted;
}

std::optional<Converted> KeptConversions::find(const Keys& keys, const std::string& place,
                                               const std::filesystem::path& folder) const {
  const auto words = cache_.find(keys.words);
  if (!words) return std::nullopt;
  Descriptor output = open_unnamed_file(folder);
  const auto write = [&](std::span<const std::byte> bytes) { write_all(output.number(), bytes, place); };
  if (!cache_.read(keys.output, write)) return std::nullopt;
  Converted converted{std::make_shared<StreamSource>(place, std::move(output)), {}, {}};
  ByteReader reader(*words, place);
  for (auto count = reader.read<uint32_t>(); count > 0; --count)
    converted.warnings.push_back(reader.read_text());
  return converted;
}

void KeptConversions::keep(const Keys& keys, const Converted& converted) {
  cache_.keep_stretches(keys.output, converted.output->size(),
                        [&](const Take& take) { read_all(converted.output, take); });
  ByteWriter words;
  words.write(static_cast<uint32_t>(converted.warnings.size()));
  for (const std::string& warning : converted.warnings) words.write_text(warning);
  cache_.keep(keys.words, words.bytes());
}

}  // namespace triptych
