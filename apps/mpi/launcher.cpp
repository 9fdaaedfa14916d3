#include "apps/mpi/launcher.hpp"

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "apps/mpi/world.hpp"

namespace navjit::apps::mpi {
namespace {

std::optional<unsigned> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return std::nullopt;
  unsigned value = 0;
  const char* end = text + std::strlen(text);
  const auto [at, error] = std::from_chars(text, end, value);
  if (error != std::errc{} || at != end) return std::nullopt;
  return value;
}

}  // namespace

std::optional<Launched> launched() {
  constexpr const char* variables[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                          {"PMI_RANK", "PMI_SIZE"},
                                          {"PMIX_RANK", "SLURM_STEP_NUM_TASKS"}};
  for (const auto& [rank, of] : variables) {
    const auto number = number_in(rank);
    if (number) return Launched{*number, number_in(of).value_or(0)};
  }
  return std::nullopt;
}

bool is_silent(int words, const char* const* word) {
  const auto here = launched();
  if (!here || here->rank == 0 || here->of == 1) return false;
  if (here->of == 0 && library().empty()) return false;  // taken for alone
  bool runs = false;
  for (int i = 1; i < words; ++i) {
    const std::string_view text = word[i];
    if (text == "run") runs = true;
    if (text == "--part" || text.starts_with("--part=")) return false;
  }
  return runs;
}

}  // namespace navjit::apps::mpi
