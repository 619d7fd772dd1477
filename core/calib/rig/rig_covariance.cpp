// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <Eigen/Dense>

#include "core/calib/rig/rig_problem.h"

namespace gyre {
namespace {

// Below this share of the largest, after scaling to unit diagonal, a direction is undetermined.
constexpr double kSingular = 1e-13;

// Sightings a hundred times better than stated are exact, and priors must still count beside them.
constexpr double kLeastVariance = 1e-4;

constexpr std::array<const char*, kCameraSize> kCameraNames = {
    "focal_px", "aspect", "cx_px", "cy_px", "k1", "k2", "k3", "p1", "p2"};
constexpr std::array<const char*, kAxisSize> kAxisNames = {"axis_turn_x_rad", "axis_turn_y_rad",
                                                           "axis_shift_x_mm", "axis_shift_y_mm"};
constexpr std::array<const char*, kTargetSize> kTargetNames = {
    "target_turn_x_rad", "target_turn_y_rad", "target_turn_z_rad",
    "target_shift_x_mm", "target_shift_y_mm", "target_shift_z_mm"};
constexpr std::array<const char*, kFaceSize> kFaceNames = {"turn_x_rad", "turn_y_rad", "turn_z_rad",
                                                           "shift_x_mm", "shift_y_mm", "shift_z_mm",
                                                           "bow_xx_mm",  "bow_xy_mm",  "bow_yy_mm"};

// Where each parameter stands in the normal matrix; -1 where it is held.
class Layout {
 public:
  Layout(const RigScene& scene, const RigFreedom& freedom, const RigState& state) {
    for (std::size_t i = 0; i < kCameraSize; ++i) {
      camera[i] = freedom.camera[i] ? add(kCameraNames[i]) : -1;
    }
    for (std::size_t i = 0; i < kAxisSize; ++i) axis[i] = freedom.axis ? add(kAxisNames[i]) : -1;
    for (std::size_t i = 0; i < kTargetSize; ++i) {
      target[i] = freedom.target ? add(kTargetNames[i]) : -1;
    }
    std::vector<bool> view_seen(state.angles_rad.size(), false);
    std::vector<bool> face_seen(state.faces.size(), false);
    for (const RigSighting& seen : scene.sightings) {
      if (!seen.used) continue;
      view_seen[seen.view] = true;
      face_seen[scene.face_of[seen.point]] = true;
    }
    for (std::size_t k = 0; k < state.angles_rad.size(); ++k) {
      const bool known = view_seen[k] || scene.commanded_rad[k];
      angles.push_back(k > 0 && known ? add("angle_" + std::to_string(k + 1) + "_rad") : -1);
    }
    for (std::size_t face = 0; face < state.faces.size(); ++face) {
      faces.emplace_back();
      for (std::size_t i = 0; i < kFaceSize; ++i) {
        const bool free = (i < 6 ? freedom.face_places : freedom.face_bows) && face_seen[face] &&
                          face + 1 < state.faces.size();
        faces[face][i] = free ? add("face_" + std::to_string(face + 1) + "_" + kFaceNames[i]) : -1;
      }
    }
    page_stretch = freedom.page_stretch ? add("page_stretch") : -1;
    bool commanded = false;
    for (std::size_t k = 1; k < scene.commanded_rad.size(); ++k) {
      commanded = commanded || (scene.commanded_rad[k] && *scene.commanded_rad[k] != 0.0);
    }
    step_scale = freedom.step_scale && commanded ? add("step_scale") : -1;
  }

  std::vector<std::string> names;
  std::array<int, kCameraSize> camera{};
  std::array<int, kAxisSize> axis{};
  std::array<int, kTargetSize> target{};
  std::vector<int> angles;
  std::vector<std::array<int, kFaceSize>> faces;
  int page_stretch = -1;
  int step_scale = -1;

 private:
  int add(std::string name) {
    names.push_back(std::move(name));
    return static_cast<int>(names.size()) - 1;
  }
};

// The rows of one sighting: column indices and values of what is free.
struct SparseRows {
  std::vector<int> columns;
  std::vector<Eigen::Vector2d> values;

  void add(int column, const Eigen::Vector2d& value) {
    if (column < 0) return;
    columns.push_back(column);
    values.push_back(value);
  }
};

SparseRows rowsOf(const Layout& layout, const RigSighting& seen, std::size_t face,
                  const RigJacobian& by) {
  SparseRows rows;
  for (int i = 0; i < kCameraSize; ++i) {
    rows.add(layout.camera[static_cast<std::size_t>(i)], by.camera.col(i));
  }
  for (int i = 0; i < kAxisSize; ++i) {
    rows.add(layout.axis[static_cast<std::size_t>(i)], by.axis.col(i));
  }
  for (int i = 0; i < kTargetSize; ++i) {
    rows.add(layout.target[static_cast<std::size_t>(i)], by.target.col(i));
  }
  rows.add(layout.angles[seen.view], by.angle);
  for (int i = 0; i < kFaceSize; ++i) {
    rows.add(layout.faces[face][static_cast<std::size_t>(i)], by.face.col(i));
  }
  rows.add(layout.page_stretch, by.page_stretch);
  return rows;
}

struct Normal {
  Eigen::MatrixXd matrix;
  double squares = 0.0;  // of the residuals over sigma
  double rows = 0.0;
};

Normal sightingsNormal(const RigScene& scene, const RigState& state, const Layout& layout) {
  const auto size = static_cast<Eigen::Index>(layout.names.size());
  Normal normal{Eigen::MatrixXd::Zero(size, size), 0.0, 0.0};
  for (const RigSighting& seen : scene.sightings) {
    if (!seen.used) continue;
    const std::size_t face = scene.face_of[seen.point];
    Eigen::Vector2d pixel;
    RigJacobian by;
    if (!projectRig(state.frames, state.at(seen.view, face), scene.points[seen.point], &pixel,
                    &by)) {
      continue;
    }
    const double weight = 1.0 / (seen.sigma_px * seen.sigma_px);
    normal.squares += weight * (seen.pixel - pixel).squaredNorm();
    normal.rows += 2.0;
    const SparseRows rows = rowsOf(layout, seen, face, by);
    for (std::size_t i = 0; i < rows.columns.size(); ++i) {
      for (std::size_t j = 0; j < rows.columns.size(); ++j) {
        normal.matrix(rows.columns[i], rows.columns[j]) +=
            weight * rows.values[i].dot(rows.values[j]);
      }
    }
  }
  return normal;
}

void addPriors(const RigScene& scene, const RigPriors& priors, const Layout& layout,
               Eigen::MatrixXd& normal) {
  for (std::size_t k = 1; k < layout.angles.size(); ++k) {
    const int angle = layout.angles[k];
    if (angle < 0 || !scene.commanded_rad[k]) continue;
    const double weight = 1.0 / (priors.angle_rad * priors.angle_rad);
    const double commanded = *scene.commanded_rad[k];
    normal(angle, angle) += weight;
    const int scale = layout.step_scale;
    if (scale < 0) continue;
    normal(scale, scale) += weight * commanded * commanded;
    normal(angle, scale) -= weight * commanded;
    normal(scale, angle) -= weight * commanded;
  }
  for (const auto& face : layout.faces) {
    if (!priors.folds) break;
    const auto sigmas = priors.folds->sigmas();
    for (int i = 0; i < kFaceSize; ++i) {
      const int column = face[static_cast<std::size_t>(i)];
      if (column >= 0) normal(column, column) += 1.0 / (sigmas[i] * sigmas[i]);
    }
  }
  const int page = layout.page_stretch;
  if (page >= 0) normal(page, page) += 1.0 / (priors.page_stretch * priors.page_stretch);
}

}  // namespace

RigCovariance covarianceOf(const RigScene& scene, const RigFreedom& freedom,
                           const RigPriors& priors, const RigState& state) {
  const Layout layout(scene, freedom, state);
  Normal normal = sightingsNormal(scene, state, layout);
  RigCovariance covariance;
  const double spare = normal.rows - static_cast<double>(layout.names.size());
  if (spare > 0.0) covariance.variance_factor = normal.squares / spare;
  // With few spare rows the found variance is itself a guess: it may only warn, not reassure.
  if (spare < 100.0) covariance.variance_factor = std::max(1.0, covariance.variance_factor);
  normal.matrix /= std::max(covariance.variance_factor, kLeastVariance);
  addPriors(scene, priors, layout, normal.matrix);

  // Scaled to unit diagonal, so that mixed units do not look like degeneracy.
  const Eigen::VectorXd diagonal = normal.matrix.diagonal();
  if (!(diagonal.minCoeff() > 0.0)) return covariance;
  const Eigen::VectorXd scale = diagonal.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * normal.matrix *
                                                             scale.asDiagonal());
  if (!(eigen.eigenvalues()[0] > kSingular * eigen.eigenvalues().maxCoeff())) return covariance;
  covariance.matrix = scale.asDiagonal() * eigen.eigenvectors() *
                      eigen.eigenvalues().cwiseInverse().asDiagonal() *
                      eigen.eigenvectors().transpose() * scale.asDiagonal();
  covariance.names = layout.names;
  for (const auto& face : layout.faces) {
    covariance.face_variances.push_back(Eigen::Matrix<double, kFaceSize, 1>::Zero());
    for (int i = 0; i < kFaceSize; ++i) {
      const int column = face[static_cast<std::size_t>(i)];
      if (column >= 0) covariance.face_variances.back()[i] = covariance.matrix(column, column);
    }
  }
  std::vector<int> rig(layout.camera.begin(), layout.camera.end());
  rig.insert(rig.end(), layout.axis.begin(), layout.axis.end());
  for (std::size_t i = 0; i < rig.size(); ++i) {
    for (std::size_t j = 0; j < rig.size(); ++j) {
      if (rig[i] < 0 || rig[j] < 0) continue;
      covariance.rig(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          covariance.matrix(rig[i], rig[j]);
    }
  }
  return covariance;
}

}  // namespace gyre
