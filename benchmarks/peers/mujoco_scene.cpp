#include "benchmarks/peers/mujoco_scene.hpp"

#include <fmt/format.h>

#include "model/lattice/square/family/net.hpp"

namespace kinetix::bench {
namespace {

using Eigen::Vector3d;

std::string text(const Vector3d& v) { return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z()); }

class Scene {
 public:
  Scene(const model::Structure& structure, const std::vector<MujocoLink>& links, int driven_hinge,
        const MujocoSettings& settings)
      : structure_(structure), links_(links), driven_hinge_(driven_hinge), settings_(settings) {
    children_.resize(links.size());
    for (int b = 0; b < bodies(); ++b)
      if (links[b].parent >= 0) children_[links[b].parent].push_back(b);
  }

  std::string xml() const {
    std::string out = "<mujoco>\n" + head() + "<worldbody>\n";
    for (int b = 0; b < bodies(); ++b)
      if (links_[b].parent < 0) add_body(b, out);
    return out + "</worldbody>\n<equality>\n" + drive() + loops() + "</equality>\n</mujoco>\n";
  }

 private:
  int bodies() const { return static_cast<int>(links_.size()); }
  Vector3d place(int body) const { return structure_.rest_position(body) / structure_.size.edge_mm; }
  Vector3d place(const model::Hinge& hinge) const {
    return structure_.hinge_point(hinge) / structure_.size.edge_mm;
  }
  bool is_joint(int hinge) const {
    const model::Hinge& h = structure_.hinges[hinge];
    return links_[h.lower].hinge == hinge || links_[h.upper].hinge == hinge;
  }

  std::string head() const {
    const std::size_t dofs = 6 * links_.size(), rows = 6 * structure_.hinges.size() + 1;
    const double h = settings_.step_s;
    return fmt::format(
        "<size njmax=\"{}\" nconmax=\"1\" nstack=\"{}\"/>\n"
        "<option timestep=\"{:.17g}\" integrator=\"{}\" solver=\"{}\" iterations=\"{}\" tolerance=\"{}\" "
        "gravity=\"0 0 0\"><flag contact=\"disable\" gravity=\"disable\" sensor=\"disable\"/></option>\n"
        "<default><equality solref=\"{:.17g} {:.17g}\" solimp=\"{} {} 1 0.5 1\"/></default>\n",
        rows, 8 * dofs * dofs + 4 * rows * dofs + 100000, h,
        settings_.integrator == MujocoSettings::Integrator::euler ? "Euler" : "implicit",
        settings_.solver == MujocoSettings::Solver::newton ? "Newton" : "CG", settings_.iterations,
        settings_.tolerance, -settings_.error_reduction / (h * h), -1 / h, settings_.impedance,
        settings_.impedance);
  }

  void add_body(int body, std::string& out) const {
    const MujocoLink& link = links_[body];
    const Vector3d from = link.parent < 0 ? Vector3d::Zero().eval() : place(link.parent);
    out += fmt::format("<body name=\"b{}\" pos=\"{}\">", body, text(place(body) - from));
    out += fmt::format("<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"{0} {0} {0}\"/>",
                       settings_.part_inertia);
    out += link.parent < 0 ? "<freejoint/>\n" : joint(body, link.hinge);
    for (const int child : children_[body]) add_body(child, out);
    out += "</body>\n";
  }

  std::string joint(int body, int index) const {
    const model::Hinge& hinge = structure_.hinges[index];
    return fmt::format("<joint name=\"j{}\" type=\"hinge\" pos=\"{}\" axis=\"{}\"/>\n", index,
                       text(place(hinge) - place(body)), text(hinge_axis(hinge.wall.axis, hinge.parameters)));
  }

  std::string drive() const {
    return fmt::format("<joint joint1=\"j{}\" polycoef=\"0 0 0 0 0\"/>\n", driven_hinge_);
  }

  std::string loops() const {
    std::string out;
    for (std::size_t h = 0; h < structure_.hinges.size(); ++h)
      if (!is_joint(static_cast<int>(h))) out += points(structure_.hinges[h]);
    return out;
  }

  std::string points(const model::Hinge& hinge) const {
    const Vector3d arm = settings_.reach * hinge_axis(hinge.wall.axis, hinge.parameters);
    std::string out;
    for (const double side : {1.0, -1.0})
      out += fmt::format("<connect body1=\"b{}\" body2=\"b{}\" anchor=\"{}\"/>\n", hinge.lower, hinge.upper,
                         text(place(hinge) + side * arm - place(hinge.lower)));
    return out;
  }

  const model::Structure& structure_;
  const std::vector<MujocoLink>& links_;
  const int driven_hinge_;
  const MujocoSettings& settings_;
  std::vector<std::vector<int>> children_;
};

}  // namespace

std::vector<MujocoLink> mujoco_links(const model::Structure& structure, int driven_hinge,
                                     MujocoSettings::Bodies bodies) {
  const model::Hinge& driven = structure.hinges[driven_hinge];
  std::vector<MujocoLink> links(structure.bodies.size());
  if (bodies == MujocoSettings::Bodies::tree)
    for (const model::NetTree::Link& link : make_net_tree(structure, driven.lower).links)
      links[link.body] = {link.parent, link.hinge};
  links[driven.upper] = {driven.lower, driven_hinge};
  return links;
}

std::string mujoco_scene(const model::Structure& structure, const std::vector<MujocoLink>& links,
                         int driven_hinge, const MujocoSettings& settings) {
  return Scene(structure, links, driven_hinge, settings).xml();
}

}  // namespace kinetix::bench
