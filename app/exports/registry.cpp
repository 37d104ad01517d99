#include "app/exports/registry.hpp"

#include "app/exports/crease_export.hpp"
#include "app/exports/design_export.hpp"
#include "app/exports/pictures_export.hpp"
#include "app/exports/report_export.hpp"

namespace kinetix::app {
namespace {

std::vector<const Exporter*>& all() {
  static std::vector<const Exporter*> list = {
      &design_export,
      &crease_export,
      &pictures_export,
      &report_export,
  };
  return list;
}

}  // namespace

const std::vector<const Exporter*>& exporters() { return all(); }

void add_exporter(const Exporter& exporter) { all().push_back(&exporter); }

}  // namespace kinetix::app
