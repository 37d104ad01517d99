#include "app/imports/hinge_choices.hpp"

#include "app/files/file_header.hpp"
#include "targets/document/section.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;

targets::ValueType axis_type() { return value::list(value::number(), "`[x, y, z]`", 3, 3); }

const targets::KeyTable& choice_keys() {
  static const targets::KeyTable keys({
      {"hinge", value::text("name of a soft part"), targets::otherwise("`bodies`"), "the soft part"},
      {"bodies", value::list(value::text("name of a body"), "`[name, name]`", 2, 2),
       targets::otherwise("`hinge`"), "the two bodies that it joins, instead of its name"},
      {"axis", axis_type(), targets::needed, "its axis at rest, of any length"},
  });
  return keys;
}

Eigen::Vector3d read_axis(const targets::Node& node) {
  const auto entries = node.list_of(3, "a direction [x, y, z]");
  const Eigen::Vector3d v(entries[0].number(), entries[1].number(), entries[2].number());
  if (!(v.norm() > 0)) throw node.error("is not a direction: all three numbers are 0");
  return v.normalized();
}

std::string key_of(const targets::Section& entry) {
  const auto hinge = entry.optional("hinge"), bodies = entry.optional("bodies");
  if (hinge.has_value() == bodies.has_value())
    throw entry.error("needs `hinge` or `bodies`, and one of them only");
  if (hinge) return hinge->text("name of a soft part");
  const auto ends = bodies->list_of(2, "the names of two bodies");
  return ends[0].text("name of a body") + "/" + ends[1].text("name of a body");
}

}  // namespace

const targets::KeyTable& hinge_choice_keys() {
  static const targets::KeyTable keys({
      {"kinetix", value::integer(1, 1), targets::needed, "version of the file format"},
      {"hinges", value::list(value::map(choice_keys()), "a list of hinges", 0), targets::no_default,
       "hinges whose axis is set by hand"},
      {"towards", axis_type(), targets::no_default,
       "of ambiguous hinges that are not listed: the axis nearer to this direction is taken"},
  });
  return keys;
}

model::HingeChoices read_hinge_choices(const std::string& file) {
  const targets::Section root = read_root(targets::read_document(file), hinge_choice_keys());
  model::HingeChoices out;
  if (const auto list = root.optional("hinges"))
    for (const targets::Node& entry : list->list("a list of hinges")) {
      const targets::Section section(entry, choice_keys());
      if (!out.axes
               .try_emplace(key_of(section),
                            read_axis(section.required("axis", "its axis, e.g. `axis: [0, 0, 1]`")))
               .second)
        throw entry.error("names a hinge that is named before");
    }
  if (const auto towards = root.optional("towards")) out.towards = read_axis(*towards);
  return out;
}

}  // namespace kinetix::app
