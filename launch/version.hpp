// What this program is, for --version and for reports.
#pragma once

#include <string>

namespace triptych {

/// "0.1.0".
std::string program_version();
/// "0.1.0, commit 1a2b3c4, with changes"; "0.1.0" where it was built without its repository.
std::string version_and_commit();
/// Lines for people: version and commit, how it was built, what it draws with here, and the OpenGL that there
/// is.
std::string version_text();

}  // namespace triptych
