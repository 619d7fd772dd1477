// What a quick look around the object found: facts for the user, before minutes are spent.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scan/frame.h"

namespace gyre {

// kRedo advises; it forbids nothing.
enum class QuickVerdict : std::uint8_t { kGood, kAcceptable, kRedo };

enum class QuickAspect : std::uint8_t { kInPicture, kSharp, kExposed, kTextured };
inline constexpr std::size_t kQuickAspects = 4;

// One aspect over all pictures, in words.
struct QuickFinding {
  QuickAspect aspect = QuickAspect::kInPicture;
  QuickVerdict verdict = QuickVerdict::kGood;
  std::string sentence;  // what was seen
  std::string advice;    // what to do; empty when nothing needs to be done
};

// One picture of the look.
struct QuickView {
  FramePtr picture;
  QuickVerdict verdict = QuickVerdict::kGood;
  std::string fault;  // why it is not good, a few words; empty when it is

  // All of the object alone.
  double object_share = 0.0;            // of the picture
  std::optional<double> edge_width_px;  // standard deviation of its edges; none to judge by
  double white_share = 0.0;             // without detail because it is too bright
  double black_share = 0.0;             // and too dark
  double brightness = 0.0;              // of its brighter parts, of 255
  double textured_share = 0.0;          // of the places where features are looked for
  std::string leaves_at;  // "left", "right, top": where the object meets the picture's edge
};

struct QuickLook {
  QuickVerdict verdict = QuickVerdict::kGood;  // the worst of the findings
  std::array<QuickFinding, kQuickAspects> findings;
  std::vector<QuickView> views;
};

using QuickLookPtr = std::shared_ptr<const QuickLook>;

}  // namespace gyre
