#include "app/print/format/print_format.hpp"

#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {

const std::vector<const PrintFormat*>& print_formats() {
  static const std::vector<const PrintFormat*> list = {
      &stl_format, &threemf_format, &step_format, &svg_format,
      &dxf_format, &mjcf_format,    &glb_format,  &scad_format,
  };
  return list;
}

const PrintFormat& print_format(std::string_view name) {
  std::vector<std::string_view> names;
  for (const PrintFormat* format : print_formats()) {
    if (format->name == name) return *format;
    names.push_back(format->name);
  }
  names.push_back("all");
  throw InvalidInput("--format: unknown format " + targets::in_ticks(name) +
                     targets::did_you_mean(name, names) + "; allowed: " + targets::joined(names));
}

}  // namespace kinetix::app
