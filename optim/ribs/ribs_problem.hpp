#pragma once

#include "model/lattice/square/family/net.hpp"
#include "model/lattice/square/fishbone.hpp"
#include "optim/solvers/arrow_solver.hpp"
#include "optim/solvers/solver.hpp"
#include "targets/curve/space_curve.hpp"
#include "targets/mesh/triangle_tree.hpp"

namespace kinetix::optim {

/// Goal of a fishbone, in a frame with z up and y along the spine.
struct RibsGoal {
  const targets::MeshDistance* surface = nullptr;
  double clearance_mm = 0;
  double rim_z = 0;     ///< height of both ends of the spine, mm
  double middle_x = 0;  ///< of the spine, mm
};

/// Unknowns of a fishbone.
struct RibsShape {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();   ///< rotation vector of the root's panel, rad
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< of the root, mm
  double theta = 0;                                 ///< rad
  std::vector<double> spine;                        ///< tilts of the spine's creases, rad
  /// Tilts of each rib and side, rad, from the spine outwards.
  std::vector<std::array<std::vector<double>, 2>> ribs;
};

/// Returns a folded net moved as a whole.
/// @param root body that is moved to `place`   @param turn rotation vector, rad   @param place mm
model::State placed(model::State state, int root, const Eigen::Vector3d& turn, const Eigen::Vector3d& place);

/// Rms distance, in cell edges, at which |r| = 1 in a RibsProblem.
inline constexpr double ribs_residual_in_cells = 0.1;

/// Fit of a fishbone to a surface: all tilts, one theta and its place, by least squares.
///
/// Residuals, in this order:
/// - Distance to the surface minus the clearance, for every body and every hinge point. It is over the square
/// root of their number and in units of a tenth of the cell edge, so |r| is ten times the rms distance in
/// cell edges.
/// - Heights of the spine's ends above the rim and their distances from the middle, with a weight of 0.1.
/// - Every tilt with a weight of 0.001, which keeps tilts small that affect no distance.
/// The variables of a part are the tilts of one side of one rib. The place is in units of the cell edge.
class RibsProblem final : public ArrowProblem {
 public:
  /// @param fishbone its root is the middle of the spine; references to it and the surface are kept.
  /// @param tilt limit of all tilts, rad   @param theta bounds, rad, within (0, pi/2)
  RibsProblem(const model::Fishbone& fishbone, const RibsGoal& goal, double tilt, const AngleRange& theta);

  int shared() const override { return fixed_shared + static_cast<int>(fishbone_.spine.size()); }
  const std::vector<int>& parts() const override { return parts_; }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  const std::vector<int>& residuals() const override { return residuals_; }
  bool evaluate(const Eigen::VectorXd& x, bool with_derivatives,
                std::vector<ResidualBlock>& blocks) const override;

  Eigen::VectorXd pack(const RibsShape& shape) const;
  RibsShape unpack(const Eigen::VectorXd& x) const;
  /// Returns a copy of the fishbone's structure with the tilts of x.
  model::Structure structure(const Eigen::VectorXd& x) const;
  /// Returns the state in the goal's frame, mm.
  model::State state(const Eigen::VectorXd& x) const;

 private:
  static constexpr int fixed_shared = 7;  // variables before the tilts: turn (3), place (3), theta

  /// Point of a body whose distance counts.
  struct Probe {
    int body = 0;
    Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< in the body, mm
  };
  /// Crease on the path from the root to a body.
  struct Step {
    int link = 0;      ///< of the tree
    int variable = 0;  ///< index in x
    int sign = 1;      ///< alternation of the link's wall
  };

  void index_variables();
  void place_probes();
  void find_hinge_paths();
  int part_of(int body) const;
  void fill(const model::NetMotion& motion, const Eigen::VectorXd& x, bool with_derivatives, int part,
            ResidualBlock& block) const;
  void fill_probe(const model::NetMotion& motion, const Eigen::VectorXd& x, bool with_derivatives, int part,
                  const Probe& probe, int row, ResidualBlock& block) const;
  void fill_ends(const model::NetMotion& motion, const Eigen::VectorXd& x, bool with_derivatives, int row,
                 ResidualBlock& block) const;
  Eigen::VectorXd derivatives_of(const model::NetMotion& motion, const Eigen::VectorXd& x, const Probe& probe,
                                 const Eigen::Vector3d& direction, int part) const;
  Eigen::Vector3d in_place(const model::NetMotion& motion, const Eigen::VectorXd& x,
                           const Probe& probe) const;

  const model::Fishbone& fishbone_;
  RibsGoal goal_;
  model::NetTree tree_;
  std::vector<int> parts_, residuals_, first_;  // first_: index in x of each part's first variable
  std::vector<int> variable_of_hinge_;          // index in x, or -1
  std::vector<std::vector<Probe>> probes_;      // of each part; the last are those of the spine
  std::vector<std::vector<Step>> hinge_paths_;  // of each body
  std::array<std::array<int, 2>, 2> ends_;      // bodies of the spine's ends
  int count_ = 0;
  Eigen::VectorXd lower_, upper_;
};

/// Specification of a fishbone, in a frame with z up, y along the spine.
struct RibsSpec {
  model::CellSize size = {};
  int ribs = 8;                           ///< >= 1
  std::optional<double> spacing_mm;       ///< between the middles of ribs along the spine, mm;
                                          ///< overrides `ribs`, rounded to even spaces
  double clearance_mm = 5;                ///< from the surface, mm, >= 0
  double coverage_mm = 90;                ///< height of the crown above the rim, mm, > 0
  double tilt = 60 * radians_per_degree;  ///< limit of all tilts, rad, (0, pi/2)
  AngleRange theta = {2 * radians_per_degree, 40 * radians_per_degree};
  double start_theta = 30 * radians_per_degree;  ///< theta at which cells are counted, rad
};

/// Fishbone that suits a surface, folded as its curves alone suggest.
struct RibsLayout {
  model::FishboneLayout spine_and_ribs;
  RibsShape start;
  targets::SpaceCurve spine;  ///< at the clearance, from its end of least y over the crown, mm
  std::vector<std::array<targets::SpaceCurve, 2>>
      sections;                    ///< curves of each rib, from the spine to -x and to +x
  double rim_z = 0;                ///< mm
  std::vector<std::string> notes;  ///< ribs that end above the rim, with the reason
};

/// Plane of a rib, normal to the spine.
struct RibPlane {
  Eigen::Vector3d p, along;  ///< a point of the spine, mm, and the spine's direction there
  double beyond(const Eigen::Vector3d& q) const { return (q - p).dot(along); }
  Eigen::Vector3d outward() const { return Eigen::Vector3d::UnitX().cross(along); }
};

/// Planes of all ribs, with the room that a rib needs.
struct RibPlanes {
  std::vector<RibPlane> planes;  ///< of all ribs
  double width = 0;              ///< least distance of a rib from the plane of its neighbour, mm
  double pitch = 0;              ///< pitch of folded cells, mm

  /// Returns whether the rib meets its neighbour at p. Every other rib ends next to its neighbours; those
  /// between continue until they meet each other.
  bool meets_neighbour(std::size_t rib, const Eigen::Vector3d& p) const;
};

/// Returns the line of a rib from the spine to its end, to -x (side -1) or +x (side 1).
using TraceRib = std::function<targets::SpaceCurve(const RibPlanes& planes, std::size_t rib, int side)>;

/// Lays out ribs evenly along a spine, with as many cells on each as its line is long. Tilts follow from the
/// slopes.
/// @param spine in a plane x = const, from its end of least y.
/// @param span_mm to either side, for directions of curves, mm, > 0.
/// @return rim_z and notes are left to the caller.
/// @throws InvalidInput for a spine shorter than two cells, and ribs that overlap flat
RibsLayout layout_along(const targets::SpaceCurve& spine, double span_mm, const RibsSpec& spec,
                        const TraceRib& trace);

}  // namespace kinetix::optim
