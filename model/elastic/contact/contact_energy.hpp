#pragma once

#include "model/elastic/contact/contact_search.hpp"
#include "model/elastic/contact/point_gap.hpp"

namespace kinetix::model {

/// Contact of walls of thickness w: points of half walls (ContactPlates) against the boxes of other half
/// walls. Energy per point: 1/2 contact depth^2; in space a third of that, since a wall tip edge has three
/// points. The depth is measured to the nearest of the two sides, the end and (in space) top and bottom. It
/// is linear in the carried point. Energies are in units of k_point edge^2, stiffnesses of k_point.
///
/// As in the simulation, the two halves of one wall do not touch each other, nor do plates of one body or
/// plates that touch in the flat state. Some crossings cause no force: walls in the plane without a point
/// inside, and wall tip edges in space that cross between their points. newly_cross() detects both.
class ContactModel {
 public:
  /// @param planar as of contact_plates()
  ContactModel(const Linkage& structure, bool planar);

  const std::optional<WallPair>& overlap_at_rest() const { return search_.overlap_at_rest(); }
  const std::vector<Contact>& find(const State& state) { return search_.find(state); }
  bool passed_through(const State& before, const State& after) {
    return search_.passed_through(before, after);
  }
  bool sweep_through(const State& before, const State& after) { return search_.sweep_through(before, after); }
  bool newly_cross(const State& before, const State& after) { return search_.newly_cross(before, after); }

  int body(int plate) const { return all().plates[plate].body; }
  static int hinge(int plate) { return plate / 2; }

  /// Returns the energy of a contact. Body a is that of the point, b that of the box.
  Element element(const Contact& contact, double stiffness, const State& state) const;
  double energy(const std::vector<Contact>& contacts, double stiffness) const;

  /// Derivatives by t, alpha and beta of contact.plate's hinge, then of contact.other's.
  using ByTwoHinges = Eigen::Matrix<double, 6, 1>;
  /// Returns the derivatives of the gradient of a contact's energy, one column per parameter.
  Eigen::Matrix<double, 12, 6> derivatives(const Contact& contact, double stiffness,
                                           const State& state) const;
  /// Returns the derivative of the gradient of a contact's energy by the contact stiffness.
  Vector12 stiffness_rate(const Contact& contact, const State& state) const;
  /// Returns the derivatives of the depth of a contact.
  ByTwoHinges depth_gradient(const Contact& contact, const State& state) const;

 private:
  const ContactPlates& all() const { return search_.all(); }
  PointGap gap(const Contact& contact, const State& state) const;
  ByTwoHinges gap_gradient(const PointGap& gap, const Contact& contact, const State& state) const;

  ContactSearch search_;
  double weight_;  ///< of a point's energy, shared with others on the same wall tip edge
};

}  // namespace kinetix::model
