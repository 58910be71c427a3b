#pragma once

#include <filesystem>
#include <stdexcept>

#include "modeler/tetgen_protocol.hh"

namespace maille::modeler::tetgen {

/// One run of TetGen came to nothing: the message says how it ended.
class Failure : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// One run of TetGen came to no end within its time.
class TimeOut : public Failure {
  public:
    using Failure::Failure;
};

/// The worker program: `MAILLE_TETGEN` of the environment if set; else the first of: beside the running
/// program, in
/// ../libexec/maille from there, where this library was built, where it was installed.
/// Throws InputError, naming the places, where there is none.
std::filesystem::path find_worker();

/// Runs TetGen in a process of its own and waits for it, at most four times the request's processor time: a
/// process that has not ended by then is killed. Thread-safe: several may run at once. No file is left
/// behind, whatever happens. Throws Failure where TetGen crashes, hangs or answers nonsense; InputError where
/// the worker cannot be started.
Answer run(const Request& request);

}  // namespace maille::modeler::tetgen
