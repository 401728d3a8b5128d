#include "preprocess/kept_pairs.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <utility>

namespace triptych {

KeptPairs::KeptPairs(const std::vector<std::byte>& before) : is_used_(true) {
  if (before.empty()) return;
  before_ = record_of<PairTable>(before, "a build's cache");
  if (before_.keys.size() != before_.values.size())
    fail("a build's cache", "has pairs without what was found of them");
}

ContentKey KeptPairs::key_of(const ContentKey& a, const ContentKey& b) {
  ContentKeyWriter key;
  key.write(a);
  key.write(b);
  return key.key();
}

const std::vector<std::byte>* KeptPairs::find(const ContentKey& pair) {
  // Most come in the same order as then.
  auto found = std::find(before_.keys.begin() + static_cast<std::ptrdiff_t>(next_), before_.keys.end(), pair);
  if (found == before_.keys.end()) found = std::find(before_.keys.begin(), before_.keys.end(), pair);
  if (found == before_.keys.end()) return nullptr;
  const auto index = static_cast<size_t>(found - before_.keys.begin());
  next_ = index + 1;
  return &before_.values[index];
}

void KeptPairs::note(const ContentKey& pair, std::vector<std::byte> bytes) {
  now_.keys.push_back(pair);
  now_.values.push_back(std::move(bytes));
}

}  // namespace triptych
