#include "launch/model_cache.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/file_access.hpp"
#include "base/hashing.hpp"
#include "base/notice.hpp"
#include "base/parse_json.hpp"
#include "launch/entry_lock.hpp"
#include "launch/model_content.hpp"
#include "launch/run_program.hpp"
#include "scene/pack.hpp"

#include <algorithm>
#include <chrono>
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

/// Whether the folder is an entry of the cache: NAME-0123456789abcdef, with a lock.
bool is_entry(const std::filesystem::path& folder) {
  constexpr size_t digits = 16;
  const std::string name = folder.filename().string();
  std::error_code error;
  return name.size() > digits && name[name.size() - digits - 1] == '-' &&
         name.find_first_not_of("0123456789abcdef", name.size() - digits) == std::string::npos &&
         std::filesystem::is_regular_file(folder / EntryLock::name, error);
}

/// Removes entries that nobody has wanted for a long time, such as those of earlier versions of the program.
void remove_unused(const std::filesystem::path& cache) {
  constexpr std::chrono::hours patience(60 * 24);
  const auto long_ago = std::filesystem::file_time_type::clock::now() - patience;
  std::error_code error;
  std::vector<std::filesystem::path> unused;
  for (std::filesystem::directory_iterator entry(cache, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_entry(entry->path()) &&
        std::filesystem::last_write_time(entry->path() / EntryLock::name, error) < long_ago)
      unused.push_back(entry->path());
  }
  for (const auto& folder : unused) {
    const EntryLock lock(folder);
    if (lock.try_now()) std::filesystem::remove_all(folder, error);
  }
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

}  // namespace

std::filesystem::path cache_folder() {
  if (const auto named = variable("TRIPTYCH_CACHE"); !named.empty()) return std::filesystem::absolute(named);
  if (const auto caches = variable("XDG_CACHE_HOME"); caches.is_absolute()) return caches / "triptych";
  if (const auto home = variable("HOME"); home.is_absolute()) return home / ".cache" / "triptych";
  fail("cache",
       "there is no folder for packs of models: set TRIPTYCH_CACHE to one, or build the pack with `build`");
}

std::filesystem::path cached_pack(const BuildFlags& flags) {
  const ModelContent content(flags);
  const std::string key = content.key(), name = flags.inputs.front().stem().string();
  const std::filesystem::path folder =
      cache_folder() / fmt::format("{}-{:016x}", name, hash_values(std::span<const char>(key)));
  std::optional<EntryLock> lock;
  do {
    std::error_code ignored;
    std::filesystem::create_directories(folder, ignored);  // the lock says what is wrong
    lock.emplace(folder);
    lock->wait();
  } while (!lock->is_there());
  lock->note_use();
  const Entry entry(folder, content, name);
  if (!entry.holds()) {
    remove_unused(cache_folder());
    notice("{}{}: building a pack, which is kept as {}", flags.inputs.front().string(),
           flags.inputs.size() > 1 ? fmt::format(" and {} more", flags.inputs.size() - 1) : "",
           entry.pack().string());
    entry.build(flags, *lock);
  }
  return entry.pack();
}

}  // namespace triptych
