#include "common/part.hpp"

#include "common/numbers.hpp"
#include "navjit/errors.hpp"

namespace navjit::common {

Part parse_part(std::string_view text) {
  constexpr std::uint64_t most = 1'000'000'000;
  const std::size_t slash = text.find('/');
  try {
    if (slash == std::string_view::npos) throw UsageError("there is no slash");
    Part part;
    part.of = parse_count(text.substr(slash + 1), 1, most);
    part.number = parse_count(text.substr(0, slash), 1, part.of);
    return part;
  } catch (const UsageError& error) {
    throw UsageError("'" + std::string(text.substr(0, 60)) +
                     "' is no part, such as 3/100: " + error.what());
  }
}

std::string part_text(const Part& part) {
  return std::to_string(part.number) + '/' + std::to_string(part.of);
}

}  // namespace navjit::common
