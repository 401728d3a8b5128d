#include "launch/model_cache.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/file_access.hpp"
#include "base/hashing.hpp"
#include "base/notice.hpp"
#include "base/parse_json.hpp"
#include "launch/cache_room.hpp"
#include "launch/entry_lock.hpp"
#include "launch/model_content.hpp"
#include "launch/run_program.hpp"
#include "scene/pack.hpp"

#include <cstdlib>
#include <map>
#include <optional>

namespace triptych {

namespace {

using nlohmann::json;

/// A variable of the environment that is set and not empty.
std::filesystem::path variable(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

/// One pack of the cache, in a folder of its own: the pack, what the build said, and, written last, its key
/// and the files that were read beside those of the key, relative to the first model.
class Entry {
 public:
  Entry(const std::filesystem::path& folder, const ModelContent& content, const std::string& name)
      : folder_(folder), content_(content), pack_(folder / (name + ".tpk")) {}

  const std::filesystem::path& pack() const { return pack_; }

  bool holds() const {
    std::error_code error;
    if (!std::filesystem::is_regular_file(pack_, error) || !std::filesystem::exists(said(), error))
      return false;
    try {
      const json said_then = parse_json(read_text_file(said()), said().string());
      if (said_then.at("key") != content_.key() ||
          !content_.still_holds(said_then.at("read").get<ModelContent::Files>()))
        return false;
      Pack{pack_};  // reads all but the geometry
      return true;
    } catch (const json::exception&) {
      return false;  // it is built again
    } catch (const Error&) {
      return false;  // as is a pack that was damaged
    }
  }

  void build(const BuildFlags& flags, const EntryLock& lock) const {
    std::error_code error;
    std::filesystem::remove(said(), error);
    // A signal ends this process as it would without the build; the child gets its own when this one is gone.
    const json report = [&] {
      const EntryLock::Shared shared(lock);
      return run_build(
          flags, pack_, [] { return false; }, [&](pid_t builder) { shared.note_builder(builder); });
    }();
    const ModelContent::Files read = content_.opened(report.at("files").get<std::vector<std::string>>());
    if (content_.key_now() != content_.key()) {
      std::filesystem::remove(pack_, error);
      fail(flags.inputs.front().string(), "or a file that it names changed while a pack of it was built");
    }
    write_file(
        said(),
        json({{"key", content_.key()}, {"read", read}}).dump(2, ' ', false, json::error_handler_t::replace) +
            "\n");
  }

 private:
  std::filesystem::path said() const { return folder_ / "key.json"; }

  std::filesystem::path folder_;
  const ModelContent& content_;
  std::filesystem::path pack_;
};

/// Makes the entry where it is not there. Another process may remove it until this one has its lock.
EntryLock locked_entry(const std::filesystem::path& folder) {
  for (;;) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) fail(folder.string(), "cannot be made: {}", error.message());
    try {
      EntryLock lock(folder);
      lock.wait();
      if (lock.is_there()) return lock;
    } catch (const Error&) {
      if (std::filesystem::exists(folder, error)) throw;
    }
  }
}

}  // namespace

std::filesystem::path cache_folder() {
  if (const auto named = variable("TRIPTYCH_CACHE"); !named.empty()) return std::filesystem::absolute(named);
  if (const auto caches = variable("XDG_CACHE_HOME"); caches.is_absolute()) return caches / "triptych";
  if (const auto home = variable("HOME"); home.is_absolute()) return home / ".cache" / "triptych";
  fail("cache",
       "there is no folder for packs of models: set TRIPTYCH_CACHE to one, or build the pack with `build`");
}

std::filesystem::path cached_pack(const BuildFlags& flags, std::optional<uint64_t> limit) {
  const ModelContent content(flags);
  const std::string key = content.key(), name = flags.inputs.front().stem().string();
  const std::filesystem::path folder =
      cache_folder() / fmt::format("{}-{:016x}", name, hash_values(std::span<const char>(key)));
  const EntryLock lock = locked_entry(folder);
  lock.note_use();
  const Entry entry(folder, content, name);
  if (!entry.holds()) {
    make_room(cache_folder(), limit, folder);
    notice("{}{}: building a pack, which is kept as {}", flags.inputs.front().string(),
           flags.inputs.size() > 1 ? fmt::format(" and {} more", flags.inputs.size() - 1) : "",
           entry.pack().string());
    entry.build(flags, lock);
    make_room(cache_folder(), limit, folder);
  }
  keep_in_use(entry.pack());
  return entry.pack();
}

}  // namespace triptych
