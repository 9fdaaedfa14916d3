#include "apps/mpi/world.hpp"

#include <mpi.h>

#include <list>

#include "navjit/errors.hpp"

namespace navjit::apps::mpi {
namespace {

std::optional<std::string> look(int from, int kind) {
  int there = 0, bytes = 0;
  MPI_Status status;
  MPI_Iprobe(from, kind, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return std::nullopt;
  MPI_Get_count(&status, MPI_CHAR, &bytes);
  std::string text(static_cast<std::size_t>(bytes), '\0');
  MPI_Recv(text.data(), bytes, MPI_CHAR, status.MPI_SOURCE, kind, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return text;
}

}  // namespace

struct World::Outbox {
  struct Sent {
    std::string text;
    MPI_Request request;
  };
  std::list<Sent> under_way;
};

std::string library() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string all(text, static_cast<std::size_t>(length));
  return all.substr(0, all.find_first_of(",\n"));
}

World::World() : outbox_(std::make_unique<Outbox>()) {
  int threads = 0, rank = 0, count = 1;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &threads);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  rank_ = static_cast<unsigned>(rank);
  count_ = static_cast<unsigned>(count);
  if (threads >= MPI_THREAD_SERIALIZED) return;
  MPI_Finalize();
  throw Error(library() + " does not let threads call it in turn; say --part K/N instead");
}

World::~World() { MPI_Finalize(); }

void World::send(unsigned to, int kind, const std::string& text) {
  Outbox::Sent& sent = outbox_->under_way.emplace_back(Outbox::Sent{text, MPI_REQUEST_NULL});
  MPI_Isend(sent.text.data(), static_cast<int>(sent.text.size()), MPI_CHAR, static_cast<int>(to),
            kind, MPI_COMM_WORLD, &sent.request);
}

bool World::sent_all() {
  std::list<Outbox::Sent>& all = outbox_->under_way;
  for (auto at = all.begin(); at != all.end();) {
    int gone = 0;
    MPI_Test(&at->request, &gone, MPI_STATUS_IGNORE);
    at = gone != 0 ? all.erase(at) : std::next(at);
  }
  return all.empty();
}

std::optional<std::string> World::receive(unsigned from, int kind) {
  return look(static_cast<int>(from), kind);
}

std::optional<std::string> World::receive_from_any(int kind) { return look(MPI_ANY_SOURCE, kind); }

void World::abandon() { MPI_Abort(MPI_COMM_WORLD, 1); }

}  // namespace navjit::apps::mpi
