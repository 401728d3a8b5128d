// What programs around ours do when they start: they take on the language of their user.
#include <clocale>
#include <locale>

namespace {

[[gnu::constructor]] void speak_the_users_language() {
  std::setlocale(LC_ALL, "");
  std::locale::global(std::locale(""));
}

}  // namespace
