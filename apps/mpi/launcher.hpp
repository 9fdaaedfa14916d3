// What a launcher of MPI (mpirun, srun) says to a process in its environment.
#pragma once

#include <optional>
#include <string>

namespace navjit::apps::mpi {

/// One of `of` processes, with numbers from 0 on; `of` is 0 where the launcher does not say it.
struct Launched {
  unsigned rank = 0, of = 0;
};

/// From what Open MPI, PMI (MPICH and what descends from it, Slurm) or PMIx say. Nothing where this
/// process was started by none of them: MPI then stays untouched, and costs nothing.
std::optional<Launched> launched();

/// Whether this is a process of several that make one `navjit run`, and not the first of them,
/// which speaks for all. With --part each is a run of its own. `words`: of the command line.
bool is_silent(int words, const char* const* word);

}  // namespace navjit::apps::mpi
