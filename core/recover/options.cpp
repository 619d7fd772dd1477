// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/recover/options.h"

#include "core/recover/solver.h"

namespace gyre {

Result<void> RecoverOptions::validate() const {
  if (!solverFromName(solver)) {
    return Error{Error::Code::kInvalidInput, "There is no solver \"" + solver + "\".",
                 std::string("Choose ") + kSolverNames + "."};
  }
  return validateRanges(*this);
}

}  // namespace gyre
