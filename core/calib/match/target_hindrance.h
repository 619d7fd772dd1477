// Says why a target was not found, from what the picture shows.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/result.h"
#include "core/calib/match/coded_target.h"
#include "core/calib/match/uncoded_target.h"

namespace gyre {

// The sentence for a coded target of which fewer than needed points were found. In the order of
// how sure the evidence is: codes of another target; codes of this one that leave the picture, or
// are too small, or are blurred or blown out around; then what the picture as a whole lacks; then
// that nothing like it is there.
Error whyCodedNotFound(const TargetPicture& picture, const Target& target,
                       const CodedSearch& search, int needed);

// The same for a target of checkerboards alone.
Error whyUncodedNotFound(const TargetPicture& picture, std::span<const TargetFace> faces,
                         const UncodedSearch& search, int needed);

}  // namespace gyre
