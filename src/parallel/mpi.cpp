// SPDX-License-Identifier: BSD-3-Clause
#include "src/parallel/mpi.hpp"

namespace whipple::parallel {
namespace {

/// MPI is a property of the process, so its lifetime is bound to the process and not to an object of ours.
class Session {
 public:
  Session() {
    int initialised = 0;
    MPI_Initialized(&initialised);
    if (initialised != 0) return;
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    owner_ = true;
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() {
    int finalised = 0;
    MPI_Finalized(&finalised);
    if (owner_ && finalised == 0) MPI_Finalize();
  }

 private:
  bool owner_ = false;
};

}  // namespace

MPI_Comm world() {
  static const Session session;
  return MPI_COMM_WORLD;
}

int rank(MPI_Comm comm) {
  int value = 0;
  MPI_Comm_rank(comm, &value);
  return value;
}

int size(MPI_Comm comm) {
  int value = 1;
  MPI_Comm_size(comm, &value);
  return value;
}

}  // namespace whipple::parallel
