// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/quick_words.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/formatted.h"
#include "core/base/median.h"

namespace gyre {
namespace {

// Simulated objects through a lens that blurs by 0.8 px come out between 0 and 0.8 px, by 2.5 px
// between 1.6 and 2.2, by 4 px between 2.7 and 3.3. Cameras with more pixels than kUsualWidth_px
// seldom fill them, so their limits grow with them.
constexpr double kUsualWidth_px = 1280.0;
constexpr double kSharp_px = 1.5;
constexpr double kBlurred_px = 2.4;
constexpr double kFewLost = 0.05;  // of the object, white or black
constexpr double kManyLost = 0.2;
constexpr double kBright = 70.0;  // of 255; darker pictures are more noise than texture
constexpr double kDark = 30.0;
// Simulated objects with texture give 1.0, a plain egg 0.03, a twentieth of the usual contrast 0.5.
constexpr double kTextured = 0.6;
constexpr double kPlain = 0.15;
constexpr double kNothing = 0.002;   // of the picture: no object
constexpr double kEverything = 0.7;  // of the picture: something else has changed
constexpr double kSmall = 0.015;     // of the picture
constexpr double kFewLeave = 0.01;   // of the object
constexpr double kManyLeave = 0.10;
constexpr double kOffAxis = 0.4;  // of its reach: it swings about instead of turning
constexpr double kRedoShare = 0.25;

using Judge = std::function<std::pair<QuickVerdict, std::string>(const QuickView&)>;

QuickVerdict worse(QuickVerdict a, QuickVerdict b) { return std::max(a, b); }

double widthScale(const QuickView& view) {
  return std::max(1.0, view.picture->image_bgr.cols / kUsualWidth_px);
}

std::pair<QuickVerdict, std::string> judgeSharpness(const QuickView& view) {
  if (!view.edge_width_px) return {QuickVerdict::kAcceptable, "no edges to judge sharpness by"};
  const double px = *view.edge_width_px / widthScale(view);
  if (px <= kSharp_px) return {QuickVerdict::kGood, ""};
  if (px <= kBlurred_px) return {QuickVerdict::kAcceptable, "a little soft"};
  return {QuickVerdict::kRedo, "blurred"};
}

std::pair<QuickVerdict, std::string> judgeExposure(const QuickView& view) {
  const auto level = [](double share) {
    return share <= kFewLost    ? QuickVerdict::kGood
           : share <= kManyLost ? QuickVerdict::kAcceptable
                                : QuickVerdict::kRedo;
  };
  const QuickVerdict white = level(view.white_share);
  QuickVerdict dark = level(view.black_share);
  if (view.brightness < kBright) dark = worse(dark, QuickVerdict::kAcceptable);
  if (view.brightness < kDark) dark = QuickVerdict::kRedo;
  if (white == QuickVerdict::kGood && dark == QuickVerdict::kGood) return {QuickVerdict::kGood, ""};
  return white >= dark ? std::pair(white, std::string("burnt out"))
                       : std::pair(dark, std::string("too dark"));
}

std::pair<QuickVerdict, std::string> judgeTexture(const QuickView& view) {
  if (view.textured_share >= kTextured) return {QuickVerdict::kGood, ""};
  if (view.textured_share >= kPlain) return {QuickVerdict::kAcceptable, "little texture"};
  return {QuickVerdict::kRedo, "hardly any texture"};
}

std::pair<QuickVerdict, std::string> judgePlace(const QuickView& view) {
  if (view.object_share < kNothing) return {QuickVerdict::kRedo, "no object seen"};
  if (view.object_share > kEverything) return {QuickVerdict::kRedo, "all of the picture changed"};
  if (!view.leaves_at.empty()) return {QuickVerdict::kRedo, "cut off: " + view.leaves_at};
  if (view.object_share < kSmall) return {QuickVerdict::kAcceptable, "small in the picture"};
  return {QuickVerdict::kGood, ""};
}

// How many pictures got which verdict from one judge; what is wrong is noted at each.
struct Count {
  std::size_t acceptable = 0;
  std::size_t redo = 0;
  std::size_t all = 0;

  // One bad picture of eight is no reason to begin anew.
  QuickVerdict verdict() const {
    if (static_cast<double>(redo) >= kRedoShare * static_cast<double>(all) && redo > 0) {
      return QuickVerdict::kRedo;
    }
    const std::size_t poor = acceptable + redo;
    const bool any = redo > 0 || static_cast<double>(poor) >= kRedoShare * static_cast<double>(all);
    return any && poor > 0 ? QuickVerdict::kAcceptable : QuickVerdict::kGood;
  }
  std::string pictures() const { return formatted("%zu of %zu pictures", acceptable + redo, all); }
};

Count judgeViews(const Judge& judge, QuickLook& look) {
  Count count;
  for (QuickView& view : look.views) {
    const auto [verdict, fault] = judge(view);
    ++count.all;
    if (verdict == QuickVerdict::kAcceptable) ++count.acceptable;
    if (verdict == QuickVerdict::kRedo) ++count.redo;
    view.verdict = worse(view.verdict, verdict);
    if (!fault.empty()) view.fault += (view.fault.empty() ? "" : "; ") + fault;
  }
  return count;
}

template <class Figure>
double middle(const QuickLook& look, const Figure& figure) {
  std::vector<double> values;
  for (const QuickView& view : look.views) values.push_back(figure(view));
  return median(std::move(values));
}

QuickFinding sharpness(QuickLook& look) {
  const Count count = judgeViews(judgeSharpness, look);
  QuickFinding finding{QuickAspect::kSharp, count.verdict(), "", ""};
  const bool any_edges =
      std::any_of(look.views.begin(), look.views.end(),
                  [](const QuickView& view) { return view.edge_width_px.has_value(); });
  const double px =
      middle(look, [](const QuickView& view) { return view.edge_width_px.value_or(0.0); });
  if (finding.verdict == QuickVerdict::kGood) {
    finding.sentence = px < 1.0 ? std::string("The object is sharp.")
                                : formatted("The object is sharp: its edges are %.1f px wide.", px);
    return finding;
  }
  if (!any_edges) {
    finding.sentence = "Whether the object is sharp cannot be told: no edge stands out on it.";
    finding.advice = "Look at it in the live picture.";
    return finding;
  }
  finding.sentence = formatted("The object is %s in %s: its edges are %.1f px wide.",
                               finding.verdict == QuickVerdict::kRedo ? "blurred" : "a little soft",
                               count.pictures().c_str(), px);
  finding.advice =
      count.acceptable + count.redo == count.all
          ? "Focus on the object itself, not on what is behind it, and calibrate again: "
            "focus changes the camera."
          : "Close the aperture or add light, so that near and far sides are sharp; and "
            "see that nothing sways when the table stops.";
  return finding;
}

QuickFinding exposure(QuickLook& look) {
  const Count count = judgeViews(judgeExposure, look);
  QuickFinding finding{QuickAspect::kExposed, count.verdict(), "", ""};
  if (finding.verdict == QuickVerdict::kGood) {
    finding.sentence = "The object is well exposed.";
    return finding;
  }
  const double white = middle(look, [](const QuickView& view) { return view.white_share; });
  const double black = middle(look, [](const QuickView& view) { return view.black_share; });
  const double brightness = middle(look, [](const QuickView& view) { return view.brightness; });
  if (white > black && white > kFewLost) {
    finding.sentence =
        formatted("Burnt out: %.0f %% of the object is white without detail.", 100.0 * white);
    finding.advice = "Dim the light, expose shorter, or take shine off with a diffuser.";
  } else if (black > kFewLost || brightness < kBright) {
    finding.sentence =
        formatted("Too dark: the brighter parts of the object reach %.0f of 255.", brightness);
    finding.advice = "Add light or expose longer.";
  } else {
    finding.sentence = "Some sides are badly exposed: " + count.pictures() + ".";
    finding.advice = "Light the object from two sides.";
  }
  return finding;
}

QuickFinding texture(QuickLook& look, bool clear) {
  const Count count = judgeViews(judgeTexture, look);
  QuickFinding finding{QuickAspect::kTextured, count.verdict(), "", ""};
  const double share = middle(look, [](const QuickView& view) { return view.textured_share; });
  finding.sentence =
      formatted("%.0f %% of the surface has texture that can be followed.", 100.0 * share);
  if (finding.verdict == QuickVerdict::kGood) return finding;
  if (!clear) {
    finding.advice = "Mend focus and light first: they hide texture.";
  } else if (finding.verdict == QuickVerdict::kAcceptable) {
    finding.advice = "Plain parts will have few points. Chalk, dots or dust on them help.";
  } else {
    finding.advice =
        "Put chalk, dots or dust on it, or scan it as it is: its body is then made from its "
        "outlines.";
  }
  return finding;
}

// What to do about an object that is in the picture, but not well.
void judgeExtent(const ObjectExtent& extent, QuickFinding& finding) {
  const std::string size = formatted("It reaches %.0f mm from the axis and is about %.0f mm high.",
                                     extent.reach_mm, extent.height_mm);
  finding.sentence += " " + size;
  if (extent.leaving_share > kFewLeave) {
    finding.verdict =
        worse(finding.verdict,
              extent.leaving_share > kManyLeave ? QuickVerdict::kRedo : QuickVerdict::kAcceptable);
    finding.sentence += " Between these pictures a part of it leaves the picture.";
  }
  if (extent.off_axis_mm > kOffAxis * extent.reach_mm) {
    finding.verdict = worse(finding.verdict, QuickVerdict::kAcceptable);
    finding.sentence += formatted(" It stands %.0f mm off the axis.", extent.off_axis_mm);
  }
  if (finding.verdict != QuickVerdict::kGood && finding.advice.empty()) {
    finding.advice = "Move it to the middle of the table.";
  }
}

QuickFinding place(const std::optional<ObjectExtent>& extent, QuickLook& look) {
  const Count count = judgeViews(judgePlace, look);
  QuickFinding finding{QuickAspect::kInPicture, count.verdict(), "", ""};
  const double share = middle(look, [](const QuickView& view) { return view.object_share; });
  const auto leave = static_cast<std::size_t>(
      std::count_if(look.views.begin(), look.views.end(),
                    [](const QuickView& view) { return !view.leaves_at.empty(); }));
  if (share < kNothing) {
    finding.sentence = "No object is seen on the table.";
    finding.advice =
        "Put it there, or add light. If it stands there, take the picture of the empty table "
        "again, "
        "without it.";
    return finding;
  }
  if (share > kEverything) {
    finding.sentence = "Nearly all of the picture differs from that of the empty table.";
    finding.advice =
        "Camera or lights were changed since: take the object off and that picture again. If the "
        "object fills the picture, move the camera back.";
    return finding;
  }
  if (leave > 0) {
    finding.sentence =
        formatted("The object is cut off by the picture's edge in %zu of %zu pictures.", leave,
                  look.views.size());
    finding.advice =
        "Move it to the middle of the table; if it is too large, move the camera back and "
        "calibrate again.";
  } else if (finding.verdict != QuickVerdict::kGood && share < kSmall) {
    finding.sentence = formatted("The object is small: %.1f %% of the picture.", 100.0 * share);
    finding.advice = "Bring the camera nearer and calibrate again: it will see finer detail.";
  } else {
    finding.sentence = "The object stays in the picture.";
  }
  if (extent && leave == 0) judgeExtent(*extent, finding);
  return finding;
}

// Without it the turning platter counts as object.
QuickFinding notJudged(QuickAspect aspect, const char* what) {
  return {aspect, QuickVerdict::kAcceptable, std::string(what) + " was not judged.",
          "Take the picture of the empty table first."};
}

}  // namespace

void putIntoWords(OutlinesKnown outlines, const std::optional<ObjectExtent>& extent,
                  QuickLook& look) {
  const bool known = outlines == OutlinesKnown::kYes;
  look.findings[0] =
      known ? place(extent, look)
            : notJudged(QuickAspect::kInPicture, "Whether the object stays in the picture");
  look.findings[1] = sharpness(look);
  look.findings[2] = exposure(look);
  const bool clear = look.findings[1].verdict != QuickVerdict::kRedo &&
                     look.findings[2].verdict != QuickVerdict::kRedo;
  look.findings[3] =
      known ? texture(look, clear)
            : notJudged(QuickAspect::kTextured, "Whether the object has texture enough");
  for (const QuickFinding& finding : look.findings) {
    look.verdict = worse(look.verdict, finding.verdict);
  }
}

}  // namespace gyre
