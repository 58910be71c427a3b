#pragma once

#include <stdexcept>

namespace maille {

/// Input that cannot be used: the message names the file, line and column or the entities, and what to do.
/// The command line prints it on one line and exits with status 2.
class InputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace maille
