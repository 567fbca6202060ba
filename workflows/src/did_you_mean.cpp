// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/did_you_mean.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace gigaray {
namespace {

/// Letters to add, leave out, change or swap with their neighbour.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = a[i - 1] != b[j - 1];
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

/// Capitals, and - for _, are no differences.
std::string plain(const std::string& word) {
  std::string result;
  for (const char letter : word)
    result += letter == '_' ? '-' : char(std::tolower(static_cast<unsigned char>(letter)));
  return result;
}

/// Letters without the dashes that all options begin with.
std::size_t letters(const std::string& word) {
  const auto begin = word.find_first_not_of('-');
  return begin == std::string::npos ? 0 : word.size() - begin;
}

}  // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t kLongest = 64;  // longer words are no typos
  if (word.size() > kLongest) return {};
  const std::string wanted = plain(word);
  std::string best;
  std::size_t least = 0;
  for (const std::string& candidate : known) {
    const std::size_t away = distance(wanted, plain(candidate));
    if (!best.empty() && away >= least) continue;
    best = candidate;
    least = away;
  }
  // A third of the letters may be wrong, of three letters one.
  if (!best.empty() && 3 * least <= std::max<std::size_t>(letters(word), 3) &&
      least < letters(best))
    return best;
  constexpr std::size_t kBeginning = 3;
  std::vector<std::string> longer;
  for (const std::string& candidate : known)
    if (letters(word) >= kBeginning && plain(candidate).starts_with(wanted))
      longer.push_back(candidate);
  return longer.size() == 1 ? longer.front() : std::string();
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const std::string nearest = nearest_word(word, known);
  return nearest.empty() ? std::string() : fmt::format("; did you mean {}?", nearest);
}

}  // namespace gigaray
