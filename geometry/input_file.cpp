#include "geometry/input_file.hpp"

#include <fstream>
#include <system_error>

namespace navjit {

namespace fs = std::filesystem;

const char* why_not_fetched(std::string_view contents) {
  if (!contents.starts_with("version https://git-lfs.")) return nullptr;
  return "it is a Git LFS pointer, not the file itself; 'git lfs pull' fetches that";
}

Expected<std::string> read_regular_file(const fs::path& path, std::size_t most,
                                        const std::string& too_long) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    const bool missing = !error || error == std::errc::no_such_file_or_directory;
    return Failure{missing ? "no such file" : error.message()};
  }
  if (fs::is_directory(status)) return Failure{"it is a directory, not a file"};
  if (!fs::is_regular_file(status)) return Failure{"it is not a regular file"};
  const std::uintmax_t size = fs::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) return Failure{"it cannot be opened; check its permissions"};
  if (size > most) return Failure{too_long};
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (const char* why = why_not_fetched(text)) return Failure{why};
  return text;
}

}  // namespace navjit
