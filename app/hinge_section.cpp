#include "app/hinge_section.hpp"

namespace kinetix {

HingeSection read_hinge_section(const Node& root, double edge_mm) {
  using Model = HingeSection::Model;
  HingeSection hinge;
  const auto section = root.optional("hinge");
  if (!section) return hinge;
  section->reject_unknown_keys({"model", "k_point", "k_turn", "reach_mm", "k_contact"});
  if (const auto node = section->optional("model"))
    hinge.model = node->choice<Model>({{"rotary", Model::rotary}, {"elastic", Model::elastic}});
  if (const auto node = section->optional("k_point")) hinge.k_point = node->number(above(0, "N/mm"));
  if (const auto node = section->optional("k_turn"))
    hinge.k_turn =
        node->number(hinge.model == Model::elastic ? above(0, "N mm/rad") : at_least(0, "N mm/rad"));
  if (const auto node = section->optional("reach_mm"))
    hinge.reach_mm = node->number(from_to(0.01 * edge_mm, 10 * edge_mm, "mm (0.01 to 10 cells)"));
  if (const auto node = section->optional("k_contact")) hinge.k_contact = node->number(above(0, "N/mm"));
  return hinge;
}

}  // namespace kinetix
