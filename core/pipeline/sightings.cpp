// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/sightings.h"

#include <algorithm>
#include <utility>

namespace gyre {

void Sightings::found(const FramePtr& frame, TargetView view) {
  if (watcher_.on_picture) {
    watcher_.on_picture({number_, pictures_, view.name, frame, view, ""});
  }
  ++number_;
  views.push_back(std::move(view));
}

void Sightings::missed(const FramePtr& frame, const std::string& name, const Error& reason) {
  if (watcher_.on_picture) {
    watcher_.on_picture({number_, pictures_, name, frame, std::nullopt, reason.what});
  }
  ++number_;
  skipped.push_back(name + ": " + reason.what);
  ++reasons_[reason.sentence()];
}

Result<void> Sightings::checkEnough(std::size_t needed) const {
  if (views.size() >= needed) return {};
  std::string what = "The target was found in only " + std::to_string(views.size()) + " of " +
                     std::to_string(pictures_) + " pictures, and " + std::to_string(needed) +
                     " are needed.";
  const auto commonest =
      std::max_element(reasons_.begin(), reasons_.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return Error{
      Error::Code::kTooFew, std::move(what),
      commonest == reasons_.end() ? "Take more pictures of the turning target." : commonest->first};
}

}  // namespace gyre
