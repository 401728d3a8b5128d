// Which parts of a buffer are free.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace triptych {

/// Bytes from 0 to size(); the first gap that is large enough is taken.
class DeviceSpace {
 public:
  uint64_t size() const { return size_; }
  /// To at least what it is.
  void grow(uint64_t size);
  /// Takes so many bytes (above 0) from a multiple of `alignment` on; nullopt where no gap is large enough.
  std::optional<uint64_t> take(uint64_t bytes, uint64_t alignment);
  /// Gives back what take() gave.
  void give_back(uint64_t offset, uint64_t bytes);

 private:
  uint64_t size_ = 0;
  std::map<uint64_t, uint64_t> gaps_;  ///< by where they begin: where they end
};

}  // namespace triptych
