#include <algorithm>

#include "cache/detail/cache_format.hpp"

namespace navjit::cache::detail {
namespace {

constexpr std::string_view magic = "NAVJITC1";
constexpr std::size_t checksum_at = 56;

void put_number(std::string& text, std::uint64_t value) {
  for (int i = 0; i < 8; ++i) text += static_cast<char>(value >> (8 * i) & 0xff);
}

std::uint64_t get_number(std::string_view text, std::size_t at) {
  std::uint64_t value = 0;
  for (int i = 7; i >= 0; --i) {
    value = value << 8 | static_cast<unsigned char>(text[at + static_cast<std::size_t>(i)]);
  }
  return value;
}

void put_digest(std::string& text, const Digest& digest) {
  text.append(reinterpret_cast<const char*>(digest.data()), digest.size());
}

Digest get_digest(std::string_view text, std::size_t at) {
  Digest digest;
  std::copy_n(text.begin() + static_cast<std::ptrdiff_t>(at), digest.size(), digest.begin());
  return digest;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out(text.substr(0, max_label_bytes));
  for (char& c : out) {
    if (c < ' ' || c > '~') c = '?';
  }
  return out;
}

std::string make_header(const Digest& key, std::string_view label, std::string_view content) {
  std::string header(magic);
  put_number(header, content.size());
  put_number(header, label.size());
  put_digest(header, key);
  const Digest checksum = sha256({header, label, content});
  put_digest(header, checksum);
  header += label;
  return header;
}

ParsedHeader parse_header(std::string_view start, std::uint64_t file_bytes) {
  ParsedHeader header;
  if (start.size() < header_bytes || file_bytes < header_bytes) {
    header.problem = "truncated";
    return header;
  }
  if (start.substr(0, magic.size()) != magic) {
    header.problem = "no entry of this version of the cache";
    return header;
  }
  header.content_bytes = get_number(start, 8);
  header.label_bytes = get_number(start, 16);
  header.key = get_digest(start, 24);
  header.checksum = get_digest(start, checksum_at);
  const std::uint64_t rest = file_bytes - header_bytes;
  if (header.label_bytes > max_label_bytes || header.label_bytes > rest ||
      header.content_bytes != rest - header.label_bytes) {
    header.problem = "truncated, or its length is damaged";
  }
  return header;
}

std::string check_entry(std::string_view file, const ParsedHeader& header) {
  if (!header.problem.empty()) return header.problem;
  const Digest checksum = sha256({file.substr(0, checksum_at), file.substr(header_bytes)});
  return checksum == header.checksum ? "" : "its checksum does not match its content";
}

}  // namespace navjit::cache::detail
