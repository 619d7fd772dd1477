// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/object_models.h"

#include <array>
#include <cmath>

#include "core/base/check.h"
#include "core/sim/implicit.h"

namespace gyre {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::Vector4d;
using implicit::blend;
using implicit::cut;
using implicit::ellipsoid;
using implicit::rod;
using implicit::sphere;

// The same point with y >= 0: for what comes in pairs.
Vector3d mirrored(const Vector3d& p) { return {p.x(), std::abs(p.y()), p.z()}; }

// Everything stands on its flattened base.
double standing(double distance, const Vector3d& p) { return cut(distance, -p.z(), 1.5); }

Bounds boxOf(const Vector3d& min, const Vector3d& max) {
  Bounds box;
  box.include(min);
  box.include(max);
  return box;
}

double duckBeak(const Vector3d& p) {
  const double upper = ellipsoid(p, {29.0, 0.0, 41.6}, {9.5, 7.5, 2.6});
  const double lower = ellipsoid(p, {27.5, 0.0, 38.0}, {7.5, 6.0, 2.2});
  return blend(upper, lower, 1.5);
}

double duck(const Vector3d& p) {
  const Vector3d q = mirrored(p);
  double body = ellipsoid(p, {-2.0, 0.0, 14.5}, {29.0, 20.0, 17.5});
  body = blend(body, rod(p, {{-20.0, 0.0, 22.0}, {-33.0, 0.0, 36.0}, 9.0, 2.8}), 9.0);
  body = blend(body, ellipsoid(q, {-6.0, 18.0, 20.0}, {15.0, 4.5, 8.5}), 2.5);
  const double head = sphere(p, {15.0, 0.0, 43.0}, 14.0);
  return standing(blend(blend(body, head, 7.0), duckBeak(p), 1.5), p);
}

Vector3f duckPaint(const Vector3d& p) {
  const Vector3d q = mirrored(p);
  if (sphere(q, {23.5, 8.5, 48.0}, 2.4) < 0.0) return {0.05F, 0.05F, 0.07F};
  if (sphere(q, {23.5, 8.5, 48.0}, 4.0) < 0.0) return {0.97F, 0.97F, 0.93F};
  if (duckBeak(p) < 0.8) return {0.98F, 0.42F, 0.08F};
  return {1.0F, 0.82F, 0.16F};
}

double mouseEar(const Vector3d& p) {
  return ellipsoid(mirrored(p), {14.0, 14.0, 33.0}, {2.6, 11.0, 11.5});
}

double mouseTail(const Vector3d& p) {
  static const std::array<Vector4d, 8> kPath = {
      Vector4d(-26.0, 2.0, 7.0, 4.6),  Vector4d(-34.0, 5.0, 4.6, 3.9),
      Vector4d(-39.5, 11.0, 3.2, 3.5), Vector4d(-40.0, 19.0, 3.0, 3.3),
      Vector4d(-35.0, 26.0, 2.8, 3.1), Vector4d(-27.0, 29.5, 2.6, 2.9),
      Vector4d(-18.0, 30.0, 2.4, 2.7), Vector4d(-9.0, 28.5, 2.2, 2.4)};
  return implicit::tube(p, kPath);
}

double mouse(const Vector3d& p) {
  const Vector3d q = mirrored(p);
  double body = ellipsoid(p, {-8.0, 0.0, 15.0}, {25.0, 18.5, 18.5});
  body = blend(body, rod(p, {{14.0, 0.0, 17.0}, {35.0, 0.0, 10.5}, 12.5, 4.2}), 9.0);
  body = blend(body, sphere(p, {38.2, 0.0, 10.6}, 3.0), 1.0);
  body = blend(body, mouseEar(p), 4.0);
  body = blend(body, mouseTail(p), 4.0);
  body = blend(body, ellipsoid(q, {22.0, 9.5, 3.0}, {7.0, 4.2, 4.0}), 5.0);
  return standing(body, p);
}

Vector3f mousePaint(const Vector3d& p) {
  const Vector3d q = mirrored(p);
  if (sphere(q, {27.5, 6.8, 18.5}, 2.5) < 0.0) return {0.04F, 0.04F, 0.05F};
  if (sphere(p, {38.6, 0.0, 10.6}, 3.1) < 0.0) return {0.9F, 0.35F, 0.4F};
  const bool in_front_of_ear =
      p.x() > 14.6 && ellipsoid(q, {15.0, 14.5, 34.0}, {5.0, 8.0, 8.5}) < 0.0;
  if (in_front_of_ear || mouseTail(p) < 0.4) return {0.95F, 0.62F, 0.6F};
  return {0.68F, 0.62F, 0.58F};
}

// The vase's outer radius at a height, and how it grows with the height.
struct Profile {
  double radius;
  double slope;
};

// Foot, belly, neck and flared lip: a cylinder with Gaussian rings.
Profile vaseProfile(double z) {
  Profile profile{10.0, 0.0};
  const auto add_ring = [&](double height, double centre, double width) {
    const double t = (z - centre) / width;
    const double ring = height * std::exp(-t * t);
    profile.radius += ring;
    profile.slope -= 2.0 * t / width * ring;
  };
  add_ring(12.5, 24.0, 15.0);
  add_ring(5.0, -2.0, 6.0);
  add_ring(6.0, 70.0, 9.0);
  return profile;
}

double vaseWall(const Vector3d& p, double inset) {
  const auto [radius, slope] = vaseProfile(p.z());
  return (p.head<2>().norm() - (radius - inset)) / std::sqrt(1.0 + slope * slope);
}

double vaseHandle(const Vector3d& p) {
  static const std::array<Vector4d, 8> kPath = {
      Vector4d(9.0, 0.0, 58.0, 1.9),  Vector4d(17.0, 0.0, 60.0, 1.9),
      Vector4d(24.0, 0.0, 58.0, 1.8), Vector4d(29.0, 0.0, 52.5, 1.8),
      Vector4d(31.0, 0.0, 45.0, 1.8), Vector4d(29.5, 0.0, 37.5, 1.8),
      Vector4d(25.5, 0.0, 31.5, 1.9), Vector4d(19.0, 0.0, 27.5, 2.2)};
  return implicit::tube(p, kPath);
}

double vase(const Vector3d& p) {
  double solid = cut(vaseWall(p, 0.0), p.z() - 68.0, 2.0);
  solid = blend(solid, vaseHandle(p), 1.5);
  const double hollow = cut(vaseWall(p, 3.4), 6.0 - p.z(), 3.0);
  return standing(cut(solid, -hollow, 1.2), p);
}

Vector3f vasePaint(const Vector3d& p) {
  if (p.head<2>().norm() < vaseProfile(p.z()).radius - 2.0) return {0.72F, 0.62F, 0.5F};
  if (std::abs(p.z() - 40.0) < 2.2 || std::abs(p.z() - 9.5) < 1.6) return {0.95F, 0.9F, 0.75F};
  if (vaseHandle(p) < 0.5) return {0.86F, 0.42F, 0.25F};
  return {0.25F, 0.5F, 0.75F};
}

constexpr double kBowlRim = 36.0;

double bowl(const Vector3d& p) {
  const Vector3d centre(0.0, 0.0, 44.0);
  const double outer = ellipsoid(p, centre, {42.0, 42.0, 42.0});
  const double inner = ellipsoid(p, centre, {37.5, 37.5, 37.0});
  double shell = cut(outer, -inner, 1.0);
  shell = cut(shell, p.z() - kBowlRim, 2.5);
  const double rho = p.head<2>().norm();
  const double foot = cut(cut(rho - 19.0, 12.0 - rho, 1.0), p.z() - 9.0, 1.0);
  // The foot is a ring below the shell: what of it would stand inside the bowl is cut away.
  return standing(blend(shell, std::max(foot, -inner), 2.0), p);
}

Vector3f bowlPaint(const Vector3d& p) {
  const bool inside = (p - Vector3d(0.0, 0.0, 44.0)).norm() < 40.0;
  if (p.z() > kBowlRim - 3.0) return {0.95F, 0.88F, 0.7F};
  return inside ? Vector3f(0.85F, 0.78F, 0.6F) : Vector3f(0.35F, 0.6F, 0.45F);
}

// A dinner plate on edge, leant back by 10° in a block: two sides, 2.6 mm apart.
constexpr double kPlateRadius = 30.0;
constexpr double kPlateLean = 0.17632698;  // tan 10°

// The place in the plate's own frame: along its axis, and how far from it.
Eigen::Vector2d onPlate(const Vector3d& p) {
  const double cosine = 1.0 / std::sqrt(1.0 + kPlateLean * kPlateLean);
  const double up = p.z() - 33.0;
  const double along = cosine * (p.x() + kPlateLean * up);
  const double high = cosine * (up - kPlateLean * p.x());
  return {along, std::hypot(p.y(), high)};
}

double plate(const Vector3d& p) {
  const Eigen::Vector2d at = onPlate(p);
  const double t = (at.y() - 26.0) / 3.0;
  const double rim = 0.8 * std::exp(-t * t);  // a raised ring on both sides
  const double disc = cut(at.y() - kPlateRadius, std::abs(at.x()) - 1.3 - rim, 1.0);
  const double sides = cut(std::abs(p.x()) - 9.0, std::abs(p.y()) - 20.0, 2.0);
  return standing(blend(disc, cut(sides, p.z() - 7.0, 2.0), 2.0), p);
}

Vector3f platePaint(const Vector3d& p) {
  const Eigen::Vector2d at = onPlate(p);
  if (p.z() < 7.5) return {0.5F, 0.36F, 0.24F};
  if (at.x() < 0.0) return {0.8F, 0.55F, 0.4F};
  const bool ring = std::abs(at.y() - 26.0) < 2.5 || at.y() < 8.0;
  return ring ? Vector3f(0.2F, 0.35F, 0.65F) : Vector3f(0.93F, 0.91F, 0.86F);
}

double plain(const Vector3d& p) {
  // An egg: a sphere whose width falls with height.
  const double taper = 1.0 + 0.008 * (p.z() - 24.0);
  const Vector3d q(p.x() * taper, p.y() * taper, p.z());
  const double egg = ellipsoid(q, {0.0, 0.0, 26.0}, {24.0, 24.0, 32.0});
  return standing(cut(egg, p.z() - 50.0, 1.5), p);
}

ObjectModel make(SignedDistance distance, const Bounds& box,
                 std::function<Vector3f(const Vector3d&)> paint, double texture) {
  return {std::move(distance), box, std::move(paint), texture};
}

// Six by six squares a face, on a cube of side 1.
Vector3f cubePaint(const Vector3d& p) {
  const Vector3d q = p - Vector3d(0.0, 0.0, 0.5);
  int axis = 0;
  q.cwiseAbs().maxCoeff(&axis);
  const auto square = [&](int a) { return static_cast<int>(std::floor((q[a] + 0.5) * 6.0)); };
  const bool light = ((square((axis + 1) % 3) + square((axis + 2) % 3)) & 1) != 0;
  return light ? Vector3f(0.95F, 0.93F, 0.9F) : Vector3f(0.4F, 0.38F, 0.42F);
}

}  // namespace

const std::vector<std::string>& objectNames() {
  static const std::vector<std::string> kNames = {"duck", "mouse", "cube", "vase",
                                                  "bowl", "plate", "plain"};
  return kNames;
}

ObjectModel objectModel(const std::string& name) {
  if (name == "duck") return make(duck, boxOf({-40, -26, 0}, {41, 26, 60}), duckPaint, 1.0);
  if (name == "mouse") return make(mouse, boxOf({-46, -28, 0}, {44, 36, 48}), mousePaint, 1.0);
  if (name == "vase") return make(vase, boxOf({-28, -28, 0}, {36, 28, 72}), vasePaint, 1.0);
  if (name == "bowl") return make(bowl, boxOf({-45, -45, 0}, {45, 45, 40}), bowlPaint, 1.0);
  if (name == "plate") return make(plate, boxOf({-14, -33, 0}, {14, 33, 66}), platePaint, 1.0);
  if (name == "cube") return make({}, boxOf({-0.5, -0.5, 0}, {0.5, 0.5, 1}), cubePaint, 1.0);
  GYRE_CHECK(name == "plain");
  return make(
      plain, boxOf({-32, -32, 0}, {32, 32, 54}),
      [](const Vector3d&) { return Vector3f(0.86F, 0.82F, 0.74F); }, 0.02);
}

}  // namespace gyre
