// The lock of an entry of the model cache, and who holds it.
#pragma once

#include "base/descriptor.hpp"

#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

namespace triptych {

/// Held while one process looks at an entry of the cache, builds it or removes it. Its file's time says when
/// the entry was wanted last; in it are the processes that build it.
class EntryLock {
 public:
  static constexpr const char* name = "lock";

  /// entry: its folder. Error where the lock cannot be opened.
  explicit EntryLock(const std::filesystem::path& entry);

  /// Whether no other process holds it. Error where there are no locks.
  bool try_now() const;
  /// Whether it still has its name: an entry that was unused for long is removed.
  bool is_there() const;
  /// Waits until no other process holds it, however long that takes, and says for whom it waits: also that
  /// they are stopped, and how to go on.
  void wait() const;
  void note_use() const;

  /// While this lives, programs that are started hold the lock, too: as long as the build lives, whatever
  /// becomes of the process that began it.
  class Shared {
   public:
    explicit Shared(const EntryLock& lock);
    ~Shared();
    Shared(const Shared&) = delete;
    Shared& operator=(const Shared&) = delete;
    /// This process and that one build the entry.
    void note_builder(pid_t builder) const;

   private:
    const EntryLock& lock_;
  };

 private:
  std::string holders() const;

  std::string file_name_;
  Descriptor file_;
};

}  // namespace triptych
