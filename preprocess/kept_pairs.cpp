#include "preprocess/kept_pairs.hpp"

#include "base/error.hpp"

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

const std::vector<std::byte>* KeptPairs::find(const ContentKey& key) {
  // Most come in the same order as then.
  if (next_ < before_.keys.size() && before_.keys[next_] == key) return &before_.values[next_++];
  if (numbers_.empty()) {
    for (size_t i = 0; i < before_.keys.size(); ++i) numbers_.insert({before_.keys[i], i});
  }
  const auto found = numbers_.find(key);
  if (found == numbers_.end()) return nullptr;
  next_ = found->second + 1;
  return &before_.values[found->second];
}

void KeptPairs::note(const ContentKey& key, std::vector<std::byte> bytes) {
  now_.keys.push_back(key);
  now_.values.push_back(std::move(bytes));
}

}  // namespace triptych
