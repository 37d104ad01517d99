#include "app/pipeline/print_hinges.hpp"

#include <algorithm>
#include <cmath>

#include "app/pipeline/physics_settings.hpp"
#include "app/run/design_hinges.hpp"
#include "model/closure/closure_drive.hpp"
#include "model/closure/drive_theta.hpp"
#include "model/matter/hinge_strain.hpp"
#include "model/solids/open_hinge.hpp"

namespace kinetix::app {
namespace {

constexpr double part = 1e-4;  // rad of theta, to either side: what differences of energies are taken over

/// A block that does for all hinges in a state. Along an exact motion nothing pulls them apart: what rounding leaves is none.
model::MadeHinge soft_block(const Found& found, const model::Linkage& linkage, const model::State& design) {
  const model::CellSize size = linkage.size;
  model::MadeHinge block = open_hinge(model::HingeKind::block, found.design.process, size);
  for (int h = 0; h < found.design.structure.hinges(); ++h) {
    const double stretch = found.plan.exact ? 0 : edge_stretch_mm(linkage, design, h, block.height_mm);
    block.gap_mm = std::max(block.gap_mm, open_gap_mm(block, size.thickness_mm,
                                                      found.design.structure.hinge(h).offset * size.edge_mm,
                                                      hinge_turn(linkage, design, h), stretch));
  }
  return block;
}

/// Energy of all turns in the exact state at theta, N mm. @param k_turn of each hinge, N mm/rad
double turning_energy(const Found& found, const model::Linkage& linkage, double k_turn, double theta) {
  const model::State state = found.plan.exact.at(theta);
  double sum = 0;
  for (int h = 0; h < found.design.structure.hinges(); ++h) {
    const double turn = hinge_turn(linkage, state, h);
    sum += k_turn * turn * turn / 2;
  }
  return sum;
}

/// What the drive must hold if springs alone stand against it, N or N mm. Plates close in as the sheet does, which need not be
/// by the cosine of its theta.
double holding_load(const Found& found, const model::LinkageDrive& drive, const model::Linkage& linkage,
                    const model::Elasticity& elasticity) {
  const auto energy = [&](double at) { return turning_energy(found, linkage, elasticity.k_turn, at); };
  const auto way = [&](double at) { return way_of(drive, linkage, found.plan.exact.at(at)); };
  const double more = found.theta + part, less = found.theta - part;
  return (energy(more) - energy(less)) / (way(more) - way(less));
}

model::Elasticity set_at(const model::MadeHinge& made, double turn) {
  model::Elasticity out = elasticity_of(made);
  out.law = std::make_shared<model::SetHinge>(turn);
  return out;
}

}  // namespace

PrintHinges print_hinges(const Found& found, const model::LinkageDrive& drive, const model::State& design) {
  if (found.design.hinge.model == HingeSection::Model::elastic)
    return {elasticity_of(found.design), drive, std::nullopt};
  const model::Linkage linkage(found.design.structure);
  const model::MadeHinge block = soft_block(found, linkage, design);
  PrintHinges out{elasticity_of(block), {}, std::nullopt};
  const model::Elasticity soft = out.elasticity;
  int open = 0;
  double largest_strain = 0;
  for (int h = 0; h < found.design.structure.hinges(); ++h) {
    const auto& made = hinge_section(found.design, h).made;
    const double turn = hinge_turn(linkage, design, h);
    out.elasticity.each.push_back(set_at(made.value_or(block), turn));
    out.elasticity.k_point = std::max(out.elasticity.k_point, out.elasticity.each.back().k_point);
    if (made) continue;
    ++open;
    largest_strain = std::max(largest_strain, hinge_strain(block, linkage, design, h));
  }
  if (open == 0) return out;
  out.taken = TakenHinges{.made = block, .strain = largest_strain};
  if (open == found.design.structure.hinges() && found.plan.exact && drive.acts_from_outside())
    out.taken->load = holding_load(found, drive, linkage, soft);
  out.taken->is_force = drive.has_force();
  return out;
}

model::Elasticity set_in(model::Elasticity elasticity, const model::Linkage& linkage,
                         const model::State& state) {
  if (elasticity.each.empty()) elasticity.each.assign(linkage.hinges.size(), elasticity);
  for (std::size_t h = 0; h < linkage.hinges.size(); ++h)
    elasticity.each[h].law =
        std::make_shared<model::SetHinge>(hinge_turn(linkage, state, static_cast<int>(h)));
  return elasticity;
}

}  // namespace kinetix::app
