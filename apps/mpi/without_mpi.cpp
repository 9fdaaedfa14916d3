// World where navjit is built without MPI: nobody makes one.
#include "apps/mpi/world.hpp"
#include "navjit/errors.hpp"

namespace navjit::apps::mpi {

struct World::Outbox {};

std::string library() { return {}; }

World::World() { throw Error("navjit is built without MPI"); }
World::~World() = default;

void World::send(unsigned, int, const std::string&) {}
bool World::sent_all() { return true; }
std::optional<std::string> World::receive(unsigned, int) { return std::nullopt; }
std::optional<std::string> World::receive_from_any(int) { return std::nullopt; }
void World::abandon() {}

}  // namespace navjit::apps::mpi
