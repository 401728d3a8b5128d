#include "base/near_words.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// How many letters must be left out, put in, changed, or exchanged with the next one (Damerau's distance, of
/// which no stretch is edited twice).
size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<size_t> before, last(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  const size_t most = std::max<size_t>(1, word.size() / 3);
  size_t least = most + 1;
  std::string nearest;
  for (const std::string& candidate : known) {
    const size_t edits = edits_between(word, candidate);
    // A beginning was meant for the whole: --pixel for --pixel-error.
    const bool begins = word.size() > 3 && candidate.starts_with(word);
    const size_t distance = begins ? std::min(edits, most) : edits;
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string nearest = nearest_word(word, known);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace triptych
