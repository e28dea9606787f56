#include "models/kinematics/kinematic_chain.h"

#include <set>
#include <stdexcept>
#include <utility>

namespace errmap::models {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
[[noreturn]] void Refuse(const std::string& what) {
  throw std::invalid_argument("KinematicChain: " + what);
}

Vector3d Unit(ErrorDirection direction) {
  return Vector3d::Unit(static_cast<Index>(direction) % 3);
}

Matrix3d Turned(const Vector3d& angles) {
  const double angle = angles.norm();
  if (angle == 0.0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, angles / angle).toRotationMatrix();
}

// The nearest rotation, for a matrix that rounding moved away from one: a step
// of Newton's iteration for the polar factor (Higham 1986).
Matrix3d Orthonormal(const Matrix3d& rotation) {
  return 0.5 * rotation *
         (3.0 * Matrix3d::Identity() - rotation.transpose() * rotation);
}

bool Moves(const KinematicLink& link) { return link.joint != Joint::kFixed; }

void CheckLink(const KinematicLink& link) {
  const auto refuse = [&](const std::string& what) {
    Refuse("link '" + link.name + "' " + what);
  };
  if (!link.offset.allFinite() || !link.axis.allFinite()) {
    refuse("has a number that is not finite");
  }
  if (Moves(link) && link.axis.norm() == 0.0) {
    refuse("moves and needs an axis that is not 0");
  }
  std::set<ErrorDirection> seen;
  for (const ErrorDirection direction : link.errors) {
    if (!seen.insert(direction).second) refuse("has an error twice");
  }
}

}  // namespace

bool IsRotation(ErrorDirection direction) {
  return direction >= ErrorDirection::kA;
}

KinematicChain::KinematicChain(std::vector<KinematicLink> links)
    : links_(std::move(links)) {
  std::set<std::string> names;
  bool has_tool = false;
  for (KinematicLink& link : links_) {
    if (link.name.empty()) Refuse("a link without a name");
    if (!names.insert(link.name).second) {
      Refuse("two links are named '" + link.name + "'; a chain has no loops");
    }
    CheckLink(link);
    if (Moves(link)) {
      link.axis.normalize();
      ++num_coordinates_;
    }
    has_tool = has_tool || link.branch == Branch::kTool;
    const auto index = std::ssize(names) - 1;
    for (const ErrorDirection direction : link.errors) {
      errors_.push_back({index, direction});
    }
  }
  if (!has_tool) Refuse("no link on the tool's branch");
}

void KinematicChain::CheckSizes(const VectorXd& coordinates,
                                const VectorXd* errors) const {
  const auto check = [](const char* what, Index found, Index expected) {
    if (found == expected) return;
    Refuse(std::to_string(found) + " " + what + ", expected " +
           std::to_string(expected));
  };
  check("coordinates", coordinates.size(), num_coordinates_);
  if (errors != nullptr) check("errors", errors->size(), num_errors());
}

// The link's own transformation; `errors` (of this link) may be null.
Isometry3d KinematicChain::StepOf(const KinematicLink& link,
                                  double coordinate,
                                  const double* errors) const {
  Vector3d moved = link.offset;
  if (link.joint == Joint::kLinear) moved += coordinate * link.axis;
  Vector3d turned = Vector3d::Zero();
  if (errors != nullptr) {
    for (const ErrorDirection direction : link.errors) {
      (IsRotation(direction) ? turned : moved) += *errors++ * Unit(direction);
    }
  }
  Isometry3d step = Isometry3d::Identity();
  step.translation() = moved;
  step.linear() = Turned(turned);
  if (link.joint == Joint::kRotary) {
    step.linear() *= Turned(coordinate * link.axis);
  }
  return step;
}

// The frames at the end of both branches (Eq. 6).
KinematicChain::Ends KinematicChain::EndsOf(const VectorXd& coordinates,
                                            const VectorXd* errors) const {
  Ends ends{Isometry3d::Identity(), Isometry3d::Identity()};
  const double* coordinate = coordinates.data();
  const double* error = errors == nullptr ? nullptr : errors->data();
  for (const KinematicLink& link : links_) {
    Isometry3d& end = link.branch == Branch::kTool ? ends.tool : ends.work;
    end = end * StepOf(link, Moves(link) ? *coordinate++ : 0.0, error);
    if (error != nullptr) error += link.errors.size();
  }
  for (Isometry3d* end : {&ends.tool, &ends.work}) {
    end->linear() = Orthonormal(end->linear());
  }
  return ends;
}

Vector3d KinematicChain::NominalReach(const VectorXd& coordinates) const {
  CheckSizes(coordinates, nullptr);
  const Ends nominal = EndsOf(coordinates, nullptr);
  return nominal.tool.translation() - nominal.work.translation();
}

Vector3d KinematicChain::ExactError(const VectorXd& coordinates,
                                    const VectorXd& errors) const {
  CheckSizes(coordinates, &errors);
  const Ends nominal = EndsOf(coordinates, nullptr);
  const Ends actual = EndsOf(coordinates, &errors);
  const Vector3d touched =
      nominal.work.inverse() * Vector3d(nominal.tool.translation());
  return actual.tool.translation() - actual.work * touched;
}

Matrix3Xd KinematicChain::Sensitivities(const VectorXd& coordinates) const {
  CheckSizes(coordinates, nullptr);
  const Vector3d tip = EndsOf(coordinates, nullptr).tool.translation();
  Matrix3Xd sensitivities(3, num_errors());
  Ends ends{Isometry3d::Identity(), Isometry3d::Identity()};
  const double* coordinate = coordinates.data();
  Index column = 0;
  for (const KinematicLink& link : links_) {
    const bool is_tool = link.branch == Branch::kTool;
    Isometry3d& end = is_tool ? ends.tool : ends.work;
    const Matrix3d before = end.linear();
    end = end * StepOf(link, Moves(link) ? *coordinate++ : 0.0, nullptr);
    const Vector3d arm = tip - end.translation();
    for (const ErrorDirection direction : link.errors) {
      const Vector3d axis = before * Unit(direction);
      const Vector3d moved = IsRotation(direction) ? axis.cross(arm) : axis;
      sensitivities.col(column++) = is_tool ? moved : Vector3d(-moved);
    }
  }
  return sensitivities;
}

}  // namespace errmap::models
