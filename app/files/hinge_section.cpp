#include "app/files/hinge_section.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using Model = HingeSection::Model;

// What the key `model` may say.
constexpr targets::Word<Model> models[] = {{"rotary", Model::rotary}, {"elastic", Model::elastic}};

std::vector<targets::Key> keys_with(targets::Key model) {
  static const HingeSection usual{};
  return {
      std::move(model),
      {"k_point", value::number(targets::above(0, "N/mm")), targets::by_default(usual.k_point),
       "stiffness against pulling the two halves of a wall apart, in every direction"},
      {"k_turn", value::number(targets::at_least(0, "N mm/rad")), targets::by_default(usual.k_turn),
       "stiffness against turning; above 0 where hinges are elastic"},
      {"reach_mm", value::length(targets::from_to(0.01, 10, "mm (0.01 to 10 cells)")),
       targets::otherwise("0.18 cells"),
       "half distance of the two points at which a hinge holds its bodies together: what makes it resist "
       "tilting"},
      {"k_contact", value::number(targets::above(0, "N/mm")), targets::otherwise("10 `k_point`"),
       "stiffness of two walls pressed together"},
  };
}

HingeSection read_section(const targets::Section& root, double edge_mm, HingeSection hinge) {
  const targets::Section section = root.section("hinge");
  if (const auto node = section.optional("model")) hinge.model = read_word(*node, models);
  section.read("k_point", hinge.k_point);
  section.read(
      "k_turn", hinge.k_turn,
      hinge.model == Model::elastic ? targets::above(0, "N mm/rad") : targets::at_least(0, "N mm/rad"));
  section.read_length("reach_mm", hinge.reach_mm, edge_mm);
  section.read("k_contact", hinge.k_contact);
  return hinge;
}

}  // namespace

const targets::KeyTable& hinge_keys() {
  static const targets::KeyTable keys(
      keys_with(
          {"model", value::choice(models), targets::by_default("rotary"),
           "`rotary`: joints that cannot stretch; `elastic`: joints that give by the stiffnesses below"}),
      {}, "Section hinge");
  return keys;
}

targets::KeyTable elastic_hinge_keys() {
  return targets::KeyTable(keys_with({"model", value::choice({"elastic"}), targets::by_default("elastic"),
                                      "joints that give by the stiffnesses below"}));
}

HingeSection read_hinge_section(const targets::Section& root, double edge_mm) {
  return read_section(root, edge_mm, {});
}

HingeSection read_elastic_hinge_section(const targets::Section& root, double edge_mm) {
  const HingeSection hinge = read_section(root, edge_mm, {.model = Model::elastic, .reach_mm = {}});
  if (hinge.model == Model::rotary)
    throw root.section("hinge").optional("model")->error(
        "`rotary` hinges cannot stretch, which the picture needs; allowed for a display: elastic");
  return hinge;
}

}  // namespace kinetix::app
