// Random changes of GDML that keep to its grammar more often than changed bytes would.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace navjit::fuzz {

using Engine = std::minstd_rand;

inline std::size_t pick(Engine& random, std::size_t count) { return random() % count; }

/// Values at the edge of what is allowed or sensible.
inline const std::string& odd_value(Engine& random) {
  static const std::vector<std::string> values = {"0",
                                                  "-1",
                                                  "1",
                                                  "2",
                                                  "1e-300",
                                                  "1e300",
                                                  "-1e30",
                                                  "1e-9",
                                                  "nan",
                                                  "inf",
                                                  "1/0",
                                                  "360",
                                                  "pi",
                                                  "7",
                                                  "1e9",
                                                  "2147483647",
                                                  "0.5",
                                                  "1e-12",
                                                  "",
                                                  "x",
                                                  "i",
                                                  "m[1,2]",
                                                  "m[9]",
                                                  "2^0.5",
                                                  "-0.0",
                                                  "3.1415926535897931",
                                                  "1.5707963267948966",
                                                  "10000000000000",
                                                  "((((1))))",
                                                  "deg",
                                                  "mm",
                                                  "cm",
                                                  "W"};
  return values[pick(random, values.size())];
}

/// Where each match of `open`...`close` begins and ends; no more than a few hundred matches.
struct Range {
  std::size_t begin, end;
};
inline std::vector<Range> ranges(const std::string& text, char open, char close) {
  std::vector<Range> found;
  for (std::size_t at = 0; found.size() < 400;) {
    const auto begin = text.find(open, at);
    if (begin == std::string::npos) break;
    const auto end = text.find(close, begin + 1);
    if (end == std::string::npos) break;
    found.push_back({begin, end + 1});
    at = end + 1;
  }
  return found;
}

/// An element with everything in it, which begins with the tag at `tag`.
inline std::string whole_element(const std::string& text, const Range& tag) {
  if (text[tag.end - 2] == '/') return text.substr(tag.begin, tag.end - tag.begin);
  const auto space = text.find_first_of(" >", tag.begin);
  const std::string close = "</" + text.substr(tag.begin + 1, space - tag.begin - 1) + ">";
  const auto end = text.find(close, tag.end);
  return end == std::string::npos ? "" : text.substr(tag.begin, end + close.size() - tag.begin);
}

/// Makes one change; the text may stay the same.
inline void mutate_once(std::string& text, Engine& random) {
  const auto values = ranges(text, '\'', '\'');
  const auto tags = ranges(text, '<', '>');
  if (values.empty() || tags.empty()) return;
  const Range value = values[pick(random, values.size())];
  const Range tag = tags[pick(random, tags.size())];
  const std::size_t inner = value.end - value.begin - 2;
  switch (pick(random, 8)) {
    case 0:
    case 1:
    case 2:
      text.replace(value.begin + 1, inner, odd_value(random));
      break;
    case 3: {
      const Range other = values[pick(random, values.size())];
      text.replace(value.begin + 1, inner,
                   text.substr(other.begin + 1, other.end - other.begin - 2));
      break;
    }
    case 4:
      text.insert(value.begin + 1, pick(random, 2) ? "-" : "1e9*");
      break;
    case 5:
      text.insert(tags[pick(random, tags.size())].begin, whole_element(text, tag));
      break;
    case 6:
      text.erase(tag.begin, whole_element(text, tag).size());
      break;
    default:
      // A number a little changed.
      if (inner > 0)
        text[value.begin + 1 + pick(random, inner)] = "0123456789.-e"[pick(random, 13)];
      break;
  }
}

}  // namespace navjit::fuzz
