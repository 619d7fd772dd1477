// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/rigid_alignment.h"

#include <algorithm>
#include <vector>

#include <Eigen/Cholesky>

#include "core/base/parallel.h"
#include "core/mesh/small_motion.h"
#include "core/mesh/surface_index.h"
#include "core/mesh/surface_samples.h"

namespace gyre {
namespace {

constexpr std::size_t kSamples = 5000;  // far more than six unknowns need, and fast
constexpr int kMaxRounds = 100;
constexpr double kKeptShare = 0.9;
constexpr double kConverged = 1e-7;  // of the reference's size: the last step, in mm and in rad*mm

struct Pair {
  Eigen::Vector3d moved;    // the sample as it now lies
  Eigen::Vector3d nearest;  // on the reference
  Eigen::Vector3d normal;   // of the reference there; zero at a bare point
  double distance_mm = 0.0;
};

std::vector<Pair> pairUp(const std::vector<SurfaceSample>& samples, const Rigid3& motion,
                         const SurfaceIndex& reference) {
  std::vector<Pair> pairs(samples.size());
  parallelFor(samples.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d moved = motion * samples[i].position;
      const SurfaceHit hit = reference.nearest(moved);
      pairs[i] = {moved, hit.position, reference.normalAt(hit), hit.distance_mm};
    }
  });
  const auto kept = static_cast<std::size_t>(kKeptShare * static_cast<double>(pairs.size()));
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.distance_mm < b.distance_mm; });
  pairs.resize(std::max<std::size_t>(kept, 1));
  return pairs;
}

// The small motion (rotation vector about `centre` in units of `size`, then shift) that minimises
//   sum |M (x + w x (x - c) + t - y)|^2,  M = n n^T on triangles and the identity at bare points.
struct Step {
  SmallMotion motion = SmallMotion::Zero();
  bool determined = false;
};
Step solveStep(const std::vector<Pair>& pairs, const Eigen::Vector3d& centre, double size) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  Matrix6 normal_matrix = Matrix6::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  for (const Pair& pair : pairs) {
    const Eigen::Vector3d arm = (pair.moved - centre) / size;
    const Eigen::Matrix<double, 3, 6> jacobian = smallMotionJacobian(arm);
    Eigen::Matrix3d measured = Eigen::Matrix3d::Identity();
    if (!pair.normal.isZero()) measured = pair.normal * pair.normal.transpose();
    normal_matrix += jacobian.transpose() * measured * jacobian;
    right += jacobian.transpose() * measured * (pair.nearest - pair.moved);
  }
  // A thousandth of a millionth of damping keeps directions that the shape leaves open (a sphere
  // turns in itself) at rest instead of adrift.
  Step step;
  const double scale = normal_matrix.trace() / 6.0;
  if (!(scale > 0.0)) return step;
  normal_matrix += 1e-9 * scale * Matrix6::Identity();
  step.motion = normal_matrix.ldlt().solve(right);
  step.determined = step.motion.allFinite();
  return step;
}

}  // namespace

Result<Rigid3> alignRigidly(const Mesh& result, const Mesh& reference, const Task& task) {
  const SurfaceIndex index(reference);
  std::vector<SurfaceSample> samples = sampleSurface(result, kSamples);
  if (samples.size() > kSamples) {  // a large cloud: every n-th point
    const std::size_t stride = (samples.size() + kSamples - 1) / kSamples;
    for (std::size_t i = 0; i * stride < samples.size(); ++i) samples[i] = samples[i * stride];
    samples.resize(samples.size() / stride);
  }
  const Bounds bounds = boundsOf(reference);
  const double size_mm = bounds.diagonal();
  if (samples.size() < 3 || !(size_mm > 0.0)) {
    return Error{Error::Code::kTooFew, "The two shapes have too little surface to be aligned.",
                 "Compare them without alignment."};
  }
  Rigid3 motion;
  for (int round = 0; round < kMaxRounds; ++round) {
    if (task.stopRequested()) return cancelled();
    task.report(static_cast<double>(round) / kMaxRounds, "Aligning");
    const std::vector<Pair> pairs = pairUp(samples, motion, index);
    const Eigen::Vector3d centre = 0.5 * (bounds.min + bounds.max);
    const Step step = solveStep(pairs, centre, size_mm);
    if (!step.determined) {
      return Error{Error::Code::kTooFew, "The two shapes do not say how to align them.",
                   "Compare them without alignment."};
    }
    motion = rigidOf(step.motion, centre, size_mm) * motion;
    if (step.motion.norm() < kConverged * size_mm) break;
  }
  return motion;
}

}  // namespace gyre
