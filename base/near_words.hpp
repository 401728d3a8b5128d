// Which word was meant, where one is not known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// The known word that is nearest by letters that are left out, put in, exchanged or changed; empty where
/// none is near enough to have been meant.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean WORD?", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace triptych
