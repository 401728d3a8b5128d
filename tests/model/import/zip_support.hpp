// Archives for the tests of what reads them.
#pragma once

#include "import_support.hpp"

#include <utility>
#include <zip.h>

namespace triptych::test {

/// Writes a zip archive of these members, deflated, into the running test's folder.
inline std::filesystem::path write_zip(const std::string& name,
                                       const std::vector<std::pair<std::string, std::string>>& members) {
  const auto file = write_model(name, "");
  std::filesystem::remove(file);
  zipFile zip = zipOpen64(file.c_str(), APPEND_STATUS_CREATE);
  EXPECT_TRUE(zip);
  for (const auto& [member, content] : members) {
    EXPECT_EQ(
        zipOpenNewFileInZip(zip, member.c_str(), nullptr, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED, 6), 0);
    EXPECT_EQ(zipWriteInFileInZip(zip, content.data(), static_cast<unsigned>(content.size())), 0);
    zipCloseFileInZip(zip);
  }
  zipClose(zip, nullptr);
  return file;
}

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace triptych::test
