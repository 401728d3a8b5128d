// Where a window begins that is to show a viewpoint of a BCF file.
#pragma once

#include <cstddef>
#include <filesystem>

namespace triptych {

struct FirstViewpoint {
  std::filesystem::path bcf;  ///< empty: it begins elsewhere
  size_t number = 1;          ///< which of the file's viewpoints, from 1 on
};

}  // namespace triptych
