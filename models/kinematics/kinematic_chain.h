#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "stats/eigen.h"

namespace errmap::models {

/// Side of the machine to which a link belongs. Both branches begin at the
/// base; one ends at the tool, the other at the workpiece.
enum class Branch { kTool, kWork };

enum class Joint { kFixed, kLinear, kRotary };

/// Direction of an error: the link moves along (X, Y, Z) or turns about (A, B,
/// C) an axis of the previous link's frame. The letters are those of ISO 230-1,
/// clause 3.
enum class ErrorDirection { kX, kY, kZ, kA, kB, kC };
inline constexpr int kNumErrorDirections = 6;

/// A, B and C: rad, positive by the right-hand rule; the others are lengths.
bool IsRotation(ErrorDirection direction);

/// A rigid element of the machine, placed relative to the previous one on its
/// branch. Lengths are in one unit of the caller's choice, say mm; angles in
/// rad.
struct KinematicLink {
  std::string name;
  Branch branch = Branch::kTool;
  Joint joint = Joint::kFixed;
  /// Direction of motion or axis of rotation of a moving joint, in the previous
  /// link's frame. Any length but 0.
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  /// Origin of this link's frame in the previous link's frame, at coordinate 0.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::vector<ErrorDirection> errors = {};  // each at most once
};

/// The chain of homogeneous transformations from a machine's base to its tool
/// and to its workpiece (NISTIR 5367, section 3.1, Eq. 1 to 6).
///
/// The transformation of a link with coordinate q and errors d (3 lengths) and
/// e (3 angles) is
///
///   T(offset + q axis + d) R(e)               linear (fixed: without q)
///   T(offset + d) R(e) R(axis, q)             rotary
///
/// R(e) turns by |e| about e, so that no order of the three is preferred. An
/// angular error turns all later links of its branch about the link's own
/// origin. The error at the tool is tool minus work in the base frame: the
/// position of the tip minus that of the workpiece point which the nominal tip
/// touches.
///
/// In the functions below, `coordinates` are those of the moving links and
/// `errors` those of all links, both in the order of the links.
class KinematicChain {
 public:
  /// Throws std::invalid_argument naming the link, if a name is empty or used
  /// twice, or a moving joint has an axis of length 0. Also if a number is not
  /// finite, an error is given twice, or no link is on the tool's branch.
  explicit KinematicChain(std::vector<KinematicLink> links);

  /// An error of a link.
  struct ErrorPlace {
    Index link = 0;
    ErrorDirection direction = ErrorDirection::kX;
  };

  const std::vector<KinematicLink>& links() const { return links_; }
  const std::vector<ErrorPlace>& errors() const { return errors_; }
  Index num_coordinates() const { return num_coordinates_; }
  Index num_errors() const { return std::ssize(errors_); }

  /// Returns the tip minus the work's origin (3), without errors, along the
  /// axes of the base. Like all functions below, it throws
  /// std::invalid_argument for a wrong number of coordinates or errors.
  Eigen::Vector3d NominalReach(const VectorXd& coordinates) const;

  /// Returns tool minus work (3) by the product of the matrices.
  Eigen::Vector3d ExactError(const VectorXd& coordinates,
                             const VectorXd& errors) const;

  /// Returns the derivatives (3 x errors) of ExactError at errors of 0. For a
  /// length this is its unit vector, for an angle its rotation axis times the
  /// arm; both are negative on the work's branch. Multiplied by the errors,
  /// they give ExactError to first order (section 3.1).
  Eigen::Matrix3Xd Sensitivities(const VectorXd& coordinates) const;

 private:
  struct Ends {
    Eigen::Isometry3d tool;
    Eigen::Isometry3d work;
  };

  void CheckSizes(const VectorXd& coordinates, const VectorXd* errors) const;
  Eigen::Isometry3d StepOf(const KinematicLink& link,
                           double coordinate,
                           const double* errors) const;
  Ends EndsOf(const VectorXd& coordinates, const VectorXd* errors) const;

  std::vector<KinematicLink> links_;
  std::vector<ErrorPlace> errors_;
  Index num_coordinates_ = 0;
};

}  // namespace errmap::models
