#include "view/keepsakes.hpp"

#include "base/file.hpp"
#include "base/notice.hpp"

#include <fmt/core.h>

namespace triptych {

std::string keep(const std::filesystem::path& folder, const std::string& kind, const std::string& extension,
                 const std::function<void(const std::filesystem::path&)>& write) {
  try {
    make_folder(folder);
    std::filesystem::path file;
    int number = 0;
    do {
      file = folder / fmt::format("{}-{:03}.{}", kind, number++, extension);
    } while (std::filesystem::exists(file));
    write(file);
    notice("wrote {}", file.string());
    return fmt::format("saved {}", file.filename().string());
  } catch (const std::exception& error) {
    notice("the {} is not saved: {}", kind, error.what());
    return fmt::format("{} NOT saved", kind);
  }
}

}  // namespace triptych
