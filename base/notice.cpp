#include "base/notice.hpp"

#include <mutex>
#include <set>

namespace triptych {

void notice_once(const std::string& line) {
  constexpr size_t most = 100;
  static std::mutex mutex;
  static std::set<std::string> said;
  const std::lock_guard lock(mutex);
  if (said.size() < most && said.insert(line).second) notice("{}", line);
}

}  // namespace triptych
